#pragma once
/// What came of one method on the queries of one place, pair and precision.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace thinwall {

struct ExtremeTally {
  std::string method;
  std::int64_t queries = 0;                      ///< that the precision can hold
  std::int64_t touching = 0;                     ///< at the start or during the step, by the oracle
  std::int64_t changed = 0;                      ///< whose verdict rounding the input has changed, whatever the method
  std::int64_t wrong = 0;                        ///< verdicts, of any size
  std::int64_t far_wrong = 0;                    ///< verdicts that are wrong by more than 4 u
  std::int64_t gave_up = 0;                      ///< no verdict, for want of budget
  std::int64_t invalid = 0;                      ///< no verdict: NaN, or input declared invalid
  std::int64_t timed = 0;                        ///< hits answered as such, whose errors follow
  double worst_wrong = 0;                        ///< [u] of the worst wrong verdict
  double forward_median = 0, forward_max = 0;    ///< [u kappa t]
  double backward_median = 0, backward_max = 0;  ///< [u]
  double loss_rms = 0, loss_max = 0;             ///< [u (d/R)^2 / 2] error along the normal over R
  double nanoseconds = 0;                        ///< a query
  bool operator==(const ExtremeTally&) const = default;
};

std::string to_line(const std::vector<ExtremeTally>& tallies);
/// Throws std::runtime_error for anything else.
std::vector<ExtremeTally> extreme_tallies_from_line(const std::string& line);

}  // namespace thinwall
