#pragma once
/// A bullet fired level from the origin along +x, and a ball for a target: the arc, the conditions, the shots, whether and when the
/// bullet truly touches, and the rules that guess it; what geometry expects of that, and whether what was counted and measured agrees.
/// y is up; the wind blows along +z. Derived in docs/hitscan.md.

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <boost/icl/interval_set.hpp>
#include <boost/math/special_functions/log1p.hpp>
#include <boost/math/tools/toms748_solve.hpp>

#include <thinwall/discrete/sphere.hpp>
#include <thinwall/experiments/lab/factors.hpp>
#include <thinwall/experiments/lab/judge.hpp>
#include <thinwall/experiments/lab/record.hpp>
#include <thinwall/experiments/lab/statistics.hpp>

namespace thinwall {

// The arc of a bullet with a drag that grows as the speed: dv/dt = -k (v - wind) + gravity. A constant wind acts as a constant pull
// k * wind, so gravity and wind add up to one pull `a`, and the arc lies in one plane:
//
//   tau = (1 - exp(-k t)) / k,   x = v tau,   s = a (t - tau) / k.

/// [s] tau: the time in which a bullet without drag would get as far. t >= 0.
template <class Real> Real undragged_time(const Real& drag, const Real& t) {
  using std::expm1;
  const Real kt = drag * t;
  return kt < std::numeric_limits<Real>::epsilon() ? t : Real(-expm1(-kt) / drag);
}

/// [s] The other way round. 0 <= drag * tau < 1.
template <class Real> Real dragged_time(const Real& drag, const Real& tau) {
  using std::log1p;
  const Real y = drag * tau;
  return y < std::numeric_limits<Real>::epsilon() ? tau : Real(-log1p(-y) / drag);
}

/// [s^2] (t - tau) / k as a function of tau: the deflection of a pull of 1. With y = k tau it is (-log(1 - y) - y) /
/// k^2, a sum of positive terms tau^2 (1/2 + y/3 + ...), so that it loses no digits where the subtraction would.
/// Error: a few units of round-off for 0 <= y <= 0.99.
template <class Real> Real pull_factor(const Real& drag, const Real& tau) {
  using std::log1p;
  const Real y = drag * tau;
  if (y < std::numeric_limits<Real>::epsilon()) return tau * tau / 2;
  if (y < Real(1) / 2) return -boost::math::log1pmx(Real(-y)) / (drag * drag);
  return (-log1p(-y) - y) / (drag * drag);
}

/// Where the bullet is, and how it moves, after a time or at a distance: along the line of fire, and across, along the
/// pull.
template <class Real> struct ArcPoint {
  Real x, s;    ///< [m]
  Real vx, vs;  ///< [m/s]
};

template <class Real> struct Arc {
  Real speed;  ///< [m/s] > 0, at the muzzle
  Real drag;   ///< [1/s] >= 0
  Real pull;   ///< [m/s^2] >= 0, across the line of fire

  ArcPoint<Real> after_undragged(const Real& tau) const {
    return {speed * tau, pull * pull_factor(drag, tau), speed * (1 - drag * tau), pull * tau};
  }
  ArcPoint<Real> after(const Real& t) const { return after_undragged(undragged_time(drag, t)); }
  /// Both require 0 <= drag * x < speed.
  ArcPoint<Real> at_distance(const Real& x) const { return after_undragged(Real(x / speed)); }
  Real time_to(const Real& x) const { return dragged_time(drag, Real(x / speed)); }  ///< [s]
};

/// Where a function that is negative at the one end and positive at the other is zero, to so many binary digits.
template <class Real, class Function>
Real root(const Function& f, const Real& lower, const Real& upper,
          unsigned digits = std::numeric_limits<Real>::digits - 2) {
  const boost::math::tools::eps_tolerance<Real> tolerance(digits);
  std::uintmax_t most = 200;
  const auto bracket = boost::math::tools::toms748_solve(f, lower, upper, tolerance, most);
  return bracket.first + (bracket.second - bracket.first) / 2;
}

// The conditions.

struct HitscanCell {
  double range;    ///< [m] > 2 (target + radius): x of the target's center
  double speed;    ///< [m/s] > 0, at the muzzle
  double radius;   ///< [m] >= 0, of the bullet
  double wind;     ///< [m/s] >= 0; 0 where there is no drag
  double drag;     ///< [1/s] >= 0
  double step;     ///< [s] > 0
  double target;   ///< [m] > 0, radius of the target
  double gravity;  ///< [m/s^2] >= 0
  double aim;      ///< [1] >= 1.1: size of the discs that the target's center is drawn from

