/// A rod that spins flies at a thin wall: how often does it get through unseen, for each way of detecting the hit? See
/// docs/spinning_rod.md.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/lab/columns.hpp>
#include <thinwall/experiments/lab/factors.hpp>
#include <thinwall/experiments/lab/plot.hpp>
#include <thinwall/experiments/lab/tasks.hpp>
#include <thinwall/experiments/lab/terminal.hpp>
#include <thinwall/experiments/lab/text.hpp>
#include <thinwall/experiments/models/rods.hpp>
#include <thinwall_embedded.hpp>

namespace thinwall {

namespace {

using Tally = RodTally;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

constexpr Range a_length = {.lower = 1e-3, .upper = 1e3, .unit = "m"};
constexpr Range a_thickness = {.lower = 0, .upper = 1e3, .unit = "m"};

const Factors<RodFlight> rod_factors = factors<RodFlight>(
    number("half_length", &RodFlight::half_length, a_length, "From the middle of the rod's core to its end."),
    number("radius", &RodFlight::radius, a_length, "Radius of the rod."),
    number("thickness", &RodFlight::thickness, a_thickness, "Of the wall."),
    numbers("tilt_deg", &RodFlight::tilt_deg, {.lower = 0, .upper = 90, .unit = "deg"},
            "Between the axis of spin and the wall's normal."),
    numbers("spin_deg", &RodFlight::spin_deg, {.lower = 0, .upper = 720, .unit = "deg"},
            "How far the rod turns in a step."),
    numbers("step_ratio", &RodFlight::step_ratio, {.lower = 0.05, .upper = 1e4},
            "The step over wall and rod at their widest, w + 2 r + 2 L sin(tilt)."));

const Factors<BladePass> blade_factors = factors<BladePass>(
    number("half_length", &BladePass::half_length, a_length, "From the axis to the end of the blade's core."),
    number("radius", &BladePass::radius, a_length, "Radius of the blade."),
    number("post_radius", &BladePass::post_radius, a_thickness, "Radius of the post."),
    number("post_distance", &BladePass::post_distance, a_length, "From the blade's axis to the post's."),
    numbers("post_spin_deg", &BladePass::post_spin_deg, {.lower = 0, .upper = 180, .lower_open = true, .unit = "deg"},
            "How far the blade turns in a step."));

std::vector<BladePass> make_passes(const Settings& settings, std::size_t each) {
  const std::vector<BladePass> cells = blade_factors.cells(settings, each);
  for (const BladePass& c : cells) {
    if (c.post_distance <= c.radius + c.post_radius || c.post_distance > c.half_length) {
      settings.complain("post_distance",
                        fmt::format("more than radius + post_radius, and at most half_length: not so at {}, {} and {}",
                                    c.radius, c.post_radius, c.half_length));
    }
    if (radians(c.post_spin_deg) > std::numbers::pi - 2 * half_window(c)) {
      settings.complain("post_spin_deg",
                        fmt::format("at most {:.6g}, so that one end alone is near the post; it is not at {}",
                                    180 - 2 * half_window(c) * 180 / std::numbers::pi, c.post_spin_deg));
    }
  }
  return cells;
}

/// A cell at a method.
template <class Cell> struct RowOf {
  Cell cell;
  std::string method;
  RodClaims claims;
  std::optional<double> theory;  ///< [1] chance of tunneling
  Tally tally = {};
};
using FlightRow = RowOf<RodFlight>;
using PassRow = RowOf<BladePass>;

double expected(const auto& row) { return row.theory.value_or(0) * static_cast<double>(row.tally.trials); }

/// [m] How well double holds a pose of the cell: a few coordinates as large as what the rod flies through.
double resolution(double size) { return 64 * std::numeric_limits<double>::epsilon() * size; }
double resolution(const RodFlight& c) {
  return resolution(widest(c) + 4 * step_length(c) + radians(c.spin_deg) * (reach(c) + c.radius));
}
double resolution(const BladePass& c) { return resolution(c.half_length + c.post_distance); }

/// [m] The most that a point of the rod moves in a step.
double path_of(const RodFlight& c) { return step_length(c) + radians(c.spin_deg) * (c.half_length + c.radius); }
double path_of(const BladePass& c) { return radians(c.post_spin_deg) * (c.half_length + c.radius); }

// What the tables show.

/// What is counted of a row.
auto of(auto part) {
  return [part](const auto& row) { return std::invoke(part, row.tally); };
}

auto late_share(std::string description) {
  return share("late_share", std::move(description), of(&Tally::late), of(&Tally::detected), "late_");
}

/// `own`: a column of such cells alone.
template <class Row, class Cell, class Own> Columns<Row> cell_columns(const Factors<Cell>& factors, const Own& own) {
  return columns_of<Row>(
      text("method", "Way of detecting the hit.", &Row::method), factors.columns(&Row::cell), own,
      fields(&Row::tally, {"trials", "tunneled"}),
      share("probability", "tunneled / trials.", of(&Tally::tunneled), of(&Tally::trials)),
      value("theory", "1", "The same by theory; missing where there is none.", &Row::theory),
      value("residual", "1", "Standard errors between the two, where at least five are expected of either.",
            [](const Row& r) -> std::optional<double> {
              if (!r.theory || !can_be_judged(r.tally.trials, *r.theory)) return std::nullopt;
              return standard_residual(r.tally.tunneled, r.tally.trials, *r.theory);
            }),
      late_share("late over the trials with a hit."),
      value("lateness_mean", "step", "Mean time from first contact to the hit.",
            [](const Row& r) { return r.tally.lateness.mean(); }),
      fields(&Row::tally, {"lateness_max", "lateness_min", "gap_max", "gap_min", "false_hits", "undecided", "steps",
                           "evaluations"}));
}

Columns<FlightRow> flight_columns() {
  return cell_columns<FlightRow>(rod_factors, value("step", "m", "How far the rod flies in a step.",
                                                    [](const FlightRow& r) { return step_length(r.cell); }));
}

Table flights_table(const std::vector<FlightRow>& rows) {
  return table("flights", "Every cell of a spinning rod's flight at the wall, at every method.", flight_columns(),
               rows);
}

Table passes_table(const std::vector<PassRow>& rows) {
  const auto window = value("window_deg", "deg", "How far the blade turns while it touches the post.",
                            [](const PassRow& r) { return 2 * half_window(r.cell) / radians(1); });
  return table("passes", "Every cell of a blade that turns past the post, at every method.",
               cell_columns<PassRow>(blade_factors, window), rows);
}

/// A method over all of its cells, or over those of one spin.
struct Total {
  std::string obstacle, method;
  double spin_deg = 0;
  Tally tally;
  double expected = 0;  ///< tunneled, by theory
  bool has_theory = true;

