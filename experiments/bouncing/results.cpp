#include <thinwall/experiments/bouncing/results.hpp>

#include <algorithm>

namespace thinwall {

std::size_t BouncingResults::scenario_count() const {
  std::size_t count = 0;
  for (const ScenarioGroup& group : groups) count += group.scenarios.size();
  return count;
}

std::size_t BouncingResults::scenarios_passed() const {
  std::size_t count = 0;
  for (const ScenarioGroup& group : groups) {
    for (const BounceScenario& scenario : group.scenarios) count += scenario.passed ? 1 : 0;
  }
  return count;
}

bool BouncingResults::passed() const { return all_passed(tests) && scenarios_passed() == scenario_count(); }

std::vector<BounceLine> liveliest(const std::vector<BounceLine>& lines) {
  double most = 0;
  for (const BounceLine& line : lines) most = std::max(most, line.cell.restitution);
  std::vector<BounceLine> chosen;
  std::copy_if(lines.begin(), lines.end(), std::back_inserter(chosen),
               [&](const BounceLine& line) { return line.cell.restitution == most; });
  return chosen;
}

}  // namespace thinwall
