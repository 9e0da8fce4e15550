#pragma once
/// Each rule over all of its cells.

#include <string>
#include <vector>

#include <thinwall/experiments/hitscan/line.hpp>

namespace thinwall {

struct HitscanTotal {
  HitscanRule rule = {};
  std::int64_t shots = 0, touching = 0, missed = 0, reported = 0, false_hits = 0;
  double missed_theory = 0, false_theory = 0;  ///< expected numbers
  double latest = 0;                           ///< [step] the latest report of a true hit; < 0 if all are early
  double earliest = 0;                         ///< [step] the earliest
  double late_steps = 0;                       ///< [step] sum over the timed
  std::int64_t timed = 0;                      ///< true hits that are reported
  double path_error_most = 0;                  ///< [m] from the arc at the range, of all cells
  double point_error_most = 0;                 ///< [m] from the true point on the target, of all cells
};

std::vector<HitscanTotal> totals(const std::vector<HitscanLine>& lines);  ///< by rule, in the order of their first line

}  // namespace thinwall
