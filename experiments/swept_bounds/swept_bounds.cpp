/// How many false hits does each bound of a swept shape make, and what do they cost, against speed, shape and direction? See
/// docs/swept_bounds.md.
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/lab/columns.hpp>
#include <thinwall/experiments/lab/plot.hpp>
#include <thinwall/experiments/lab/tasks.hpp>
#include <thinwall/experiments/lab/terminal.hpp>
#include <thinwall/experiments/lab/text.hpp>
#include <thinwall/experiments/swept_bounds/bounds.hpp>
#include <thinwall_embedded.hpp>

namespace thinwall {

namespace {

using Row = SweepRow;
using Tally = SweepTally;

// What the tables show.

template <class Row> auto shape_column() {
  return text("shape", "What moves.", [](const Row& r) { return name(r.sweep.form); });
}
template <class Row> auto bound_column() {
  return text("bound", "What stands for the volume it sweeps.", [](const Row& r) { return r.bound->name; });
}

Columns<Row> row_columns() {
  const auto factors = [](std::initializer_list<std::string_view> names) {
    return sweep_factors.columns(&Row::sweep, names);
  };
  const auto expected = [](double share, const Row& r) { return share * static_cast<double>(r.tally.shots); };
  return columns_of<Row>(
      factors({"shape"}), bound_column<Row>(), factors({"speed", "step", "width"}),
      value("path", "widths", "How far the shape moves in a step.",
            [](const Row& r) { return path_in_widths(r.sweep); }),
      factors({"angle_deg", "turn_deg", "obstacle"}), fields(&Row::tally, {"shots", "touching"}),
      value("touching_theory", "1", "Expected number of them.",
            [=](const Row& r) { return expected(r.theory.touching, r); }),
      fields(&Row::tally, {"reported"}),
      value("reported_theory", "1", "Expected number of them.",
            [=](const Row& r) { return expected(r.theory.reported(), r); }),
      fields(&Row::tally, {"false_hits"}),
      share(
          "false_fraction", "false_hits / reported; missing if none is reported.",
          [](const Row& r) { return r.tally.false_hits; }, [](const Row& r) { return r.tally.reported; }, "false_"),
      value("false_theory", "1", "The same by Steiner's formula.",
            [](const Row& r) { return r.theory.false_fraction; }),
      value("wasted_tests", "1", "False hits for each true one, by theory: exact tests that find nothing.",
            [](const Row& r) { return r.theory.false_hits / r.theory.touching; }),
      value("empty", "1", "Share of the bound's own volume that is not swept.",
            [](const Row& r) { return r.theory.empty; }),
      fields(&Row::tally, {"grazing", "missed"}));
}

/// A bound of a shape over all of their cells, of which the first is the pair's.
struct Total : SweepPair {
  Group<Row> cells;
  Tally tally = total_of(cells, &Row::tally);

