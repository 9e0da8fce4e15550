/// How often does a fast ball pass through a thin wall, for each way of detecting the hit, and does theory agree? See
/// docs/thin_wall.md.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/lab/columns.hpp>
#include <thinwall/experiments/lab/factors.hpp>
#include <thinwall/experiments/lab/plot.hpp>
#include <thinwall/experiments/lab/statistics.hpp>
#include <thinwall/experiments/lab/tasks.hpp>
#include <thinwall/experiments/lab/terminal.hpp>
#include <thinwall/experiments/lab/text.hpp>
#include <thinwall/experiments/thin_wall/results.hpp>
#include <thinwall_embedded.hpp>

namespace thinwall {

namespace {

using Row = ThinWallRow;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

auto method_and_scalar(const Row& row) { return std::tie(row.method, row.scalar); }
bool is_finite(const Row& row) { return row.cell.wall == Wall::finite; }
std::int64_t shots(const Row& row) { return row.tally.shots; }
std::int64_t went_through(const Row& row) { return row.tally.went_through(); }

/// [m] Of the detected, if any.
std::optional<double> lateness_mean(const Row& row) {
  const std::int64_t detected = row.tally.detected();
  if (detected == 0) return std::nullopt;
  return static_cast<double>(row.tally.lateness) * row.lateness_unit / static_cast<double>(detected);
}

/// Standard errors from theory, where theory is not 0 or 1.
std::optional<double> residual(const Row& row) {
  const std::optional<double>& p = row.theory.probability;
  if (!p || *p <= 0 || *p >= 1) return std::nullopt;
  return standard_residual(row.tally.tunneled, row.tally.shots, *p);
}

/// By its residual.
bool is_judged(const Row& row) {
  return residual(row).has_value() && can_be_judged(row.tally.shots, *row.theory.probability);
}

template <class Row> std::vector<Row> chosen(const std::vector<Row>& rows, const auto& choice) {
  std::vector<Row> result;
  std::ranges::copy_if(rows, std::back_inserter(result), choice);
  return result;
}

/// Those of the scalar whose shots are spoken of: double if it was fired. Float's are the same shots and must not count twice.
template <class Row> std::vector<Row> of_one_scalar(const std::vector<Row>& rows) {
  const auto in_double = chosen(rows, [](const Row& row) { return row.scalar == "double"; });
  return in_double.empty() ? rows : in_double;
}

// What the tables show.

Columns<Row> method_columns() {
  return columns_of<Row>(text("method", "Way of detecting the hit; substeps_N tests N poses a step.", &Row::method),
                         text("scalar", "Floating-point type the query is asked in.", &Row::scalar),
                         cell_factors().columns(&Row::cell),
                         where(is_finite, value("wall_size", "m", "Side of the square; missing for an infinite wall.",
                                                [](const Row& r) { return r.cell.wall_size; })));
}

Columns<Row> row_columns() {
  return columns_of<Row>(
      method_columns(),
      value("step_ratio", "1", "speed * step * cos(angle_deg) / (thickness + 2 * radius).", &Row::step_ratio),
      fields(&Row::tally, {"shots", "tunneled", "undecided"}),
      share(
          "probability", "tunneled / shots.", [](const Row& r) { return r.tally.tunneled; }, shots),
      value("theory", "1", "Probability by theory; missing where no formula holds.",
            [](const Row& r) { return r.theory.probability; }),
      value("residual", "1", "Standard errors between count and theory; missing where theory is 0, 1 or missing.",
            residual),
      value("lateness_mean", "m", "Mean path length from first contact to detection, of the detected.", lateness_mean),
      value("lateness_mean_theory", "m", "The same by theory; missing where no formula holds.",
            [](const Row& r) { return r.theory.lateness ? std::optional(r.theory.lateness->mean) : std::nullopt; }),
      fields(&Row::tally, {"lateness_max"}),
      value("lateness_max_theory", "m", "The largest there can be; missing where no formula holds.",
            [](const Row& r) { return r.theory.largest_lateness(); }),
      fields(&Row::tally, {"lateness_min", "gap_max"}), fields(&Row::tally, {"queries", "evaluations"}));
}

Columns<Row> bounce_columns() {
  return columns_of<Row>(fields(&Row::tally, {"wrong_side", "behind"}),
                         share("through", "(tunneled + wrong_side) / shots.", went_through, shots, "through_"),
                         value("through_theory", "1", "The same by theory; missing where no formula holds.",
                               [](const Row& r) { return r.theory.through; }));
}

Table timings_table(const std::vector<Row>& rows) {
  const auto columns =
      columns_of<Row>(method_columns(), fields(&Row::tally, {"shots"}),
                      value("nanoseconds_per_shot", "ns", "Wall-clock time over shots, drawing the shot included.",
                            [](const Row& r) { return 1e9 * r.seconds / static_cast<double>(r.tally.shots); }));
  return timing(table("timings", "Time a shot, on this machine, with every core at work.", columns, rows));
}

/// Of the shots for which theory has a chance: how many, and of how many that came true or was expected to.
struct Foretold {
  std::int64_t shots = 0, counted = 0;
  double expected = 0;

