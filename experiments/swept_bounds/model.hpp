#pragma once
/// A shape that moves straight through one step among balls at rest: the conditions, the balls, and whether the shape truly
/// touches them. No bound and no query of the library is in here.

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include <thinwall/discrete/aabb.hpp>
#include <thinwall/discrete/sphere.hpp>
#include <thinwall/experiments/lab/factors.hpp>
#include <thinwall/swept/moving.hpp>

namespace thinwall {

enum class SweptForm { sphere, cube, plate, rod };
inline constexpr std::array<std::string_view, 4> swept_form_names = {"sphere", "cube", "plate", "rod"};
constexpr std::string_view name(SweptForm form) { return swept_form_names[static_cast<std::size_t>(form)]; }

struct Sweep {
  SweptForm form;
  double speed;      ///< [m/s] > 0
  double step;       ///< [s] > 0
  double width;      ///< [m] > 0: diameter of the sphere, longest edge of a box
  double angle_deg;  ///< [deg] in [0, 90], between the motion and x
  double turn_deg;   ///< [deg] in [0, 90]: 0 leans towards y, 90 towards z; 0 where angle_deg is
  double obstacle;   ///< [widths] >= 0: diameter of the balls; 0 is a point

  bool operator==(const Sweep&) const = default;
};

/// The textbook's picture: a ball and a cube that move along a diagonal, as fast as its bullet, among balls as wide.
inline constexpr std::array diagonals = {Sweep{SweptForm::sphere, 10, 1.0 / 60, 0.04, 45, 0, 1},
                                         Sweep{SweptForm::cube, 10, 1.0 / 60, 0.04, 45, 0, 1}};
bool is_diagonal(const Sweep& s);

const Factors<Sweep>& sweep_factors();

inline constexpr double least_path = 1e-3, longest_path = 1e4;  ///< [widths]

double path_in_widths(const Sweep& s);               ///< [1] speed * step / width
double ball_radius(const Sweep& s);                  ///< [m] of the balls at rest
Vec3<double> half_extents(const Sweep& s);           ///< [m] of the moving shape
Vec3<double> direction(const Sweep& s);              ///< unit; exactly an axis at 0 and 90 degrees
Vec3<double> path(const Sweep& s);                   ///< [m] displacement over the step
Moving<Sphere<double>> moving_ball(const Sweep& s);  ///< starts at the origin
Moving<Aabb<double>> moving_box(const Sweep& s);
RandomStream random_stream(const Sweep& s, std::uint64_t seed);  ///< from the physical factors alone

/// The cells, and which of them is drawn and timed: along x and y alike, among balls as wide as the shape, and as fast as
/// the bullet, or what the settings have nearest to that.
struct SweepPlan {
  std::vector<Sweep> cells;  ///< `diagonals` first, then every combination of the settings' factors
  Sweep view;                ///< its form does not count
  std::vector<Sweep> timed;  ///< every form and speed in the direction of `view`
};
/// `each` units come of a cell. Throws UsageError.
SweepPlan make_sweeps(const Settings& settings, std::size_t each = 1);

/// A box that balls are drawn from.
struct BallRegion {
  Vec3<double> middle;        ///< [m]
  Mat3<double> axes;          ///< unit columns
  Vec3<double> half_extents;  ///< [m]
};

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
