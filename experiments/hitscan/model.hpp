#pragma once
/// A bullet fired level from the origin along +x, and a ball for a target: the conditions, the shots, whether and when the bullet
/// truly touches, and the rules that guess it. y is up; the wind blows along +z.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/discrete/sphere.hpp>
#include <thinwall/experiments/hitscan/arc.hpp>
#include <thinwall/experiments/lab/factors.hpp>
#include <thinwall/experiments/lab/record.hpp>

namespace thinwall {

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
inline bool is_known(const HitscanCell& c) { return !known_name(c).empty(); }

const Factors<HitscanCell>& hitscan_factors();
RandomStream random_stream(const HitscanCell& c, std::uint64_t seed);  ///< from the physical factors alone

/// `known_shots` first, then every combination of the settings' factors in which the bullet arrives. Throws UsageError.
std::vector<HitscanCell> make_hitscan_cells(const Settings& settings);

double reach(const HitscanCell& c);                 ///< [m] target + radius: the centers' distance at contact
Vec3<double> pull_direction(const HitscanCell& c);  ///< unit, across x; down if nothing pulls
template <class Real> Arc<Real> arc_of(const HitscanCell& c) {
  using std::hypot;
  return {Real(c.speed), Real(c.drag), hypot(Real(c.gravity), Real(c.drag) * Real(c.wind))};
}

double deflection(const HitscanCell& c);   ///< [m] of the arc from the line of fire, at the range
double flight_time(const HitscanCell& c);  ///< [s] from the muzzle to the range
double disc_radius(const HitscanCell& c);  ///< [m] of the two discs that the target's center is drawn from

/// The times [s] at which the bullet is as near to the target's plane as contact needs.
struct HitscanWindow {
  double from, until;
};
HitscanWindow contact_window(const HitscanCell& c);

/// The bounds [s] of the steps from the last but one before the window to the one that ends it. The gun goes off
/// `phase` [1], in [0, 1), of a step after a frame, so that the first step is shorter. Time counts from there.
std::vector<double> frames_near_target(const HitscanCell& c, double phase);

// The shots and the oracle: no rule is in here.

struct Placement {
  Sphere<double> target;
  double phase;  ///< [1] in [0, 1): how far into a frame's step the gun goes off
};

/// The target's center is uniform over the two discs together, in the plane across the line of fire at the range.
Placement random_placement(const HitscanCell& c, const RandomStream& stream, std::uint64_t trial);

/// The arc against the ball, in long double, as a function of the distance flown. Shares no code with any rule.
struct TrueImpact {
  bool touches;
  double time = 0;                             ///< [s] of first contact, from the muzzle, if they touch
  Vec3<double> bullet = Vec3<double>::Zero();  ///< [m] the bullet's center then
};
TrueImpact true_impact(const HitscanCell& c, const Vec3<double>& target_center);

/// [m] Where on the target the bullet touches it.
Vec3<double> contact_point(const HitscanCell& c, const TrueImpact& truth, const Vec3<double>& target_center);

// The rules: which way the bullet is taken to fly, whether it has a radius, and when a hit is reported.

enum class FlightPath {
  line,      ///< along the line of fire, at once and without end
  tangents,  ///< every step along the velocity at its start, as far as the bullet would get in the step
  chords,    ///< every step straight to where the bullet is at its end
};

enum class ReportTime {
  firing,       ///< when the gun goes off
  end_of_step,  ///< at the next frame
  in_step,      ///< when the rule says that they touch
};

struct HitscanRule {
  std::string_view name;
  FlightPath path;
  bool has_radius;  ///< the bullet is swept as a ball, by `time_of_impact`; otherwise its center, by `raycast`
  ReportTime report;
};

inline constexpr HitscanRule hitscan_ray = {"hitscan", FlightPath::line, false, ReportTime::firing};
inline constexpr HitscanRule hitscan_ball = {"hitscan_ball", FlightPath::line, true, ReportTime::firing};
inline constexpr HitscanRule next_frame = {"next_frame", FlightPath::tangents, false, ReportTime::end_of_step};
inline constexpr HitscanRule swept_steps = {"swept_steps", FlightPath::chords, true, ReportTime::in_step};
inline constexpr std::array hitscan_rules = {hitscan_ray, hitscan_ball, next_frame, swept_steps};

struct HitscanAnswer {
  bool hit = false;
  double time = 0;                               ///< [s] of the report, since firing
  Vec3<double> point = Vec3<double>::Zero();     ///< [m] on the target
  Vec3<double> at_range = Vec3<double>::Zero();  ///< [m] where the path crosses the plane of the target's center
};
HitscanAnswer answer_of(const HitscanRule& rule, const HitscanCell& c, const Placement& placement);

// What is counted.

/// A sum and the extremes of a quantity. The sum is kept in 2^-30 of a unit that the cell sets: it does not add up over cells.
struct HitscanSpread {
  std::int64_t count = 0, sum = 0;
  double least = no_least, most = no_most;  ///< in its own unit

  void add(double x, double unit);  ///< |x| <= 2 `unit`, so that 2^30 of them add up without overflow
  double mean(double unit) const;   ///< requires count > 0
  static constexpr auto fields() {
    using S = HitscanSpread;
    return record(thinwall::sum("count", &S::count, "1", "How many."), kept("sum", &S::sum),
                  thinwall::least("least", &S::least, "1", "The least."),
                  thinwall::most("most", &S::most, "1", "The largest."));
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

/// The units of a cell's sums.
double time_unit(const HitscanCell& c);    ///< [s]
double length_unit(const HitscanCell& c);  ///< [m]

/// All shots of a cell, put to every rule; as long as `rules`.
std::vector<HitscanTally> shoot(std::span<const HitscanRule> rules, const HitscanCell& c, std::uint64_t seed,
                                std::int64_t shots);

}  // namespace thinwall