  void add(const Row& row, const std::optional<double>& chance, std::int64_t count) {
    if (!chance) return;
    shots += row.tally.shots;
    counted += count;
    expected += *chance * static_cast<double>(row.tally.shots);
  }
  bool is_known() const { return shots > 0; }
};

/// A method at a scalar over all of its cells.
struct Total {
  std::string method, scalar;
  std::int64_t cells = 0, clean_cells = 0;    ///< clean: none tunneled
  Tally tally = {};                           ///< without lateness, whose unit is each cell's own
  Foretold unseen = {}, through = {};         ///< tunneled; the same or pushed out on the wrong side
  std::optional<double> worst_residual = {};  ///< [1] of the cells that can be judged alone, the one farthest from 0

  bool is_clean() const { return tally.tunneled + tally.undecided == 0; }
  double upper() const { return clopper_pearson(0, tally.shots).upper; }
};

std::vector<Total> totals_of(const std::vector<Row>& rows) {
  std::vector<Total> totals;
  for (const Group<Row>& group : group_by(rows, method_and_scalar)) {
    Total& total = totals.emplace_back();
    total.method = group[0]->method;
    total.scalar = group[0]->scalar;
    for (const Row* row : group) {
      ++total.cells;
      total.clean_cells += row->tally.tunneled == 0 ? 1 : 0;
      Tally tally = row->tally;
      tally.lateness = 0;
      total.tally += tally;
      total.unseen.add(*row, row->theory.probability, row->tally.tunneled);
      total.through.add(*row, row->theory.through, row->tally.went_through());
      if (is_judged(*row) && std::abs(*residual(*row)) >= std::abs(total.worst_residual.value_or(0)))
        total.worst_residual = residual(*row);
    }
  }
  return totals;
}

Columns<Total> foretold_columns(Foretold Total::*foretold, const std::string& what, const std::string& event) {
  return columns_of<Total>(
      value("theory_shots", "1", "Shots in cells for which there is a theory.",
            [=](const Total& t) { return (t.*foretold).shots; }),
      value("theory_" + what, "1", "Of those, counted " + event, [=](const Total& t) { return (t.*foretold).counted; }),
      value("theory_expected", "1", "Of those, expected " + event,
            [=](const Total& t) { return (t.*foretold).expected; }));
}

Table methods_table(const std::vector<Total>& totals) {
  const auto columns = columns_of<Total>(
      text("method", "Way of detecting the hit.", &Total::method),
      text("scalar", "Floating-point type the query is asked in.", &Total::scalar),
      value("cells", "1", "Cells fired at.", &Total::cells),
      value("clean_cells", "1", "Cells in which no shot tunneled.", &Total::clean_cells),
      fields(&Total::tally, {"shots", "tunneled", "undecided"}),
      where(&Total::is_clean, value("upper", "1",
                                    "With 97.5 % confidence the mean probability over the cells is below this "
                                    "(Clopper-Pearson); stated where none tunneled.",
                                    &Total::upper)),
      foretold_columns(&Total::unseen, "tunneled", "to tunnel."),
      value("worst_residual", "1", "Standard errors from theory, in the cell where that is most.",
            &Total::worst_residual));
  return in_report(table("methods", "Each method over all of its cells, every cell with the same number of shots.",
                         columns, totals));
}

/// For the terminal: the counts of `methods_table` as shares.
Table shares_table(const std::vector<Total>& totals) {
  const auto share = [](double count, const Total& t) -> std::optional<double> {
    return t.unseen.shots > 0 ? std::optional(count / static_cast<double>(t.unseen.shots)) : std::nullopt;
  };
  const auto columns = columns_of<Total>(
      text("method", "Way of detecting the hit.", &Total::method),
      text("scalar", "Floating-point type the query is asked in.", &Total::scalar),
      fields(&Total::tally, {"shots", "tunneled"}),
      value("share", "1", "Tunneled, of the shots for which there is a theory.",
            [=](const Total& t) { return share(static_cast<double>(t.unseen.counted), t); }),
      value("theory", "1", "Of the same, by theory.", [=](const Total& t) { return share(t.unseen.expected, t); }),
      value("worst_residual", "1", "Standard errors from theory, in the cell where that is most.",
            &Total::worst_residual));
  return table("methods",
               "Each method over all of its cells; share and theory: of the shots for which there is a formula.",
               columns, totals);
}

Table bounce_table(const std::vector<Total>& totals) {
  const auto columns = columns_of<Total>(
      text("method", "Way of detecting the hit.", &Total::method),
      text("scalar", "Floating-point type the query is asked in.", &Total::scalar),
      fields(&Total::tally, {"shots", "tunneled", "wrong_side", "behind"}),
      foretold_columns(&Total::through, "through", "to tunnel or to be pushed out on the wrong side."));
  return in_report(table("bounce", "What became of the balls, each method over all of its cells.", columns, totals));
}

Table bounce_self_test_table(const std::vector<SelfTest>& tests) {
  Table table = self_test_table(tests);
  table.name = "bounce_self_test";
  table.description = "Counts that went through, tunneled or pushed out on the wrong side, against theory.";
  return table;
}

Table lateness_table(const std::vector<LatenessTest>& tests) {
  using T = LatenessTest;
  const auto columns = columns_of<T>(
      text("method", "Way of detecting the hit.", &T::method),
      text("scalar", "Floating-point type the method ran in.", &T::scalar),
      value("cells", "1", "Cells in which anything was detected.", &T::cells),
      value("false_cells", "1",
            "Of those, cells with a hit where ball and wall are farther apart than the method claims; must be 0.",
            &T::false_cells),
      value("late_cells", "1", "Of those, cells with one later than theory allows; must be 0.", &T::late_cells),
      residual_columns("Cells with a theory and enough detections to judge their mean.",
                       "Sum of squared standard residuals of the judged means.", &T::mean),
      value("passed", "", "All of the above hold.", &T::passed));
  return in_report(table(
      "lateness", "Lateness of detection along the path against theory, over all cells of a method and scalar at once.",
      columns, tests));
}

Table stratified_table(const std::vector<StratifiedTest>& tests) {
  using T = StratifiedTest;
  const auto columns =
      columns_of<T>(text("method", "Way of detecting the hit.", &T::method),
                    value("cells", "1", "Cells with an infinite wall and a theory.", &T::cells),
                    value("shots", "1", "Phases in each cell, n.", [](const T&) { return stratified_shots; }),
                    value("largest_deviation", "1", "Largest |k - n p| over the cells, k the number that tunneled.",
                          &T::largest_deviation),
                    value("passed", "", "The largest deviation is at most 1.", &T::passed));
  return in_report(
      table("stratified", "Counts of evenly spread phases against theory: infinite walls, double.", columns, tests));
}

// What the pictures show: double only, since float's points would lie on the same spots.

constexpr double left = 0.1, right = 1000;  // of the pictures' axis; more to the right is all 1

/// What lies along x, of walls of one kind.
struct Abscissa {
  Wall wall;
  double (*x)(const Row&);
  const char* label;
};
constexpr Abscissa step_ratio = {Wall::infinite, [](const Row& row) { return row.step_ratio; },
                                 "step ratio  v h cos(angle) / (w + 2 r)  [1]"};
/// The mean chord of a finite wall thickened by the ball is its volume over its shadow.
constexpr Abscissa mean_chord_ratio = {Wall::finite,
                                       [](const Row& row) {
                                         const RoundedBox box = rounded_box(row.cell);
                                         const double across = shadow(box, direction(row.cell));
                                         return step_length(row.cell) * across / volume(box);
                                       },
                                       "step over mean chord  v h shadow / volume  [1]"};

std::vector<Row> drawn(const std::vector<Row>& rows, const Abscissa& along) {
  return chosen(of_one_scalar(rows), [&](const Row& row) {
    return row.cell.wall == along.wall && left <= along.x(row) && along.x(row) <= right;
  });
}

/// Of the cells that would be drawn into the same sixth of a decade, the first: enough to see, few enough to see through.
/// From left to right.
std::vector<Row> thinned(const std::vector<Row>& rows, const Abscissa& along) {
  const auto place = [&](const Row& row) { return std::floor(6 * std::log10(along.x(row))); };
  std::map<double, Cell> first;
  for (const Row& row : rows) first.try_emplace(place(row), row.cell);
  std::vector<Row> result = chosen(rows, [&](const Row& row) { return first.at(place(row)) == row.cell; });
  std::ranges::stable_sort(result, {}, along.x);
  return result;
}

/// Mean lateness over the path in contact, with the 95 % of a normal mean.
double lateness_share(const Row& row) { return lateness_mean(row).value_or(nan) / slab_chord(row.cell); }
double lateness_bar(const Row& row) {
  const double spread = row.theory.lateness ? row.theory.lateness->deviation / slab_chord(row.cell) : nan;
  return 1.96 * spread / std::sqrt(static_cast<double>(row.tally.detected()));
}

Plot points(const std::vector<Row>& rows, const Abscissa& along, std::string_view y, std::string y_label) {
  const auto columns = columns_of<Row>(
      row_columns(), bounce_columns(), value("x", "", "", along.x),
      ValueColumn{"lateness_share", "", "", lateness_share, "lateness_lower", "lateness_upper"},
      value("lateness_lower", "", "", [](const Row& r) { return lateness_share(r) - lateness_bar(r); }),
      value("lateness_upper", "", "", [](const Row& r) { return lateness_share(r) + lateness_bar(r); }));
  return plot(table("drawn", "", columns, rows))
      .x("x", Axis::log, along.label)
      .y(y, Axis::linear, std::move(y_label))
      .by("method");
}

/// Methods that never tunnel would hide each other on the zero line: they take turns on it.
Panel taking_turns(Panel panel) {
  const auto is_zero = [](const Series& series) {
    return std::ranges::all_of(series.y, [](double y) { return y == 0; });
  };
  const auto sharing = static_cast<std::size_t>(std::ranges::count_if(panel.series, is_zero));
  std::size_t turn = 0;
  for (Series& series : panel.series) {
    if (!is_zero(series)) continue;
    for (std::vector<double>* column : {&series.x, &series.y, &series.lower, &series.upper}) {
      std::vector<double> kept;
      for (std::size_t i = turn; i < column->size(); i += sharing) kept.push_back((*column)[i]);
      *column = kept;
    }
    ++turn;
  }
  return panel;
}

/// y = curve(x / n) for every number of poses n that was fired, as one series with gaps, over the panel's points.
Panel with_theory(Panel panel, const std::vector<Row>& rows, double (*curve)(double), const char* label = "theory",
                  Mark mark = Mark::line) {
  std::set<int> poses;
  for (const Row& row : rows) poses.insert(row.poses_per_step);
  poses.erase(0);
  Series series = {.label = label, .mark = mark, .x = {}, .y = {}, .lower = {}, .upper = {}};
  constexpr int samples = 400;
  for (const int n : poses) {
    for (int i = 0; i <= samples; ++i) {
      series.x.push_back(left * std::pow(right / left, static_cast<double>(i) / samples));
      series.y.push_back(curve(series.x.back() / n));
    }
    series.x.push_back(right);
    series.y.push_back(nan);
  }
  panel.series.push_back(std::move(series));
  return panel;
}

double unseen_curve(double x) { return miss_probability(1, x); }

Figure probability_figure(const std::vector<Row>& infinite) {
  const std::vector<Row> judged = chosen(infinite, is_judged);
  const Panel top = points(thinned(infinite, step_ratio), step_ratio, "probability", "tunneling probability [1]");
  Panel bottom = points(judged, step_ratio, "residual", "residual [std. errors]").height(0.45);
  for (const double y : {-1.96, 1.96}) {
    bottom.series.push_back({.label = "95 % of residuals",
                             .mark = Mark::dashes,
                             .x = {left, right},
                             .y = {y, y},
                             .lower = {},
                             .upper = {}});
  }
  return {
      .name = "probability",
      .title = "How often a ball passes a thin wall unseen",
      .caption = fmt::format(
          "Infinite walls, double. Points are measured, with 95 % Wilson intervals; the line is the theory "
          "max(0, 1 - n (w + 2 r) / (v h cos(angle))) for n poses a step. {}ne cell in each sixth of a decade, methods that "
          "never tunnel taking turns on the zero line.{}",
          judged.empty() ? "O" : "Above: o",
          judged.empty() ? "" : " Below: every cell in which at least 5 shots are expected to tunnel and 5 not to."),
      .panels = {with_theory(taking_turns(top), infinite, unseen_curve), bottom}};
}

Figure lateness_figure(const std::vector<Row>& infinite) {
  const Panel panel =
      points(thinned(infinite, step_ratio), step_ratio, "lateness_share", "mean lateness / path in contact [1]");
  return {
      .name = "lateness",
      .title = "How late a hit is detected",
      .caption =
          "Mean path length from first contact to detection, over the path length (w + 2 r) / cos(angle) in "
          "contact, with 95 % intervals. Infinite walls, double. The line is min(x / n, 1) / 2 for n poses a step. A ray "
          "from the center is late by what the radius leads it, r / cos(angle), however short the wall.",
      .panels = {with_theory(panel, infinite, [](double x) { return std::min(x, 1.0) / 2; })}};
}

Figure finite_figure(const std::vector<Row>& finite) {
  const Panel panel =
      points(thinned(finite, mean_chord_ratio), mean_chord_ratio, "probability", "tunneling probability [1]");
  return {.name = "finite",
          .title = "The same for walls that end",
          .caption =
              "Finite walls, double; aim uniform over the wall's shadow, rim included. Points are measured, with "
              "95 % Wilson intervals; the line is 1 - n / x for n poses a step, which holds where the poses are "
              "farther apart than the longest chord. A ray from the center misses what only the rim would hit.",
          .panels = {with_theory(taking_turns(panel), finite, unseen_curve)}};
}

Figure bounce_figure(const std::vector<Row>& infinite) {
  const Panel panel = points(thinned(infinite, step_ratio), step_ratio, "through", "share that went through [1]");
  const Panel with_line = with_theory(taking_turns(panel), infinite, [](double x) { return miss_probability(0.5, x); });
  return {
      .name = "bounce",
      .title = "How often a ball that should bounce goes through",
      .caption =
          "Infinite walls, double. Points are measured, with 95 % Wilson intervals: shots that went through unseen, "
          "or were pushed out on the wrong side. The line is max(0, 1 - n (r + w / 2) / (v h cos(angle))) for n "
          "poses a step; the dashes are those unseen alone. Seen is not saved: the step that is safe is half as long.",
      .panels = {with_theory(with_line, infinite, unseen_curve, "theory, unseen alone", Mark::dashes)}};
}

/// Without the panels in which nothing was measured, and without the figures that then have none.
std::vector<Figure> figures_of(const std::vector<Row>& rows, bool bounces) {
  const std::vector<Row> infinite = drawn(rows, step_ratio), finite = drawn(rows, mean_chord_ratio);
  std::vector<Figure> figures = {probability_figure(infinite), lateness_figure(infinite), finite_figure(finite)};
  if (bounces) figures.insert(figures.begin(), bounce_figure(infinite));
  const auto is_measured = [](const Series& series) { return series.mark == Mark::points && !series.y.empty(); };
  for (Figure& figure : figures)
    std::erase_if(figure.panels, [&](const Panel& panel) { return std::ranges::none_of(panel.series, is_measured); });
  std::erase_if(figures, [](const Figure& figure) { return figure.panels.empty(); });
  return figures;
}

// What it says.

std::string percent(double share) { return fmt::format("{:.2f} %", 100 * share); }
std::string percent(auto part, std::int64_t whole) {
  return percent(static_cast<double>(part) / static_cast<double>(whole));
}
const char* verdict(bool passed) { return passed ? "passed" : "FAILED"; }
template <class Test> bool all_pass(const std::vector<Test>& tests) {
  return std::ranges::all_of(tests, &Test::passed);
}

std::string answer_of(const std::vector<Total>& totals) {
  std::string text;
  for (const Total& t : of_one_scalar(totals)) {
    if (t.method == "end_of_step" && t.unseen.is_known()) {
      const Interval bars = wilson(t.unseen.counted, t.unseen.shots);  // too wide, if anything: the cells differ
      text += fmt::format(
          "Of {} shots for which theory has a formula, testing only the end of the step let {} through "
          "(95 % interval {:.2f} to {}; theory {}). ",
          grouped_text(t.unseen.shots), percent(t.unseen.counted, t.unseen.shots), 100 * bars.lower,
          percent(bars.upper), percent(t.unseen.expected, t.unseen.shots));
    }
    if (t.method == "closed_form" && t.is_clean()) {
      text += fmt::format(
          "The closed form let none of {} through: with 95 % confidence its chance per shot, on average "
          "over these conditions, is below {}.",
          grouped_text(t.tally.shots), rounded_text(t.upper(), 2));
    } else if (t.method == "closed_form") {
      text += fmt::format("The closed form let {} of {} through.", grouped_text(t.tally.tunneled),
                          grouped_text(t.tally.shots));
    }
  }
  for (const Total& t : of_one_scalar(totals)) {
    if (text.empty()) text = fmt::format("{} let {} of {} shots through.", t.method, t.tally.tunneled, t.tally.shots);
  }
  return text;
}

std::string bounce_answer(const std::vector<Total>& totals) {
  std::string text;
  for (const Total& t : of_one_scalar(totals)) {
    if (t.method == "end_of_step" && t.through.is_known()) {
      text = fmt::format(
          "Testing only the end of the step, {} of {} balls that should have bounced went through (theory {}): "
          "{} of all shots unseen, {} seen and pushed out on the wrong side. ",
          percent(t.through.counted, t.through.shots), grouped_text(t.through.shots),
          percent(t.through.expected, t.through.shots), percent(t.tally.tunneled, t.tally.shots),
          percent(t.tally.wrong_side, t.tally.shots));
    }
    if (t.method == "closed_form") {
      text += fmt::format("Swept with the closed form, {} of {} did.", grouped_text(t.tally.went_through()),
                          grouped_text(t.tally.shots));
    }
  }
  return text;
}

/// How many cells count differently at float and at double.
std::string scalars_text(const std::vector<Row>& rows) {
  std::int64_t pairs = 0, differing = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = i + 1; j < rows.size() && rows[j].cell == rows[i].cell; ++j) {
      if (rows[i].method != rows[j].method) continue;
      ++pairs;
      differing += rows[i].tally.tunneled != rows[j].tally.tunneled ? 1 : 0;
    }
  }
  if (pairs == 0) return "";
  return fmt::format("float and double count differently in {} of {} cells.\n", grouped_text(differing),
                     grouped_text(pairs));
}

