#include <thinwall/experiments/experiment_list.hpp>

#include <algorithm>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include <thinwall/experiments/swept_bounds/figures.hpp>
#include <thinwall/experiments/swept_bounds/summary.hpp>
#include <thinwall/experiments/swept_bounds/tables.hpp>
#include <thinwall_embedded.hpp>

namespace thinwall {

namespace {

class SweptBoundsRun final : public Run {
 public:
  SweptBoundsRun(SweepPlan plan, std::vector<SweptBound> bounds, std::int64_t shots, std::int64_t repeats,
                 std::uint64_t seed)
      : plan_(std::move(plan)),
        bounds_(std::move(bounds)),
        pairs_(serving_pairs(plan_.cells, bounds_)),
        shots_(shots),
        repeats_(repeats),
        seed_(seed) {
    if (repeats_ > 0) subjects_ = timed_subjects(plan_.timed, bounds_, seed_);
  }

  std::vector<Unit> units() const override {
    std::vector<Unit> units;
    for (const SweepPair& pair : pairs_) {
      units.push_back({fmt::format("{} {}", key(pair.sweep), pair.bound->name), 2 * shots_,
                       [this, &pair] { return to_line(pair.bound->ask_all(pair.sweep, seed_, shots_)); }});
    }
    for (Unit& unit : timing_units(subjects_, repeats_)) units.push_back(std::move(unit));
    return units;
  }

  Outcome finish(const std::vector<std::string>& results, const std::vector<double>& seconds) const override {
    std::vector<SweepLine> lines;
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      lines.push_back(make_line(pairs_[i], sweep_tally_from_line(results[i])));
    }
    const std::vector<SweepTotal> sums = totals(lines);
    const std::vector<SelfTest> tests = self_test(counts_of(lines));
    const std::vector<SweepCost> costs = sweep_costs(subjects_, std::span(seconds).subspan(pairs_.size()));
    Outcome outcome = {
        .answer = sweep_answer(lines, sums, plan_.view),
        .summary = sweep_summary(lines, sums, tests, costs, plan_.view),
        .tables = {diagonal_table(lines), shapes_table(sums), sweep_test_table(tests), sweeps_table(lines)},
        .figures = sweep_figures(lines, bounds_, plan_.view),
        .sections = sweep_sections(tests),
        .self_test_passed = all_passed(tests)};
    if (!costs.empty()) outcome.tables.push_back(sweep_timings_table(costs));
    return outcome;
  }

 private:
  SweepPlan plan_;
  std::vector<SweptBound> bounds_;
  std::vector<SweepPair> pairs_;  ///< point into bounds_
  std::vector<TimedSubject> subjects_{};
  std::int64_t shots_, repeats_;
  std::uint64_t seed_;
};

std::vector<SweptBound> chosen_bounds(const Settings& settings) {
  std::vector<std::string_view> allowed = swept_bound_names();
  std::vector<std::string> all(allowed.begin(), allowed.end());
  allowed.emplace_back("all");
  std::vector<std::string> chosen = settings.choices("bound", allowed);
  if (std::find(chosen.begin(), chosen.end(), "all") != chosen.end()) chosen = all;
  return swept_bounds_named(chosen);
}

std::unique_ptr<Run> configure(const Settings& settings, const RunOptions& options) {
  const std::int64_t shots = settings.trials("shots", 1, std::int64_t(1) << 30, options.trials);
  const std::int64_t repeats = settings.integer("timing_repeats", 0, 1000);
  std::vector<SweptBound> bounds = chosen_bounds(settings);
  settings.limit_cells({"shape", "speed", "angle_deg", "turn_deg", "obstacle"}, bounds.size());
  SweepPlan plan = make_sweeps(settings);
  if (serving_pairs(plan.timed, bounds).empty()) settings.complain("bound", "one that serves one of the shapes");
  return std::make_unique<SweptBoundsRun>(std::move(plan), std::move(bounds), shots, repeats, options.seed);
}

}  // namespace

Experiment swept_bounds_experiment() {
  return {"swept_bounds",
          "How many false hits does each bound of a swept shape make, and what do they cost, against speed, shape and "
          "direction?",
          embedded_toml("swept_bounds"), configure};
}

}  // namespace thinwall
