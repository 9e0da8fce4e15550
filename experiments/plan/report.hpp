#pragma once
/// The tables, pictures and words of the experiment plan.

#include <string>
#include <utility>
#include <vector>

#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/plan/gate.hpp>
#include <thinwall/experiments/plan/race.hpp>
#include <thinwall/experiments/self_test.hpp>

namespace thinwall {

struct GateLine {
  GateCell cell;
  GateTally tally;
};

struct PlanResults {
  std::vector<PlanRace> races;
  std::vector<GateLine> shots;
};

/// What a way to step a scene takes beyond the plan, round by round.
struct Saved {
  double milliseconds = 0;     ///< a step: median over the rounds of the differences
  Interval interval = {0, 0};  ///< 95 %, by bootstrap over the rounds
  double ratio = 1;            ///< of the medians
  std::int64_t bytes = 0;
};
Saved saved_by(const PlanRace& race, const Way& way);

/// Outcomes, the same in every run.
Table ways_table(const PlanResults& results);
/// Time and memory that each omission saves.
Table savings_table(const PlanResults& results);
/// What the gate misses of the shots.
Table gate_table(const PlanResults& results);
/// What it saves on them.
Table gate_timings_table(const PlanResults& results);

std::vector<Figure> plan_figures(const PlanResults& results);

/// The shots against theory.
std::vector<SelfTest> gate_self_test(const std::vector<GateLine>& shots);

/// All of it: outcomes to the bit, shots against theory, and no meeting told early.
bool all_right(const PlanResults& results);

std::string plan_answer(const PlanResults& results);
std::string plan_summary(const PlanResults& results);
std::vector<Section> plan_sections(const PlanResults& results);

}  // namespace thinwall
