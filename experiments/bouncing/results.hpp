#pragma once
/// Everything that a run of the bouncing ball found.

#include <string>
#include <vector>

#include <thinwall/experiments/bouncing/line.hpp>
#include <thinwall/experiments/bouncing/long_run.hpp>
#include <thinwall/experiments/bouncing/scenarios.hpp>
#include <thinwall/experiments/bouncing/work.hpp>

namespace thinwall {

struct ScenarioGroup {
  std::string name;
  std::vector<BounceScenario> scenarios;
};

struct BouncingResults {
  std::vector<BounceLine> lines;
  std::vector<BounceTest> tests;
  std::vector<LongRun> long_runs;
  std::vector<BounceWork> work;
  std::vector<ScenarioGroup> groups;

  std::size_t scenario_count() const;
  std::size_t scenarios_passed() const;
  bool passed() const;  ///< every self-test and every scenario
};

/// The lines at the highest restitution that was asked for: 1, unless the settings leave it out.
std::vector<BounceLine> liveliest(const std::vector<BounceLine>& lines);

}  // namespace thinwall
