#pragma once
/// One physical condition of the crossing bullets: two balls of one radius that cross in the plane of x and y.

#include <cstdint>
#include <string>
#include <vector>

#include <thinwall/discrete/scalar.hpp>
#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/random.hpp>
#include <thinwall/experiments/settings.hpp>

namespace thinwall {

struct Crossing {
  double speed;      ///< [m/s] > 0, of the faster ball
  double step;       ///< [s] > 0
  double radius;     ///< [m] > 0, of both
  double ratio;      ///< [1] in [0, 1]: the slower ball's speed over the faster one's
  double angle_deg;  ///< [deg] in [0, 180], between the motions: 0 is a chase, 180 is head-on
  double offset;     ///< [contact distances] >= 1: radius of the disc that closest approach is drawn from

  bool operator==(const Crossing&) const = default;
};

/// The textbook's bullet, 10 m/s at 60 steps a second, and another that comes straight at it: they all touch.
inline constexpr Crossing head_on = {
    .speed = 10, .step = 1.0 / 60, .radius = 0.02, .ratio = 1, .angle_deg = 180, .offset = 1};

std::string key(const Crossing& c);  ///< one line, for people and the journal

double contact_distance(const Crossing& c);     ///< [m] R = 2 r
Vec3<double> faster_path(const Crossing& c);    ///< [m] a, in one step
Vec3<double> slower_path(const Crossing& c);    ///< [m] b
Vec3<double> relative_path(const Crossing& c);  ///< [m] d = b - a: of the slower ball, seen from the faster
double longest_contact(const Crossing& c);      ///< [1] the longest that two balls can be in contact, of a step
bool is_parallel(const Crossing& c);            ///< both fly along one line, or the slower one rests
RandomStream random_stream(const Crossing& c, std::uint64_t seed);  ///< from the physical factors alone

/// `head_on` first, then every combination of the settings' factors in which the balls move against each other.
/// Throws UsageError.
std::vector<Crossing> make_crossings(const Settings& settings);

}  // namespace thinwall
