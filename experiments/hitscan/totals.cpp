#include <thinwall/experiments/hitscan/totals.hpp>

#include <algorithm>

namespace thinwall {

namespace {

void add(HitscanTotal& total, const HitscanLine& line) {
  const HitscanTally& t = line.tally;
  total.shots += t.shots;
  total.touching += t.touching;
  total.missed += t.missed;
  total.reported += t.reported();
  total.false_hits += t.false_hits;
  total.missed_theory += line.expected.missed * static_cast<double>(t.shots);
  total.false_theory += line.expected.false_hits * static_cast<double>(t.shots);
  total.path_error_most = std::max(total.path_error_most, t.path_error.most);
  if (t.lateness.count == 0) return;
  const double latest = t.lateness.most / line.cell.step, earliest = t.lateness.least / line.cell.step;
  total.latest = total.timed > 0 ? std::max(total.latest, latest) : latest;
  total.earliest = total.timed > 0 ? std::min(total.earliest, earliest) : earliest;
  total.timed += t.lateness.count;
  total.late_steps += *mean_lateness(line) / line.cell.step * static_cast<double>(t.lateness.count);
  total.point_error_most = std::max(total.point_error_most, t.point_error.most);
}

}  // namespace

std::vector<HitscanTotal> totals(const std::vector<HitscanLine>& lines) {
  std::vector<HitscanTotal> all;
  for (const HitscanLine& line : lines) {
    auto found =
        std::find_if(all.begin(), all.end(), [&](const HitscanTotal& t) { return t.rule.name == line.rule.name; });
    if (found == all.end()) {
      all.emplace_back().rule = line.rule;
      found = all.end() - 1;
    }
    add(*found, line);
  }
  return all;
}

}  // namespace thinwall