/// What a bounce adds. It comes first: it is what was asked for.
void add_bounce(const std::vector<Row>& rows, const std::vector<Row>& bullets, const std::vector<Total>& totals,
                Outcome& outcome) {
  const std::vector<SelfTest> tests = self_test(through_counts(rows));
  outcome.answer = bounce_answer(totals) + " " + outcome.answer;
  outcome.summary =
      terminal(table("bullet", "With a bounce, the bullet goes through unseen, or pushed out on the wrong side.",
                     columns_of<Row>(row_columns(), bounce_columns()), of_one_scalar(bullets)),
               {"method", "scalar", "shots", "tunneled", "wrong_side", "through", "through_theory"}) +
      "\n" +
      terminal(bounce_table(of_one_scalar(totals)),
               {"method", "scalar", "tunneled", "wrong_side", "theory_through", "theory_expected"}) +
      fmt::format("\nSelf-test of the bounce: counts {}, ends {}.\n\n", verdict(all_passed(tests)),
                  verdict(ends_agree(rows))) +
      outcome.summary;
  outcome.tables.insert(outcome.tables.begin(), {bounce_table(totals), bounce_self_test_table(tests)});
  outcome.sections.push_back({"Self-test of the bounce", self_test_text(tests)});
  outcome.self_test_passed &= all_passed(tests) && ends_agree(rows);
}