  /// False fractions by theory, [1] of each cell.
  std::vector<double> false_shares() const {
    std::vector<double> shares;
    for (const Row* cell : cells) shares.push_back(cell->theory.false_fraction);
    return shares;
  }
};

std::vector<Total> totals_of(const std::vector<Row>& rows) {
  std::vector<Total> totals;
  for (const Group<Row>& group : group_by(rows, [](const Row& r) { return std::pair(r.sweep.form, r.bound); }))
    totals.push_back({{group[0]->sweep, group[0]->bound}, group});
  std::ranges::stable_sort(totals, {}, [](const Total& t) { return t.sweep.form; });
  return totals;
}

Table shapes_table(const std::vector<Total>& totals) {
  return in_report(
      table("shapes", "Each bound of each shape over all of its cells.", totals, shape_column<Total>(),
            bound_column<Total>(), value("cells", "1", "Conditions.", [](const Total& t) { return t.cells.size(); }),
            value("touched", "1", "Balls that the shape truly touches, those that just touch included.",
                  [](const Total& t) { return t.tally.touched(); }),
            value("missed", "1", "Of those, not reported by the bound.", [](const Total& t) { return t.tally.missed; }),
            fields(&Total::tally, {"reported", "false_hits"}),
            value("false_least", "1", "Share of reports that are false, by theory, in the cell where it is least.",
                  [](const Total& t) { return std::ranges::min(t.false_shares()); }),
            value("false_most", "1", "The same where it is most.",
                  [](const Total& t) { return std::ranges::max(t.false_shares()); })));
}

Table counts_test_table(const std::vector<SelfTest>& tests) {
  return self_test_table(tests,
                         "Counts of independent balls against theory, over all cells of a bound and event at once.",
                         {"bound", "What stands for the swept volume."}, {"event", "What is counted."});
}

Table timings_table(const std::vector<SweepCost>& costs) {
  using T = SweepCost;
  const auto time = [](std::string name, std::string description, TimedWork work, double share = 0.5) {
    return value(std::move(name), "ns", std::move(description), [=](const T& c) { return c.quantile_ns(work, share); });
  };
  return timing(in_report(table(
      "timings",
      "What each bound costs among the pairs that a broad phase of boxes hands over: medians over "
      "rounds, on this machine.",
      costs, shape_column<T>(), value("speed", "m/s", "Its speed.", [](const T& c) { return c.sweep.speed; }),
      value("path", "widths", "How far it moves in a step.", [](const T& c) { return path_in_widths(c.sweep); }),
      bound_column<T>(), value("reported", "1", "Share of the pairs that it reports.", &T::reported),
      value("false_hits", "1", "Share of the pairs that it reports although they do not touch.", &T::false_hits),
      time("build_ns", "Time to make the bound, once a shape and step.", TimedWork::build),
      time("test_ns", "Time to put a pair to it.", TimedWork::test),
      time("false_ns", "Time of the closed form on one of its false hits; missing if there are none.",
           TimedWork::exact),
      value("wasted_ns", "ns", "false_hits * false_ns: time a pair that false hits cost.", &T::wasted_ns),
      time("pair_ns", "Time a pair, the bound first and then the closed form on those reported.", TimedWork::pipeline),
      time("pair_lower_ns", "Lower quartile of the rounds.", TimedWork::pipeline, 0.25),
      time("pair_upper_ns", "Upper quartile of them.", TimedWork::pipeline, 0.75))));
}

// What the pictures show: around the view one factor varies, the others are its. Bounds that are exact by construction are not
// drawn.

/// What varies along x.
struct Abscissa {
  const char *column, *label;
  Axis axis;
  double Sweep::*factor;
};

/// A panel for each shape.
std::vector<Panel> panels(const std::vector<Row>& rows, const std::vector<SweptBound>& bounds, const Abscissa& along,
                          const Sweep& view) {
  const auto belongs = [&](const Row& row) {  // nothing else sets the cell apart; along x the turn does not count
    Sweep s = row.sweep;
    if (along.axis == Axis::log && s.*along.factor == 0) return false;
    if (s.angle_deg == 0) s.turn_deg = view.turn_deg;
    s.*along.factor = view.*along.factor;
    s.form = view.form;
    return s == view && row.bound->makes_volume;
  };
  std::vector<Row> those = only(rows, belongs);
  std::ranges::stable_sort(those, {}, [&](const Row& row) { return row.sweep.*along.factor; });
  std::vector<Panel> all;
  for (const std::string_view form : swept_form_names) {
    const auto shown = only(those, [&](const Row& row) { return name(row.sweep.form) == form; });
    if (shown.empty()) continue;
    Plot panel = plot(shown, row_columns())
                     .x(along.column, along.axis, along.label)
                     .y("false_fraction", Axis::linear, fmt::format("false share [1], {}", form))
                     .by("bound")
                     .height(0.6);
    for (const SweptBound& bound : bounds) {
      Sweep s = view;
      s.form = shown[0].sweep.form;
      if (!bound.makes_volume || !bound.serves(s.form)) continue;
      panel.curve(bound.name, [&bound, &along, s](double x) mutable {
        s.*along.factor = along.factor == &Sweep::speed ? x * s.width / s.step : x;
        return sweep_theory(bound.body(s), s).false_fraction;
      });
    }
    all.push_back(panel);
  }
  return all;
}

/// The view, turned as near to 45 degrees as there are cells: on the way to the space diagonal.
Sweep turned(Sweep view, const std::vector<Row>& rows) {
  for (const Row& row : rows) {
    const Sweep& s = row.sweep;
    if (s.angle_deg > 0 && std::abs(s.turn_deg - 45) < std::abs(view.turn_deg - 45)) view.turn_deg = s.turn_deg;
  }
  return view;
}

std::vector<Figure> figures_of(const std::vector<Row>& rows, const std::vector<SweptBound>& bounds, const Sweep& view) {
  constexpr const char* how =
      "Share of the balls reported that the shape does not touch, with 95 % Wilson intervals; the lines are Steiner's "
      "formula. ";
  const Abscissa path = {"path", "path in a step [widths]", Axis::log, &Sweep::speed};
  const Abscissa angle = {"angle_deg", "angle between motion and x [deg]", Axis::linear, &Sweep::angle_deg};
  const Abscissa obstacle = {"obstacle", "diameter of the balls hit [widths]", Axis::log, &Sweep::obstacle};
  const Sweep turned_view = turned(view, rows);
  const std::string motion = fmt::format("{:g} degrees from x and turned by {:g}", view.angle_deg, view.turn_deg);
  const std::string balls = fmt::format("among balls {:g} times as wide", view.obstacle);
  const std::string moves = fmt::format("a path {:.3g} times the width", path_in_widths(view));
  std::vector<Figure> figures = {
      {"false_hits", "False hits against the path: points counted, lines by Steiner's formula",
       fmt::format("{}Motion {}, {}.", how, motion, balls), panels(rows, bounds, path, view)},
      {"direction", "False hits against the direction: points counted, lines by theory",
       fmt::format("{}Motion turned by {:g} degrees: 54.7 is then the space diagonal if that is 45. At {}, {}.", how,
                   turned_view.turn_deg, moves, balls),
       panels(rows, bounds, angle, turned_view)},
      {"obstacle", "False hits against the size of what is hit: points counted, lines by theory",
       fmt::format("{}Motion {}, {}.", how, motion, moves), panels(rows, bounds, obstacle, view)}};
  std::erase_if(figures, [](const Figure& figure) { return figure.panels.empty(); });
  return figures;
}

// What it says.

/// "enclosing sphere 85.8 % (theory 85.9 %), capsule 0.0 % (theory 0.0 %)", of the bounds that are volumes.
std::string diagonal_answer(const std::vector<Row>& rows, const Sweep& diagonal) {
  std::vector<std::string> shares;
  for (const Row& row : rows) {
    const std::optional<double> false_share = share_of(row.tally.false_hits, row.tally.reported);
    if (row.sweep != diagonal || !row.bound->makes_volume || !false_share) continue;
    const std::string bound = row.bound->name == "enclosing_aabb" ? "enclosing AABB" : spaced(row.bound->name);
    shares.push_back(
        fmt::format("{} {} (theory {})", bound, percent_text(false_share), percent_text(row.theory.false_fraction)));
  }
  return fmt::format("{}", fmt::join(shares, ", "));
}

/// "1.9 widths (cube), 1.0 (plate)", in the direction of the view.
std::string turning_answer(const std::vector<Total>& totals, Sweep view) {
  std::string text;
  for (const Total& t : totals) {
    view.form = t.sweep.form;
    const auto widths = t.bound->name == "oriented_box" ? path_to_turn_for(view) : std::nullopt;
    if (widths) text += fmt::format("{}{:.2f} ({})", text.empty() ? "" : ", ", *widths, name(t.sweep.form));
  }
  if (text.empty()) return "";
  return fmt::format(
      "At {:g} degrees from x, turned by {:g}, the oriented box makes fewer false hits than the enclosing "
      "one on paths longer than, in widths, {}, and more on shorter ones. ",
      view.angle_deg, view.turn_deg, text);
}

/// Of counts alone: the same on every run.
std::string answer_of(const std::vector<Row>& rows, const std::vector<Total>& totals, const Sweep& view) {
  std::string text;
  for (const Sweep& diagonal : diagonals) {
    const std::string shares = diagonal_answer(rows, diagonal);
    if (shares.empty()) continue;
    text += fmt::format(
        "Of what is reported when a {} moves {:.2f} widths along a diagonal among balls as wide, false are: {}. ",
        name(diagonal.form), path_in_widths(diagonal), shares);
  }
  Tally sum;
  for (const Total& t : totals) sum += t.tally;
  return text + turning_answer(totals, view) +
         fmt::format("Of {} balls that are touched the bounds miss {}.", grouped_text(sum.touched()),
                     grouped_text(sum.missed));
}

Outcome outcome_of(const std::vector<Row>& rows, const std::vector<SweepCost>& costs,
                   const std::vector<SweptBound>& bounds, const Sweep& view) {
  const std::vector<Total> totals = totals_of(rows);
  const std::vector<SelfTest> tests = self_test(counts_of(rows));
  const Table diagonal = in_report(table(
      "diagonal", "A ball and a cube 4 cm wide that move at 10 m/s and 60 steps a second along a face's diagonal.",
      row_columns(), only(rows, [](const Row& row) { return is_diagonal(row.sweep); })));
  const Table shapes = shapes_table(totals);
  Outcome outcome = {
      .answer = answer_of(rows, totals, view),
      .summary = terminal(diagonal, {"shape", "bound", "shots", "reported", "false_fraction", "false_theory", "empty",
                                     "missed"}) +
                 "\n" + terminal(shapes, {"shape", "bound", "cells", "touched", "missed", "false_least", "false_most"}),
      .tables = {diagonal, shapes, counts_test_table(tests),
                 table("cells", "Every cell at every bound: balls reported, touched, falsely reported and missed.",
                       row_columns(), rows)},
      .figures = figures_of(rows, bounds, view),
      .sections = {{"Self-test", self_test_text(tests)}},
      .self_test_passed = all_passed(tests)};
  if (!costs.empty()) {
    outcome.tables.push_back(timings_table(costs));
    outcome.summary +=
        "\n" +
        terminal(timings_table(only(costs, [&](const SweepCost& c) { return c.sweep.speed == view.speed; })),
                 {"shape", "speed", "bound", "false_hits", "build_ns", "test_ns", "false_ns", "wasted_ns", "pair_ns"});
  }
  outcome.summary += fmt::format("\nSelf-test: {}.\n", verdict_text(all_passed(tests)));
  return outcome;
}

struct Asked {
  SweepPlan plan;
  std::vector<SweptBound> bounds;
  std::vector<SweepPair> pairs;        ///< of the cells
  std::vector<TimedSubject> subjects;  ///< none if nothing is timed
};

std::unique_ptr<Run> configure(const Settings& settings, const RunOptions& options) {
  const std::int64_t shots = settings.trials("shots", 1, std::int64_t(1) << 30, options.trials);
  const std::int64_t repeats = settings.integer("timing_repeats", 0, 1000);
  const auto asked = std::make_shared<Asked>();
  asked->bounds = chosen(settings, "bound", all_swept_bounds());
  asked->plan = make_sweeps(settings, asked->bounds.size());
  asked->pairs = serving_pairs(asked->plan.cells, asked->bounds);
  if (serving_pairs(asked->plan.timed, asked->bounds).empty())
    settings.complain("bound", "one that serves one of the shapes");
  if (repeats > 0) asked->subjects = timed_subjects(asked->plan.timed, asked->bounds, options.seed);

  std::vector<Task<Tally>> counted;
  for (const SweepPair& pair : asked->pairs) {
    counted.push_back({fmt::format("{} {}", sweep_factors.key(pair.sweep), pair.bound->name), 2 * shots,
                       [asked, &pair, shots, seed = options.seed] { return count_balls(pair, seed, shots); }});
  }
  std::vector<Task<std::int64_t>> timed;
  for (std::int64_t round = 0; round < repeats; ++round) {
    for (const TimedSubject& t : asked->subjects) {
      const std::string key = sweep_factors.key(t.pair.sweep);
      timed.push_back({fmt::format("time {} {} {} {}", round, key, t.pair.bound->name, name(t.work)), t.tests(),
                       [asked, &t] { return t.pair.bound->repeat(t.work, t.pair.sweep, t.balls, t.passes); }});
    }
  }
  const auto finish = [asked](const Done<Tally>& done, const Done<std::int64_t>& rounds) {
    std::vector<Row> rows;
    for (std::size_t i = 0; i < asked->pairs.size(); ++i) rows.push_back({asked->pairs[i], done.results[i]});
    return outcome_of(rows, sweep_costs(asked->subjects, rounds.seconds), asked->bounds, asked->plan.view);
  };
  return make_run(finish, std::move(counted), std::move(timed));
}

}  // namespace

Experiment swept_bounds_experiment() {
  return {"swept_bounds",
          "How many false hits does each bound of a swept shape make, and what do they cost, against speed, shape and "
          "direction?",
          embedded_toml("swept_bounds"), configure};
}

}  // namespace thinwall
