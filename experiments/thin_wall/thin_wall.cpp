/// How often does a fast ball pass through a thin wall, for each way of detecting the hit, and does theory agree? See
/// docs/thin_wall.md.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include <fmt/format.h>

#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/lab/columns.hpp>
#include <thinwall/experiments/lab/factors.hpp>
#include <thinwall/experiments/lab/plot.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/lab/statistics.hpp>
#include <thinwall/experiments/lab/tasks.hpp>
#include <thinwall/experiments/lab/terminal.hpp>
#include <thinwall/experiments/lab/text.hpp>
#include <thinwall/experiments/thin_wall/results.hpp>
#include <thinwall_embedded.hpp>

namespace thinwall {

namespace {

using Row = ThinWallRow;
using Rows = std::vector<Row>;
using Total = ThinWallTotal;
using Totals = std::vector<Total>;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

bool is_finite(const Row& row) { return row.cell.wall == Wall::finite; }

/// [1] v h cos(angle) / (w + 2 r)
double step_ratio(const Row& row) { return step_length(row.cell) / slab_chord(row.cell); }

/// [m] Of the detected, if any.
std::optional<double> lateness_mean(const Row& row) {
  const std::int64_t detected = row.tally.detected();
  if (detected == 0) return std::nullopt;
  return static_cast<double>(row.tally.lateness) * target(row.cell).lateness_unit / static_cast<double>(detected);
}

/// Standard errors from theory, where theory is not 0 or 1.
std::optional<double> residual(const Row& row) {
  const std::optional<double>& p = row.theory.probability;
  if (!p || *p <= 0 || *p >= 1) return std::nullopt;
  return standard_residual(row.tally.tunneled, row.tally.shots, *p);
}

/// By its residual.
bool is_judged(const Row& row) {
  return row.theory.probability && can_be_judged(row.tally.shots, *row.theory.probability);
}

/// Those of the scalar whose shots are spoken of: double if it was fired. Float's are the same shots and must not count twice.
template <class Row> std::vector<Row> of_one_scalar(const std::vector<Row>& rows) {
  const auto in_double = only(rows, [](const Row& row) { return row.method->scalar == "double"; });
  return in_double.empty() ? rows : in_double;
}

// What the tables show.

template <class Row> Columns<Row> method_columns() {
  return columns_of<Row>(
      text("method", "Way of detecting the hit; substeps_N tests N poses a step.",
           of(&Row::method, &ThinWallMethod::name)),
      text("scalar", "Floating-point type the query is asked in.", of(&Row::method, &ThinWallMethod::scalar)));
}

Columns<Row> cell_columns() {
  return columns_of<Row>(method_columns<Row>(), cell_factors.columns(&Row::cell),
                         where(is_finite, value("wall_size", "m", "Side of the square; missing for an infinite wall.",
                                                of(&Row::cell, &Cell::wall_size))));
}

Columns<Row> row_columns() {
  return columns_of<Row>(
      cell_columns(), value("step_ratio", "1", "speed * step * cos(angle_deg) / (thickness + 2 * radius).", step_ratio),
      fields(&Row::tally, {"shots", "tunneled", "undecided"}),
      share("probability", "tunneled / shots.", of(&Row::tally, &Tally::tunneled), of(&Row::tally, &Tally::shots)),
      value("theory", "1", "Probability by theory; missing where no formula holds.",
            of(&Row::theory, &Theory::probability)),
      value("residual", "1", "Standard errors between count and theory; missing where theory is 0, 1 or missing.",
            residual),
      value("lateness_mean", "m",
            "Mean path length from first contact to detection, of the detected; of a sum in fixed point, "
            "so that it may lie a rounding above lateness_max.",
            lateness_mean),
      value("lateness_mean_theory", "m", "The same by theory; missing where no formula holds.",
            [](const Row& r) { return r.theory.lateness ? std::optional(r.theory.lateness->mean) : std::nullopt; }),
      fields(&Row::tally, {"lateness_max"}),
      value(
          "lateness_max_theory", "m",
          "The largest by theory for the settings; a shot on the grid may exceed it by a unit of the grid and 2^-20 of "
          "it. Missing where no formula holds.",
          of(&Row::theory, &Theory::largest_lateness)),
      fields(&Row::tally, {"lateness_min", "gap_max"}), fields(&Row::tally, {"queries", "evaluations"}));
}

Columns<Row> bounce_columns() {
  return columns_of<Row>(fields(&Row::tally, {"wrong_side", "behind"}),
                         share("through", "(tunneled + wrong_side) / shots.", of(&Row::tally, &Tally::went_through),
                               of(&Row::tally, &Tally::shots), "through_"),
                         value("through_theory", "1", "The same by theory; missing where no formula holds.",
                               of(&Row::theory, &Theory::through)));
}

Table timings_table(const Rows& rows) {
  return timing(table("timings", "Time a shot, on this machine, the threads of the run at work.", rows, cell_columns(),
                      fields(&Row::tally, {"shots"}),
                      value("nanoseconds_per_shot", "ns", "Wall-clock time over shots, drawing the shot included.",
                            [](const Row& r) { return 1e9 * r.seconds / static_cast<double>(r.tally.shots); })));
}

/// [1] With 97.5 % confidence the chance is below this, where none tunneled.
double upper_of(const Total& total) { return clopper_pearson(0, total.tally.shots).upper; }

Columns<Total> foretold_columns(Foretold Total::*foretold, const std::string& what, const std::string& event) {
  return columns_of<Total>(
      value("theory_shots", "1", "Shots in cells for which there is a theory.", of(foretold, &Foretold::shots)),
      value("theory_" + what, "1", "Of those, counted " + event, of(foretold, &Foretold::counted)),
      value("theory_expected", "1", "Of those, expected " + event, of(foretold, &Foretold::expected)));
}

Columns<Total> total_columns() {
  return columns_of<Total>(
      method_columns<Total>(), value("cells", "1", "Cells fired at.", &Total::cells),
      value("clean_cells", "1", "Cells in which no shot tunneled.", &Total::clean_cells),
      fields(&Total::tally, {"shots", "tunneled", "undecided"}),
      where(&Total::is_clean, value("upper", "1",
                                    "With 97.5 % confidence the mean probability over the cells is below this "
                                    "(Clopper-Pearson); stated where none tunneled.",
                                    upper_of)),
      foretold_columns(&Total::tunneled, "tunneled", "to tunnel."),
      value("worst_residual", "1", "Standard errors from theory, in the cell where that is most.",
            &Total::worst_residual));
}

Table methods_table(const Totals& totals) {
  return in_report(table("methods", "Each method over all of its cells, every cell with the same number of shots.",
                         total_columns(), totals));
}

/// For the terminal: of `methods_table` what theory speaks of, as shares.
std::string shares_text(const Totals& totals) {
  const auto of_foretold = [](auto what) { return of(&Total::tunneled, what); };
  return terminal(
      table("methods", "Each method over all of its cells for which theory has a formula.", totals,
            method_columns<Total>(), value("shots", "1", "Fired.", of_foretold(&Foretold::shots)),
            value("tunneled", "1", "Of those.", of_foretold(&Foretold::counted)),
            value("share", "1", "tunneled / shots.", of_foretold(&Foretold::share)),
            value("theory", "1", "The same by theory.", of_foretold(&Foretold::theory)),
            value("worst_residual", "1", "Standard errors, in the cell where that is most.", &Total::worst_residual)));
}

Table bounce_table(const Totals& totals) {
  const auto columns = columns_of<Total>(
      method_columns<Total>(), fields(&Total::tally, {"shots", "tunneled", "wrong_side", "behind"}),
      foretold_columns(&Total::through, "through", "to tunnel or to be pushed out on the wrong side."));
  return in_report(table("bounce", "What became of the balls, each method over all of its cells.", columns, totals));
}

Table bounce_self_test_table(const std::vector<SelfTest>& tests) {
  Table table =
      self_test_table(tests, "Counts that went through, tunneled or pushed out on the wrong side, against theory.");
  table.name = "bounce_self_test";
  return table;
}

Table lateness_table(const Totals& totals) {
  return in_report(table(
      "lateness", "Lateness of detection along the path against theory, over all cells of a method and scalar at once.",
      totals, method_columns<Total>(),
      value("cells", "1", "Cells in which anything was detected.", &Total::detected_cells),
      value("false_cells", "1",
            "Of those, cells with a hit where ball and wall are farther apart than the method claims; must be 0.",
            &Total::false_cells),
      value("late_cells", "1", "Of those, cells with one later than theory allows; must be 0.", &Total::late_cells),
      residual_columns("Cells with a theory and enough detections to judge their mean.",
                       "Sum of squared standard residuals of the judged means.", &Total::lateness),
      value("passed", "", "All of the above hold.", &Total::lateness_passes)));
}

Table stratified_table(const Totals& totals) {
  const auto columns = columns_of<Total>(
      method_columns<Total>(), value("cells", "1", "Cells with an infinite wall and a theory.", &Total::even_cells),
      value("shots", "1", "Phases in each cell, n.", [](const Total&) { return stratified_shots; }),
      value("largest_deviation", "1", "Largest |k - n p| over the cells, k the number that tunneled.",
            &Total::largest_deviation),
      value("passed", "", "The largest deviation is at most 1.", &Total::even_passes));
  return in_report(table("stratified", "Counts of evenly spread phases against theory: infinite walls, double.",
                         columns.without({"scalar"}),
                         only(totals, [](const Total& t) { return t.method->scalar == "double"; })));
}

// What the pictures show: double only, since float's points would lie on the same spots.

constexpr double left = 0.1, right = 1000;  // of the pictures' axis; more to the right is all 1

/// What lies along x, of walls of one kind.
struct Abscissa {
  Wall wall;
  double (*x)(const Row&);
  const char* label;
};
constexpr Abscissa step_ratios = {Wall::infinite, step_ratio, "step ratio  v h cos(angle) / (w + 2 r)  [1]"};
/// The mean chord of a finite wall thickened by the ball is its volume over its shadow.
constexpr Abscissa mean_chord_ratios = {Wall::finite,
                                        [](const Row& row) {
                                          const RoundedBox box = rounded_box(row.cell);
                                          const double across = shadow(box, direction(row.cell));
                                          return step_length(row.cell) * across / volume(box);
                                        },
                                        "step over mean chord  v h shadow / volume  [1]"};

Rows drawn(const Rows& rows, const Abscissa& along) {
  return only(of_one_scalar(rows), [&](const Row& row) {
    return row.cell.wall == along.wall && left <= along.x(row) && along.x(row) <= right;
  });
}

/// Of the cells that would be drawn into the same sixth of a decade, the first: enough to see, few enough to see through.
/// From left to right.
Rows thinned(const Rows& rows, const Abscissa& along) {
  const auto place = [&](const Row& row) { return std::floor(6 * std::log10(along.x(row))); };
  std::map<double, Cell> first;
  for (const Row& row : rows) first.try_emplace(place(row), row.cell);
  Rows result = only(rows, [&](const Row& row) { return first.at(place(row)) == row.cell; });
  std::ranges::stable_sort(result, {}, along.x);
  return result;
}

/// [1] Over the path in contact.
std::optional<Measured> lateness_share(const Row& row) {
  const std::optional<double> mean = lateness_mean(row);
  if (!mean) return std::nullopt;
  const double deviation = row.theory.lateness ? row.theory.lateness->deviation : nan;
  return normal_mean(*mean, deviation, row.tally.detected()).times(1 / slab_chord(row.cell));
}

Plot points(const Rows& rows, const Abscissa& along, std::string_view y, std::string y_label) {
  const auto columns = columns_of<Row>(row_columns(), bounce_columns(), value("x", "", "", along.x),
                                       measured("lateness_share", "", "", lateness_share, "lateness_"));
  return plot(rows, columns).x("x", Axis::log, along.label).y(y, Axis::linear, std::move(y_label)).by("method");
}

/// y = curve(x / n) for every number of poses n that was fired.
Plot with_theory(Plot plot, const Rows& rows, double (*curve)(double), const char* label = "theory",
                 Mark mark = Mark::line) {
  std::set<int> poses;
  for (const Row& row : rows) poses.insert(row.method->poses_per_step);
  poses.erase(0);
  for (const int n : poses) {
    plot.curve(
        label, [=](double x) { return curve(x / n); }, left, right, mark);
  }
  return plot;
}

double unseen_curve(double x) { return miss_probability(1, x); }

Figure probability_figure(const Rows& infinite, const Rows& few) {
  const Rows judged = only(infinite, is_judged);
  Plot top = points(few, step_ratios, "probability", "tunneling probability [1]");
  Plot bottom = points(judged, step_ratios, "residual", "residual [std. errors]").height(0.45);
  for (const double y : {-1.96, 1.96}) bottom.line("95 % of residuals", {left, right}, {y, y}, Mark::dashes);
  return {
      .name = "probability",
      .title = "How often a ball passes a thin wall unseen",
      .caption = fmt::format(
          "Infinite walls, double. Points are measured, with 95 % Wilson intervals; the line is the theory "
          "max(0, 1 - n (w + 2 r) / (v h cos(angle))) for n poses a step. {}ne cell in each sixth of a decade, methods that "
          "never tunnel taking turns on the zero line.{}",
          judged.empty() ? "O" : "Above: o",
          judged.empty() ? "" : " Below: every cell in which at least 5 shots are expected to tunnel and 5 not to."),
      .panels = {taking_turns(with_theory(top, few, unseen_curve)), bottom}};
}

Figure lateness_figure(const Rows& few) {
  const Plot late = points(few, step_ratios, "lateness_share", "mean lateness / path in contact [1]");
  return {
      .name = "lateness",
      .title = "How late a hit is detected",
      .caption =
          "Mean path length from first contact to detection, over the path length (w + 2 r) / cos(angle) in "
          "contact, with 95 % intervals. Infinite walls, double. The lines are of poses only: min(x / n, 1) / 2 for n "
          "of them a step. A ray from the center is late by what the radius leads it, r / cos(angle), however thin "
          "the wall.",
      .panels = {with_theory(late, few, [](double x) { return std::min(x, 1.0) / 2; })}};
}

Figure finite_figure(const Rows& few) {
  const Plot seen = points(few, mean_chord_ratios, "probability", "tunneling probability [1]");
  return {
      .name = "finite",
      .title = "The same for walls that end",
      .caption =
          "Finite walls, double; aim uniform over the wall's shadow, rim included. Points are measured, with "
          "95 % Wilson intervals; the line is 1 - n / x for n poses a step, which holds where the poses are "
          "farther apart than the longest chord: never left of n, where it begins. A ray from the center misses what only "
          "the rim would hit.",
      .panels = {taking_turns(with_theory(seen, few, [](double x) { return x < 1 ? nan : unseen_curve(x); }))}};
}

Figure bounce_figure(const Rows& few) {
  const Plot share = with_theory(points(few, step_ratios, "through", "share that went through [1]"), few,
                                 [](double x) { return miss_probability(0.5, x); });
  return {
      .name = "bounce",
      .title = "How often a ball that should bounce goes through",
      .caption =
          "Infinite walls, double. Points are measured, with 95 % Wilson intervals: shots that went through unseen, "
          "or were pushed out on the wrong side. The line is max(0, 1 - n (r + w / 2) / (v h cos(angle))) for n "
          "poses a step; the dashes are those unseen alone. Seen is not saved: the step that is safe is half as long.",
      .panels = {taking_turns(with_theory(share, few, unseen_curve, "theory, unseen alone", Mark::dashes))}};
}

std::vector<Figure> figures_of(const Rows& rows, bool bounces) {
  const Rows infinite = drawn(rows, step_ratios), few = thinned(infinite, step_ratios);
  std::vector<Figure> figures = {probability_figure(infinite, few), lateness_figure(few),
                                 finite_figure(thinned(drawn(rows, mean_chord_ratios), mean_chord_ratios))};
  if (bounces) figures.insert(figures.begin(), bounce_figure(few));
  return only_measured(std::move(figures));
}

// What it says.

std::string percent(double share) { return fmt::format("{:.2f} %", 100 * share); }
std::string percent(std::int64_t part, std::int64_t whole) {
  return percent(static_cast<double>(part) / static_cast<double>(whole));
}

std::string total_answer(const Total& t) {
  if (t.method->name == "end_of_step" && t.tunneled.shots > 0) {
    const Interval bars = wilson(t.tunneled.counted, t.tunneled.shots);  // too wide, if anything: the cells differ
    return fmt::format(
        "Of {} shots for which theory has a formula, testing only the end of the step let {} through "
        "(95 % interval {:.2f} to {}; theory {}). ",
        grouped_text(t.tunneled.shots), percent(t.tunneled.share()), 100 * bars.lower, percent(bars.upper),
        percent(t.tunneled.theory()));
  }
  if (t.method->name != "closed_form") return "";
  if (!t.is_clean()) {
    return fmt::format("The closed form let {} of {} through.", grouped_text(t.tally.tunneled),
                       grouped_text(t.tally.shots));
  }
  return fmt::format(
      "The closed form let none of {} through: with 95 % confidence its chance per shot, on average "
      "over these conditions, is below {}.",
      grouped_text(t.tally.shots), rounded_text(upper_of(t), 2));
}

std::string bounce_answer(const Total& t) {
  if (t.method->name == "end_of_step" && t.through.shots > 0) {
    return fmt::format(
        "Of {} balls that should have bounced, and for which theory has a formula, testing only the end of the step "
        "let {} through (theory {}). Of all {} shots, {} went through unseen, and {} were seen and pushed out on the "
        "wrong side. ",
        grouped_text(t.through.shots), percent(t.through.share()), percent(t.through.theory()),
        grouped_text(t.tally.shots), percent(t.tally.tunneled, t.tally.shots),
        percent(t.tally.wrong_side, t.tally.shots));
  }
  if (t.method->name != "closed_form") return "";
  return fmt::format("Swept with the closed form, {} of {} went through.", grouped_text(t.tally.went_through()),
                     grouped_text(t.tally.shots));
}

std::string answer_of(const Totals& totals, bool bounces) {
  std::string text, answer;
  for (const Total& t : totals) {
    if (bounces) text += bounce_answer(t);
    answer += total_answer(t);
  }
  if (answer.empty()) {
    const Total& first = totals.front();
    answer = fmt::format("{} let {} of {} shots through.", first.method->name, first.tally.tunneled, first.tally.shots);
  }
  return bounces ? text + " " + answer : answer;
}

/// How many cells count differently at float and at double.
std::string scalars_text(const Rows& rows) {
  std::int64_t pairs = 0, differing = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = i + 1; j < rows.size() && rows[j].cell == rows[i].cell; ++j) {
      if (rows[i].method->name != rows[j].method->name) continue;
      ++pairs;
      differing += rows[i].tally.tunneled != rows[j].tally.tunneled ? 1 : 0;
    }
  }
  if (pairs == 0) return "";
  return fmt::format("float and double count differently in {} of {} cells.\n", grouped_text(differing),
                     grouped_text(pairs));
}

