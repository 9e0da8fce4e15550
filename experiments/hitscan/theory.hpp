#pragma once
/// What geometry expects of a cell. Derived in docs/hitscan.md.

#include <optional>

#include <thinwall/experiments/hitscan/error_theory.hpp>

namespace thinwall {

/// What a rule should count, as shares of the shots, and measure.
struct HitscanExpected {
  double touch;                            ///< the bullet truly hits
  double reported;                         ///< the rule says so
  double missed;                           ///< the bullet hits, and the rule says no
  double false_hits;                       ///< it does not, and the rule says so
  HitscanMoments path_error;               ///< [m] from the rule's path to the arc at the range
  double path_error_most;                  ///< [m]
  std::optional<HitscanMoments> lateness;  ///< [s], of next_frame
};
HitscanExpected expected_of(const HitscanRule& rule, const HitscanCell& c);

/// The limit of flat fire: the shadows are discs, `deflection` [m] apart.
double flat_missed(double target, double radius, double deflection);  ///< [1] of the true hits, by hitscan
double flat_false(double target, double radius, double deflection);   ///< [1] of its hits

/// [m] The range at which hitscan misses that share of the true hits, of a bullet without radius, in the limit of flat
/// fire. The other factors are the cell's. Nothing where no range does: no pull, or the bullet does not get there.
std::optional<double> range_of_missed(const HitscanCell& c, double share);

}  // namespace thinwall