/// Where the page of `thinwall explore` fires the first of the plan's own cells that has an infinite wall.
Section page_section(const ShotPlan& plan) {
  const auto own = std::find_if(plan.cells.begin() + 1, plan.cells.end(),
                                [](const Cell& cell) { return cell.wall == Wall::infinite; });
  const Cell& cell = own == plan.cells.end() ? plan.cells.front() : *own;
  return {
      "To play with",
      "A page beside this one, which `thinwall explore` in this folder puts there, fires such shots in the browser.",
      fmt::format("explore.html#speed={}&step={}&radius={}&thickness={}&angle_deg={}&seed={}", exact_text(cell.speed),
                  exact_text(cell.step), exact_text(cell.radius), exact_text(cell.thickness),
                  exact_text(cell.angle_deg), plan.seed)};
}

Outcome outcome_of(const std::vector<Row>& rows, const std::vector<StratifiedTest>& stratified, const ShotPlan& plan) {
  const bool bounces = plan.response == Response::bounce;
  const std::vector<Total> totals = totals_of(rows);
  const std::vector<SelfTest> counts = self_test(tunneled_counts(rows));
  const std::vector<LatenessTest> lateness = lateness_test(rows);
  const std::vector<Row> bullets = chosen(rows, [](const Row& row) { return row.cell == bullet; });
  const auto bullet_table = [&](const std::vector<Row>& shown) {
    return in_report(table("bullet",
                           "The bullet at 10 m/s that is before the wall at one frame and behind it at the next.",
                           row_columns().without({"lateness_min", "gap_max", "queries"}), shown));
  };
  const bool counts_pass = all_passed(counts), stratified_pass = all_pass(stratified),
             lateness_pass = all_pass(lateness);
  std::string summary =
      terminal(bullet_table(of_one_scalar(bullets)), {"method", "scalar", "probability", "theory", "lateness_mean",
                                                      "lateness_mean_theory", "lateness_max", "lateness_max_theory"}) +
      "\n" + terminal(shares_table(of_one_scalar(totals))) + "\n" + scalars_text(rows);
  for (const Total& t : of_one_scalar(totals)) {
    if (t.is_clean()) {
      summary += wrapped(fmt::format("{}: none of {}; chance per shot below {} (95 %, Clopper-Pearson).", t.method,
                                     grouped_text(t.tally.shots), rounded_text(t.upper(), 2)));
    }
  }
  summary += fmt::format("Self-test: counts {}, evenly spread phases {}, lateness {}.\n", verdict(counts_pass),
                         verdict(stratified_pass), verdict(lateness_pass));
  Outcome outcome = {
      .answer = answer_of(totals),
      .summary = std::move(summary),
      .tables = {bullet_table(bullets), methods_table(totals), self_test_table(counts), stratified_table(stratified),
                 lateness_table(lateness),
                 table("cells",
                       "Every cell at every method and scalar: how often the ball tunnels, how late it is detected.",
                       bounces ? columns_of<Row>(row_columns(), bounce_columns()) : row_columns(), rows),
                 timings_table(rows)},
      .figures = figures_of(rows, bounces),
      .sections = {{"Self-test", self_test_text(counts)}, page_section(plan)},
      .self_test_passed = counts_pass && stratified_pass && lateness_pass};
  if (bounces) add_bounce(rows, bullets, totals, outcome);
  return outcome;
}

