#include <thinwall/experiments/experiment_list.hpp>

#include <memory>
#include <utility>

#include <fmt/format.h>

#include <thinwall/experiments/plan/report.hpp>
#include <thinwall/experiments/settings.hpp>
#include <thinwall_embedded.hpp>

namespace thinwall {

namespace {

class PlanRun final : public Run {
 public:
  PlanRun(std::vector<PlanScene> scenes, std::vector<GateCell> cells, const PlanRaceOptions& options,
          std::uint64_t seed)
      : scenes_(std::move(scenes)), cells_(std::move(cells)), options_(options), seed_(seed) {}

  std::vector<Unit> units() const override {
    std::vector<Unit> units;
    for (const PlanScene& scene : scenes_) {
      units.push_back({"scene " + scene.name, static_cast<std::int64_t>(scene.bodies.size()) * options_.rounds,
                       [this, &scene] { return to_line(race_plans(scene, options_)); }});
    }
    for (const GateCell& cell : cells_) {
      units.push_back({fmt::format("gate {} {} {}", gate_target_name(cell.target), cell.path, cell.gate), cell.shots,
                       [this, &cell] { return to_line(shoot_at_gate(cell, options_.rounds, seed_)); }});
    }
    return units;
  }

  Outcome finish(const std::vector<std::string>& lines, const std::vector<double>&) const override {
    PlanResults results;
    for (std::size_t i = 0; i < scenes_.size(); ++i) results.races.push_back(plan_race_from_line(lines[i]));
    for (std::size_t i = 0; i < cells_.size(); ++i)
      results.shots.push_back({cells_[i], gate_tally_from_line(lines[scenes_.size() + i])});
    return {.answer = plan_answer(results),
            .summary = plan_summary(results),
            .tables = {savings_table(results), ways_table(results), gate_table(results), gate_timings_table(results)},
            .figures = plan_figures(results),
            .sections = plan_sections(results),
            .self_test_passed = all_right(results)};
  }

 private:
  std::vector<PlanScene> scenes_;
  std::vector<GateCell> cells_;
  PlanRaceOptions options_;
  std::uint64_t seed_;
};

std::unique_ptr<Run> configure(const Settings& settings, const RunOptions& options) {
  constexpr Range positive = {.lower = 0, .upper = 1000, .lower_open = true};
  PlanRaceOptions race;
  race.steps = settings.integer("steps", 1, 100000);
  race.rounds = settings.trials("rounds", 1, 1000, options.trials);
  race.gate = settings.number("gate", positive);
  const std::int64_t count = settings.integer("count", 2, 100000);
  std::vector<PlanScene> scenes;
  for (const std::string& name : settings.choices("scene", plan_scene_names()))
    scenes.push_back(make_plan_scene(name, count, options.seed));
  const std::int64_t shots = settings.integer("shots", 1, 1000000);
  settings.limit_cells({"shot_path", "shot_gate"}, 2);  // at a wall, and at a ball
  const std::vector<double> gates = settings.numbers("shot_gate", positive);
  std::vector<GateCell> cells;
  for (const double path : settings.numbers("shot_path", {.lower = 0.01, .upper = 1000})) {
    for (const double gate : gates) {
      if (path == gate) settings.complain("shot_path", fmt::format("any but {}, which is a gate", path));
      for (const GateTarget target : {GateTarget::wall, GateTarget::ball}) cells.push_back({target, path, gate, shots});
    }
  }
  return std::make_unique<PlanRun>(std::move(scenes), std::move(cells), race, options.seed);
}

}  // namespace

Experiment plan_experiment() {
  return {"plan", "What does it save to leave out what a scene does not need, and does it change anything?",
          embedded_toml("plan"), configure};
}

}  // namespace thinwall
