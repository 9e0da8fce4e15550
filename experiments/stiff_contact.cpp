#include <thinwall/experiments/experiment_list.hpp>

#include <memory>
#include <utility>

#include <fmt/format.h>

#include <thinwall/experiments/settings.hpp>
#include <thinwall/experiments/stiff_contact/figures.hpp>
#include <thinwall/experiments/stiff_contact/pareto.hpp>
#include <thinwall/experiments/stiff_contact/summary.hpp>
#include <thinwall/experiments/stiff_contact/tables.hpp>
#include <thinwall_embedded.hpp>

namespace thinwall {

namespace {

class StiffContactRun final : public Run {
 public:
  explicit StiffContactRun(StiffPlan plan)
      : plan_(std::move(plan)), limits_(limit_cells(plan_)), series_(bounce_series(plan_)) {}

  std::vector<Unit> units() const override {
    std::vector<Unit> units;
    const auto steps = static_cast<std::int64_t>(plan_.steps.size());
    for (const LimitCell& cell : limits_) {
      units.push_back({key(cell), steps, [this, cell] { return limit_result(plan_, cell); }});
    }
    const auto bounces = plan_.bounces * static_cast<std::int64_t>(plan_.bounce_steps.size());
    for (const BounceSeries& series : series_) {
      units.push_back({key(series), bounces, [this, series] { return bounce_result(plan_, series); }});
    }
    for (const double ratio : plan_.bounce_ratios) {
      units.push_back({fmt::format("race ratio {}", ratio), plan_.race_bounces * plan_.rounds,
                       [this, ratio] { return to_line(stiff_race(plan_, ratio)); }});
    }
    return units;
  }

  Outcome finish(const std::vector<std::string>& results, const std::vector<double>&) const override {
    StiffResults found;
    auto result = results.begin();
    for (const LimitCell& cell : limits_) found.limits.push_back(limit_line(plan_, cell, *result++));
    for (const BounceSeries& series : series_) {
      for (const ContactLine& line : bounce_lines(plan_, series, *result++)) found.bounces.push_back(line);
    }
    for (const double ratio : plan_.bounce_ratios) {
      for (StiffRacer& racer : racers_from(plan_, ratio, *result++)) found.racers.push_back(std::move(racer));
    }
    found.tests = stiff_tests(plan_, found.limits, found.bounces);
    Outcome outcome;
    outcome.answer = stiff_answer(plan_, found);
    outcome.summary = stiff_summary(plan_, found);
    outcome.tables = {stiff_tests_table(found.tests),        limits_table(found.limits),
                      stability_table(plan_, found.limits),  bounces_table(plan_, found.bounces),
                      detection_table(plan_, found.bounces), race_table(plan_, found.racers),
                      race_times_table(found.racers)};
    outcome.figures = {stability_figure(plan_, found.limits), bounce_figure(plan_, found.bounces),
                       escape_figure(plan_, found.bounces), detection_figure(plan_, found.bounces),
                       race_figure(plan_, found.racers)};
    std::erase_if(outcome.figures, [](const Figure& figure) { return figure.panels.empty(); });
    outcome.sections = stiff_sections(plan_, found);
    outcome.self_test_passed = all_passed(found.tests);
    return outcome;
  }

 private:
  StiffPlan plan_;
  std::vector<LimitCell> limits_;
  std::vector<BounceSeries> series_;
};

std::unique_ptr<Run> configure(const Settings& settings, const RunOptions& options) {
  return std::make_unique<StiffContactRun>(make_stiff_plan(settings, options));
}

}  // namespace

Experiment stiff_contact_experiment() {
  return {
      "stiff_contact",
      "A ball held by a stiff spring at a wall: which steps are stable, what does a bounce do to the energy, and when does "
      "the ball get through?",
      embedded_toml("stiff_contact"), configure};
}

}  // namespace thinwall
