/// What does it save to leave out what a scene does not need, and does it change anything? See docs/plan.md.
#include <algorithm>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/lab/columns.hpp>
#include <thinwall/experiments/lab/judge.hpp>
#include <thinwall/experiments/lab/plot.hpp>
#include <thinwall/experiments/lab/race.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/lab/tasks.hpp>
#include <thinwall/experiments/lab/terminal.hpp>
#include <thinwall/experiments/lab/text.hpp>
#include <thinwall/experiments/plan/model.hpp>
#include <thinwall_embedded.hpp>

namespace thinwall {

namespace {

constexpr double noise = 0.02;  // [1] of a step's time: less is not called a saving in words

/// A way to step a scene, beside the plan.
struct WayRow {
  std::string scene;
  Way way, lean;
  bool same() const { return way.outcome == lean.outcome; }
  bool is_omission() const { return way.name != lean_way && way.name != full_way && way.name != gate_way; }
  double time() const { return median(way.milliseconds); }
  double ratio() const { return time() / median(lean.milliseconds); }
  /// [ms] The median over the rounds of the differences.
  Measured saved() const {
    std::vector<double> more;
    for (std::size_t i = 0; i < way.milliseconds.size(); ++i)
      more.push_back(way.milliseconds[i] - lean.milliseconds[i]);
    return median_of_rounds(more);
  }
};

std::vector<WayRow> rows_of(const PlanRace& race) {
  std::vector<WayRow> rows;
  for (const Way& way : race.ways) rows.push_back({race.scene, way, race.ways.front()});
  return rows;
}

std::vector<WayRow> rows_of(const std::vector<PlanRace>& races) {
  std::vector<WayRow> rows;
  for (const PlanRace& race : races) std::ranges::move(rows_of(race), std::back_inserter(rows));
  return rows;
}

// What the tables show.

auto scene_column() { return text("scene", "Scene.", &WayRow::scene); }
auto way_fields(std::initializer_list<std::string_view> names) { return fields(&WayRow::way, names); }
auto time_column() { return value("time", "ms", "Processor time of a step: median over the rounds.", &WayRow::time); }
auto ratio_column() { return value("ratio", "1", "Time over that of the plan.", &WayRow::ratio); }
auto same_column() {
  return value("same_as_plan", "", "States, hits and events have the bits that they have with the plan.",
               &WayRow::same);
}
auto tunneled_column() {
  return where([](const WayRow& row) { return row.way.is_judged(); }, way_fields({"tunneled"}));
}

Table savings_table(const std::vector<PlanRace>& races) {
  return in_report(timing(table(
      "savings", "What a step takes with the plan, and how much more with each omission taken back.", rows_of(races),
      scene_column(), way_fields({"way"}), time_column(),
      measured("saved", "ms", "Time of a step less that of the plan: median over the rounds of the differences.",
               &WayRow::saved, "saved_"),
      ratio_column(), way_fields({"bytes"}), value("bytes_saved", "B", "Less that of the plan.", [](const WayRow& row) {
        return row.way.bytes - row.lean.bytes;
      }))));
}

Table ways_table(const std::vector<PlanRace>& races) {
  return in_report(table("ways", "What each way to step finds and asks, the same in every run.", rows_of(races),
                         scene_column(), way_fields({"way"}), same_column(),
                         way_fields({"repeated_alike", "sweeps", "gated", "hits"}), tunneled_column()));
}

/// For the terminal.
Table race_table(const PlanRace& race) {
  return table(race.scene,
               fmt::format("{}: {} bodies, {} steps; each omission taken back in turn.", race.scene,
                           grouped_text(race.bodies), grouped_text(race.steps)),
               rows_of(race), way_fields({"way"}), time_column(), ratio_column(),
               way_fields({"sweeps", "bytes", "hits"}), tunneled_column(), same_column());
}

double path_of(const GateRow& row) { return row.cell.path; }
double gate_of(const GateRow& row) { return row.cell.gate; }

Columns<GateRow> cell_columns() {
  return columns_of<GateRow>(
      text("target", "A wall of 0.1 radii, or a ball of the same radius.",
           [](const GateRow& row) { return gate_target_name(row.cell.target); }),
      value("path", "1", "Radii that the ball moves in a step.", path_of),
      value("gate", "1", "Gate: the ball is not swept if it moves at most so many radii a step.", gate_of));
}

std::int64_t shots_of(const GateRow& row) { return row.cell.shots; }
std::int64_t missed_of(const GateRow& row) { return row.tally.missed; }
double theory_of(const GateRow& row) { return missed_by_gate(row.cell); }

Columns<GateRow> gate_columns() {
  return columns_of<GateRow>(cell_columns(), value("shots", "1", "Balls, each of which meets its target.", shots_of),
                             fields(&GateRow::tally, {"missed"}),
                             share("missed_share", "Share of the shots.", missed_of, shots_of),
                             value("theory", "1", "Chance to be missed.", theory_of),
                             fields(&GateRow::tally, {"late", "missed_without_gate", "sweeps", "gated"}));
}

Table gate_table(const std::vector<GateRow>& rows) {
  return in_report(table("gate",
                         "Shots that the motion gate never sees, against theory. Without it every shot is seen.",
                         gate_columns(), rows));
}

Table gate_timings_table(const std::vector<GateRow>& rows) {
  return timing(table("gate_timings", "Time of a step of the shots, with the gate and without.", rows, cell_columns(),
                      value("time", "ms", "A step with the gate: median over the rounds.",
                            [](const GateRow& row) { return median(row.tally.milliseconds); }),
                      value("time_without_gate", "ms", "A step without.",
                            [](const GateRow& row) { return median(row.tally.swept_milliseconds); })));
}

// What the pictures show.

Figure savings_figure(const std::vector<PlanRace>& races) {
  std::vector<WayRow> rows = rows_of(races);
  std::erase_if(rows, [](const WayRow& row) { return row.way.name == lean_way; });
  const std::vector<std::string> names = distinct(rows, [](const WayRow& row) { return row.way.name; });
  const auto aside = [&](const WayRow& row) {  // the ways of a scene stand next to each other
    const auto scene = std::ranges::find(races, row.scene, &PlanRace::scene) - races.begin();
    const auto way = std::ranges::find(names, row.way.name) - names.begin();
    return static_cast<double>(scene) +
           0.7 * ((static_cast<double>(way) + 0.5) / static_cast<double>(names.size()) - 0.5);
  };
  const auto relative = [](const WayRow& row) {
    const Measured more = row.saved().times(1 / median(row.lean.milliseconds));
    return Measured{1 + more.value, {1 + more.interval.lower, 1 + more.interval.upper}};
  };
  Panel panel = plot(rows, way_fields({"way"}), value("scene", "", "", aside), measured("y", "", "", relative))
                    .x("scene")
                    .y("y", Axis::log, "time of a step over that of the plan [1]")
                    .by("way")
                    .height(1.4);
  for (std::size_t k = 0; k < races.size(); ++k) panel.x_tics.push_back({static_cast<double>(k), races[k].scene});
  return {
      .name = "savings",
      .title = "What a step costs with one omission taken back",
      .caption =
          "Above 1 is what the omission saves; the full plan takes back all of them. Same bits in each case, but for "
          "the gate, which is no omission. Medians over interleaved rounds, 95 % bootstrap intervals.",
      .panels = {std::move(panel)},
      .is_timing = true};
}

Panel gate_panel(const std::vector<GateRow>& rows, GateTarget target) {
  const auto label = text("series", "", [](const GateRow& row) { return fmt::format("gate {:g}", row.cell.gate); });
  const std::string name = gate_target_name(target);
  Plot points = plot(rows, gate_columns(), label);
  points.where("target", name).x("path", Axis::log, "path of a step [radii]").by("series");
  const double shortest = std::ranges::min(rows, {}, path_of).cell.path,
               longest = std::ranges::max(rows, {}, path_of).cell.path;
  for (const double gate : distinct(rows, gate_of)) {
    if (gate <= shortest) continue;
    points.curve(
        "theory, up to the gate",
        [=](double path) {  // whose last may round to beyond the gate
          return missed_by_gate({.target = target, .path = std::min(path, gate), .gate = gate});
        },
        shortest, std::min(gate, longest));
  }
  return points.y("missed_share", Axis::linear, fmt::format("missed, of shots at a {} [1]", name));
}

Figure gate_figure(const std::vector<GateRow>& rows) {
  return {.name = "gate",
          .title = "Shots that the motion gate never sees",
          .caption =
              "Points: share of the shots, 95 % Wilson intervals; lines: theory. A ball that moves more than the "
              "gate's part of its radius is swept, and never missed: each series falls to 0 beyond its gate.",
          .panels = {gate_panel(rows, GateTarget::wall), gate_panel(rows, GateTarget::ball)}};
}

// What it says.

/// Ways that omit or keep, over all scenes, and those of other bits.
std::pair<std::int64_t, std::int64_t> count_wrong(const std::vector<PlanRace>& races) {
  std::int64_t ways = 0, wrong = 0;
  for (const WayRow& row : rows_of(races)) {
    if (row.way.is_judged()) continue;
    ++ways;
    wrong += row.way.repeated_alike && row.same() ? 0 : 1;
  }
  return {ways, wrong};
}

std::string self_test_words(const std::vector<PlanRace>& races, const std::vector<GateRow>& shots) {
  const auto [ways, wrong] = count_wrong(races);
  std::string words = fmt::format(
      "The states after each step, and every hit and event that was asked for, to the bit: same bits as with the plan "
      "in {} of {} ways to step; ",
      ways - wrong, ways);
  for (const SelfTest& test : gate_self_test(shots)) {
    words +=
        fmt::format("{}: {} cells certain, {} of them wrong, {} of {} others hold the theory ({:g} to {:g} allowed); ",
                    test.name, test.certain_cells, test.certain_wrong, test.covered, test.judged_cells,
                    test.covered_allowed.lower, test.covered_allowed.upper);
  }
  std::int64_t early = 0;
  for (const GateRow& row : shots) early += row.tally.early;
  return words + fmt::format("{} meetings told early.", early);
}

/// What the omissions of a scene save: all of them, and the one that saves most.
std::string savings_text(const PlanRace& race) {
  const std::vector<WayRow> rows = rows_of(race);
  const WayRow *best = nullptr, *full = nullptr;
  for (const WayRow& row : rows) {
    if (row.way.name == full_way) full = &row;
    if (row.is_omission() && (best == nullptr || row.ratio() > best->ratio())) best = &row;
  }
  if (best == nullptr || full == nullptr) return "";
  std::string text =
      fmt::format(" {}: {} times as long without any omission", race.scene, rounded_text(full->ratio(), 3));
  if (best->ratio() > 1 + noise) {
    text += fmt::format(", {} times with the omission of {} alone taken back", rounded_text(best->ratio(), 3),
                        best->way.name);
  }
  return text + ".";
}

/// What the gate does to a scene of which it spares half or more.
std::string gate_text(const PlanRace& race) {
  std::string text;
  for (const WayRow& row : rows_of(race)) {
    const Way& gate = row.way;
    if (gate.name != gate_way || 2 * gate.gated < gate.sweeps || gate.gated == 0) continue;
    text += fmt::format(
        " The gate of {} spares {} of {} sweeps and {:.0f} % of the time, for {} hits instead of {} and {} pairs "
        "that pass through each other.",
        race.scene, grouped_text(gate.gated), grouped_text(gate.sweeps), 100 * (1 - row.ratio()),
        grouped_text(gate.hits), grouped_text(row.lean.hits), grouped_text(gate.tunneled));
  }
  return text;
}

std::string answer_of(const std::vector<PlanRace>& races) {
  const auto [ways, wrong] = count_wrong(races);
  std::string text = wrong == 0
                         ? fmt::format("No omission changes a bit, in {} ways to step {} scenes.", ways, races.size())
                         : fmt::format("{} of {} ways to step change the outcome.", wrong, ways);
  for (const PlanRace& race : races) text += savings_text(race);
  for (const PlanRace& race : races) text += gate_text(race);
  return text;
}

std::string summary_of(const std::vector<PlanRace>& races, const std::vector<GateRow>& shots) {
  std::string text;
  for (const PlanRace& race : races) text += terminal(race_table(race)) + "\n";
  std::vector<GateRow> unswept = shots;
  std::erase_if(unswept, [](const GateRow& row) { return row.cell.path > row.cell.gate; });
  return text + terminal(gate_table(unswept), {"path", "gate", "target", "shots", "missed_share", "theory", "late"});
}

Outcome outcome_of(const std::vector<PlanRace>& races, const std::vector<GateRow>& shots) {
  const bool right = std::ranges::all_of(races, is_right) && gate_is_right(shots);
  return {.answer = answer_of(races),
          .summary = summary_of(races, shots) + fmt::format("\nSelf-test {}.\n", verdict_text(right)),
          .tables = {savings_table(races), ways_table(races), gate_table(shots), gate_timings_table(shots)},
          .figures = {savings_figure(races), gate_figure(shots)},
          .sections = {{"Self-test", self_test_words(races, shots)}},
          .self_test_passed = right};
}

std::vector<GateRow> make_cells(const Settings& settings) {
  constexpr Range positive = {.lower = 0, .upper = 1000, .lower_open = true};
  const std::int64_t shots = settings.integer("shots", 1, 1000000);
  settings.limit_cells({"shot_path", "shot_gate"}, 2);  // at a wall, and at a ball
  const std::vector<double> gates = settings.numbers("shot_gate", positive);
  std::vector<GateRow> rows;
  for (const double path : settings.numbers("shot_path", {.lower = 0.01, .upper = 1000})) {
    for (const double gate : gates) {
      if (path == gate) settings.complain("shot_path", fmt::format("any but {}, which is a gate", path));
      for (const GateTarget target : {GateTarget::wall, GateTarget::ball})
        rows.push_back({{target, path, gate, shots}, {}});
    }
  }
  return rows;
}

std::unique_ptr<Run> configure(const Settings& settings, const RunOptions& options) {
  const PlanRaceOptions how = {.steps = settings.integer("steps", 1, 100000),
                               .rounds = settings.trials("rounds", 1, 1000, options.trials),
                               .gate = settings.number("gate", {.lower = 0, .upper = 1000, .lower_open = true})};
  const std::int64_t count = settings.integer("count", 2, 100000);
  std::vector<Task<PlanRace>> races;
  for (const std::string& name : settings.choices("scene", plan_scene_names)) {
    const PlanScene scene = make_plan_scene(name, count, options.seed);
    races.push_back(
        {"scene " + name, std::ssize(scene.bodies) * how.rounds, [scene, how] { return race_plans(scene, how); }});
  }
  const std::vector<GateRow> cells = make_cells(settings);
  std::vector<Task<GateTally>> shots;
  for (const auto& [cell, empty] : cells) {
    shots.push_back({fmt::format("gate {} {} {}", gate_target_name(cell.target), cell.path, cell.gate), cell.shots,
                     [cell = cell, how, seed = options.seed] { return shoot_at_gate(cell, how.rounds, seed); }});
  }
  const auto finish = [cells](const Done<PlanRace>& raced, const Done<GateTally>& shot) {
    std::vector<GateRow> rows = cells;
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].tally = shot.results[i];
    return outcome_of(raced.results, rows);
  };
  return make_run(finish, std::move(races), std::move(shots));
}

}  // namespace

Experiment plan_experiment() {
  return {"plan", "What does it save to leave out what a scene does not need, and does it change anything?",
          embedded_toml("plan"), configure};
}

}  // namespace thinwall