/// What a bounce adds. It comes first: it is what was asked for.
void add_bounce(const Rows& rows, const Rows& bullets, const Totals& totals, Outcome& outcome) {
  const std::vector<SelfTest> tests = self_test(counts_of(rows, going_through));
  outcome.summary =
      terminal(table("bullet", "With a bounce, the bullet goes through unseen, or pushed out on the wrong side.",
                     columns_of<Row>(row_columns(), bounce_columns()), of_one_scalar(bullets)),
               {"method", "scalar", "shots", "tunneled", "wrong_side", "through", "through_theory"}) +
      "\n" +
      terminal(bounce_table(of_one_scalar(totals)), {"method", "scalar", "shots", "tunneled", "wrong_side",
                                                     "theory_shots", "theory_through", "theory_expected"}) +
      fmt::format("\nSelf-test of the bounce: counts {}, ends {}.\n\n", verdict_text(all_passed(tests)),
                  verdict_text(ends_agree(rows))) +
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
  return {"To play with",
          "Run thinwall explore in this folder: it puts a page beside this one that fires such shots in the browser.",
          fmt::format("explore.html#speed={}&step={}&radius={}&thickness={}&angle_deg={}&seed={}",
                      exact_text(cell.speed), exact_text(cell.step), exact_text(cell.radius),
                      exact_text(cell.thickness), exact_text(cell.angle_deg), plan.seed)};
}