using Counts = std::vector<std::int64_t>;

/// First every cell at every method, cell by cell and volley by volley, then the stratified cells.
std::unique_ptr<Run> configure(const Settings& settings, const RunOptions& options) {
  const auto plan = std::make_shared<const ShotPlan>(make_plan(settings, options));
  const auto even = std::make_shared<const ShotPlan>(evenly_spread(*plan));
  const std::vector<Volley> volleys = volleys_of(plan->shots);
  std::vector<Task<Tally>> fired;
  for (const Cell& cell : plan->cells) {
    const std::string where = cell_factors().key(cell);
    for (const ThinWallMethod& method : plan->methods) {
      for (const Volley& volley : volleys) {
        std::string key = fmt::format("{} {} {}", where, method.name, method.scalar);
        if (volleys.size() > 1) key += fmt::format(" from {}", volley.first);
        fired.push_back({std::move(key), volley.shots,
                         [plan, &cell, &method, volley] { return fire(cell, method, volley, plan->seed); }});
      }
    }
  }
  std::vector<Task<Counts>> spread;
  for (const Cell& cell : even->cells) {
    spread.push_back({cell_factors().key(cell) + " stratified",
                      stratified_shots * static_cast<std::int64_t>(even->methods.size()),
                      [even, &cell, seed = plan->seed] { return stratified_counts(cell, even->methods, seed); }});
  }
  const auto finish = [plan, even, each = volleys.size()](const Done<Tally>& done, const Done<Counts>& counts) {
    std::vector<Tally> tallies(done.results.size() / each);
    std::vector<double> seconds(tallies.size());
    for (std::size_t i = 0; i < done.results.size(); ++i) {
      tallies[i / each] += done.results[i];
      seconds[i / each] += done.seconds[i];
    }
    return outcome_of(make_rows(*plan, tallies, seconds), stratified_test(*even, counts.results), *plan);
  };
  return make_run(finish, std::move(fired), std::move(spread));
}

