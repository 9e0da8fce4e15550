#include <thinwall/experiments/experiment_list.hpp>

#include <memory>
#include <utility>

#include <thinwall/experiments/engines/report.hpp>
#include <thinwall_embedded.hpp>

namespace thinwall {

namespace {

class EnginesRun final : public Run {
 public:
  explicit EnginesRun(EnginePlan plan) : plan_(std::move(plan)) {}

  std::vector<Unit> units() const override { return engine_units(plan_); }
  std::vector<std::string> notes() const override { return missing_engines(plan_); }

  Outcome finish(const std::vector<std::string>& results, const std::vector<double>&) const override {
    const std::vector<EngineLine> lines = engine_lines(plan_, results);
    return {.answer = engines_answer(lines),
            .summary = engines_summary(plan_, lines),
            .tables = {told_engines_table(lines), engine_cells_table(lines), engine_timings_table(lines)},
            .figures = engine_figures(lines),
            .sections = engines_sections(plan_, lines),
            .self_test_passed = all_passed(self_test(own_counts(lines)))};
  }

 private:
  EnginePlan plan_;
};

std::unique_ptr<Run> configure(const Settings& settings, const RunOptions& options) {
  return std::make_unique<EnginesRun>(make_engine_plan(settings, options));
}

}  // namespace

Experiment engines_experiment() {
  return {"engines",
          "How often do the same fast balls pass a thin wall in whole physics engines, and does theory agree?",
          embedded_toml("engines"), configure};
}

}  // namespace thinwall