Outcome outcome_of(const Rows& rows, const ShotPlan& plan) {
  const bool bounces = plan.response == Response::bounce;
  const Totals totals = totals_of(rows), spoken_of = of_one_scalar(totals);
  const std::vector<SelfTest> counts = self_test(counts_of(rows, tunneling));
  const Rows bullets = only(rows, [](const Row& row) { return row.cell == bullet; });
  const auto bullet_table = [&](const Rows& shown) {
    return in_report(table("bullet",
                           "The bullet at 10 m/s that is before the wall at one frame and behind it at the next.",
                           row_columns().without({"lateness_min", "gap_max", "queries"}), shown));
  };
  const bool counts_pass = all_passed(counts), even_pass = std::ranges::all_of(totals, &Total::even_passes),
             lateness_pass = std::ranges::all_of(totals, &Total::lateness_passes);
  std::string summary =
      terminal(bullet_table(of_one_scalar(bullets)), {"method", "scalar", "probability", "theory", "lateness_mean",
                                                      "lateness_mean_theory", "lateness_max", "lateness_max_theory"}) +
      "\n" + shares_text(spoken_of) + "\n" + scalars_text(rows);
  for (const Total& t : spoken_of) {
    if (t.is_clean()) {
      summary += wrapped(fmt::format("{}: none of {}; chance per shot below {} (95 %, Clopper-Pearson).",
                                     t.method->name, grouped_text(t.tally.shots), rounded_text(upper_of(t), 2)));
    }
  }
  summary += fmt::format("Self-test: counts {}, evenly spread phases {}, lateness {}.\n", verdict_text(counts_pass),
                         verdict_text(even_pass), verdict_text(lateness_pass));
  Outcome outcome = {
      .answer = answer_of(spoken_of, bounces),
      .summary = std::move(summary),
      .tables = {bullet_table(bullets), methods_table(totals), self_test_table(counts), stratified_table(totals),
                 lateness_table(totals),
                 table("cells",
                       "Every cell at every method and scalar: how often the ball tunnels, how late it is detected.",
                       bounces ? columns_of<Row>(row_columns(), bounce_columns()) : row_columns(), rows),
                 timings_table(rows)},
      .figures = figures_of(rows, bounces),
      .sections = {{"Self-test", self_test_text(counts)}, page_section(plan)},
      .self_test_passed = counts_pass && even_pass && lateness_pass};
  if (bounces) add_bounce(rows, bullets, totals, outcome);
  return outcome;
}

