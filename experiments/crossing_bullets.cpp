#include <thinwall/experiments/crossing_bullets.hpp>

#include <algorithm>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include <thinwall/experiments/crossing_bullets/figures.hpp>
#include <thinwall/experiments/crossing_bullets/summary.hpp>
#include <thinwall/experiments/crossing_bullets/tables.hpp>
#include <thinwall_embedded.hpp>

namespace thinwall {

namespace {

class CrossingBulletsRun final : public Run {
 public:
  CrossingBulletsRun(std::vector<Crossing> cells, std::vector<CrossingRule> rules, std::int64_t shots,
                     std::uint64_t seed)
      : cells_(std::move(cells)), rules_(std::move(rules)), shots_(shots), seed_(seed) {}

  std::vector<Unit> units() const override {
    std::vector<Unit> units;
    for (const Crossing& cell : cells_) {
      for (const CrossingRule& rule : rules_) {
        units.push_back({fmt::format("{} {}", key(cell), rule.name), shots_,
                         [this, &cell, &rule] { return to_line(ask_all(rule, cell, seed_, shots_)); }});
      }
    }
    return units;
  }

  Outcome finish(const std::vector<std::string>& results, const std::vector<double>& seconds) const override {
    std::vector<CrossingTally> tallies;
    for (const std::string& result : results) tallies.push_back(crossing_tally_from_line(result));
    const std::vector<CrossingLine> lines = make_lines(cells_, rules_, tallies);
    const std::vector<CrossingTotal> sums = totals(lines, seconds);
    const CrossingVerdicts verdicts = {self_test(counts_of(lines)), timing_test(lines)};
    return {.answer = crossing_answer(lines, sums),
            .summary = crossing_summary(lines, sums, verdicts),
            .tables = {head_on_table(lines), rules_table(sums), counts_test_table(verdicts.counts),
                       timing_test_table(verdicts.times), crossings_table(lines), rule_timings_table(sums)},
            .figures = crossing_figures(lines),
            .sections = crossing_sections(verdicts),
            .self_test_passed = verdicts.passed()};
  }

 private:
  std::vector<Crossing> cells_;
  std::vector<CrossingRule> rules_;
  std::int64_t shots_;
  std::uint64_t seed_;
};

std::unique_ptr<Run> configure(const Settings& settings, const RunOptions& options) {
  std::vector<std::string_view> allowed = crossing_rule_names();
  std::vector<std::string> all(allowed.begin(), allowed.end());
  allowed.emplace_back("all");
  std::vector<std::string> chosen = settings.choices("rule", allowed);
  if (std::find(chosen.begin(), chosen.end(), "all") != chosen.end()) chosen = all;
  const std::int64_t shots = settings.trials("shots", 1, std::int64_t(1) << 30, options.trials);
  std::vector<CrossingRule> rules = crossing_rules(chosen);
  settings.limit_cells({"speed", "ratio", "angle_deg", "offset"}, rules.size());
  return std::make_unique<CrossingBulletsRun>(make_crossings(settings), std::move(rules), shots, options.seed);
}

}  // namespace

Experiment crossing_bullets_experiment() {
  return {"crossing_bullets",
          "Two fast bodies cross: how many false hits and misses come of sweeping both and testing, against the exact "
          "relative motion?",
          embedded_toml("crossing_bullets"), configure};
}

}  // namespace thinwall
