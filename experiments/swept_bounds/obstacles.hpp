#pragma once
/// The balls at rest that a cell's bounds are asked about, and whether the moving shape truly touches them. No bound and no
/// query of the library is in here.

#include <cstdint>

#include <thinwall/experiments/swept_bounds/theory.hpp>

namespace thinwall {

/// Its center is uniform over the region.
Sphere<double> ball_in(const BallRegion& region, const Sweep& s, const RandomStream& stream, std::uint64_t trial);

/// A ball that just touches the moving shape at some time: in a direction uniform over the sphere, where the swept volume
/// and the ball reach farthest, and then a millionth of the way to the middle of the path. A bound that is too small by
/// more anywhere misses some of these.
Sphere<double> grazing_ball(const Sweep& s, const RandomStream& stream, std::uint64_t trial);

/// True if the moving shape touches the ball at some time of the step. The squared distance of the ball's center is convex
/// in time and its derivative is in straight pieces, so its least value has a formula; in long double.
bool touches(const Sweep& s, const Vec3<double>& center);

/// [m] The least distance from the center to the moving shape, over the step; 0 inside.
long double least_distance(const Sweep& s, const Vec3<double>& center);

}  // namespace thinwall