using Counts = std::vector<std::int64_t>;

/// By method of the plan in double: where the wall is infinite.
Counts evenly_spread(const ShotPlan& plan, const Cell& cell) {
  Counts counts;
  for (const ThinWallMethod& method : plan.methods) {
    if (is_fired_evenly(cell, method)) counts.push_back(tunneled_evenly(cell, method, plan.seed));
  }
  return counts;
}

/// First every cell at every method, cell by cell and volley by volley, then the cells at evenly spread phases.
std::unique_ptr<Run> configure(const Settings& settings, const RunOptions& options) {
  const auto plan = std::make_shared<const ShotPlan>(make_plan(settings, options));
  const std::vector<Volley> volleys = volleys_of(plan->shots);
  std::vector<Task<Tally>> fired;
  std::vector<Task<Counts>> spread;
  for (const Cell& cell : plan->cells) {
    const std::string where = cell_factors.key(cell);
    std::int64_t even = 0;
    for (const ThinWallMethod& method : plan->methods) {
      for (const Volley& volley : volleys) {
        std::string key = fmt::format("{} {} {}", where, method.name, method.scalar);
        if (volleys.size() > 1) key += fmt::format(" from {}", volley.first);
        fired.push_back({std::move(key), volley.shots,
                         [plan, &cell, &method, volley] { return fire(cell, method, volley, plan->seed); }});
      }
      if (is_fired_evenly(cell, method)) even += stratified_shots;
    }
    if (even > 0) spread.push_back({where + " stratified", even, [plan, &cell] { return evenly_spread(*plan, cell); }});
  }
  const auto finish = [plan, each = volleys.size()](const Done<Tally>& done, const Done<Counts>& evenly) {
    Rows rows = rows_of(*plan);
    for (std::size_t i = 0; i < done.results.size(); ++i) {
      rows[i / each].tally += done.results[i];
      rows[i / each].seconds += done.seconds[i];
    }
    const Counts counts = flat(evenly.results);
    auto next = counts.begin();
    for (Row& row : rows) {
      if (is_fired_evenly(row.cell, *row.method)) row.tunneled_evenly = *next++;
    }
    return outcome_of(rows, *plan);
  };
  return make_run(finish, std::move(fired), std::move(spread));
}

