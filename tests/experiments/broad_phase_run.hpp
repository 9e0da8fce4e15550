#pragma once
/// Small runs of broad_phase in memory, for its tests.

#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/broad_phase/lines.hpp>

#include "support/experiment_run.hpp"

namespace thinwall {

inline constexpr std::string_view few_crowds = R"(
  count = [30, 400]
  speed = [0.1, 2]
  rounds = 3
)";

inline std::unique_ptr<Run> broad_phase_run(std::string_view text) {
  return run_of(broad_phase_experiment(), text, {.seed = 5, .trials = {}});
}

/// A finding as none is.
inline Finding made_up_finding(std::string finder, double milliseconds) {
  Finding f;
  f.finder = std::move(finder);
  f.pairs = 3;
  f.milliseconds = {milliseconds, milliseconds, milliseconds};
  return f;
}

inline SurveyLine made_up_line(std::int64_t count, std::vector<Finding> findings) {
  SurveyLine line;
  line.factors.count = count;
  line.survey = {3, 1, std::move(findings)};
  return line;
}

}  // namespace thinwall
