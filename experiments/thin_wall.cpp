#include <thinwall/experiments/experiment_list.hpp>

#include <memory>
#include <utility>

#include <fmt/format.h>

#include <thinwall/experiments/thin_wall/bounce_results.hpp>
#include <thinwall/experiments/thin_wall/figures.hpp>
#include <thinwall/experiments/thin_wall/summary.hpp>
#include <thinwall/experiments/thin_wall/tables.hpp>
#include <thinwall/experiments/thin_wall/volley.hpp>
#include <thinwall_embedded.hpp>

namespace thinwall {

namespace {

class ThinWallRun final : public Run {
 public:
  explicit ThinWallRun(ShotPlan plan) : plan_(std::move(plan)), stratified_(stratified_plan(plan_)) {}

  /// First every cell at every detector, cell by cell and volley by volley, then the stratified cells.
  std::vector<Unit> units() const override {
    std::vector<Unit> units;
    const std::vector<Volley> volleys = volleys_of(plan_.shots);
    for (const Cell& cell : plan_.cells) {
      const std::string where = key(cell);
      for (const Detector& detector : plan_.detectors) {
        for (const Volley& volley : volleys) {
          std::string unit = fmt::format("{} {} {}", where, detector.method, detector.scalar);
          if (volleys.size() > 1) unit += fmt::format(" from {}", volley.first);
          units.push_back({std::move(unit), volley.shots, [this, &cell, &detector, volley] {
                             return to_line(fire(cell, detector, volley, plan_.seed));
                           }});
        }
      }
    }
    for (const Cell& cell : stratified_.cells) {
      const auto shots = stratified_shots * static_cast<std::int64_t>(stratified_.detectors.size());
      units.push_back({fmt::format("{} stratified", key(cell)), shots,
                       [this, &cell] { return stratified_counts(cell, stratified_.detectors, plan_.seed); }});
    }
    return units;
  }

  Outcome finish(const std::vector<std::string>& results, const std::vector<double>& seconds) const override {
    const std::size_t volleys = volleys_of(plan_.shots).size();
    const std::size_t count = plan_.cells.size() * plan_.detectors.size() * volleys;
    std::vector<Tally> tallies;
    std::vector<double> times;
    for (std::size_t i = 0; i < count; ++i) {
      if (i % volleys == 0) {
        tallies.emplace_back();
        times.push_back(0);
      }
      tallies.back() += tally_from_line(results[i]);
      times.back() += seconds[i];
    }
    const std::vector<Line> lines = make_lines(plan_, tallies, times);
    const std::vector<Total> sums = totals(lines);
    const Verdicts verdicts = {
        self_test(counts_of(lines)),
        stratified_test(stratified_, {results.begin() + static_cast<std::ptrdiff_t>(count), results.end()}),
        lateness_test(lines)};
    Outcome outcome{.answer = answer_text(sums),
                    .summary = summary_text(lines, sums, verdicts),
                    .tables = {bullet_table(lines), totals_table(sums), self_test_table(verdicts.counts),
                               stratified_table(verdicts.stratified), lateness_table(verdicts.lateness),
                               cells_table(lines, plan_.response), timings_table(lines)},
                    .figures = with_points({probability_figure(lines), lateness_figure(lines), finite_figure(lines)}),
                    .sections = report_sections(sums, verdicts),
                    .self_test_passed = verdicts.passed()};
    if (plan_.response == Response::bounce) add_bounces(lines, outcome);
    return outcome;
  }

 private:
  /// The bounce comes first: it is what was asked for.
  static void add_bounces(const std::vector<Line>& lines, Outcome& outcome) {
    const std::vector<SelfTest> tests = self_test(through_counts(lines));
    outcome.answer = bounce_answer(lines) + " " + outcome.answer;
    outcome.summary = bounce_text(lines, tests) + outcome.summary;
    outcome.tables.insert(outcome.tables.begin(), {bounce_table(lines), bounce_self_test_table(tests)});
    for (Figure& figure : with_points({bounce_figure(lines)}))
      outcome.figures.insert(outcome.figures.begin(), std::move(figure));
    outcome.sections.push_back(bounce_section(tests));
    outcome.self_test_passed &= all_passed(tests) && ends_agree(lines);
  }

  static std::vector<CellCount> counts_of(const std::vector<Line>& lines) {
    std::vector<CellCount> counts;
    for (const Line& line : lines) {
      if (!line.theory.probability) continue;
      counts.push_back({line.detector->method, line.detector->scalar, line.tally.shots, line.tally.tunneled,
                        *line.theory.probability});
    }
    return counts;
  }

  ShotPlan plan_;
  StratifiedPlan stratified_;
};

std::unique_ptr<Run> configure(const Settings& settings, const RunOptions& options) {
  return std::make_unique<ThinWallRun>(make_plan(settings, options));
}

}  // namespace

Experiment thin_wall_experiment() {
  return {
      "thin_wall",
      "How often does a fast ball pass through a thin wall, for each way of detecting the hit, and does theory agree?",
      embedded_toml("thin_wall"), configure};
}

}  // namespace thinwall