/// The mean of this many is near normal: at least 5 times the number over which rare values average out.
bool mean_is_normal(double detected, const Lateness& theory) {
  const double spread = theory.deviation / theory.largest;
  return theory.largest > 0 && detected * spread * spread >= 5;
}

/// [m] How well the scalar holds a pose of the cell. A time in [0, 1] is rounded once, and so are a few coordinates as
/// large as a step, a chord or the wall; or the time backs off by as much, so as not to be late.
double resolution(const Row& row) {
  const double size = target(row.cell).step_length + slab_chord(row.cell) + row.cell.wall_size;
  return 32 * row.method->round_off * size;
}

void add_lateness(Total& total, const Row& row) {
  const double detected = static_cast<double>(row.tally.detected());
  if (detected == 0) return;
  ++total.detected_cells;
  if (row.tally.widest > row.theory.widest + resolution(row)) ++total.false_cells;
  if (const std::optional<double> largest = row.theory.largest_lateness()) {
    // Against the settings, a shot's step may be shorter and its wall thicker by a grid unit.
    const double rounding = resolution(row) / cosine(row.cell) + *largest * 0x1p-20;
    if (row.tally.latest > *largest + rounding) ++total.late_cells;
  }
  const std::optional<Lateness>& theory = row.theory.lateness;
  if (theory && mean_is_normal(detected, *theory))
    total.lateness.add((*lateness_mean(row) - theory->mean) / (theory->deviation / std::sqrt(detected)));
}

