#pragma once
/// The shots of a cell: where each one starts, and when it first touches the wall. No method under test is in here.
///
/// Every coordinate is a multiple of a power of two that float holds exactly, axis by axis. So pose k is start + k s
/// without rounding, and both scalars are asked the very same question: what differs is a method's own arithmetic.

#include <cstdint>

#include <thinwall/experiments/thin_wall/cell.hpp>

namespace thinwall {

/// A cell as it is fired: the wall around the origin, the ball, and the grid its poses lie on. All in meters.
/// Against the cell, a step is at most one grid unit shorter and the wall and ball at most one float wider, so that
/// what theory says cannot happen cannot be made to happen by rounding.
struct Target {
  Vec3<double> half_extents;  ///< of the wall; beyond every shot's reach where it is infinite
  double radius;
  Vec3<double> displacement;  ///< of a step; >= 0 on every axis, z = 0
  Vec3<double> grid;          ///< coordinates are multiples of it
  double step_length;         ///< |displacement|
  double lateness_unit;       ///< 2^-32 of a power of two that no shot outlives: lateness is summed in whole units
  Wall wall;
};
Target target(const Cell& cell);

/// The start of a shot less than two steps before it can touch anything. Phase uniform over a step; on a finite wall
/// the line is uniform over the wall's shadow, rim included, by rejection.
Vec3<double> random_start(const Target& target, const RandomStream& stream, std::uint64_t trial);

/// The same for an infinite wall and a given phase in [0, 1).
Vec3<double> start_at_phase(const Target& target, double phase);

/// [m] From the ball's surface to the wall; < 0 where they overlap.
double gap(const Target& target, const Vec3<double>& position);

/// The path length [m] from the start to first contact, by Newton's method on the distance from the center to the box:
/// it is convex along the line, so the iterates rise to contact and never pass it.
/// Degenerate: a line that grazes, and for rounding misses, yields its closest approach.
double path_to_contact(const Target& target, const Vec3<double>& start);

/// The ball is beyond the wall on some axis and moving away: it cannot touch any more.
bool is_past(const Target& target, const Vec3<double>& position);

}  // namespace thinwall
