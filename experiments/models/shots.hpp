#pragma once
/// The thin wall: the conditions, the shots of each, and when a shot first touches the wall. No method under test is in here.
///
/// A ball flies straight at a wall, in steps. The wall's front faces -x, its side runs along y and z, and the ball flies in the
/// plane of x and y. Every coordinate is a multiple of a power of two that float holds exactly, axis by axis. So pose k is
/// start + k s without rounding, and both scalars are asked the very same question: what differs is a method's own arithmetic.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <thinwall/experiments/lab/random.hpp>
#include <thinwall/experiments/lab/text.hpp>
#include <thinwall/experiments/models/tunneling_theory.hpp>

namespace thinwall {

enum class Wall { infinite, finite };

struct Cell {
  double speed;      ///< [m/s] > 0
  double step;       ///< [s] > 0
  double radius;     ///< [m] >= 0; not both 0 with thickness
  double thickness;  ///< [m] >= 0
  double angle_deg;  ///< [deg] in [0, 90), between the motion and the wall's normal
  Wall wall = Wall::infinite;
  double wall_size = 0;  ///< [m] side of the square wall; 0 if it is infinite

  bool operator==(const Cell&) const = default;
};

inline constexpr Range allowed_speed = {.lower = 0, .upper = 1e9, .lower_open = true, .unit = "m/s"};
inline constexpr Range allowed_step = {.lower = 0, .upper = 1e3, .lower_open = true, .unit = "s"};
inline constexpr Range allowed_radius = {.lower = 0, .upper = 1e3, .unit = "m"};
inline constexpr Range allowed_thickness = {.lower = 0, .upper = 1e3, .unit = "m"};
inline constexpr Range allowed_angle = {.lower = 0, .upper = 89.9, .unit = "deg"};

/// The bullet of the textbook: 10 m/s, 60 steps a second, before the wall at one frame and behind it at the next.
/// Ball and wall together are 5 cm thick and a step is 17 cm, so that it is missed 7 times in 10.
inline constexpr Cell bullet = {.speed = 10, .step = 1.0 / 60, .radius = 0.02, .thickness = 0.01, .angle_deg = 0};

/// What keeps a cell, each of whose numbers is in its range, from being fired: which of them, and what is expected of it. `speed` may be
/// the fault of `step` as well.
struct CellFault {
  std::string_view key;
  std::string expected;
};
std::optional<CellFault> fault_of(const Cell& cell);

double step_length(const Cell& cell);      ///< [m] s = speed * step
double cosine(const Cell& cell);           ///< [1] of the angle of incidence, > 0
Vec3<double> direction(const Cell& cell);  ///< unit
double slab_chord(const Cell& cell);       ///< [m] (w + 2 r) / cosine: in contact with the wall's plane
RoundedBox rounded_box(const Cell& cell);  ///< of a finite wall
RandomStream random_stream(const Cell& cell, std::uint64_t seed);  ///< from the physical factors alone

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

}  // namespace thinwall
