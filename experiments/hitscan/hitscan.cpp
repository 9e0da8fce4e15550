/// A ray stands for a bullet: how many hits does it miss, how many are false, and how far off is it, at what range and speed?
/// See docs/hitscan.md.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/hitscan/model.hpp>
#include <thinwall/experiments/lab/columns.hpp>
#include <thinwall/experiments/lab/plot.hpp>
#include <thinwall/experiments/lab/tasks.hpp>
#include <thinwall/experiments/lab/terminal.hpp>
#include <thinwall/experiments/lab/text.hpp>
#include <thinwall_embedded.hpp>

namespace thinwall {

namespace {

using Cell = HitscanCell;
using Row = HitscanRow;
using Rows = std::vector<Row>;
using Tally = HitscanTally;

// Of a row, or of a total.
constexpr auto is_timed = [](const auto& row) { return row.tally.lateness.count > 0; };
constexpr auto missed = [](const auto& row) { return row.tally.missed; };
constexpr auto true_hits = [](const auto& row) { return row.tally.touching; };
constexpr auto false_hits = [](const auto& row) { return row.tally.false_hits; };
constexpr auto reported = [](const auto& row) { return row.tally.reported(); };

std::optional<double> missed_share(const auto& row) { return share_of(missed(row), true_hits(row)); }
std::optional<double> missed_share_theory(const Row& row) { return share_of(row.expected.missed, row.expected.touch); }

bool is_of_known_shot(const Row& row) { return !known_name(row.cell).empty(); }
double radius_of(const Row& row) { return row.cell.radius; }
double steps_late(const Row& row) { return row.tally.lateness.mean() / row.cell.step; }

Rows of_rule(const Rows& rows, const HitscanRule& rule) {
  return only(rows, [&](const Row& row) { return row.rule.name == rule.name; });
}

// What the tables show.

/// The factors of these names, in this order.
auto columns_in_turn(auto cell, auto... names) { return together(hitscan_factors.columns(cell, {names})...); }

Columns<Row> row_columns() {
  return columns_of<Row>(
      text("rule", "How a hit is found.", rule_name),
      text("shot", "Which of the known shots it is; empty for the others.",
           [](const Row& r) { return known_name(r.cell); }),
      columns_in_turn(&Row::cell, "range", "speed", "radius", "wind", "drag", "gravity", "step", "target"),
      value("flight_time", "s", "From the muzzle to the range.", [](const Row& r) { return flight_time(r.cell); }),
      value("deflection", "m", "Of the arc from the line of fire, at the range, by gravity and wind.",
            [](const Row& r) { return deflection(r.cell); }),
      fields(&Row::tally, {"shots", "touching"}),
      value("touching_theory", "1", "Expected number of them.",
            [](const Row& r) { return r.expected.touch * static_cast<double>(r.tally.shots); }),
      fields(&Row::tally, {"missed"}),
      share("missed_share", "missed / touching; missing if nothing touches.", missed, true_hits, "missed_"),
      value("missed_theory", "1", "The share by theory.", missed_share_theory),
      value("reported", "1", "Hits that the rule reports.", reported), fields(&Row::tally, {"false_hits"}),
      share("false_share", "false_hits / reported; missing if nothing is reported.", false_hits, reported, "false_"),
      value("false_theory", "1", "The share by theory.",
            [](const Row& r) { return share_of(r.expected.false_hits, r.expected.reported); }),
      value("path_error_mean", "m", "From the rule's path to the arc, where they cross the plane of the target.",
            [](const Row& r) { return r.tally.path_error.mean(); }),
      value("path_error_theory", "m", "The same by theory.", [](const Row& r) { return r.expected.path_error.mean; }),
      value("path_error_max", "m", "The largest.", [](const Row& r) { return r.tally.path_error.most; }),
      value("path_error_bound", "m", "The largest possible, by theory.",
            [](const Row& r) { return r.expected.path_error_possible.upper; }),
      where(is_timed,
            together(
                value("point_error_mean", "m",
                      "From the reported point on the target to the true one, of the true hits it reports; missing if "
                      "there are none.",
                      [](const Row& r) { return r.tally.point_error.mean(); }),
                value("point_error_max", "m", "The largest.", [](const Row& r) { return r.tally.point_error.most; }),
                value("lateness_mean", "step", "From first contact to the report, of the same hits; < 0 is early.",
                      steps_late))),
      value("lateness_theory", "step", "The same by theory, of next_frame.",
            [](const Row& r) {
              return r.expected.lateness ? std::optional(r.expected.lateness->mean / r.cell.step) : std::nullopt;
            }),
      where(is_timed, together(value("lateness_min", "step", "The earliest report.",
                                     [](const Row& r) { return r.tally.lateness.least / r.cell.step; }),
                               value("lateness_max", "step", "The latest.",
                                     [](const Row& r) { return r.tally.lateness.most / r.cell.step; }))));
}

/// A rule over all of its cells.
struct Total {
  std::string_view rule;
  Tally tally;
  double missed_theory = 0, false_theory = 0;    ///< expected numbers
  double latest = no_most, earliest = no_least;  ///< [step] the reports of true hits; < 0 is early
  double late_steps = 0;                         ///< [step] sum over them

