#pragma once
/// One physical condition of hitscan: a bullet fired level from the origin along +x, and a ball for a target.
/// y is up; the wind blows along +z.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <thinwall/discrete/scalar.hpp>
#include <thinwall/experiments/hitscan/arc.hpp>
#include <thinwall/experiments/random.hpp>
#include <thinwall/experiments/settings.hpp>

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
bool is_known(const HitscanCell& c);

std::string key(const HitscanCell& c);                                 ///< one line, for people and the journal
RandomStream random_stream(const HitscanCell& c, std::uint64_t seed);  ///< from the physical factors alone

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

/// `known_shots` first, then every combination of the settings' factors in which the bullet arrives. Throws UsageError.
std::vector<HitscanCell> make_hitscan_cells(const Settings& settings);

}  // namespace thinwall
