#pragma once
/// The balls at rest that a cell's bounds are asked about, and whether the moving shape truly touches them. No bound and no
/// query of the library is in here.

#include <cstdint>

#include <thinwall/experiments/swept_bounds/theory.hpp>

namespace thinwall {

/// Its center is uniform over the region.
Sphere<double> ball_in(const BallRegion& region, const Sweep& s, const RandomStream& stream, std::uint64_t trial);

/// A ball that just touches the moving shape at some time: in some direction, where the swept volume and the ball reach
/// farthest, and then a millionth of the way to the middle of the path. Half of the directions are uniform over the
/// sphere; the others are those in which a bound can be tight: along `axes`, and from the center to a corner. A tight bound
/// that is too small there misses these balls.
Sphere<double> grazing_ball(const Sweep& s, const Mat3<double>& axes, const RandomStream& stream, std::uint64_t trial);

/// True if the moving shape touches the ball at some time of the step. The squared distance of the ball's center is convex
/// in time and its derivative is in straight pieces, so its least value has a formula; in long double.
bool touches(const Sweep& s, const Vec3<double>& center);

/// [m] The least distance from the center to the moving shape, over the step; 0 inside.
long double least_distance(const Sweep& s, const Vec3<double>& center);

}  // namespace thinwall