  bool operator==(const HitscanCell&) const = default;
};

struct KnownShot {
  const char* name;
  HitscanCell cell;
};

/// Shots whose numbers a reader knows. The drag is what the weapon loses at its speed, and rough.
inline constexpr std::array<KnownShot, 4> known_shots = {{
    {"rifle at 100 m", {100, 900, 0.0039, 3, 0.6, 1.0 / 60, 0.15, 9.81, 1.25}},
    {"rifle at 300 m", {300, 900, 0.0039, 3, 0.6, 1.0 / 60, 0.15, 9.81, 1.25}},
    {"paintball at 10 m", {10, 90, 0.0086, 3, 2, 1.0 / 60, 0.15, 9.81, 1.25}},
    {"textbook bullet at 1 m", {1, 10, 0.02, 0, 0, 1.0 / 60, 0.15, 9.81, 1.25}},
}};
std::string_view known_name(const HitscanCell& c);  ///< of a known shot; otherwise empty

extern const Factors<HitscanCell> hitscan_factors;

/// `known_shots` first, then every combination of the settings' factors in which the bullet arrives. Throws UsageError.
std::vector<HitscanCell> make_hitscan_cells(const Settings& settings);

/// [m] The centers' distance at contact.
inline double reach(const HitscanCell& c) { return c.target + c.radius; }
template <class Real> Arc<Real> arc_of(const HitscanCell& c) {
  using std::hypot;
  return {Real(c.speed), Real(c.drag), hypot(Real(c.gravity), Real(c.drag) * Real(c.wind))};
}
/// [m] Of the arc from the line of fire, at the range.
inline double deflection(const HitscanCell& c) { return arc_of<double>(c).at_distance(c.range).s; }
/// [s] From the muzzle to the range.
inline double flight_time(const HitscanCell& c) { return arc_of<double>(c).time_to(c.range); }
Vec3<double> pull_direction(const HitscanCell& c);  ///< unit, across x; down if nothing pulls
double disc_radius(const HitscanCell& c);           ///< [m] of the two discs that the target's center is drawn from
/// [s] When the bullet is as near to the target's plane as contact needs.
Interval contact_window(const HitscanCell& c);

// The shots and the oracle: no rule is in here.

struct Placement {
  Sphere<double> target;
  double phase;  ///< [1] in [0, 1): how far into a frame's step the gun goes off
};

/// The target's center is uniform over the two discs together, in the plane across the line of fire at the range.
Placement random_placement(const HitscanCell& c, const RandomStream& stream, std::uint64_t trial);

/// The arc against the ball, in long double, as a function of the distance flown. Shares no code with any rule.
struct TrueImpact {
  double time;          ///< [s] of first contact, from the muzzle
  Vec3<double> bullet;  ///< [m] its center then
};
std::optional<TrueImpact> true_impact(const HitscanCell& c, const Vec3<double>& target_center);

// The rules: which way the bullet is taken to fly, and with that, when a hit is reported; and whether it has a radius.

enum class FlightPath {
  line,      ///< along the line of fire, at once and without end; reported when the gun goes off
  tangents,  ///< every step along the velocity at its start, as far as the bullet would get; reported at the next frame
  chords,    ///< every step straight to where the bullet is at its end; reported when the two touch
};

struct HitscanRule {
  std::string_view name;
  FlightPath path;
  bool has_radius;  ///< the bullet is swept as a ball, by `time_of_impact`; otherwise its center, by `raycast`
};

inline constexpr HitscanRule hitscan_ray = {"hitscan", FlightPath::line, false};
inline constexpr HitscanRule hitscan_ball = {"hitscan_ball", FlightPath::line, true};
inline constexpr HitscanRule next_frame = {"next_frame", FlightPath::tangents, false};
inline constexpr HitscanRule swept_steps = {"swept_steps", FlightPath::chords, true};
inline const std::vector<HitscanRule> hitscan_rules = {hitscan_ray, hitscan_ball, next_frame, swept_steps};

struct HitscanAnswer {
  bool hit = false;
  double time = 0;                               ///< [s] of the report, since firing
  Vec3<double> point = Vec3<double>::Zero();     ///< [m] on the target
  Vec3<double> at_range = Vec3<double>::Zero();  ///< [m] where the path crosses the plane of the target's center
};
HitscanAnswer answer_of(const HitscanRule& rule, const HitscanCell& c, const Placement& placement);

// What is counted.

/// The mean and the extremes of a quantity. The sum is kept in 2^-30 of a unit that the cell sets: it does not add up over cells.
struct HitscanSpread {
  std::int64_t count = 0, sum = 0;
  double least = no_least, most = no_most, unit = 0;  ///< in the unit of what is measured

