/// The tables of the stages, and what is said of them.
#include <algorithm>
#include <string>

#include <fmt/format.h>

#include <thinwall/experiments/engines/stages.hpp>
#include <thinwall/experiments/lab/columns.hpp>
#include <thinwall/experiments/lab/terminal.hpp>

namespace thinwall {

namespace {

Columns<StageRow> stage_columns() {
  return columns_of<StageRow>(
      text("stage", "What is played.", [](const StageRow& r) { return r.kind->name; }),
      text("engine", "The physics engine.", [](const StageRow& r) { return r.setup->engine.called; }),
      text("mode", "How it is set up.", [](const StageRow& r) { return r.setup->mode.name; }));
}

/// In percent: who passed or was lost, and after a slash who was disturbed.
std::string in_short(const StageRow& row) {
  const StageTally& t = row.tally;
  const auto percent = [&](std::int64_t part) {
    const double x = share_of(100 * part, t.shots).value_or(0);
    return fmt::format("{:.{}f}", x, x == 0 || x >= 9.95 ? 0 : 1);
  };
  const std::string passed = percent(t.passed + t.lost);
  return row.kind->spins ? passed : passed + "/" + percent(t.disturbed);
}

}  // namespace

Table stages_table(const std::vector<StageRow>& rows) {
  const auto columns = columns_of<StageRow>(
      stage_columns(), fields(&StageRow::tally, {"shots", "passed"}),
      share(
          "passed_share", "passed / shots.", [](const StageRow& r) { return r.tally.passed; },
          [](const StageRow& r) { return r.tally.shots; }, "passed_"),
      value("theory", "1", "Expected share, where only poses are looked at and a formula is known; missing elsewhere.",
            &StageRow::theory),
      fields(&StageRow::tally, {"lost", "disturbed"}),
      value("error", "1",
            "Mean distance of the velocity from the exact one over the speed at the start, of those that did not pass.",
            [](const StageRow& r) { return r.tally.error.mean(); }),
      fields(&StageRow::tally, {"most_error"}));
  return in_report(table("stages", "Every stage in every engine and mode that can play it.", columns, rows));
}

Table stage_timings_table(const std::vector<StageRow>& rows) {
  const auto columns = columns_of<StageRow>(
      stage_columns(), value("nanoseconds", "ns", "Time a step, mean.", [](const StageRow& r) {
        return 1e9 * r.tally.seconds / static_cast<double>(std::max<std::int64_t>(1, r.tally.shots) * r.kind->steps);
      }));
  return timing(table("stage_timings", "Time a step; making the world is not in it.", columns, rows));
}

std::string stages_summary(const std::vector<StageRow>& rows) {
  if (rows.empty()) return "";
  const std::vector<std::string> labels = distinct(rows, [](const StageRow& r) { return r.setup->label(); });
  auto columns = columns_of<std::string>(text("engine and mode", "", [](const std::string& label) { return label; }));
  for (const StageKind& kind : stage_kinds()) {
    if (std::ranges::none_of(rows, [&](const StageRow& r) { return r.kind == &kind; })) continue;
    text(std::string(kind.name), "", [&rows, &kind](const std::string& label) -> std::string {
      const auto row =
          std::ranges::find_if(rows, [&](const StageRow& r) { return r.kind == &kind && r.setup->label() == label; });
      return row == rows.end() ? "-" : in_short(*row);
    }).add_to(columns);
  }
  return terminal(
      table("stages", "Percent that passed / percent of the others that flew away wrong.", columns, labels));
}

std::string stages_text(const EnginePlan& plan, const std::vector<StageRow>& rows) {
  if (rows.empty()) return "";
  std::string text = fmt::format("The motion is {} m a step.", rows.front().size.path);
  for (const StageKind& kind : stage_kinds()) {
    if (std::ranges::any_of(rows, [&](const StageRow& r) { return r.kind == &kind; }))
      text += fmt::format("\n\n{}: {}.", kind.name, kind.what);
  }
  const auto is_apart = [](const EngineSetup& setup) { return !setup.mode.play; };
  const auto apart =
      distinct(only(plan.setups, is_apart), [](const EngineSetup& setup) { return setup.engine.called; });
  if (!apart.empty())
    text += fmt::format("\n\nNot played in {}: only the ball at the wall is.", fmt::join(apart, ", "));
  return text;
}

}  // namespace thinwall