  double lateness() const { return late_steps / static_cast<double>(tally.lateness.count); }  ///< [step] mean
};

std::vector<Total> totals_of(const Rows& rows) {
  std::vector<Total> totals;
  for (const Group<Row>& group : group_by(rows, rule_name)) {
    Total& total = totals.emplace_back(Total{group[0]->rule.name, total_of(group, &Row::tally)});
    for (const Row* row : group) {
      const Tally& t = row->tally;
      total.missed_theory += row->expected.missed * static_cast<double>(t.shots);
      total.false_theory += row->expected.false_hits * static_cast<double>(t.shots);
      total.latest = std::max(total.latest, t.lateness.most / row->cell.step);
      total.earliest = std::min(total.earliest, t.lateness.least / row->cell.step);
      if (is_timed(*row)) total.late_steps += steps_late(*row) * static_cast<double>(t.lateness.count);
    }
  }
  return totals;
}

Table rules_table(const std::vector<Total>& totals) {
  using T = Total;
  return in_report(table(
      "rules", "Each rule over all of its cells, every cell with the same number of shots.", totals,
      text("rule", "How a hit is found.", &T::rule), fields(&T::tally, {"shots", "touching", "missed"}),
      value("missed_expected", "1", "By theory.", &T::missed_theory),
      value("reported", "1", "Hits that the rule reports.", reported), fields(&T::tally, {"false_hits"}),
      value("false_expected", "1", "By theory.", &T::false_theory),
      where(is_timed, together(value("lateness_mean", "step",
                                     "From contact to the report, of the true hits it reports.", &T::lateness),
                               value("lateness_min", "step", "The earliest of all cells.", &T::earliest),
                               value("lateness_max", "step", "The latest of all cells.", &T::latest))),
      value("path_error_max", "m", "Largest distance from the arc at the range, of all cells.",
            [](const T& t) { return t.tally.path_error.most; }),
      where(is_timed, value("point_error_max", "m", "Largest distance from the true point on the target, of all cells.",
                            [](const T& t) { return t.tally.point_error.most; }))));
}

/// [s] The flight time from which on the ray of a bullet without radius misses this share of the hits.
std::optional<double> time_of_missed(const Cell& c, double share) {
  const auto found = range_of_missed(c, share);
  return found ? std::optional(arc_of<double>(c).time_to(*found)) : std::nullopt;
}

/// How far hitscan is good: by speed and air, the range at which it misses a share of the hits.
Table reach_table(const std::vector<Cell>& cells) {
  const auto bullet = [](Cell c) {
    c.range = c.radius = c.step = c.aim = 0;
    return c;
  };
  const auto range = [](double share) { return [=](const Cell& c) { return range_of_missed(c, share); }; };
  const auto time = [](double share) { return [=](const Cell& c) { return time_of_missed(c, share); }; };
  return in_report(
      table("reach",
            "How far hitscan is good: the range at which the ray misses a share of the hits of a bullet without "
            "radius, in the limit of flat fire. Missing where the bullet slows to a tenth of its speed before.",
            distinct(cells, bullet), columns_in_turn(std::identity(), "speed", "drag", "wind", "gravity", "target"),
            value("range_5_percent", "m", "Range at which 5 % of the hits are missed.", range(0.05)),
            value("time_5_percent", "s", "Flight time to there.", time(0.05)),
            value("range_50_percent", "m", "Range at which half of the hits are missed.", range(0.5)),
            value("time_50_percent", "s", "Flight time to there.", time(0.5))));
}

Table moments_table(const std::vector<HitscanMomentTest>& tests) {
  using T = HitscanMomentTest;
  return in_report(table(
      "moments", "Path errors and lateness against theory, over all cells of a rule at once.", tests,
      text("rule", "How a hit is found.", &T::rule), text("quantity", "What is measured.", &T::quantity),
      value("cells", "1", "Cells in which it is.", &T::cells),
      value("out_of_bounds", "1", "Of those, cells with a shot beyond what is possible; must be 0.", &T::out_of_bounds),
      residual_columns("Cells whose mean is held against theory.", "Sum of squared standard residuals of the means.",
                       &T::means),
      value("passed", "", "All of the above hold.", &T::passed)));
}

// What the pictures show.

/// What is drawn of a row, with its bars.
Plot drawn(const Rows& rows) {
  const auto speed_there = [](const Row& r) {
    const auto there = arc_of<double>(r.cell).at_distance(r.cell.range);
    return std::hypot(there.vx, there.vs);
  };
  const auto is_judged = [](const Row& r) { return can_be_judged(r.tally.shots, r.expected.missed); };
  const auto missed_residual = [](const Row& r) {
    return standard_residual(missed(r), r.tally.shots, r.expected.missed);
  };
  const auto late = [](const Row& r) -> std::optional<Measured> {
    if (!r.expected.lateness) return std::nullopt;
    return normal_mean(steps_late(r), r.expected.lateness->sigma / r.cell.step, r.tally.lateness.count);
  };
  return plot(
      rows, row_columns(),
      text("bullet", "", [](const Row& r) { return fmt::format("bullet radius {:g} mm", 1e3 * r.cell.radius); }),
      value("off", "", "", [](const Row& r) { return deflection(r.cell) / r.cell.target; }),
      value("speed_there", "", "", speed_there), where(is_judged, value("residual", "", "", missed_residual)),
      where(is_timed, together(measured("late", "", "", late, "late_"),
                               value("early", "", "", [](const Row& r) { return -steps_late(r); }))),
      value("flight", "", "", [](const Row& r) { return flight_time(r.cell) / r.cell.step; }));
}

/// Of hitscan, all with some deflection and the same target.
Figure missed_figure(const Rows& rays, double target) {
  const auto over_deflection = [&](const char* y, const char* label, double height) {
    return drawn(rays)
        .x("off", Axis::log, "deflection at the range / radius of the target [1]")
        .y(y, Axis::linear, label)
        .by("bullet")
        .height(height);
  };
  Plot unseen = over_deflection("missed_share", "true hits missed [1]", 1.3);
  Plot wrong = over_deflection("false_share", "hits that are false [1]", 1.3);
  for (const double radius : distinct(rays, radius_of)) {
    unseen.curve("theory, flat fire", [=](double off) { return flat_missed(target, radius, off * target); });
    wrong.curve("theory, flat fire", [=](double off) { return flat_false(target, radius, off * target); });
  }
  return {.name = "missed",
          .title = "What the ray of an instant bullet misses, and hits falsely",
          .caption =
              "Above, the share of true hits that hitscan does not see, in the middle, the share of its hits that "
              "are false, with 95 % Wilson intervals, against how far gravity and wind take the bullet from the "
              "line of fire. The curves are the lens that two discs share. Below, the residuals against the full "
              "theory.",
          .panels = {unseen, wrong, over_deflection("residual", "residual of the misses [standard errors]", 1)}};
}

/// Of one radius and air, and of every rule but hitscan_ball, whose path is the ray's.
Figure path_error_figure(const Rows& rows) {
  return {.name = "path_error",
          .title = "How far each rule's path is from the arc at the range",
          .caption =
              "Mean distance from the arc where the path crosses the plane of the target, against the flight "
              "time, and the theory. The ray is off by the whole fall; the rules that go step by step by that of "
              "a step, or less in a first step that reaches the target.",
          .panels = {drawn(only(rows, [](const Row& r) { return r.rule.name != hitscan_ball.name; }))
                         .x("flight_time", Axis::log, "flight time [s]")
                         .y("path_error_mean", Axis::log, "mean distance from the arc [m]")
                         .by("rule")
                         .through("path_error_theory", "theory")}};
}

Figure lateness_figure(const Rows& timed) {
  const Rows framed = only(of_rule(timed, next_frame), [](const Row& r) { return flight_time(r.cell) >= r.cell.step; });
  return {.name = "lateness",
          .title = "When a hit is reported",
          .caption =
              "Above, the mean time from first contact to the report of next_frame, with 95 % intervals, and the "
              "theory: half a step, and the time from where the ball touches to where its center does; flights of a "
              "step or more. Below, how much too early hitscan reports: the whole flight, until it hits nothing the "
              "bullet hits.",
          .panels = {drawn(framed)
                         .x("speed_there", Axis::log, "speed at the target [m/s]")
                         .y("late", Axis::linear, "mean lateness of next_frame [steps]")
                         .by("bullet")
                         .through("lateness_theory", "theory"),
                     drawn(of_rule(timed, hitscan_ray))
                         .x("flight_time", Axis::log, "flight time [s]")
                         .y("early", Axis::log, "hitscan is early by [steps]")
                         .by("bullet")
                         .through("flight", "theory")}};
}

/// Those whose rule was asked. Of the known shots none, of several targets, steps and, where times are drawn, drags the first.
std::vector<Figure> figures_of(const Rows& rows) {
  const Rows asked = only(rows, std::not_fn(is_of_known_shot));
  if (asked.empty()) return {};
  const Cell& one = asked.front().cell;
  const Rows alike = only(asked, [&](const Row& r) { return r.cell.target == one.target && r.cell.step == one.step; });
  const Rows bent = only(alike, [](const Row& r) { return deflection(r.cell) > 0; });
  const Rows rays = of_rule(bent, hitscan_ray);
  const Rows of_one_kind = only(bent, [&](const Row& r) {
    return r.cell.drag == one.drag && r.cell.wind == one.wind && r.cell.radius == one.radius;
  });
  const Rows timed = only(alike, [&](const Row& r) { return r.cell.drag == one.drag && is_timed(r); });
  return only_measured({missed_figure(rays, one.target), path_error_figure(of_one_kind), lateness_figure(timed)});
}

// What it says.

std::string known_answer(const Rows& rows) {
  std::vector<std::string> shots;
  for (const Row& row : only(of_rule(rows, hitscan_ray), is_of_known_shot)) {
    shots.push_back(fmt::format("{} with a {} (theory {}, the arc {} m off the line of fire)",
                                percent_text(missed_share(row)), known_name(row.cell),
                                percent_text(missed_share_theory(row)), rounded_text(deflection(row.cell), 3)));
  }
  return shots.empty() ? "" : fmt::format("Of the true hits the ray misses {}.", fmt::join(shots, ", "));
}

/// From when on the ray is no longer good, of the settings' cells.
std::string ray_answer(const Rows& rows) {
  constexpr double never = std::numeric_limits<double>::infinity();
  double few = never, half = never;
  for (const Row& row : only(of_rule(rows, hitscan_ray), std::not_fn(is_of_known_shot))) {
    few = std::min(few, time_of_missed(row.cell, 0.05).value_or(never));
    half = std::min(half, time_of_missed(row.cell, 0.5).value_or(never));
  }
  if (half == never) return "";
  return fmt::format(
      "The flight time decides: by theory the ray of a bullet without radius misses 5 % of its hits from {} s on at the earliest, and half from {} s on.",
      rounded_text(few, 2), rounded_text(half, 2));
}

std::string answer_of(const Rows& rows, const std::vector<Total>& totals) {
  std::vector<std::string> sentences = {known_answer(rows), ray_answer(rows)};
  for (const Total& t : totals) {
    if (t.rule == next_frame.name && is_timed(t)) {
      sentences.push_back(fmt::format(
          "A ray along each step that reports at the next frame is {:.2f} steps late on average and {:.2f} at most; "
          "it misses {} of the true hits, and {} of its own are false.",
          t.lateness(), t.latest, percent_text(missed_share(t)), percent_text(share_of(false_hits(t), reported(t)))));
    }
    if (t.rule == swept_steps.name) {
      sentences.push_back(fmt::format(
          "The ball swept along each step is wrong on {} of {} shots and at most {} m off the arc at the range.",
          grouped_text(missed(t) + false_hits(t)), grouped_text(t.tally.shots),
          rounded_text(t.tally.path_error.most, 3)));
    }
  }
  std::erase(sentences, "");
  if (!sentences.empty()) return fmt::format("{}", fmt::join(sentences, " "));
  const Total& first = totals.front();
  return fmt::format("{} misses {} of {} true hits and makes {} false ones.", first.rule, grouped_text(missed(first)),
                     grouped_text(true_hits(first)), grouped_text(false_hits(first)));
}

Outcome outcome_of(const std::vector<Cell>& cells, const Rows& rows) {
  const std::vector<Total> totals = totals_of(rows);
  const std::vector<SelfTest> counts = self_test(counts_of(rows));
  const std::vector<HitscanMomentTest> moments = moment_tests(rows);
  const auto columns = row_columns();
  const Table all =
      table("cells", "Every cell at every rule: what it misses, what it hits falsely, how far off and how late it is.",
            columns, rows);
  const Table known = in_report(
      table("known_shots",
            "Shots whose numbers a reader knows, at every rule; cells.csv holds all that was measured of them.",
            columns.without({"drag", "flight_time", "deflection", "touching", "touching_theory", "missed", "reported",
                             "false_hits", "path_error_max", "point_error_mean", "path_error_bound", "point_error_max",
                             "lateness_min", "lateness_max"}),
            only(rows, is_of_known_shot)));
  const Table rules = rules_table(totals);
  const Table counts_table =
      self_test_table(counts, "Counts of independent shots against theory, over all cells of a rule and event at once.",
                      {"rule", "How a hit is found."}, {"event", "What is counted."});
  return {.answer = answer_of(rows, totals),
          .summary = terminal(known, {"shot", "rule", "missed_share", "missed_theory", "false_share", "false_theory",
                                      "path_error_mean", "lateness_mean"}) +
                     "\n" +
                     terminal(rules, {"rule", "touching", "missed", "missed_expected", "reported", "false_hits",
                                      "false_expected", "lateness_mean", "path_error_max"}) +
                     fmt::format("\nSelf-test: counts {}, errors {}.\n", verdict_text(all_passed(counts)),
                                 verdict_text(all_passed(moments))),
          .tables = {known, reach_table(cells), rules, counts_table, moments_table(moments), all},
          .figures = figures_of(rows),
          .sections = {{"Self-test", self_test_text(counts)}},
          .self_test_passed = all_passed(counts) && all_passed(moments)};
}

std::unique_ptr<Run> configure(const Settings& settings, const RunOptions& options) {
  const std::vector<HitscanRule> rules = chosen(settings, "rule", hitscan_rules);
  const std::int64_t shots = settings.trials("shots", 1, std::int64_t(1) << 30, options.trials);
  const std::vector<Cell> cells = make_hitscan_cells(settings);
  auto tasks = tasks_of(
      cells, [](const Cell& c) { return hitscan_factors.key(c); }, shots,
      [=, seed = options.seed](const Cell& c) { return shoot(rules, c, seed, shots); });
  const auto finish = [cells, rules](const Done<std::vector<Tally>>& done) {
    Rows rows;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      for (std::size_t k = 0; k < rules.size(); ++k) rows.push_back({cells[i], rules[k], done.results[i][k]});
    }
    return outcome_of(cells, rows);
  };
  return make_run(finish, std::move(tasks));
}

}  // namespace

Experiment hitscan_experiment() {
  return {
      "hitscan",
      "A ray stands for a bullet: how many hits does it miss, how many are false, and how far off is it, at what range "
      "and speed?",
      embedded_toml("hitscan"), configure};
}

}  // namespace thinwall