std::vector<CellCount> counts_of(const std::vector<Row>& rows, std::optional<double> Theory::*chance,
                                 std::int64_t (*count)(const Tally&)) {
  std::vector<CellCount> counts;
  for (const Row& row : rows) {
    if (row.theory.*chance)
      counts.push_back({row.method, row.scalar, row.tally.shots, count(row.tally), *(row.theory.*chance)});
  }
  return counts;
}

/// The mean of this many is near normal: at least 5 times the number over which rare values average out.
bool mean_is_normal(double detected, const Lateness& theory) {
  const double spread = theory.deviation / theory.largest;
  return theory.largest > 0 && detected * spread * spread >= 5;
}

void add(LatenessTest& test, const Row& row) {
  const double detected = static_cast<double>(row.tally.detected());
  if (detected == 0) return;
  ++test.cells;
  if (row.tally.widest > row.theory.widest + row.resolution) ++test.false_cells;
  if (const std::optional<double> largest = row.theory.largest_lateness()) {
    // Against the settings, a shot's step may be shorter and its wall thicker by a grid unit.
    const double rounding = row.resolution / cosine(row.cell) + *largest * 0x1p-20;
    if (row.tally.latest > *largest + rounding) ++test.late_cells;
  }
  const std::optional<Lateness>& theory = row.theory.lateness;
  if (theory && mean_is_normal(detected, *theory))
    test.mean.add((*lateness_mean(row) - theory->mean) / (theory->deviation / std::sqrt(detected)));
}

}  // namespace

