#include <thinwall/experiments/plan/report.hpp>

namespace thinwall {

namespace {

using enum ColumnType;

Value integer_of(std::int64_t value) { return value; }

double told_share(const GateLine& line) {
  return static_cast<double>(line.tally.missed) / static_cast<double>(line.cell.shots);
}

std::vector<Column> shot_columns() {
  return {{"target", text, "", "A wall of 0.1 radii, or a ball of the same radius."},
          {"path", number, "1", "Radii that the ball moves in a step."},
          {"gate", number, "1", "Gate: the ball is not swept if it moves at most so many radii a step."}};
}

}  // namespace

Saved saved_by(const PlanRace& race, const Way& way) {
  const Way& lean = race.ways.front();
  std::vector<double> more;
  for (std::size_t i = 0; i < way.milliseconds.size(); ++i) more.push_back(way.milliseconds[i] - lean.milliseconds[i]);
  const RandomStream stream{0, 0};
  return {median(more), bootstrap_median(more, stream), median(way.milliseconds) / median(lean.milliseconds),
          way.bytes - lean.bytes};
}

Table savings_table(const PlanResults& results) {
  Table table;
  table.name = "savings";
  table.description = "What a step takes with the plan, and how much more with each omission taken back.";
  table.is_timing = true;
  table.in_report = true;
  table.columns = {
      {"scene", text, "", "Scene."},
      {"way", text, "", "The plan, the omission that is taken back, the full plan, or the gate."},
      {"time", number, "ms", "Processor time of a step: median over the rounds."},
      {"saved", number, "ms", "Time of a step less that of the plan: median over the rounds of the differences.",
       "saved_lower", "saved_upper"},
      {"saved_lower", number, "ms", "Its 95 % bootstrap interval."},
      {"saved_upper", number, "ms", "Its 95 % bootstrap interval."},
      {"ratio", number, "1", "Time over that of the plan."},
      {"bytes", integer, "B", "Held for stepping at most, without the memory of the broad phase itself."},
      {"bytes_saved", integer, "B", "Less that of the plan."}};
  for (const PlanRace& race : results.races) {
    for (const Way& way : race.ways) {
      const Saved saved = saved_by(race, way);
      table.rows.push_back({race.scene, way.name, median(way.milliseconds), saved.milliseconds, saved.interval.lower,
                            saved.interval.upper, saved.ratio, integer_of(way.bytes), integer_of(saved.bytes)});
    }
  }
  return table;
}

Table ways_table(const PlanResults& results) {
  Table table;
  table.name = "ways";
  table.description = "What each way to step finds and asks, the same in every run.";
  table.in_report = true;
  table.columns = {{"scene", text, "", "Scene."},
                   {"way", text, "", "The plan, the omission that is taken back, the full plan, or the gate."},
                   {"same_as_plan", boolean, "", "States, hits and events have the bits that they have with the plan."},
                   {"repeated_alike", boolean, "", "Every round gave the same bits."},
                   {"sweeps", integer, "1", "Pairs asked over all steps."},
                   {"gated", integer, "1", "Of these not swept, but looked at where the step starts."},
                   {"hits", integer, "1", "Contacts over all steps."},
                   {"tunneled", integer, "1", "Pairs that went through each other unseen; of the plan and the gate."}};
  for (const PlanRace& race : results.races) {
    for (const Way& way : race.ways) {
      const bool is_judged = way.name == lean_way || way.name == gate_way;
      table.rows.push_back({race.scene, way.name, way.outcome == race.ways.front().outcome, way.repeated_alike,
                            integer_of(way.sweeps), integer_of(way.gated), integer_of(way.hits),
                            is_judged ? integer_of(way.tunneled) : Value()});
    }
  }
  return table;
}

Table gate_table(const PlanResults& results) {
  Table table;
  table.name = "gate";
  table.description = "Shots that the motion gate never sees, against theory. Without it every shot is seen.";
  table.in_report = true;
  table.columns = shot_columns();
  const std::vector<Column> more = {
      {"shots", integer, "1", "Balls, each of which meets its target."},
      {"missed", integer, "1", "Of these, never told to have met it."},
      {"missed_share", number, "1", "Share of the shots.", "lower", "upper"},
      {"lower", number, "1", "Its 95 % Wilson interval."},
      {"upper", number, "1", "Its 95 % Wilson interval."},
      {"theory", number, "1", "Chance to be missed."},
      {"late", number, "1", "Steps from the true meeting to the one told: mean over the shots told."},
      {"missed_without_gate", integer, "1", "Shots that are missed with no gate: none."},
      {"sweeps", integer, "1", "Pairs asked over all steps."},
      {"gated", integer, "1", "Of these not swept."}};
  table.columns.insert(table.columns.end(), more.begin(), more.end());
  for (const GateLine& line : results.shots) {
    const GateTally& t = line.tally;
    const Interval interval = wilson(t.missed, line.cell.shots);
    table.rows.push_back({gate_target_name(line.cell.target), line.cell.path, line.cell.gate,
                          integer_of(line.cell.shots), integer_of(t.missed), told_share(line), interval.lower,
                          interval.upper, missed_by_gate(line.cell), t.late, integer_of(t.missed_swept),
                          integer_of(t.sweeps), integer_of(t.gated)});
  }
  return table;
}

Table gate_timings_table(const PlanResults& results) {
  Table table;
  table.name = "gate_timings";
  table.description = "Time of a step of the shots, with the gate and without.";
  table.is_timing = true;
  table.columns = shot_columns();
  table.columns.push_back({"time", number, "ms", "A step with the gate: median over the rounds."});
  table.columns.push_back({"time_without_gate", number, "ms", "A step without."});
  for (const GateLine& line : results.shots) {
    table.rows.push_back({gate_target_name(line.cell.target), line.cell.path, line.cell.gate,
                          median(line.tally.milliseconds), median(line.tally.swept_milliseconds)});
  }
  return table;
}

}  // namespace thinwall