void add_evenly_spread(Total& total, const Row& row) {
  if (!row.tunneled_evenly || !row.theory.probability) return;
  ++total.even_cells;
  const double expected = static_cast<double>(stratified_shots) * *row.theory.probability;
  const double deviation = std::abs(static_cast<double>(*row.tunneled_evenly) - expected);
  total.largest_deviation = std::max(total.largest_deviation, deviation);
}

void add(Foretold& sum, const Row& row, const ThinWallFate& fate) {
  const std::optional<double>& chance = row.theory.*fate.chance;
  if (!chance) return;
  sum.shots += row.tally.shots;
  sum.counted += fate.count(row.tally);
  sum.expected += *chance * static_cast<double>(row.tally.shots);
}

/// The list of the two that is not the default, to complain about: the other is hardly to blame.
std::string_view step_or_speed(const Settings& settings) {
  const Settings defaults("", "defaults", embedded_toml("thin_wall"));
  return settings.numbers("step", {}) == defaults.numbers("step", {}) ? "speed" : "step";
}

/// The bullet first, then every combination of the settings' factors; `each` units come of one. Throws UsageError.
std::vector<Cell> make_cells(const Settings& settings, std::size_t each) {
  const double size = settings.number("wall_size", {.lower = 0, .upper = 1e6, .lower_open = true, .unit = "m"});
  const auto other_than_bullet = [&](Cell& cell) {
    cell.wall_size = cell.wall == Wall::finite ? size : 0;
    if (const std::optional<CellFault> fault = fault_of(cell))
      settings.complain(fault->key == "speed" ? step_or_speed(settings) : fault->key, fault->expected);
    return cell != bullet;
  };
  std::vector<Cell> cells = cell_factors.cells(settings, each, {}, other_than_bullet);
  cells.insert(cells.begin(), bullet);
  return cells;
}

