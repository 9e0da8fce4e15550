#pragma once
/// A spinning rod that flies at a wall, and one that turns past a post: the conditions, the motions, when they truly touch for the
/// first time, what theory expects of poses along the way, and the methods that are asked.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/discrete/obb.hpp>
#include <thinwall/experiments/lab/random.hpp>
#include <thinwall/experiments/lab/record.hpp>
#include <thinwall/swept/toi.hpp>
#include <thinwall/swept/turning.hpp>

namespace thinwall {

/// A rod flies along the normal of a wall without end, at right angles to the axis that it spins about.
struct RodFlight {
  double half_length;  ///< [m] > 0, of the core
  double radius;       ///< [m] > 0
  double thickness;    ///< [m] >= 0, of the wall
  double tilt_deg;     ///< [deg] in [0, 90], between the axis and the wall's normal: at 0 the rod stays flat
  double spin_deg;     ///< [deg a step] >= 0
  double step_ratio;   ///< [1] > 0: the step over `widest`

  bool operator==(const RodFlight&) const = default;
};

/// A rod turns about its middle, which stays; one of its ends passes a round post that is parallel to the axis.
struct BladePass {
  double half_length;    ///< [m] > 0, of the core
  double radius;         ///< [m] > 0, of the rod
  double post_radius;    ///< [m] >= 0
  double post_distance;  ///< [m] from the axis to the post's: more than both radii, at most half_length
  double post_spin_deg;  ///< [deg a step] > 0, at most 180 less `window`, so that the other end is not met

  bool operator==(const BladePass&) const = default;
};

double radians(double degrees);          ///< [rad]
double clearance(const RodFlight& c);    ///< [m] w + 2 r: how far the rod passes through the wall where it lies flat
double reach(const RodFlight& c);        ///< [m] L' = L sin(tilt): how far the core's ends reach towards the wall
double widest(const RodFlight& c);       ///< [m] w + 2 r + 2 L'
double step_length(const RodFlight& c);  ///< [m]
Moving<Obb<double>> wall(const RodFlight& c);      ///< around the origin, its normal along x, too wide to be missed
Moving<Capsule<double>> post(const BladePass& c);  ///< along z, too long to be missed
/// [rad] asin((r + R) / distance): the post is touched so far to either side of it.
double half_window(const BladePass& c);

// ---- Motions. No query of the library has a part in them.

/// One trial: a rod at a constant velocity and spin, from before anything touches until nothing can any more.
struct RodMotion {
  double half_length, radius;   ///< [m]
  Vec3<double> axis;            ///< unit; the rod turns about it by the right-hand rule
  Vec3<double> across, beyond;  ///< unit: the rod lies along across * cos(angle) + beyond * sin(angle)
  double start;                 ///< [m] x of the middle; y and z are 0
  double step;                  ///< [m] along x, a step
  double angle;                 ///< [rad] at the start
  double spin;                  ///< [rad a step] >= 0
  std::int64_t steps;           ///< to be asked about
  long double contact;          ///< [steps] from the start to first contact; it always comes
};

/// Of its own for every cell: that of the numbers of its factors.
RandomStream random_stream(const RodFlight& c, std::uint64_t seed);
RandomStream random_stream(const BladePass& c, std::uint64_t seed);

/// Both phases uniform, of position and of angle. The first step begins so far away that no bound of how fast a point of the rod is
/// reaches the wall in it.
RodMotion random_motion(const RodFlight& c, const RandomStream& stream, std::uint64_t trial);

/// The phase uniform. The first step begins where the blade can touch by the end of it.
RodMotion random_motion(const BladePass& c, const RandomStream& stream, std::uint64_t trial);

/// The rod in step `k`, as it is put to a method.
Turning<Capsule<double>> step_of(const RodMotion& m, std::int64_t k);

/// [m] From the rod's surface to the wall's or the post's, `time` steps after the start; < 0 where they overlap. In long double.
double gap_at(const RodFlight& c, const RodMotion& m, long double time);
double gap_at(const BladePass& c, const RodMotion& m, long double time);

/// [steps] The first root of  lead - step t - reach |cos(angle + spin t)|,  the gap between a spinning rod and a wall at time t.
/// Between two zeros of the cosine it is convex, so that Newton's method rises to its first root there and never passes it, or to the end.
/// lead >= reach >= 0 [m], step > 0 [m], spin >= 0 [rad a step]. In long double: a few of its units of the times and lengths.
long double first_contact(long double lead, long double step, long double reach, long double angle, long double spin);

// ---- Theory. Derived in docs/spinning_rod.md.

/// The chance that poses `step` apart, each turned by `spin` [rad] from the one before, all miss a wall: `clearance` is w + 2 r, `reach`
/// L sin(tilt). Lengths in one unit, clearance and step > 0. Exactly 0 where step <= clearance + reach |sin(spin)|.
double rod_miss_probability(double clearance, double reach, double step, double spin);

/// The same where `step` is long enough for the spin to drop out: 1 - (clearance + 4 reach / pi) / step.
double long_step_miss_probability(double clearance, double reach, double step);

/// The chance that poses `spin` [rad] apart all miss a post that is touched over `window` [rad].
double blade_miss_probability(double window, double spin);

// ---- Every method of the list for shapes that turn, behind one interface: put a flight or a pass to it, count, and ask what theory
// expects. A method added to the list appears here by itself; its theory and its claims are empty until given in rods.cpp.

/// What is counted over the trials of one cell and method.
struct RodTally {
  std::int64_t trials = 0, tunneled = 0, undecided = 0, false_hits = 0, late = 0, steps = 0, evaluations = 0;
  RealSum lateness = {};                         // [steps] of the detected
  double latest = no_most, earliest = no_least;  // [steps] of the same
  double widest = no_most, deepest = no_least;   // [m] gap at the reported time, of the same

