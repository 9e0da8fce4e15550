/// How often do the same fast balls pass a thin wall in whole physics engines, and does theory agree? See docs/engines.md.
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <set>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include <thinwall/experiments/engines/model.hpp>
#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/lab/columns.hpp>
#include <thinwall/experiments/lab/plot.hpp>
#include <thinwall/experiments/lab/tasks.hpp>
#include <thinwall/experiments/lab/terminal.hpp>
#include <thinwall/experiments/lab/text.hpp>
#include <thinwall_embedded.hpp>

namespace thinwall {

namespace {

using Row = EngineRow;
using Rows = std::vector<EngineRow>;

template <class AnyRow> std::string label_of(const AnyRow& row) { return row.setup->label(); }
double wall_of(const Row& row) { return row.cell.wall_size; }
double path_of(const Row& row) { return row.cell.path; }
bool looks_at_poses(const Row& row) { return row.setup->mode.poses_per_step > 0 || row.setup->mode.never_sweeps; }

bool has_turned(const Row& row) { return row.tally.turned > 0; }

std::vector<double> walls_of(const Rows& rows) { return distinct(rows, wall_of); }

Rows rows_at(const Rows& rows, double wall) {
  return only(rows, [wall](const Row& row) { return wall_of(row) == wall; });
}

/// Those that look at poses, or those that sweep.
Rows rows_at(const Rows& rows, double wall, bool poses) {
  return only(rows_at(rows, wall), [poses](const Row& row) { return looks_at_poses(row) == poses; });
}

/// [%] Of the balls that went through, with its 95 % Wilson interval.
Measured percent_of(const Row& row) {
  const auto& [shots, tunneled] = std::pair(row.tally.shots, row.tally.tunneled);
  return {*share_of(100 * tunneled, shots), measured_share(tunneled, shots)->times(100).interval};
}

/// [ns] A step.
Measured time_of(const Row& row) { return median_of_rounds(row.nanoseconds); }

/// The path that is nearest to a meter: what is told first.
double told_path(const Rows& rows) {
  return path_of(*std::ranges::min_element(rows, {}, [](const Row& row) { return std::abs(std::log(path_of(row))); }));
}

Rows told_rows(const Rows& rows) {
  return only(rows, [path = told_path(rows)](const Row& row) { return path_of(row) == path; });
}

/// [m] The longest path of those asked, at the wall, up to and with which no shot was wrong; 0 if that is none.
double safe_up_to(const Rows& rows, const Row& like) {
  double safe = 0;
  for (const Row& row : rows_of(rows, label_of(like), wall_of(like))) {
    if (row.tally.wrong() > 0) break;
    safe = path_of(row);
  }
  return safe;
}

// What the tables show.

/// Of a row of the ball at the wall, or of a stage.
template <class AnyRow> Columns<AnyRow> engine_and_mode() {
  return columns_of<AnyRow>(
      text("engine", "The physics engine.", [](const AnyRow& r) { return r.setup->engine.called; }),
      text("mode", "How it is set up.", [](const AnyRow& r) { return r.setup->mode.name; }));
}

Columns<Row> names_and_factors() {
  return columns_of<Row>(engine_and_mode<Row>(), engine_factors.columns(&Row::cell, {"wall_size", "path"}));
}

Columns<Row> verdict_columns() {
  return columns_of<Row>(
      fields(&Row::tally, {"shots", "tunneled"}),
      measured("tunneled_percent", "%", "100 tunneled / shots.", percent_of, "percent_", "its 95 % Wilson interval"),
      value("theory_percent", "%", "By theory, where only poses are looked at; missing elsewhere.",
            [](const Row& r) { return r.theory ? std::optional(100 * *r.theory) : std::nullopt; }),
      text("verdict", "By the oracle: right if every ball was kept in front of the wall.",
           [](const Row& r) { return r.tally.wrong() == 0 ? "right" : "wrong"; }));
}

Columns<Row> bounce_columns() {
  return columns_of<Row>(
      value("lateness", "steps", "Mean over the turned, from first contact to where the lines of flight meet.",
            [](const Row& r) { return r.tally.lateness.mean(); }),
      fields(&Row::tally, {"latest"}),
      value("energy", "1", "Energy after over energy before, mean over the turned.",
            [](const Row& r) { return r.tally.energy.mean(); }),
      fields(&Row::tally, {"least_energy", "most_energy"}));
}

Table told_table(const Rows& rows) {
  return in_report(
      table("engines", fmt::format("Every engine and mode at {} m a step.", told_path(rows)), told_rows(rows),
            names_and_factors(), verdict_columns(),
            value("right_up_to", "m", "Longest path up to which it kept every ball in front; 0 is none of those asked.",
                  [&](const Row& r) { return safe_up_to(rows, r); }),
            bounce_columns()));
}

Table cells_table(const Rows& rows) {
  return table("cells", "Every engine and mode at every path and wall.", rows, names_and_factors(), verdict_columns(),
               fields(&Row::tally, {"unseen", "stuck", "lost", "turned"}),
               value("held", "1", "Balls in front of the wall that do not.",
                     [](const Row& r) { return r.tally.shots - r.tally.wrong() - r.tally.turned; }),
               bounce_columns(),
               value("lateness_path", "m", "The mean lateness as a path.",
                     [](const Row& r) {
                       const auto late = r.tally.lateness.mean();
                       return late ? std::optional(*late * r.cell.path) : std::nullopt;
                     }),
               fields(&Row::tally, {"earliest", "deepest"}));
}

constexpr const char* whose_clock =
    "Processor time of the thread; of engines in npm packages, wall-clock time, which a busy machine lengthens.";

Table timings_table(const Rows& rows) {
  return timing(table(
      "timings", fmt::format("Time a step; making the world is not in it. {}", whose_clock), rows, names_and_factors(),
      measured("nanoseconds", "ns", "Time a step of a world of one wall and one ball, median over volleys.", time_of,
               "", "its 95 % bootstrap interval"),
      value("volleys", "1", "Timed apart, in turn with the other engines.",
            [](const Row& r) { return r.nanoseconds.size(); })));
}

/// One row an engine that took part.
Table packages_table(const Rows& rows) {
  std::vector<Engine> engines;
  const auto name = [](const Row& row) { return row.setup->engine.name; };
  for (const Group<Row>& group : group_by(rows, name)) engines.push_back(group[0]->setup->engine);
  return table("packages", "What each engine came from.", engines,
               text("engine", "The physics engine.", &Engine::called),
               text("package", "Of Debian or npm; empty: this program.", &Engine::package),
               text("version", "Of the package.", &Engine::version),
               text("integrity", "The npm package's hash.", &Engine::integrity));
}

// What the pictures show.

/// A line and its points for each engine and mode, of a column against the path.
Panel path_panel(const Rows& rows, const char* column, std::string y_label) {
  return joined(plot(rows, text("label", "", label_of<Row>), names_and_factors(), verdict_columns(), bounce_columns())
                    .x("path", Axis::log, "path of the ball in a step [m]")
                    .y(column, Axis::linear, std::move(y_label))
                    .by("label"));
}

/// Those that never let a ball through would hide each other on the zero line: they have no line there, where they are two
/// they take turns, and where they are more, one series stands for all.
Panel tunneling_panel(const Rows& rows, std::string y_label) {
  Panel panel = path_panel(rows, "tunneled_percent", std::move(y_label));
  const auto is_zero = [](const Series& s) { return std::ranges::all_of(s.y, [](double y) { return y == 0; }); };
  std::erase_if(panel.series, [&](const Series& s) { return s.mark == Mark::line && is_zero(s); });
  if (std::ranges::count_if(panel.series, is_zero) < 3) return taking_turns(panel);
  Series all = *std::ranges::find_if(panel.series, is_zero);
  all.label = "all others: none through";
  std::erase_if(panel.series, is_zero);
  panel.series.push_back(std::move(all));
  return panel;
}

/// A curve for each number of poses and skin that took part, as one series with gaps, and the dashes of the ball that is never seen
/// at the step's end; in percent.
void add_theory(Panel& panel, const Rows& rows) {
  const double least = path_of(rows.front()), most = path_of(std::ranges::max(rows, {}, path_of));
  if (most == least) return;
  const auto add = [&](Series& series, int poses, double skin, const auto& chance) {
    const auto through = [&, cell = rows.front().cell](double path) mutable {
      cell.path = path;
      return 100 * chance(cell, poses, skin);
    };
    add_curve(series, least, most, Axis::log, through, 200);
    series.end_line();
  };
  std::set<std::pair<int, double>> looked;
  for (const Row& row : rows) {
    if (row.theory) looked.emplace(row.setup->mode.poses_per_step, row.setup->mode.skin);
  }
  Series late = {.label = "theory, not seen in time", .mark = Mark::line};
  Series never = {.label = "theory, never seen", .mark = Mark::dashes};
  for (const auto& [poses, skin] : looked) add(late, poses, skin, through_theory);
  add(never, 1, 0, unseen_theory);
  panel.series.insert(panel.series.end(), {std::move(late), std::move(never)});
}

Figure tunneling_figure(const Rows& rows) {
  const EngineCell& cell = rows.front().cell;
  const bool has_ccd =
      std::ranges::any_of(rows, [](const Row& row) { return row.setup->mode.name.starts_with("ccd_"); });
  Figure figure = {
      .name = "tunneling",
      .title = "How often a ball goes through a thin wall in whole engines",
      .caption = fmt::format(
          "A ball of radius {} m, a wall {} m thick, angles of incidence uniform up to {} deg, the same "
          "shots for all, with 95 % Wilson intervals. Above: who looks at poses, with a curve for each "
          "number of poses and each skin. Below: who sweeps, at each wall{}. "
          "Two that let none through take turns on the zero line; more are one series.",
          cell.radius, cell.thickness, cell.angle_deg, has_ccd ? "; ccd_F sweeps a ball of F times the radius" : "")};
  figure.panels.push_back(tunneling_panel(rows_at(rows, cell.wall_size, true), "through, looking at poses [%]"));
  add_theory(figure.panels.back(), rows);
  for (const double wall : walls_of(rows)) {
    figure.panels.push_back(
        tunneling_panel(rows_at(rows, wall, false), fmt::format("through, sweeping, wall {} m wide [%]", wall)));
  }
  return figure;
}

/// Of a column of the balls that turned, at the first wall.
Figure bounce_figure(const Rows& rows, const char* column, const char* y_label, const char* title,
                     const char* caption) {
  const double wall = wall_of(rows.front());
  Figure figure = {.name = column, .title = title, .caption = fmt::format("{} The wall is {} m wide.", caption, wall)};
  for (const bool poses : {true, false}) {
    const Rows some = only(rows_at(rows, wall, poses), has_turned);
    figure.panels.push_back(path_panel(some, column, fmt::format(fmt::runtime(y_label), poses ? "poses" : "sweeping")));
  }
  return figure;
}

Figure time_figure(const Rows& rows) {
  const double path = told_path(rows);
  Figure figure = {
      .name = "times",
      .title = "Time a step against the share that goes through",
      .caption = fmt::format("Time a step of a world of one wall and one ball against the share of balls that go "
                             "through at {} m a step, with 95 % intervals. {}",
                             path, whose_clock),
      .is_timing = true};
  for (const double wall : walls_of(rows)) {
    Rows some = rows_at(told_rows(rows), wall);
    std::stable_partition(some.begin(), some.end(), looks_at_poses);  // as in the other pictures: so are the marks
    figure.panels.push_back(
        plot(some, text("label", "", label_of<Row>), measured("through", "", "", percent_of, "through_"),
             measured("time", "", "", time_of, "time_"))
            .x("through", Axis::linear, fmt::format("through at {} m a step, wall {} m wide [%]", path, wall))
            .y("time", Axis::log, "time a step [ns]")
            .by("label"));
  }
  return figure;
}

std::vector<Figure> figures_of(const Rows& rows) {
  return only_measured(
      {tunneling_figure(rows),
       bounce_figure(rows, "lateness", "lateness, {} [steps]", "How late the ball turns",
                     "Of the balls that turned: from first contact to where the lines of flight before and after the "
                     "bounce meet, mean. An exact bounce is at 0."),
       bounce_figure(rows, "energy", "energy ratio, {} [1]",
                     "What is left of the energy after a bounce of restitution 1",
                     "Of the balls that turned: kinetic energy after over before, mean. It should be 1."),
       time_figure(rows)});
}

// What it says.

std::string percent_text(double share) { return fmt::format("{:.3g} %", 100 * share); }

std::string with_interval(const Row& row) {
  const auto [value, interval] = percent_of(row);
  const bool has_its_own = row.theory && row.setup->mode.skin > 0;
  return fmt::format("{} {:.3g} % [{:.3g}, {:.3g}{}]", label_of(row), value, interval.lower, interval.upper,
                     has_its_own ? "; with its skin theory says " + percent_text(*row.theory) : "");
}

/// Of engines whose shots are not all answered.
std::string failed_text(const std::vector<std::string>& failed) {
  return fmt::format("{} {} left out, having died or hung.", listed(failed), failed.size() == 1 ? "is" : "are");
}

/// Of modes that claim to let none through. All modes and walls get the same shots: those of one are all there are.
std::string own_zero(const Rows& exact) {
  std::int64_t shots = 0, wrong = 0;
  for (const Row& row : exact) wrong += row.tally.wrong();
  for (const Row& row : rows_of(exact, label_of(exact.front()), wall_of(exact.front()))) shots += row.tally.shots;
  const std::vector<std::string> names = distinct(exact, label_of<Row>);
  const std::string modes = listed(names);
  if (wrong > 0) return fmt::format("{} let {} shots through: the self-test fails.", modes, grouped_text(wrong));
  return fmt::format("{} let none of {} shots{} through: the chance of one is below {} (95 %, Clopper-Pearson).", modes,
                     grouped_text(shots), names.size() > 1 ? " each" : "",
                     percent_text(clopper_pearson(0, shots).upper));
}

std::string answer_of(const Rows& rows, const std::vector<std::string>& failed) {
  const double path = told_path(rows);
  std::vector<std::string> sentences, poses, safe, unsafe;
  std::optional<double> theory;
  for (const Row& row : rows_at(told_rows(rows), wall_of(rows.front()))) {
    if (row.setup->mode.poses_per_step != 1) continue;
    poses.push_back(with_interval(row));
    if (row.setup->mode.skin == 0) theory = row.theory;
  }
  for (const Group<Row>& group : group_by(rows, label_of<Row>)) {
    if (looks_at_poses(*group[0]) || group[0]->setup->mode.exact) continue;
    const Row& worst = **std::ranges::max_element(group, {}, [](const Row* r) { return r->tally.wrong(); });
    if (worst.tally.wrong() == 0) {
      safe.push_back(label_of(worst));
    } else {
      unsafe.push_back(
          fmt::format("{} (at {} m, wall {} m wide)", with_interval(worst), worst.cell.path, wall_of(worst)));
    }
  }
  if (!poses.empty()) {
    sentences.push_back(
        fmt::format("At {} m a step these let through, looking at the pose at the end of a step alone (95 %): {}{}.",
                    path, listed(poses), theory ? "; without a skin theory says " + percent_text(*theory) : ""));
  }
  if (!safe.empty()) sentences.push_back(fmt::format("Sweeping, {} let none of these shots through.", listed(safe)));
  if (!unsafe.empty()) sentences.push_back(fmt::format("Others that sweep do, at worst: {}.", listed(unsafe)));
  const Rows exact = only(rows, [](const Row& r) { return r.setup->mode.exact; });
  if (!exact.empty()) sentences.push_back(own_zero(exact));
  if (!failed.empty()) sentences.push_back(failed_text(failed));
  return fmt::format("{}", fmt::join(sentences, " "));
}

/// A row for each engine and mode, a column for each value of the key.
template <class AnyRow, class Key, class Name, class Cell>
std::string matrix(const char* name, std::string description, const std::vector<AnyRow>& rows, const Key& key,
                   const Name& name_of, const Cell& cell) {
  auto columns = columns_of<std::string>(text("engine and mode", "", std::identity()));
  for (const auto& value : distinct(rows, key)) {
    text(name_of(value), "", [&rows, &key, &cell, value](const std::string& label) -> std::string {
      const auto is_it = [&](const AnyRow& row) { return std::invoke(key, row) == value && label_of(row) == label; };
      const auto row = std::ranges::find_if(rows, is_it);
      return row == rows.end() ? "-" : cell(*row);
    }).add_to(columns);
  }
  return terminal(table(name, std::move(description), columns, distinct(rows, label_of<AnyRow>)));
}

std::string percent_matrix(const Rows& rows, double wall) {
  return matrix(
      "cells", fmt::format("Percent through a wall {} m wide, against meters a step.", wall), rows_at(rows, wall),
      path_of, [](double path) { return rounded_text(path, 3); },
      [](const Row& row) {
        const bool is_whole = row.tally.tunneled % row.tally.shots == 0;  // 0 and 100
        return fmt::format("{:.{}f}", percent_of(row).value, is_whole ? 0 : 1);
      });
}

// The stages.

Columns<StageRow> stage_columns() {
  return columns_of<StageRow>(text("stage", "What is played.", [](const StageRow& r) { return r.kind->name; }),
                              engine_and_mode<StageRow>());
}

/// In percent: who passed or was lost, and after a slash who was disturbed of the others.
std::string in_short(const StageRow& row) {
  const StageTally& t = row.tally;
  const auto percent = [](std::int64_t part, std::int64_t whole) {
    const double x = share_of(100 * part, whole).value_or(0);
    return fmt::format("{:.{}f}", x, x == 0 || x >= 9.95 ? 0 : 1);
  };
  const std::int64_t gone = t.passed + t.lost;
  const std::string passed = percent(gone, t.shots);
  return row.kind->spins ? passed : passed + "/" + (gone == t.shots ? "-" : percent(t.disturbed, t.shots - gone));
}

Table stages_table(const std::vector<StageRow>& rows) {
  const auto columns = columns_of<StageRow>(
      stage_columns(), fields(&StageRow::tally, {"shots", "passed"}),
      share(
          "passed_share", "passed / shots.", [](const StageRow& r) { return r.tally.passed; },
          [](const StageRow& r) { return r.tally.shots; }, "passed_"),
      value(
          "theory", "1",
          "Expected share, where only poses are looked at and a formula is known, of rod_spinning the least there can "
          "be; missing elsewhere.",
          &StageRow::theory),
      fields(&StageRow::tally, {"lost", "disturbed"}),
      value("error", "1",
            "Mean distance of the velocity from the exact one over the speed at the start, of those that did not pass.",
            [](const StageRow& r) { return r.tally.error.mean(); }),
      fields(&StageRow::tally, {"most_error"}));
  return in_report(table(
      "stages",
      "Every stage in every engine and mode that can play it. Theory of rod_spinning: the least share there can be.",
      columns, rows));
}

Table stage_timings_table(const std::vector<StageRow>& rows) {
  return timing(table("stage_timings", fmt::format("Time a step; making the world is not in it. {}", whose_clock), rows,
                      stage_columns(),
                      value("nanoseconds", "ns", "Time a step, median over volleys.",
                            [](const StageRow& r) { return median(r.nanoseconds); })));
}

std::string stages_summary(const std::vector<StageRow>& rows) {
  if (rows.empty()) return "";
  return matrix(
      "stages", "Percent that passed / percent of the others that flew away wrong.", rows, &StageRow::kind,
      [](const StageKind* kind) { return std::string(kind->name); }, in_short);
}

std::string stages_text(const EnginePlan& plan, const std::vector<StageRow>& rows) {
  if (rows.empty()) return "";
  std::string text = fmt::format("The motion is {} m a step.", rows.front().cell.path);
  for (const StageKind& kind : stage_kinds) {
    if (std::ranges::any_of(rows, [&](const StageRow& r) { return r.kind == &kind; }))
      text += fmt::format("\n\n{}: {}.", kind.name, kind.what);
  }
  const auto is_apart = [](const EngineSetup& setup) { return !setup.engine.plays_stages; };
  const auto apart =
      distinct(only(plan.setups, is_apart), [](const EngineSetup& setup) { return setup.engine.called; });
  if (!apart.empty())
    text += fmt::format("\n\nNot played in {}: only the ball at the wall is.", fmt::join(apart, ", "));
  return text;
}

// The whole.

std::string summary_of(const Rows& rows, const std::vector<StageRow>& stages, bool passed) {
  std::string text;
  for (const double wall : walls_of(rows)) text += percent_matrix(rows, wall) + "\n";
  Table turned = cells_table(only(rows_at(told_rows(rows), wall_of(rows.front())), has_turned));
  turned.description = "Of the balls that turned: lateness, and energy after over energy before.";
  text += terminal(
      turned, {"engine", "mode", "wall_size", "path", "lateness", "latest", "energy", "least_energy", "most_energy"});
  text += "\n" + stages_summary(stages);
  text += fmt::format("\nSelf-test of ours: {}.\n", verdict_text(passed));
  return text;
}

/// How the engines of others that look at poses stand to the same theory, at the first wall: told, and held against nobody.
std::string agreement_text(const Rows& rows) {
  const auto is_judged = [](const Row& r) { return !r.setup->is_ours() && r.theory.has_value(); };
  const Rows peers = only(rows_at(rows, wall_of(rows.front())), is_judged);
  const auto excess = [](const Row* r) { return percent_of(*r).value - 100 * *r->theory; };
  std::string text;
  for (const Group<Row>& group : group_by(peers, label_of<Row>)) {
    const auto covered =
        std::ranges::count_if(group, [](const Row* r) { return percent_of(*r).interval.contains(100 * *r->theory); });
    const Row* farthest = *std::ranges::max_element(group, {}, [&](const Row* r) { return std::abs(excess(r)); });
    text += fmt::format(
        "\n\n{}: theory lies in {} of {} intervals of 95 %; the largest difference is {:+.2f} points, at {} m.",
        label_of(*farthest), covered, group.size(), excess(farthest), farthest->cell.path);
  }
  if (text.empty()) return "";
  return "\n\nThe same theory and the engines of others, which the self-test does not judge:" + text;
}

/// What is missing, and how each of the others is set up.
std::string engines_text(const EnginePlan& plan, const std::vector<std::string>& failed) {
  std::vector<std::string> parts;
  if (!failed.empty()) parts.push_back(failed_text(failed));
  for (const std::string& line : plan.missing) parts.push_back(line + ".");
  for (const auto& setups : group_by(plan.setups, [](const EngineSetup& setup) { return setup.engine.called; })) {
    const Engine& engine = setups[0]->engine;
    if (std::ranges::find(failed, engine.called) != failed.end()) continue;
    std::string& part = parts.emplace_back(fmt::format("{}: {}", engine.called, engine.made_of));
    if (!engine.why_most_path.empty()) {
      part += fmt::format(" It moves nothing further than {} m in a step ({}): longer paths are left out.",
                          engine.most_path, engine.why_most_path);
    }
    for (const EngineSetup* setup : setups) part += fmt::format(" Mode {}: {}.", setup->mode.name, setup->mode.what);
  }
  return fmt::format("{}", fmt::join(parts, "\n\n"));
}

Outcome outcome_of(const EnginePlan& plan, const Rows& rows, const std::vector<StageRow>& stages,
                   const std::vector<std::string>& failed) {
  const std::vector<SelfTest> tests = self_test(own_counts(rows, stages));
  return {.answer = answer_of(rows, failed),
          .summary = summary_of(rows, stages, all_passed(tests)),
          .tables = {told_table(rows), stages_table(stages), cells_table(rows), packages_table(rows),
                     timings_table(rows), stage_timings_table(stages)},
          .figures = figures_of(rows),
          .sections = {{"The engines", engines_text(plan, failed)},
                       {"The stages", stages_text(plan, stages)},
                       {"Self-test", self_test_text(tests) + agreement_text(rows)}},
          .self_test_passed = all_passed(tests)};
}

template <class AnyRow>
auto tasks_of(const std::shared_ptr<const EnginePlan>& plan, const std::vector<AnyRow>& rows,
              const std::vector<EngineVolley>& volleys) {
  std::vector<Task<decltype(AnyRow::tally)>> tasks;
  for (const auto& [place, first, shots] : volleys) {
    const AnyRow& row = rows[place];
    const auto& [engine, mode] = *row.setup;
    const bool at_wall = row.kind == &ball_at_wall;
    const std::string what = at_wall ? engine_factors.key(row.cell) : fmt::format("stage {}", row.kind->name);
    tasks.push_back({fmt::format("{} {} {} from {}", what, engine.name, mode.name, first), shots,
                     [=, first = first, shots = shots] { return fire(row, first, shots, plan->seed); }});
  }
  return tasks;
}

std::unique_ptr<Run> configure(const Settings& settings, const RunOptions& options) {
  const auto plan = std::make_shared<const EnginePlan>(make_engine_plan(settings, options));
  const std::vector<EngineVolley> volleys = volleys_in_turn(plan->rows, plan->shots);
  const std::vector<EngineVolley> played = volleys_in_turn(plan->stages, plan->stage_shots);
  const auto finish = [plan, volleys, played](const auto& done, const auto& stages_done) {
    Rows rows = plan->rows;
    std::vector<StageRow> stages = plan->stages;
    add_results(volleys, done.results, rows);
    add_results(played, stages_done.results, stages);
    const std::vector<std::string> failed = drop_failed(rows, stages);
    if (rows.empty())
      throw std::runtime_error(fmt::format("{}: died or hung, and no other engine took part", listed(failed)));
    return outcome_of(*plan, rows, stages, failed);
  };
  return make_run(finish, plan->missing, tasks_of(plan, plan->rows, volleys), tasks_of(plan, plan->stages, played));
}

}  // namespace

Experiment engines_experiment() {
  return {"engines",
          "How often do the same fast balls pass a thin wall in whole physics engines, and does theory agree?",
          embedded_toml("engines"), configure};
}

}  // namespace thinwall