constexpr std::array<std::string_view, 2> walls = {"infinite", "finite"};

}  // namespace

const Factors<Cell> cell_factors =
    factors(numbers("speed", &Cell::speed, allowed_speed, "Speed of the ball."),
            numbers("step", &Cell::step, allowed_step, "Time between two poses."),
            numbers("radius", &Cell::radius, allowed_radius, "Radius of the ball."),
            numbers("thickness", &Cell::thickness, allowed_thickness, "Thickness of the wall."),
            numbers("angle_deg", &Cell::angle_deg, allowed_angle,
                    "Angle of incidence, between the motion and the wall's normal."),
            choices("wall", &Cell::wall, walls, "Infinite, or a finite square."))
        .first_fastest();

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

std::vector<ThinWallRow> rows_of(const ShotPlan& plan) {
  Rows rows;
  for (const Cell& cell : plan.cells) {
    for (const ThinWallMethod& method : plan.methods) rows.push_back({cell, &method, method.theory(cell)});
  }
  return rows;
}

bool is_fired_evenly(const Cell& cell, const ThinWallMethod& method) {
  return cell.wall == Wall::infinite && method.scalar == "double";
}

std::vector<CellCount> counts_of(const std::vector<ThinWallRow>& rows, const ThinWallFate& fate) {
  std::vector<CellCount> counts;
  for (const Row& row : rows) {
    const std::optional<double>& chance = row.theory.*fate.chance;
    if (!chance) continue;
    counts.push_back({row.method->name, row.method->scalar, row.tally.shots, fate.count(row.tally), *chance});
  }
  return counts;
}