ShotPlan make_plan(const Settings& settings, const RunOptions& options) {
  ShotPlan plan;
  plan.response = settings.choice("response", response_names) == "bounce" ? Response::bounce : Response::none;
  plan.methods = thin_wall_methods(settings.choices_or_all("method", method_names()),
                                   settings.integers("substeps", least_substeps, most_substeps),
                                   settings.choices("scalar", scalar_names), plan.response);
  plan.shots = settings.trials("shots", 1, most_shots_a_cell, options.trials);
  plan.cells = make_cells(settings, plan.methods.size() * volleys_of(plan.shots).size());
  plan.seed = options.seed;
  return plan;
}

ShotPlan evenly_spread(const ShotPlan& plan) {
  ShotPlan even = plan;
  even.methods = chosen(plan.methods, [](const ThinWallMethod& m) { return m.scalar == "double"; });
  even.cells =
      chosen(plan.cells, [&](const Cell& cell) { return cell.wall == Wall::infinite && !even.methods.empty(); });
  return even;
}

std::vector<ThinWallRow> make_rows(const ShotPlan& plan, const std::vector<Tally>& tallies,
                                   const std::vector<double>& seconds) {
  std::vector<Row> rows;
  rows.reserve(tallies.size());
  for (const Cell& cell : plan.cells) {
    const Target fired = target(cell);
    for (const ThinWallMethod& method : plan.methods) {
      const std::size_t i = rows.size();
      // A time in [0, 1] is rounded once, and so are a few coordinates as large as a step, a chord or the wall; or the time
      // backs off by as much, so as not to be late.
      const double resolution = 32 * method.round_off * (fired.step_length + slab_chord(cell) + cell.wall_size);
      rows.push_back({cell, method.name, method.scalar, method.theory(cell), tallies[i], method.poses_per_step,
                      step_length(cell) / slab_chord(cell), fired.lateness_unit, resolution, seconds[i]});
    }
  }
  return rows;
}

