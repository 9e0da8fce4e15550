#pragma once
/// A spinning rod that flies at a wall, and one that turns past a post: the conditions, the motions, when they truly touch for the
/// first time, and what theory expects of poses along the way. No query of the library is in here.

#include <cstdint>
#include <vector>

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/discrete/obb.hpp>
#include <thinwall/experiments/lab/random.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/swept/turning.hpp>

namespace thinwall {

template <class Cell> class Factors;  // lab/factors.hpp

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

const Factors<RodFlight>& rod_factors();
const Factors<BladePass>& blade_factors();

/// Every combination of the settings' values; `each` units come of a cell. Throws UsageError.
std::vector<RodFlight> make_flights(const Settings& settings, std::size_t each = 1);
std::vector<BladePass> make_passes(const Settings& settings, std::size_t each = 1);

double radians(double degrees);          ///< [rad]
double clearance(const RodFlight& c);    ///< [m] w + 2 r: how far the rod passes through the wall where it lies flat
double reach(const RodFlight& c);        ///< [m] L' = L sin(tilt): how far the core's ends reach towards the wall
double widest(const RodFlight& c);       ///< [m] w + 2 r + 2 L'
double step_length(const RodFlight& c);  ///< [m]
double half_window(
    const BladePass& c);  ///< [rad] asin((r + R) / distance): the post is touched so far to either side of it
Moving<Obb<double>> wall(const RodFlight& c);      ///< around the origin, its normal along x, too wide to be missed
Moving<Capsule<double>> post(const BladePass& c);  ///< along z, too long to be missed

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

/// [m] The path of the fastest point in a step, at most.
double fastest_path(const RodMotion& m);

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

}  // namespace thinwall
