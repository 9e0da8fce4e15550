#pragma once
/// What a bounce does to the energy of the flight, exactly and not only to first order, derived in docs/bouncing.md; and whether what
/// was measured agrees with it.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/bouncing/model.hpp>
#include <thinwall/experiments/lab/judge.hpp>
#include <thinwall/experiments/lab/statistics.hpp>

namespace thinwall {

/// With delta = g h / V, where V is the speed at which the true flight meets the floor, and u = 1 - 2 tau, where tau in [0, 1] is
/// the phase: the share of the step that has passed then. The energy after the bounce, over that before, less the
/// restitution's square, is (c0 + c1 u + c2 u^2) * delta.
struct BounceTheory {
  double c0 = 0, c1 = 0, c2 = 0;  ///< [g h / V]
  double at(double u) const { return c0 + u * (c1 + u * c2); }
  double mean() const;      ///< [g h / V] over uniform phases
  double sigma() const;     ///< [g h / V] standard deviation over them
  double kurtosis() const;  ///< [1] fourth moment about the mean over the variance's square; 9/5 if c2 is 0
};

/// Requires one of the five policies' names.
BounceTheory bounce_theory(std::string_view policy, double delta, double restitution);

/// [1] What the mean energy of a long run and its standard deviation would be if every phase were random, to first order: V changes by
/// drift g h / 2 a bounce, of the standard deviation of the energy.
double random_phase_mean(const BouncePolicy& policy, const BounceCell& cell, double bounces);
double random_phase_sigma(const BouncePolicy& policy, const BounceCell& cell, double bounces);

/// A cell, a policy, what was measured and what theory expects.
struct BounceRow {
  BounceCell cell;
  BouncePolicy policy;
  BounceTally tally;
  BounceTheory theory = bounce_theory(policy.name, delta(cell), cell.restitution);
};

Measured measured_mean(const BounceRow& row);  ///< [g h / V] with its 95 % normal interval
/// Standard errors between the mean and theory, where the two differ by more than rounding; nothing where every bounce is the same.
std::optional<double> mean_residual(const BounceRow& row);
/// The same of the variance, whose standard error follows from the kurtosis; nothing below 100 trials.
std::optional<double> variance_residual(const BounceRow& row);

/// The verdict on one policy. A right theory fails by chance about once in 300 times for each.
struct BounceTest {
  BouncePolicy policy;
  std::int64_t certain_cells = 0;  ///< every bounce must give what theory says, to rounding
  std::int64_t certain_wrong = 0;  ///< ... and does not
  std::int64_t covered = 0;        ///< of the judged means, those whose 95 % interval holds the theory
  ResidualTest means = {};         ///< of cells with at least 30 bounces, and phases that matter
  ResidualTest variances = {};     ///< of those with at least 100
  std::int64_t other_cells = 0;    ///< too few bounces to judge
  /// Central 99.9 % of Binomial(judged, 0.95); missing if nothing is judged.
  std::optional<Interval> covered_allowed() const;
  bool passed() const;
};
std::vector<BounceTest> bounce_tests(const std::vector<BounceRow>& rows);  ///< by policy

}  // namespace thinwall
