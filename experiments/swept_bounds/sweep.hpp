#pragma once
/// One physical condition of the swept bounds: a shape that moves straight through one step, among balls at rest.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/discrete/aabb.hpp>
#include <thinwall/discrete/sphere.hpp>
#include <thinwall/experiments/random.hpp>
#include <thinwall/experiments/settings.hpp>
#include <thinwall/swept/moving.hpp>

namespace thinwall {

enum class SweptForm { sphere, cube, plate, rod };
inline constexpr std::array all_swept_forms = {SweptForm::sphere, SweptForm::cube, SweptForm::plate, SweptForm::rod};
std::string_view name(SweptForm form);

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

std::string key(const Sweep& s);  ///< one line, for people and the journal

inline constexpr double least_path = 1e-3, longest_path = 1e4;  ///< [widths]

double path_in_widths(const Sweep& s);               ///< [1] speed * step / width
double ball_radius(const Sweep& s);                  ///< [m] of the balls at rest
Vec3<double> half_extents(const Sweep& s);           ///< [m] of the moving shape
Vec3<double> direction(const Sweep& s);              ///< unit; exactly an axis at 0 and 90 degrees
Vec3<double> path(const Sweep& s);                   ///< [m] displacement over the step
Moving<Sphere<double>> moving_ball(const Sweep& s);  ///< starts at the origin
Moving<Aabb<double>> moving_box(const Sweep& s);
RandomStream random_stream(const Sweep& s, std::uint64_t seed);  ///< from the physical factors alone

/// Calls `visit` with the moving shape as the type it is.
template <class Visit> auto with_shape(const Sweep& s, const Visit& visit) {
  return s.form == SweptForm::sphere ? visit(moving_ball(s)) : visit(moving_box(s));
}

/// The cells, and which of them is drawn and timed: along x and y alike, among balls as wide as the shape, and as fast as
/// the bullet, or what the settings have nearest to that.
struct SweepPlan {
  std::vector<Sweep> cells;  ///< `diagonals` first, then every combination of the settings' factors
  Sweep view;                ///< its form does not count
  std::vector<Sweep> timed;  ///< every form and speed in the direction of `view`
};
SweepPlan make_sweeps(const Settings& settings);  ///< throws UsageError

}  // namespace thinwall
