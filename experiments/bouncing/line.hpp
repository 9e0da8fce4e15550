#pragma once
/// One line of the results: a cell, a policy, what was measured and what theory expects; and whether the two agree.

#include <optional>
#include <string>
#include <vector>

#include <thinwall/experiments/bouncing/trials.hpp>
#include <thinwall/experiments/statistics.hpp>
#include <thinwall/experiments/table.hpp>

namespace thinwall {

struct BounceLine {
  BounceCell cell;
  std::string policy;
  BounceTheory theory;
  BounceTally tally;
};

double standard_error(const BounceLine& line);   ///< [g h / V] of the mean, by theory
Interval mean_interval(const BounceLine& line);  ///< [g h / V] 95 % normal interval around the measured mean
bool is_certain(const BounceLine& line);         ///< phases differ by no more than rounding: every bounce is the same
/// Standard errors between the mean and theory, where the two differ by more than rounding; nothing where it is certain.
std::optional<double> mean_residual(const BounceLine& line);
/// The same of the variance, whose standard error follows from the kurtosis; nothing below 100 trials.
std::optional<double> variance_residual(const BounceLine& line);

/// `tallies[i]` is of cell i / policies and policy i % policies.
std::vector<BounceLine> make_bounce_lines(const std::vector<BounceCell>& cells,
                                          const std::vector<BouncePolicy>& policies,
                                          const std::vector<BounceTally>& tallies);

/// The verdict on one policy. A right theory fails by chance about once in 300 times for each.
struct BounceTest {
  std::string policy;
  std::int64_t certain_cells = 0;     ///< every bounce must give what theory says, to rounding
  std::int64_t certain_wrong = 0;     ///< ... and does not
  std::int64_t judged_cells = 0;      ///< at least 30 bounces, and phases that matter
  std::int64_t covered = 0;           ///< ... whose 95 % interval holds the theory
  Interval covered_allowed = {0, 0};  ///< central 99.9 % of Binomial(judged_cells, 0.95)
  double mean_chi_square = 0;         ///< sum of squared residuals of the means
  Interval mean_allowed = {0, 0};     ///< central 99.9 % of its distribution
  std::int64_t spread_cells = 0;      ///< at least 100 bounces
  double spread_chi_square = 0;       ///< sum of squared residuals of the variances
  Interval spread_allowed = {0, 0};   ///< central 99.9 % of its distribution
  std::int64_t other_cells = 0;       ///< too few bounces to judge
  bool passed() const;
};
std::vector<BounceTest> bounce_tests(const std::vector<BounceLine>& lines);
bool all_passed(const std::vector<BounceTest>& tests);

}  // namespace thinwall