  void add(double x);   ///< |x| <= 2 `unit`, so that 2^30 of them add up without overflow
  double mean() const;  ///< requires count > 0
  static constexpr auto fields() {
    using S = HitscanSpread;
    return record(thinwall::sum("count", &S::count, "1", "How many."), kept("sum", &S::sum),
                  thinwall::least("least", &S::least, "1", "The least."),
                  thinwall::most("most", &S::most, "1", "The largest."), kept("unit", &S::unit));
  }
};

struct HitscanTally {
  std::int64_t shots = 0, touching = 0, missed = 0, false_hits = 0;
  HitscanSpread lateness = {};     ///< [s] from first contact to the report, of the true hits that are reported
  HitscanSpread point_error = {};  ///< [m] from the reported point on the target to the true one, of the same
  HitscanSpread path_error = {};   ///< [m] from the rule's path to the arc, at the range; of all shots

  std::int64_t reported() const { return touching - missed + false_hits; }
  static constexpr auto fields() {
    using T = HitscanTally;
    return record(sum("shots", &T::shots, "1", "Shots."),
                  sum("touching", &T::touching, "1", "True hits, by the exact arc."),
                  sum("missed", &T::missed, "1", "True hits that the rule does not see."),
                  sum("false_hits", &T::false_hits, "1", "Hits it reports of shots whose bullet does not touch."),
                  part(&T::lateness), part(&T::point_error), part(&T::path_error));
  }
};

/// All shots of a cell, put to every rule; as long as `rules`.
std::vector<HitscanTally> shoot(const std::vector<HitscanRule>& rules, const HitscanCell& c, std::uint64_t seed,
                                std::int64_t shots);

// What geometry expects. First, which places of a ball a path meets, in a plane.

/// A straight bit of path in the plane of the arc, x0 < x1.
struct PathPiece {
  double x0, s0, x1, s1;  ///< [m]
};

/// A set of places on a line.
using Places = boost::icl::interval_set<double>;

/// The places `p` for which some point of the pieces has (x - range)^2 + (s - p)^2 <= radius^2.
Places shadow(const std::vector<PathPiece>& pieces, double range, double radius);

/// [m^2] What two discs, their centers `apart`, have in common.
double lens_area(double radius_a, double radius_b, double apart);

/// Mean and spread of a quantity from shot to shot.
struct HitscanMoments {
  double mean = 0, sigma = 0;
};

/// What a rule should count, as shares of the shots, and measure.
struct HitscanExpected {
  double touch;                            ///< the bullet truly hits
  double reported;                         ///< the rule says so
  double missed;                           ///< the bullet hits, and the rule says no
  double false_hits;                       ///< it does not, and the rule says so
  HitscanMoments path_error;               ///< [m] from the rule's path to the arc at the range
  Interval path_error_possible;            ///< [m]
  std::optional<HitscanMoments> lateness;  ///< [s], of next_frame
  Interval lateness_possible;              ///< [s] whatever the rule
};
HitscanExpected expected_of(const HitscanRule& rule, const HitscanCell& c);

/// The limit of flat fire: the shadows are discs, `deflection` [m] apart.
double flat_missed(double target, double radius, double deflection);  ///< [1] of the true hits, by hitscan
double flat_false(double target, double radius, double deflection);   ///< [1] of its hits

/// [m] The range at which hitscan misses that share of the true hits, of a bullet without radius, in the limit of flat
/// fire. The other factors are the cell's. Nothing where no range does: no pull, or the bullet does not get there.
std::optional<double> range_of_missed(const HitscanCell& c, double share);

// Whether the two agree.

/// A cell, a rule, what was counted and measured and what theory expects.
struct HitscanRow {
  HitscanCell cell;
  HitscanRule rule;
  HitscanTally tally;
  HitscanExpected expected = expected_of(rule, cell);
};

inline std::string_view rule_name(const HitscanRow& row) { return row.rule.name; }

/// What is held against theory: of each rule "reported", "missed" and "false", of the oracle, "exact arc", "touching".
std::vector<CellCount> counts_of(const std::vector<HitscanRow>& rows);

/// A measured quantity of one rule, over all cells, against theory: means by chi-square, extremes by what geometry
/// allows.
struct HitscanMomentTest {
  std::string rule, quantity;
  std::int64_t cells = 0;          ///< with a measurement
  std::int64_t out_of_bounds = 0;  ///< ... that is beyond what is possible, more than rounding explains
  ResidualTest means = {};         ///< with an expected mean, and at least 50 shots
  bool passed() const { return out_of_bounds == 0 && means.passed(); }
};
std::vector<HitscanMomentTest> moment_tests(const std::vector<HitscanRow>& rows);

}  // namespace thinwall
