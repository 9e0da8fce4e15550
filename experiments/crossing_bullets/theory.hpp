#pragma once
/// What geometry expects of a cell. Derived in docs/crossing_bullets.md.

#include <optional>

#include <thinwall/experiments/crossing_bullets/model.hpp>

namespace thinwall {

/// What the tutorial's rule confirms.
struct ConfirmedTheory {
  double share;           ///< of the encounters: they touch, and the rule says so
  double lateness_mean;   ///< [1] of a step, of the confirmed
  double lateness_sigma;  ///< [1] of a step: its standard deviation
};

double touch_theory(const Crossing& c);          ///< share of the encounters: the balls touch during the step
double false_overlap_theory(const Crossing& c);  ///< ... what they sweep overlaps, and they do not touch
double touch_at_end_theory(const Crossing& c);   ///< ... they overlap at the end of the step
ConfirmedTheory confirmed_theory(const Crossing& c);

struct CrossingTheory {
  double touch, false_overlap, touch_at_end;  ///< shares of the encounters, as above
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
