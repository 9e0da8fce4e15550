#pragma once
/// One line of the results: a cell, a method at a scalar, what was counted and what theory expects.

#include <optional>
#include <vector>

#include <thinwall/experiments/statistics.hpp>
#include <thinwall/experiments/thin_wall/plan.hpp>

namespace thinwall {

struct Line {
  const Cell* cell;
  const Detector* detector;
  Theory theory;
  Tally tally;
  double step_ratio;     ///< [1] v h cos(angle) / (w + 2 r)
  double lateness_unit;  ///< [m] of tally.lateness
  double resolution;     ///< [m] how well the scalar holds a pose of this cell
  double seconds;        ///< of computing all shots, aiming included
};

std::optional<double> lateness_mean(const Line& line);  ///< [m] of the detected, if any
double probability(const Line& line);                   ///< [1] share of shots that tunneled
Interval interval(const Line& line);                    ///< 95 % Wilson
std::optional<double> residual(const Line& line);       ///< standard errors from theory, where theory is not 0 or 1
bool can_be_judged(const Line& line);                   ///< by its residual

/// `tallies[i]` and `seconds[i]` are of cell i / detectors and detector i % detectors. `plan` must outlive the lines.
std::vector<Line> make_lines(const ShotPlan& plan, const std::vector<Tally>& tallies,
                             const std::vector<double>& seconds);

}  // namespace thinwall