  std::optional<double> tunneled_theory() const { return has_theory ? std::optional(expected) : std::nullopt; }
};

template <class Row, class Key>
void add_totals(const char* obstacle, const std::vector<Row>& rows, const Key& key, std::vector<Total>& totals) {
  for (const Group<Row>& group : group_by(rows, key)) {
    Total& total = totals.emplace_back();
    total.obstacle = obstacle;
    total.method = group[0]->method;
    total.tally = total_of(group, &Row::tally);
    for (const Row* row : group) {
      total.expected += expected(*row);
      total.has_theory &= row->theory.has_value();
    }
  }
}

Table methods_table(const std::vector<Total>& totals) {
  return in_report(
      table("methods", "Each method over all of its cells, every cell with the same number of trials.", totals,
            text("obstacle", "What is in the way.", &Total::obstacle),
            text("method", "Way of detecting the hit.", &Total::method), fields(&Total::tally, {"trials", "tunneled"}),
            value("expected", "1", "Tunneled by theory; missing where it has none.", &Total::tunneled_theory),
            late_share("First hits later than first contact, by more than a millionth of a step."),
            fields(&Total::tally, {"false_hits", "lateness_max", "gap_min", "gap_max"}),
            value("looks", "1", "Looks at a pose and closed forms a step.", [](const Total& t) {
              return static_cast<double>(t.tally.evaluations) / static_cast<double>(t.tally.steps);
            })));
}

/// What a linear sweep finds too late, by spin.
std::vector<Total> spins_of(const std::vector<FlightRow>& rows) {
  const std::vector<FlightRow> swept = only(rows, [](const FlightRow& r) { return r.method == "linear_sweep"; });
  std::vector<Total> totals;
  const auto spin = [](const FlightRow& r) { return r.cell.spin_deg; };
  add_totals("wall", swept, spin, totals);
  const auto groups = group_by(swept, spin);
  for (std::size_t i = 0; i < totals.size(); ++i) totals[i].spin_deg = groups[i][0]->cell.spin_deg;
  return totals;
}

Table spins_table(const std::vector<Total>& totals) {
  return in_report(table("linear_sweep",
                         "A linear sweep at the wall, which leaves the spin out, over all cells of a spin.", totals,
                         value("spin_deg", "deg", "How far the rod turns in a step.", &Total::spin_deg),
                         fields(&Total::tally, {"trials", "tunneled"}),
                         late_share("First hits later than first contact, by more than a millionth of a step."),
                         share("false_share", "Hits reported in a step by whose end nothing has touched yet.",
                               of(&Tally::false_hits), of(&Tally::detected), "false_"),
                         fields(&Total::tally, {"lateness_max", "gap_min", "gap_max"})));
}

// The self-test: counts against theory, and hits against what each method claims.

template <class Row>
void add_counts(const char* obstacle, const std::vector<Row>& rows, std::vector<CellCount>& counts) {
  for (const Row& r : rows) {
    if (r.theory) counts.push_back({r.method, obstacle, r.tally.trials, r.tally.tunneled, *r.theory});
  }
}

Table counts_table(const std::vector<SelfTest>& tests) {
  return self_test_table(tests, "Tunneled trials against theory, over all cells of a method at an obstacle at once.",
                         {"method", "Way of detecting the hit."}, {"obstacle", "What is in the way."});
}

struct ClaimTest {
  std::string method;
  std::int64_t cells = 0;      ///< in which anything was detected
  std::int64_t late = 0;       ///< ... with a hit after first contact, of a method that is never late
  std::int64_t apart = 0;      ///< ... with a hit at a gap wider than the method says, and rounding explains
  std::int64_t undecided = 0;  ///< ... with a trial that it gave up on
  bool passed() const { return late == 0 && apart == 0 && undecided == 0; }
};

template <class Row> void add_claims(const std::vector<Row>& rows, std::vector<ClaimTest>& tests) {
  for (const Row& r : rows) {
    auto found = std::ranges::find(tests, r.method, &ClaimTest::method);
    if (found == tests.end()) found = tests.insert(tests.end(), {.method = r.method});
    found->undecided += r.tally.undecided > 0 ? 1 : 0;
    if (r.tally.detected() == 0) continue;
    ++found->cells;
    if (r.claims.never_late && r.tally.latest > 0) ++found->late;
    if (!r.claims.most_gap) continue;
    if (r.tally.widest > *r.claims.most_gap * path_of(r.cell) + resolution(r.cell)) ++found->apart;
  }
}

Table claims_table(const std::vector<ClaimTest>& tests) {
  using T = ClaimTest;
  const auto columns = columns_of<T>(
      text("method", "Way of detecting the hit.", &T::method),
      value("cells", "1", "Cells in which it reported a hit.", &T::cells),
      value("late", "1", "Cells with a hit after first contact, of a method that is never late; must be 0.", &T::late),
      value("apart", "1", "Cells with a hit at a gap wider than its tolerance and rounding; must be 0.", &T::apart),
      value("undecided", "1", "Cells with a trial that it gave up on; must be 0.", &T::undecided),
      value("passed", "", "All of the above hold.", &T::passed));
  return in_report(table("claims", "Reported hits against what each method claims.", columns, tests));
}

// What the pictures show.

double nearest(const std::vector<FlightRow>& rows, double RodFlight::*factor, double wanted) {
  const auto distance = [=](const FlightRow& r) { return std::abs(r.cell.*factor - wanted); };
  return std::ranges::min_element(rows, {}, distance)->cell.*factor;
}

/// The flights with the spin in words.
Table drawn_table(const std::vector<FlightRow>& rows) {
  return table("drawn", "", rows, flight_columns(),
               text("spin", "", [](const FlightRow& r) { return fmt::format("{:g} deg", r.cell.spin_deg); }),
               value("depth_max", "m", "", [](const FlightRow& r) -> std::optional<double> {
                 if (r.tally.detected() == 0) return std::nullopt;
                 return std::max(0.0, -r.tally.deepest);
               }));
}

constexpr const char* step_axis = "step / (w + 2 r + 2 L sin(tilt)) [1]";

/// Tunneling along the step ratio, a series for each spin or method, and the theory of each cell but for that ratio.
Panel tunneled_panel(const std::vector<FlightRow>& rows, const char* by, const std::string& label,
                     const std::vector<RodMethod>& methods) {
  Plot panel =
      plot(drawn_table(rows)).x("step_ratio", Axis::log, step_axis).y("probability", Axis::linear, label).by(by);
  const auto series = [](const FlightRow& r) { return std::tuple(r.method, r.cell.spin_deg, r.cell.tilt_deg); };
  for (const Group<FlightRow>& group : group_by(rows, series)) {
    const auto method = std::ranges::find(methods, group[0]->method, &RodMethod::name);
    panel.curve("theory", [theory = method->wall_theory, cell = group[0]->cell](double ratio) {
      RodFlight c = cell;
      c.step_ratio = ratio;
      return theory(c).value_or(nan);
    });
  }
  return panel;
}

std::vector<Figure> flight_figures(const std::vector<FlightRow>& rows, const std::vector<RodMethod>& methods) {
  const double tilt = nearest(rows, &RodFlight::tilt_deg, 90), spin = nearest(rows, &RodFlight::spin_deg, 90);
  const auto tilted = only(rows, [=](const FlightRow& r) { return r.cell.tilt_deg == tilt; });
  std::vector<Figure> figures;
  Figure by_spin = {
      .name = "probability",
      .title = "How often a spinning rod flies through the wall unseen",
      .caption = fmt::format("Share of the flights that tunnel where poses are tested, by how far the rod "
                             "turns in a step, with 95 % Wilson intervals, and the theory; the axis of "
                             "spin is tilted by {:g} degrees.",
                             tilt)};
  for (const RodMethod& method : methods) {
    if (method.name != "end_of_step" && !method.name.starts_with("substeps")) continue;
    const auto its = only(tilted, [&](const FlightRow& r) { return r.method == method.name; });
    by_spin.panels.push_back(tunneled_panel(its, "spin", method.name + " tunneled [1]", methods));
  }
  if (!by_spin.panels.empty()) figures.push_back(std::move(by_spin));

  const auto spun = only(tilted, [=](const FlightRow& r) { return r.cell.spin_deg == spin; });
  figures.push_back({.name = "methods",
                     .title = "How often a spinning rod flies through the wall unseen, by method",
                     .caption = fmt::format("Share of the flights that tunnel, with 95 % Wilson intervals, and the "
                                            "theory, at {:g} degrees a step; the axis is tilted by {:g} degrees.",
                                            spin, tilt),
                     .panels = {tunneled_panel(spun, "method", "tunneled [1]", methods)}});

  const auto sweeps = only(tilted, [](const FlightRow& r) { return r.method == "linear_sweep"; });
  if (sweeps.empty()) return figures;
  const auto along = [drawn = drawn_table(sweeps)](const char* column, const char* label) -> Panel {
    return joined(plot(drawn).x("step_ratio", Axis::log, step_axis).y(column, Axis::linear, label).by("spin"));
  };
  figures.push_back(
      {.name = "linear_sweep",
       .title = "What a sweep that leaves the spin out sees too late",
       .caption = fmt::format("linear_sweep, by how far the rod turns in a step; the axis is tilted by {:g} "
                              "degrees. Above the share of hits later than first contact, with 95 % Wilson "
                              "intervals; below how deep the rod, as it has turned by then, is at worst.",
                              tilt),
       .panels = {along("late_share", "share of flights seen late [1]"), along("depth_max", "depth at worst [m]")}});
  return figures;
}

Figure pass_figure(const std::vector<PassRow>& rows, const std::vector<RodMethod>& methods) {
  Plot passes = plot(passes_table(rows))
                    .x("post_spin_deg", Axis::linear, "spin a step [deg]")
                    .y("probability", Axis::linear, "tunneled [1]")
                    .by("method");
  for (const RodMethod& method : methods) {
    passes.curve("theory", [&method, cell = rows[0].cell](double spin) {
      BladePass c = cell;
      c.post_spin_deg = spin;
      return method.post_theory(c).value_or(nan);
    });
  }
  return {
      .name = "post",
      .title = "How often a blade turns past a post unseen",
      .caption = fmt::format("Share of the passes that tunnel, with 95 % Wilson intervals, and the theory. The blade "
                             "touches the post over {:.3g} degrees; linear_sweep and end_of_step, both without a "
                             "path to sweep, are the same.",
                             2 * half_window(rows[0].cell) / radians(1)),
      .panels = {passes}};
}

// What it says.

/// The share that tunneled, and by theory where that is neither 0 nor 1.
std::string tunneled_text(const Total& total) {
  const std::string share = percent_text(share_of(total.tally.tunneled, total.tally.trials));
  if (!total.has_theory || total.expected == 0) return total.tally.tunneled == 0 ? "none" : share;
  return fmt::format("{} (theory {})", share, percent_text(share_of(total.expected, total.tally.trials)));
}

std::string method_answer(const Total& wall, const Total& post) {
  const Tally& t = wall.tally;
  std::string text = fmt::format("{} lets {} of the rods through the wall and {} of the blades past the post",
                                 wall.method, tunneled_text(wall), tunneled_text(post));
  if (t.late == 0 && t.detected() > 0) text += ", and is never late at the wall";
  if (t.late > 0 && t.tunneled == 0) {
    text += fmt::format(", but finds {} of the rods too late, by up to {:.2g} steps and {:.2g} m deep",
                        percent_text(share_of(t.late, t.detected())), t.latest, -t.deepest);
  }
  if (t.false_hits > 0)
    text += fmt::format("; {} of its hits are false", percent_text(share_of(t.false_hits, t.detected())));
  return text + ". ";
}

Outcome outcome_of(const std::vector<FlightRow>& flights, const std::vector<PassRow>& passes,
                   const std::vector<RodMethod>& methods) {
  std::vector<Total> walls, totals;
  add_totals("wall", flights, &FlightRow::method, walls);
  totals = walls;
  add_totals("post", passes, &PassRow::method, totals);
  std::vector<CellCount> counts;
  add_counts("wall", flights, counts);
  add_counts("post", passes, counts);
  const std::vector<SelfTest> tests = self_test(counts);
  std::vector<ClaimTest> claims;
  add_claims(flights, claims);
  add_claims(passes, claims);
  const bool claims_hold = std::ranges::all_of(claims, &ClaimTest::passed);
  const std::vector<Total> spins = spins_of(flights);

  Outcome out;
  for (std::size_t i = 0; i < walls.size(); ++i) out.answer += method_answer(walls[i], totals[walls.size() + i]);
  out.answer.pop_back();
  out.tables = {methods_table(totals), counts_table(tests), claims_table(claims), flights_table(flights),
                passes_table(passes)};
  out.summary = terminal(out.tables[0], {"obstacle", "method", "trials", "tunneled", "expected", "late_share",
                                         "false_hits", "lateness_max", "gap_min"});
  if (!spins.empty()) {
    out.tables.insert(out.tables.begin() + 1, spins_table(spins));
    out.summary += "\nlinear_sweep at the wall:\n" + terminal(out.tables[1]);
  }
  out.summary +=
      fmt::format("\nSelf-test: counts {}, claims {}.\n", verdict_text(all_passed(tests)), verdict_text(claims_hold));
  out.figures = flight_figures(flights, methods);
  out.figures.push_back(pass_figure(passes, methods));
  out.sections = {{"Self-test", self_test_text(tests)}};
  out.self_test_passed = all_passed(tests) && claims_hold;
  return out;
}

std::unique_ptr<Run> configure(const Settings& settings, const RunOptions& options) {
  const std::vector<RodMethod> methods =
      rod_methods(settings.choices_or_all("method", rod_method_names()),
                  settings.integers("substeps", least_rod_substeps, most_rod_substeps));
  const std::int64_t trials = settings.trials("flights", 1, most_rod_trials, options.trials);
  std::vector<FlightRow> flights;
  std::vector<PassRow> passes;
  std::vector<Task<Tally>> flight_tasks, pass_tasks;
  for (const RodFlight& cell : rod_factors.cells(settings, methods.size())) {
    for (const RodMethod& method : methods) {
      flights.push_back({cell, method.name, method.claims, method.wall_theory(cell)});
      flight_tasks.push_back({fmt::format("wall {} {}", rod_factors.key(cell), method.name), trials,
                              [cell, method, trials, seed = options.seed] { return fly(cell, method, trials, seed); }});
    }
  }
  for (const BladePass& cell : make_passes(settings, methods.size())) {
    for (const RodMethod& method : methods) {
      passes.push_back({cell, method.name, method.claims, method.post_theory(cell)});
      pass_tasks.push_back({fmt::format("post {} {}", blade_factors.key(cell), method.name), trials,
                            [cell, method, trials, seed = options.seed] { return pass(cell, method, trials, seed); }});
    }
  }
  const auto finish = [flights, passes, methods](const Done<Tally>& flown, const Done<Tally>& passed) {
    std::vector<FlightRow> all_flights = flights;
    std::vector<PassRow> all_passes = passes;
    for (std::size_t i = 0; i < flights.size(); ++i) all_flights[i].tally = flown.results[i];
    for (std::size_t i = 0; i < passes.size(); ++i) all_passes[i].tally = passed.results[i];
    return outcome_of(all_flights, all_passes, methods);
  };
  return make_run(finish, std::move(flight_tasks), std::move(pass_tasks));
}

}  // namespace

Experiment spinning_rod_experiment() {
  return {"spinning_rod",
          "How often does a rod that spins fly through a thin wall unseen, for each way of detecting the hit?",
          embedded_toml("spinning_rod"), configure};
}

}  // namespace thinwall