  static constexpr auto fields() {
    using T = RodTally;
    return record(
        sum("trials", &T::trials, "1", "Flights or passes, at independent uniform phases; each truly touches."),
        sum("tunneled", &T::tunneled, "1", "Of those, passed undetected."),
        sum("undecided", &T::undecided, "1", "Ended because the method gave up."),
        sum("false_hits", &T::false_hits, "1", "First hit reported in a step by whose end nothing has touched yet."),
        sum("late", &T::late, "1", "First hit later than first contact, by more than a millionth of a step."),
        sum("steps", &T::steps, "1", "Steps that the method was asked about."),
        sum("evaluations", &T::evaluations, "1", "Looks at a pose and closed forms those took."),
        sum("lateness", &T::lateness, "step", "From first contact to the hit."),
        most("lateness_max", &T::latest, "step", "The latest hit."),
        least("lateness_min", &T::earliest, "step", "The earliest; below 0 before contact."),
        most("gap_max", &T::widest, "m", "Widest gap at the time of a hit, of the rod as it has turned by then."),
        least("gap_min", &T::deepest, "m", "The least of them; below 0 where they overlap."));
  }
  std::int64_t detected() const { return trials - tunneled - undecided; }
  bool operator==(const RodTally&) const = default;
};

/// What a method owes, whatever theory says of it.
struct RodClaims {
  bool never_late = false;
  std::optional<double> most_gap = {};  ///< [1] of the fastest point's path: a hit with a wider gap is none
};

struct RodMethod {
  std::string name;  ///< the method's; with the number of poses for `substeps`: substeps_4
  RodClaims claims;
  std::function<Toi<double>(const Turning<Capsule<double>>&, const Moving<Obb<double>>&)> at_wall;
  std::function<Toi<double>(const Turning<Capsule<double>>&, const Moving<Capsule<double>>&)> at_post;
  std::function<std::optional<double>(const RodFlight&)> wall_theory;  ///< [1] chance of tunneling
  std::function<std::optional<double>(const BladePass&)> post_theory;
};

std::vector<std::string_view> rod_method_names();
inline constexpr int least_rod_substeps = 2, most_rod_substeps = 1000;  ///< poses a step

/// In the order of the method list, then by the number of poses.
std::vector<RodMethod> rod_methods(std::span<const std::string> names, std::span<const std::int64_t> substeps);

/// Lateness is summed in 64 bits; no rod takes more than some hundred steps.
inline constexpr std::int64_t most_rod_trials = std::int64_t(1) << 22;

/// All flights of a cell, each step by step until the method reports a hit or nothing can touch any more.
/// Those of the numbers `first`, `first + 1` and so on: what the pieces count adds up to what one would.
RodTally fly(const RodFlight& c, const RodMethod& method, std::int64_t flights, std::uint64_t seed,
             std::int64_t first = 0);
RodTally pass(const BladePass& c, const RodMethod& method, std::int64_t passes, std::uint64_t seed);

}  // namespace thinwall
