#include <thinwall/experiments/thin_wall/stratified.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

namespace thinwall {

StratifiedPlan stratified_plan(const ShotPlan& plan) {
  StratifiedPlan stratified;
  for (const Cell& cell : plan.cells) {
    if (cell.wall == Wall::infinite) stratified.cells.push_back(cell);
  }
  for (const Detector& detector : plan.detectors) {
    if (detector.scalar == "double") stratified.detectors.push_back(detector);
  }
  if (stratified.detectors.empty()) stratified.cells.clear();
  return stratified;
}

std::string stratified_counts(const Cell& cell, const std::vector<Detector>& detectors, std::uint64_t seed) {
  const Target fired = target(cell);
  // The offset's counter is one that no independent shot has.
  constexpr std::uint64_t no_trial = std::numeric_limits<std::uint64_t>::max();
  const double offset = uniform(random_words(random_stream(cell, seed), no_trial, 0)[0]);
  std::string counts;
  for (const Detector& detector : detectors) {
    Tally tally;
    for (std::int64_t i = 0; i < stratified_shots; ++i) {
      const double phase = (static_cast<double>(i) + offset) / static_cast<double>(stratified_shots);
      detector.fire(fired, start_at_phase(fired, phase), tally);
    }
    counts += fmt::format("{}{}", counts.empty() ? "" : " ", tally.tunneled);
  }
  return counts;
}

std::vector<StratifiedTest> stratified_test(const StratifiedPlan& plan, const std::vector<std::string>& lines) {
  std::vector<StratifiedTest> tests;
  for (const Detector& detector : plan.detectors) tests.emplace_back().method = detector.method;
  for (std::size_t i = 0; i < plan.cells.size(); ++i) {
    std::istringstream counts(lines[i]);
    for (std::size_t j = 0; j < plan.detectors.size(); ++j) {
      std::int64_t tunneled = 0;
      if (!(counts >> tunneled)) throw std::runtime_error("not a line of counts: " + lines[i]);
      const std::optional<double> p = plan.detectors[j].theory(plan.cells[i]).probability;
      if (!p) continue;
      ++tests[j].cells;
      const double deviation = std::abs(static_cast<double>(tunneled) - static_cast<double>(stratified_shots) * *p);
      tests[j].largest_deviation = std::max(tests[j].largest_deviation, deviation);
    }
  }
  return tests;
}

Table stratified_table(const std::vector<StratifiedTest>& tests) {
  Table table;
  table.name = "stratified";
  table.description = "Counts of evenly spread phases against theory: infinite walls, double.";
  table.in_report = true;
  table.columns = {
      {"method", ColumnType::text, "", "Way of detecting the hit."},
      {"cells", ColumnType::integer, "1", "Cells with an infinite wall and a theory."},
      {"shots", ColumnType::integer, "1", "Phases in each cell, n."},
      {"largest_deviation", ColumnType::number, "1", "Largest |k - n p| over the cells, k the number that tunneled."},
      {"passed", ColumnType::boolean, "", "The largest deviation is at most 1."},
  };
  for (const StratifiedTest& t : tests) {
    table.rows.push_back({t.method, t.cells, stratified_shots, t.largest_deviation, t.passed()});
  }
  return table;
}

}  // namespace thinwall