std::vector<CellCount> tunneled_counts(const std::vector<ThinWallRow>& rows) {
  return counts_of(rows, &Theory::probability, [](const Tally& tally) { return tally.tunneled; });
}

std::vector<CellCount> through_counts(const std::vector<ThinWallRow>& rows) {
  return counts_of(rows, &Theory::through, [](const Tally& tally) { return tally.went_through(); });
}

bool ends_agree(const std::vector<ThinWallRow>& rows) {
  return std::ranges::all_of(rows, [](const Row& row) {
    return is_finite(row) || row.tally.undecided > 0 || row.tally.behind == row.tally.went_through();
  });
}

std::vector<LatenessTest> lateness_test(const std::vector<ThinWallRow>& rows) {
  std::vector<LatenessTest> tests;
  for (const Group<Row>& group : group_by(rows, method_and_scalar)) {
    LatenessTest& test = tests.emplace_back();
    test.method = group[0]->method;
    test.scalar = group[0]->scalar;
    for (const Row* row : group) add(test, *row);
  }
  return tests;
}

std::vector<StratifiedTest> stratified_test(const ShotPlan& plan,
                                            const std::vector<std::vector<std::int64_t>>& counts) {
  std::vector<StratifiedTest> tests;
  for (std::size_t j = 0; j < plan.methods.size(); ++j) {
    StratifiedTest& test = tests.emplace_back();
    test.method = plan.methods[j].name;
    for (std::size_t i = 0; i < plan.cells.size(); ++i) {
      const std::optional<double> p = plan.methods[j].theory(plan.cells[i]).probability;
      if (!p) continue;
      ++test.cells;
      const double expected = static_cast<double>(stratified_shots) * *p;
      test.largest_deviation = std::max(test.largest_deviation, std::abs(static_cast<double>(counts[i][j]) - expected));
    }
  }
  return tests;
}

Experiment thin_wall_experiment() {
  return {
      "thin_wall",
      "How often does a fast ball pass through a thin wall, for each way of detecting the hit, and does theory agree?",
      embedded_toml("thin_wall"), configure};
}

}  // namespace thinwall
