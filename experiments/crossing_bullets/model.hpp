#pragma once
/// Two balls of one radius that cross in the plane of x and y: the conditions, the encounters, whether and when the balls
/// truly touch, and what theory expects. No rule is in here.

#include <cstdint>
#include <optional>
#include <vector>

#include <thinwall/discrete/sphere.hpp>
#include <thinwall/experiments/lab/factors.hpp>
#include <thinwall/swept/moving.hpp>

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

extern const Factors<Crossing> crossing_factors;

/// `head_on` first, then every combination of the settings' factors in which the balls move against each other; `each` units come
/// of one. Throws UsageError.
std::vector<Crossing> make_crossings(const Settings& settings, std::size_t each = 1);

double contact_distance(const Crossing& c);     ///< [m] R = 2 r
Vec3<double> faster_path(const Crossing& c);    ///< [m] a, in one step
Vec3<double> relative_path(const Crossing& c);  ///< [m] d = b - a, b the slower ball's: as seen from the faster
double longest_contact(const Crossing& c);      ///< [1] the longest that two balls can be in contact, of a step

struct Encounter {
  Moving<Sphere<double>> faster, slower;
};

/// Closest approach uniform over the disc, by rejection. The phase is uniform over the step: of first contact where they
/// touch, of closest approach where they do not.
Encounter random_encounter(const Crossing& c, const RandomStream& stream, std::uint64_t trial);

/// The exact relative motion: the quadratic of the squared distance, in long double. Shares no code with any rule.
struct TrueContact {
  bool touches;       ///< during the step
  long double time;   ///< [1] of first contact, if they touch
  long double until;  ///< [1] of the last contact on the line, which may be after the step
};
TrueContact true_contact(const Encounter& e);

/// [m] From surface to surface at a time in [0, 1]; < 0 where they overlap.
double gap_at(const Encounter& e, double time);

// ---- What geometry expects of a cell. Derived in docs/crossing_bullets.md.

/// What the tutorial's rule confirms.
struct ConfirmedTheory {
  double share;           ///< of the encounters: they touch, and the rule says so
  double lateness_mean;   ///< [1] of a step, of the confirmed
  double lateness_sigma;  ///< [1] of a step: its standard deviation
};

double touch_theory(const Crossing& c);          ///< share of the encounters: the balls touch during the step
double false_overlap_theory(const Crossing& c);  ///< ... what they sweep overlaps, and they do not touch
ConfirmedTheory confirmed_theory(const Crossing& c);

struct CrossingTheory {
  double touch, false_overlap;  ///< shares of the encounters, as above
  double touch_at_end;          ///< ... they overlap at the end of the step
  ConfirmedTheory confirmed;
};
CrossingTheory theory_of(const Crossing& c);

/// What a rule should count, as shares of the encounters; nothing where no formula holds.
struct Expected {
  std::optional<double> reported;    ///< it says that they touch
  std::optional<double> missed;      ///< they touch, and it says no
  std::optional<double> false_hits;  ///< they do not, and it says so
};

}  // namespace thinwall
