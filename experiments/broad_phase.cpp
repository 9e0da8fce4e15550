#include <thinwall/experiments/experiment_list.hpp>

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include <thinwall/experiments/broad_phase/finder.hpp>
#include <thinwall/experiments/broad_phase/report.hpp>
#include <thinwall/experiments/settings.hpp>
#include <thinwall_embedded.hpp>

namespace thinwall {

namespace {

class BroadPhaseRun final : public Run {
 public:
  BroadPhaseRun(std::vector<CrowdFactors> crowds, SurveyOptions options)
      : crowds_(std::move(crowds)), options_(std::move(options)) {}

  std::vector<Unit> units() const override {
    std::vector<Unit> units;
    for (const CrowdFactors& crowd : crowds_) {
      units.push_back({fmt::format("{} {} {}", placement_name(crowd), crowd.speed, crowd.count), crowd.count,
                       [this, &crowd] { return to_line(survey(crowd, options_)); }});
    }
    return units;
  }

  Outcome finish(const std::vector<std::string>& results, const std::vector<double>&) const override {
    std::vector<SurveyLine> lines;
    for (std::size_t i = 0; i < results.size(); ++i) lines.push_back({crowds_[i], survey_from_line(results[i])});
    return {.answer = broad_phase_answer(lines),
            .summary = broad_phase_summary(lines),
            .tables = {growth_table(lines), crowds_table(lines), finders_table(lines)},
            .figures = broad_phase_figures(lines),
            .sections = broad_phase_sections(lines),
            .self_test_passed = all_right(lines)};
  }

 private:
  std::vector<CrowdFactors> crowds_;
  SurveyOptions options_;
};

std::vector<std::string> chosen_finders(const Settings& settings) {
  std::vector<std::string_view> allowed = finder_names();
  const std::vector<std::string> all(allowed.begin(), allowed.end());
  allowed.emplace_back("all");
  const std::vector<std::string> chosen = settings.choices("broad_phase", allowed);
  if (std::find(chosen.begin(), chosen.end(), "all") != chosen.end()) return all;
  return chosen;
}

std::unique_ptr<Run> configure(const Settings& settings, const RunOptions& options) {
  SurveyOptions survey;
  survey.finders = chosen_finders(settings);
  survey.loops_up_to = settings.integer("loops_up_to", 0, 10000000);
  survey.sweep_up_to = settings.integer("sweep_up_to", 0, 10000000);
  survey.rounds = settings.trials("rounds", 1, 1 << 20, options.trials);
  survey.seconds = settings.number("seconds", {.lower = 0, .upper = 1000, .unit = "s"});
  survey.seed = options.seed;
  settings.limit_cells({"placement", "speed", "count"});
  const std::vector<std::int64_t> counts = settings.integers("count", 1, 10000000);
  const std::vector<double> speeds = settings.numbers("speed", {.lower = 0, .upper = 1000, .unit = "m"});
  const double density = settings.number("density", {.lower = 1e-6, .upper = 10, .unit = "1/m^3"});
  static constexpr std::array<std::string_view, 2> placements = {"uniform", "clustered"};
  std::vector<CrowdFactors> crowds;
  for (const std::string& placement : settings.choices("placement", placements)) {
    for (const double speed : speeds) {
      for (const std::int64_t count : counts) {
        if (finders_for(count, survey).empty())
          settings.complain("broad_phase", fmt::format("at least one that is not left out of {} balls", count));
        crowds.push_back({placement == "clustered", speed, density, count});
      }
    }
  }
  return std::make_unique<BroadPhaseRun>(std::move(crowds), std::move(survey));
}

}  // namespace

Experiment broad_phase_experiment() {
  return {"broad_phase", "What does it cost to find the pairs of moving balls that may touch, against their number?",
          embedded_toml("broad_phase"), configure};
}

}  // namespace thinwall