bool ends_agree(const std::vector<ThinWallRow>& rows) {
  return std::ranges::all_of(rows, [](const Row& row) {
    return is_finite(row) || row.tally.undecided > 0 || row.tally.behind == row.tally.went_through();
  });
}

std::vector<ThinWallTotal> totals_of(const std::vector<ThinWallRow>& rows) {
  Totals totals;
  for (const Group<Row>& group : group_by(rows, &Row::method)) {
    Total& total = totals.emplace_back(Total{.method = group[0]->method});
    for (const Row* row : group) {
      Tally tally = row->tally;
      tally.lateness = 0;  // of cells whose units differ, and a sum that might overflow
      total.tally += tally;
      ++total.cells;
      total.clean_cells += row->tally.tunneled == 0 ? 1 : 0;
      add(total.tunneled, *row, tunneling);
      add(total.through, *row, going_through);
      if (is_judged(*row) && std::abs(*residual(*row)) >= std::abs(total.worst_residual.value_or(0)))
        total.worst_residual = residual(*row);
      add_lateness(total, *row);
      add_evenly_spread(total, *row);
    }
  }
  return totals;
}

Experiment thin_wall_experiment() {
  return {
      "thin_wall",
      "How often does a fast ball pass through a thin wall, for each way of detecting the hit, and does theory agree?",
      embedded_toml("thin_wall"), configure};
}

}  // namespace thinwall
