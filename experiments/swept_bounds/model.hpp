#pragma once
/// A shape that moves straight through one step among balls at rest: the conditions, the balls, whether the shape truly
/// touches them, and what theory expects. No bound and no query of the library is in here.

#include <array>
#include <cstdint>
#include <optional>
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

extern const Factors<Sweep> sweep_factors;

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

// ---- What geometry expects of a bound: how large it is, and how much of it is never touched. Derived in docs/swept_bounds.md;
// shares no code with the library's bounds.

/// Segments added up, each point of one moved by each point of the next, then every point within `radius` of that.
/// No segment is a ball, one a capsule, three at right angles a rounded box.
struct RoundedZonotope {
  std::vector<Vec3<double>> segments;  ///< [length] from end to end
  double radius = 0;                   ///< [length] >= 0
};

/// The three numbers of a convex body that the volumes of all bodies around it follow from.
struct SteinerNumbers {
  double volume;          ///< [length^3]
  double area;            ///< [length^2] of the surface
  double mean_curvature;  ///< [length] integral of the mean curvature over the surface
};
SteinerNumbers steiner_numbers(const std::vector<Vec3<double>>& segments);  ///< of the zonotope, not rounded

/// [length^3] V + S r + M r^2 + 4 pi r^3 / 3, Steiner's formula.
double volume(const RoundedZonotope& body);

/// The sum with a ball: all points within `by` of the body.
RoundedZonotope grown(RoundedZonotope body, double by);

/// [length] Half of the body's extent along a unit vector.
double half_width(const RoundedZonotope& body, const Vec3<double>& along);

/// A bound as a body around the middle of the path, and the axes of a box that fits it well.
struct FittedBody {
  RoundedZonotope body;
  Mat3<double> axes;  ///< unit columns at right angles
};

FittedBody exact_body(const Sweep& s);             ///< what the shape truly sweeps: the sum of shape and path
FittedBody enclosing_sphere_body(const Sweep& s);  ///< the ball around the ball around the shape, at both ends
FittedBody enclosing_aabb_body(const Sweep& s);    ///< the box along x, y, z around both ends
FittedBody capsule_body(const Sweep& s);           ///< what the ball around the shape sweeps
FittedBody oriented_box_body(const Sweep& s);      ///< the least box with an axis along the motion; of box shapes
FittedBody box_around(const FittedBody& exact, const Mat3<double>& axes);  ///< the least with these axes

double volume(const BallRegion& region);  ///< [m^3]

/// Around all centers at which a ball's box overlaps the bound's, `room` times as wide: with a tenth more a bound that is too wide shows.
BallRegion region_around(const FittedBody& bound, const Sweep& s, double room = 1.1);

/// Of balls drawn from the region around a bound.
struct SweepTheory {
  double touching;    ///< [1] share that the shape touches
  double false_hits;  ///< [1] share that the bound reports and the shape does not touch; exactly 0 for an exact bound
  double false_fraction;  ///< [1] of those reported, the share that is false
  double empty;           ///< [1] share of the bound's volume that is not swept: the false fraction of points

  double reported() const { return touching + false_hits; }
};
SweepTheory sweep_theory(const FittedBody& bound, const Sweep& s);

/// [widths] The path from which the oriented box makes fewer false hits than the box along x, y, z, if there is one: its
/// speed left aside, the cell is kept. Shorter paths do not pay for turning the box into the motion.
std::optional<double> path_to_turn_for(const Sweep& s);

}  // namespace thinwall
