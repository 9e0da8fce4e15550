#include <thinwall/experiments/experiment_list.hpp>

#include <algorithm>
#include <memory>
#include <utility>

#include <thinwall/experiments/hitscan/figures.hpp>
#include <thinwall/experiments/hitscan/summary.hpp>
#include <thinwall/experiments/hitscan/tables.hpp>
#include <thinwall_embedded.hpp>

namespace thinwall {

namespace {

/// One line for all rules of a cell.
constexpr char separator = ';';

std::string to_line(const std::vector<HitscanTally>& tallies) {
  std::string line;
  for (const HitscanTally& tally : tallies) line += (line.empty() ? "" : std::string(1, separator)) + to_line(tally);
  return line;
}

std::vector<HitscanTally> tallies_from_line(const std::string& line) {
  std::vector<HitscanTally> tallies;
  std::size_t from = 0;
  while (from <= line.size()) {
    const std::size_t until = std::min(line.find(separator, from), line.size());
    tallies.push_back(hitscan_tally_from_line(line.substr(from, until - from)));
    from = until + 1;
  }
  return tallies;
}

class HitscanRun final : public Run {
 public:
  HitscanRun(std::vector<HitscanCell> cells, std::vector<HitscanRule> rules, std::int64_t shots, std::uint64_t seed)
      : cells_(std::move(cells)), rules_(std::move(rules)), shots_(shots), seed_(seed) {}

  std::vector<Unit> units() const override {
    std::vector<Unit> units;
    for (const HitscanCell& cell : cells_) {
      units.push_back({key(cell), shots_, [this, &cell] { return to_line(shoot(rules_, cell, seed_, shots_)); }});
    }
    return units;
  }

  Outcome finish(const std::vector<std::string>& results, const std::vector<double>& /*seconds*/) const override {
    std::vector<std::vector<HitscanTally>> tallies;
    for (const std::string& result : results) tallies.push_back(tallies_from_line(result));
    const std::vector<HitscanLine> lines = make_hitscan_lines(cells_, rules_, tallies);
    const std::vector<HitscanTotal> sums = totals(lines);
    const HitscanVerdicts verdicts = {self_test(counts_of(lines)), moment_tests(lines)};
    return {.answer = hitscan_answer(lines, sums),
            .summary = hitscan_summary(lines, sums, verdicts),
            .tables = {known_shots_table(lines), reach_table(cells_), hitscan_rules_table(sums),
                       hitscan_counts_test_table(verdicts.counts), moment_tests_table(verdicts.moments),
                       hitscan_cells_table(lines)},
            .figures = hitscan_figures(lines),
            .sections = hitscan_sections(verdicts),
            .self_test_passed = verdicts.passed()};
  }

 private:
  std::vector<HitscanCell> cells_;
  std::vector<HitscanRule> rules_;
  std::int64_t shots_;
  std::uint64_t seed_;
};

std::unique_ptr<Run> configure(const Settings& settings, const RunOptions& options) {
  std::vector<std::string_view> allowed = hitscan_rule_names();
  const std::vector<std::string> all(allowed.begin(), allowed.end());
  allowed.emplace_back("all");
  std::vector<std::string> chosen = settings.choices("rule", allowed);
  if (std::find(chosen.begin(), chosen.end(), "all") != chosen.end()) chosen = all;
  const std::int64_t shots = settings.trials("shots", 1, std::int64_t(1) << 30, options.trials);
  return std::make_unique<HitscanRun>(make_hitscan_cells(settings), hitscan_rules(chosen), shots, options.seed);
}

}  // namespace

Experiment hitscan_experiment() {
  return {
      "hitscan",
      "A ray stands for a bullet: how many hits does it miss, how many are false, and how far off is it, at what range "
      "and speed?",
      embedded_toml("hitscan"), configure};
}

}  // namespace thinwall
