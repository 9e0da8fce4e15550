/// Where does each way to find a time of impact break, at which scale, distance, speed, thickness, offset, angle or size ratio, and
/// in which precision? See docs/extremes.md.
#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <memory>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/extremes/theory.hpp>
#include <thinwall/experiments/lab/columns.hpp>
#include <thinwall/experiments/lab/plot.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/lab/statistics.hpp>
#include <thinwall/experiments/lab/tasks.hpp>
#include <thinwall/experiments/lab/terminal.hpp>
#include <thinwall/experiments/lab/text.hpp>
#include <thinwall_embedded.hpp>

namespace thinwall {

namespace {

using Row = ExtremeRow;
using Tally = ExtremeTally;

std::string_view precision_name(std::size_t precision) { return all_precisions()[precision].name; }
std::string_view side_name(const Arm& arm) { return arm.side > 0 ? "greater" : "lesser"; }
std::string_view pairs_name(PairSet pairs) { return pairs == PairSet::rounded ? "with a ball" : "two boxes"; }

/// "long double", "50 digits".
std::string title_of(std::size_t precision) { return spaced(std::string(precision_name(precision))); }

// Of a row of whatever table, as a column reads it.
constexpr auto its_precision = [](const auto& row) { return precision_name(row.precision); };
constexpr auto its_pairs = [](const auto& row) { return pairs_name(row.pairs); };

/// How far a method gets along each arm, on pairs with a ball or on two boxes.
struct Rung : ExtremeContender {
  double nanoseconds;          ///< a query: the median over pairs and places
  std::vector<Survival> arms;  ///< in the order of all_arms()

  /// On most arms, at their first value, where little or nothing is extreme.
  bool breaks_at_once() const {
    const auto at_once = [](const Survival& s) { return s.broken && !s.survived; };
    return 2 * std::ranges::count_if(arms, at_once) > std::ranges::count_if(arms, &Survival::is_asked);
  }
};

std::vector<Rung> rungs_of(const std::vector<Row>& rows) {
  std::vector<Rung> rungs;
  for (const std::string_view method : extreme_method_names()) {
    for (const std::size_t p : precisions_of(rows)) {
      for (const PairSet pairs : {PairSet::rounded, PairSet::boxes}) {
        const ExtremeContender contender = {method, p, pairs};
        std::vector<double> times;
        for (const Row& row : rows) {
          if (contender.has(row)) times.push_back(row.tally.nanoseconds);
        }
        if (times.empty()) continue;
        Rung& rung = rungs.emplace_back(Rung{contender, median(times), {}});
        for (const Arm& arm : all_arms()) rung.arms.push_back(survival(rows, arm, contender));
      }
    }
  }
  return rungs;
}

// What the tables show.

/// "1e+08 verdict", "-" where it survives, empty where it was not asked.
std::string break_text(const Survival& s) {
  if (!s.broken) return s.survived ? "-" : "";
  return fmt::format("{} {}", rounded_text(*s.broken, 3), name(s.flaw));
}

/// The power of ten and what is wrong: "4v", "-10e"; "all" where it breaks at the first value, "ok" where it survives.
std::string short_break_text(const Survival& s) {
  if (!s.broken) return s.survived ? "ok" : "";
  return fmt::format("{}{}", s.survived ? fmt::format("{:.0f}", std::log10(*s.broken)) : "all", name(s.flaw)[0]);
}

/// A column an arm.
template <class Text> void add_arms(Columns<Rung>& columns, const Text& text_of) {
  for (std::size_t i = 0; i < all_arms().size(); ++i) {
    const Arm& arm = all_arms()[i];
    text(std::string(arm.name),
         fmt::format("First break along {}, towards {} values.", info(arm.axis).title, side_name(arm)),
         [i, text_of](const Rung& r) { return text_of(r.arms[i]); })
        .add_to(columns);
  }
}

Table ladder_table(const std::vector<Rung>& rungs) {
  auto columns =
      columns_of<Rung>(text("method", "Way to find the time of impact.", &Rung::method),
                       text("precision", "Floating-point type the kernels ran in.", its_precision),
                       text("pairs", "With a ball, three pairs; or two boxes, which have no radius.", its_pairs),
                       value("nanoseconds", "ns", "A query; median over pairs and places.", &Rung::nanoseconds));
  add_arms(columns, break_text);
  return in_report(timing(table(
      "ladder",
      "The first value of each axis at which a method breaks, and why: a verdict wrong by more than 4 u, an error of the "
      "time of more than 100 u kappa t, no number, or out of budget; a dash where it survives the whole axis. Run time "
      "beside it. The textbook forms are foils.",
      columns, rungs)));
}

Table ladder_test_table(const std::vector<LadderTest>& tests) {
  using T = LadderTest;
  const auto finite = [](double x) { return std::isfinite(x) ? std::optional(x) : std::nullopt; };
  const auto columns = columns_of<T>(
      text("what", "What theory says something about; docs/extremes.md has the units.", &T::what),
      text("precision", "Floating-point type.", its_precision),
      value("cells", "1", "Cells it is held against.", &T::cells),
      value("measured", "1", "The worst of them; missing: there is none.",
            [=](const T& t) { return finite(t.measured); }),
      value("least", "1", "Least allowed.", &T::least),
      value("most", "1", "Most allowed; missing: no bound.", [=](const T& t) { return finite(t.most); }),
      text("where", "The worst cell.", &T::where), value("passed", "", "Within what is allowed.", &T::passed));
  return in_report(
      table("self_test",
            "The contract of the closed form, and the theory of the textbook's loss between two balls, by precision.",
            columns, tests));
}

/// By arm and precision.
Table breaks_table(const std::vector<Rung>& rungs) {
  using S = Survival;
  std::vector<S> breaks;
  for (const Rung& rung : rungs) std::ranges::copy_if(rung.arms, std::back_inserter(breaks), &S::is_asked);
  std::ranges::stable_sort(breaks, {}, [](const S& s) { return std::pair(s.arm, s.precision); });
  const auto columns =
      columns_of<S>(text("axis", "What is extreme.", [](const S& s) { return info(s.arm->axis).name; }),
                    text("side", "Towards greater or lesser values.", [](const S& s) { return side_name(*s.arm); }),
                    text("precision", "Floating-point type.", its_precision),
                    text("method", "Way to find the time of impact; textbook is a foil.", &S::method),
                    text("pairs", "With a ball, three pairs; or two boxes.", its_pairs),
                    value("survived", "1", "Last value before the first break; missing: none.", &S::survived),
                    value("broken", "1", "First value at which it breaks; missing: none.", &S::broken),
                    text("why", "A wrong verdict, an error, nan or gave_up.",
                         [](const S& s) { return s.broken ? name(s.flaw) : ""; }),
                    text("pair", "On which shapes.", &S::pair));
  return table("breaks", "How far each method gets along each axis, on the pairs that every method is asked.", columns,
               breaks);
}

Columns<Row> key_columns() {
  return columns_of<Row>(text("pair", "The two shapes.", [](const Row& r) { return r.pair->name; }),
                         text("precision", "Floating-point type the kernels ran in.", its_precision),
                         text("axis", "What is extreme.", [](const Row& r) { return info(r.place.axis).name; }),
                         value("value", "1", "How extreme: of lengths in sizes of the pair, R.",
                               [](const Row& r) { return r.place.value; }),
                         text("method", "Way to find the time of impact; textbook is a foil.",
                              [](const Row& r) { return r.tally.method; }));
}

Table cells_table(const std::vector<Row>& asked) {
  const auto columns =
      columns_of<Row>(
          key_columns(), fields(&Row::tally),
          where([](const Row& r) { return r.tally.timed > 0; },
                fields(&Row::tally, {"forward_median", "forward_max", "backward_median", "backward_max"})),
          where([](const Row& r) { return r.tally.loss_max > 0; }, fields(&Row::tally, {"loss_rms", "loss_max"})))
          .without({"nanoseconds"});
  return table("cells", "Every method on every pair, in every precision, at every value of every axis.", columns,
               asked);
}

Table timings_table(const std::vector<Row>& asked) {
  return timing(table("timings",
                      "Time a query on this machine: the median over up to nine passes of the cell's queries.",
                      columns_of<Row>(key_columns(), fields(&Row::tally, {"nanoseconds"})), asked));
}

// What the pictures show: heat maps over all places, whose columns are the values of all axes, side by side.

/// A class of values and its color.
struct HeatBin {
  std::string label, color;  ///< the color as #rrggbb
};

/// What is seen of all that the rows of a cell add up to: a bin, or nothing, which leaves it white.
struct Look {
  std::vector<HeatBin> bins;
  std::function<std::optional<std::size_t>(const Tally&)> bin_of;
};

/// The first bin whose upper limit is not below x; the last has none.
std::size_t bin_of(double x, const std::vector<double>& limits) {
  return static_cast<std::size_t>(std::ranges::lower_bound(limits, x) - limits.begin());
}

// The bins of a share, and of an error: each is darker than the one before, so that the order holds in gray.

Look share_look(std::int64_t Tally::*part) {
  return {{{"none", "#e6eef6"},
           {"up to 1 %", "#f2b36b"},
           {"up to 10 %", "#e77a44"},
           {"up to half", "#d7301f"},
           {"more", "#7f0000"}},
          [part](const Tally& t) -> std::optional<std::size_t> {
            if (t.queries == 0) return {};
            return bin_of(static_cast<double>(t.*part) / static_cast<double>(t.queries), {0, 0.01, 0.1, 0.5});
          }};
}
Look error_look(double Tally::*error) {
  return {{{"up to 1", "#e6eef6"},
           {"up to 4", "#b4d6ee"},
           {"up to 100", "#eaa838"},
           {"up to 1e4", "#dc741a"},
           {"up to 1e8", "#b43f0a"},
           {"more than 1e8", "#571c06"}},
          [error](const Tally& t) -> std::optional<std::size_t> {
            if (t.timed == 0) return {};
            return bin_of(t.*error, {1, 4, 100, 1e4, 1e8});
          }};
}
const Look silence_look = {{{"all answered", "#e6eef6"},
                            {"gave up, up to 10 %", "#9e9ac8"},
                            {"gave up, more", "#54278f"},
                            {"NaN or invalid, up to 10 %", "#f5c48a"},
                            {"NaN or invalid, more", "#d95f02"}},
                           [](const Tally& t) -> std::optional<std::size_t> {
                             if (t.queries == 0) return {};
                             if (t.invalid > 0) return 10 * t.invalid > t.queries ? 4 : 3;
                             if (t.gave_up > 0) return 10 * t.gave_up > t.queries ? 2 : 1;
                             return 0;
                           }};

/// The leading digits, `times`, and the power of ten; the number itself in [least, most).
std::string power_text(double x, std::string_view times, double least, double most) {
  if (least <= x && x < most) return rounded_text(x, 2);
  const double power = std::floor(std::log10(x) + 1e-9);
  return fmt::format("{}{}{:.0f}", rounded_text(x / std::pow(10, power), 2), times, power);
}

/// A heat row for all rows that `label_of` calls alike. The columns of an axis are one apart, and two from those of the next.
Panel heat_panel(const std::string& title, const std::vector<Place>& places, const std::vector<Row>& rows,
                 const auto& label_of, const Look& look, bool names_axes) {
  constexpr double row_height = 22.0 / 360;  // [1] of a panel of height 1
  const std::vector<Group<Row>> heat_rows = group_by(rows, label_of);
  Panel panel = {.x_label = "value on the axis named above, all others as usual [1]",
                 .y_label = title,
                 .height = row_height * (static_cast<double>(heat_rows.size()) + 0.4)};
  double column = 0;
  for (const Group<Place>& axis : group_by(places, &Place::axis)) {
    const double middle = column + static_cast<double>(axis.size() + 1) / 2;
    if (names_axes) panel.x_groups.push_back({middle, std::string(info(axis[0]->axis).title)});
    for (const Place* place : axis) panel.x_tics.push_back({++column, power_text(place->value, "e", 0.05, 50)});
    ++column;
  }
  for (const HeatBin& bin : look.bins)
    panel.series.push_back({.label = bin.label, .mark = Mark::cells, .color = bin.color});
  for (const Group<Row>& heat_row : heat_rows) {
    const double y = static_cast<double>(heat_rows.size() - panel.y_tics.size());
    panel.y_tics.push_back({y, label_of(*heat_row[0])});
    std::vector<Tally> sums(places.size());
    for (const Row* row : heat_row)
      sums[static_cast<std::size_t>(std::ranges::find(places, row->place) - places.begin())] += row->tally;
    for (std::size_t j = 0; j < places.size(); ++j) {
      const std::optional<std::size_t> bin = look.bin_of(sums[j]);
      if (bin) panel.series[*bin].add(panel.x_tics[j].at, y);
    }
  }
  return panel;
}

/// A panel a precision, of the rows that `is_its` and that were asked there.
std::vector<Panel> heat_panels(const std::vector<Row>& rows, const Look& look, const auto& is_its,
                               const auto& label_of) {
  std::vector<Panel> panels;
  for (const std::size_t p : precisions_of(rows)) {
    const std::vector<Row> asked =
        only(rows, [&](const Row& row) { return row.precision == p && row.tally.queries > 0 && is_its(row); });
    if (!asked.empty())
      panels.push_back(heat_panel(title_of(p), places_of(rows), asked, label_of, look, panels.empty()));
  }
  return panels;
}

/// What rounding the input changes, whatever the method: a row a precision.
Figure changed_by_rounding(std::vector<Row> rows) {
  const std::vector<Place> places = places_of(rows);
  std::ranges::stable_sort(rows, {}, &Row::precision);
  const auto label_of = [](const Row& row) { return title_of(row.precision); };
  return {
      "representation",
      "Verdicts that rounding the input alone changes",
      "Share of the queries, drawn in doubles, whose true answer is another one once they are rounded to the precision. "
      "No method is at fault: every method is judged by the answer to the rounded query.",
      {heat_panel("precision", places, rows, label_of, share_look(&Tally::changed), true)}};
}

/// The foil's loss between two balls, with u (d/R)^2 / 2.
Figure loss_figure(const std::vector<Row>& rows) {
  std::vector<Row> drawn;
  for (const std::size_t p : precisions_of(rows)) {
    for (const std::string_view method : {"textbook", "closed_form"}) {
      for (const Row& row : two_balls(rows, method, p)) {
        if (row.place.value >= 10 && row.tally.timed > 0) drawn.push_back(row);
      }
    }
  }
  const auto unit = [](const Row& r) { return all_precisions()[r.precision].unit * r.place.value * r.place.value / 2; };
  const auto columns = columns_of<Row>(
      text("who", "", [](const Row& r) { return fmt::format("{} {}", r.tally.method, title_of(r.precision)); }),
      value("distance", "1", "", [](const Row& r) { return r.place.value; }),
      where([](const Row& r) { return r.tally.loss_rms != 0; },
            value("loss", "1", "", [=](const Row& r) { return r.tally.loss_rms * unit(r); })),
      where([](const Row& r) { return r.tally.method == "textbook"; }, value("theory", "1", "", unit)));
  return {
      "textbook_loss",
      "What the textbook's quadratic loses between two balls",
      "Root mean square of the error of the place of contact along the normal, over the radius, where it finds one. The "
      "lines are u (d/R)^2 / 2, one a precision; points leave them where verdicts go wrong, at d/R = 1/sqrt(u). The "
      "closed form's stay at u d/R, whose slope is half.",
      {plot(columns, drawn)
           .x("distance", Axis::log, "distance / R [1]")
           .y("loss", Axis::log, "error along the normal / R [1]")
           .by("who")
           .through("theory", "theory")}};
}

std::vector<Figure> figures_of(const std::vector<Row>& rows) {
  const std::string columns =
      " Columns are the values of seven axes, one extreme at a time; rows are methods. White: not asked, as the precision "
      "cannot hold the query or the axis does not concern the pair.";
  const std::string balls = " Three pairs with a ball, together." + columns,
                    boxes = " Two boxes, which have no radius to give them a normal where they touch." + columns;
  const std::string wrong = "Share of the queries whose verdict is wrong by more than 4 u of its input.",
                    contract = "The contract of the closed form is 4.", timed = " White, too: no hit to time.";
  const Look verdict = share_look(&Tally::far_wrong), forward = error_look(&Tally::forward_max);
  const auto of_methods = [&](const Look& look, PairSet pairs) {
    const auto is_its = [pairs](const Row& row) { return is_in(*row.pair, pairs); };
    return heat_panels(rows, look, is_its, [](const Row& row) {
      return row.tally.method + (row.tally.method == "textbook" ? " (foil)" : "");
    });
  };
  const auto is_closed_form = [](const Row& row) { return row.tally.method == "closed_form"; };
  std::vector<Figure> figures = {
      {"verdicts", "Wrong verdicts, by more than 4 u", wrong + balls, of_methods(verdict, PairSet::rounded)},
      {"forward", "Largest forward error of the time of a hit [u kappa t]", contract + balls + timed,
       of_methods(forward, PairSet::rounded)},
      {"backward", "Largest backward error of a hit [u]", contract + balls + timed,
       of_methods(error_look(&Tally::backward_max), PairSet::rounded)},
      {"no_answer", "NaN, invalid, and gave up", "Of all four pairs. Where both occur, the NaN is shown." + columns,
       of_methods(silence_look, PairSet::four)},
      {"verdicts_boxes", "Two boxes: wrong verdicts, by more than 4 u", wrong + boxes,
       of_methods(verdict, PairSet::boxes)},
      {"forward_boxes", "Two boxes: largest forward error of the time of a hit [u kappa t]", contract + boxes + timed,
       of_methods(forward, PairSet::boxes)},
      {"closed_form_pairs", "The closed form on every pair: largest forward error [u kappa t]",
       "A row is a pair of shapes. White: no hit to time, or a value that does not concern the pair, or that the "
       "precision cannot hold.",
       heat_panels(rows, forward, is_closed_form, [](const Row& row) { return std::string(row.pair->name); })}};
  if (!rows.empty()) figures.push_back(changed_by_rounding(rows));
  figures.push_back(loss_figure(rows));
  return only_measured(std::move(figures));
}

// What it says.

/// 0.1, 30, 10^8, 3 x 10^-7.
std::string spoken(double x) {
  const std::string text = power_text(x, " x 10^", 0.1, 1000);
  return text.starts_with("1 x ") ? text.substr(4) : text;
}

std::string in_precision(std::size_t precision) {
  return fmt::format("{} {}", all_precisions()[precision].is_wide ? "at" : "in", title_of(precision));
}

std::string closed_form_answer(const std::vector<Row>& rows, const std::vector<LadderTest>& tests) {
  std::optional<double> forward;
  for (const LadderTest& t : tests) {
    if (t.what.starts_with("closed_form_forward")) forward = std::max(forward.value_or(0), t.measured);
  }
  if (!forward) return "";
  std::vector<std::string> breaks;
  bool is_on_ladder = false;
  for (const std::size_t p : precisions_of(rows)) {
    std::vector<std::string> places;
    for (const Arm& arm : all_arms()) {
      const Survival s = survival(rows, arm, {"closed_form", p});
      is_on_ladder |= s.is_asked();
      const AxisInfo& axis = info(arm.axis);
      const char* unit = axis.allowed.unit == "R" ? " R" : "";
      if (s.broken) places.push_back(fmt::format("{} {}{}", axis.name, spoken(*s.broken), unit));
    }
    if (!places.empty()) breaks.push_back(fmt::format("{} at {}", in_precision(p), listed(places)));
  }
  return fmt::format(
      "Where contact lasts long enough for a time to name it, the closed form is off by at most {:.2f} times what rounding "
      "its input changes{}. ",
      *forward,
      !is_on_ladder    ? ""
      : breaks.empty() ? ", and it breaks nowhere"
                       : ", and it breaks " + fmt::format("{}", fmt::join(breaks, ", ")));
}

/// Between two balls, along the distance: where the foil's verdicts first go wrong.
std::string foil_answer(const std::vector<Row>& rows) {
  std::vector<std::string> parts;
  for (const std::size_t p : precisions_of(rows)) {
    const std::vector<Row> asked = two_balls(rows, "textbook", p);
    if (asked.empty()) continue;
    const auto first = std::ranges::find_if(asked, [](const Row& row) { return row.tally.far_wrong > 0; });
    parts.push_back(first == asked.end()
                        ? "at no distance "
                        : fmt::format("from {} R {}", spoken(first->place.value), parts.empty() ? "apart " : ""));
    parts.back() += in_precision(p);
  }
  return parts.empty() ? "" : fmt::format("The textbook's formula gets two balls wrong {}. ", listed(parts));
}

/// The others' breaks are the ladder's.
std::string answer_of(const std::vector<Row>& rows, const std::vector<LadderTest>& tests) {
  std::string text = closed_form_answer(rows, tests) + foil_answer(rows);
  if (text.empty()) return "Neither the closed form nor the textbook's formula was asked: see the ladder.";
  text.pop_back();  // the space between sentences
  return text;
}

/// A row a method; the names of those that break at once stand above.
std::string ladder_text(const std::vector<Rung>& rungs, std::size_t precision, PairSet pairs) {
  const auto its = only(rungs, [&](const Rung& r) { return r.precision == precision && r.pairs == pairs; });
  if (its.empty()) return "";
  std::vector<std::string_view> at_once;
  for (const Rung& rung : only(its, &Rung::breaks_at_once)) at_once.push_back(rung.method);
  auto columns = columns_of<Rung>(text("method", "", &Rung::method),
                                  text("ns", "", [](const Rung& r) { return rounded_text(r.nanoseconds, 3); }));
  add_arms(columns, short_break_text);
  const std::string title = fmt::format("{}, {}. At once: {}.", title_of(precision), pairs_name(pairs),
                                        at_once.empty() ? "none" : fmt::format("{}", fmt::join(at_once, ", ")));
  const auto shown = only(its, std::not_fn(&Rung::breaks_at_once));
  return (shown.empty() ? wrapped(title) : terminal(table("ladder", title, columns, shown))) + "\n";
}

std::string summary_of(const std::vector<Row>& rows, const std::vector<Rung>& rungs,
                       const std::vector<LadderTest>& tests) {
  std::string text;
  for (const PairSet pairs : {PairSet::rounded, PairSet::boxes}) {
    for (const std::size_t p : precisions_of(rows)) text += ladder_text(rungs, p, pairs);
  }
  if (!text.empty()) {
    text +=
        wrapped(
            "The power of ten at which each first breaks, and why: v a verdict wrong by more than 4 u, e a time off by more "
            "than 100 u kappa t, n no number, g gave up; all: at the first value; ok: it does not.\n"
            "Small, large: scale. Far, offset: over R. Slow, fast: speed / R. Graze: 1 - b/R. Unequal: sizes. Textbook is a "
            "foil. At once: the methods that break at most first values; they claim less.") +
        "\n";
  }
  const auto failed = only(tests, std::not_fn(&LadderTest::passed));
  return text + fmt::format("Self-test: {} of {} passed.\n", tests.size() - failed.size(), tests.size()) +
         (failed.empty() ? "" : terminal(ladder_test_table(failed)));
}

Outcome outcome_of(const std::vector<Row>& rows) {
  const std::vector<LadderTest> tests = ladder_tests(rows);
  const std::vector<Rung> rungs = rungs_of(rows);
  std::vector<Row> asked = rows;
  std::erase_if(asked, [](const Row& row) { return row.tally.queries == 0; });
  return {.answer = answer_of(rows, tests),
          .summary = summary_of(rows, rungs, tests),
          .tables = {ladder_table(rungs), ladder_test_table(tests), breaks_table(rungs), cells_table(asked),
                     timings_table(asked)},
          .figures = figures_of(rows),
          .sections = {},
          .self_test_passed = all_passed(tests)};
}

std::unique_ptr<Run> configure(const Settings& settings, const RunOptions& options) {
  std::vector<std::string_view> pair_names, precision_names;
  for (const ExtremePair& pair : extreme_pairs()) pair_names.push_back(pair.name);
  for (const Precision& precision : all_precisions()) precision_names.push_back(precision.name);
  const std::vector<std::string> pairs = settings.choices_or_all("pair", pair_names);
  const std::vector<std::string> precisions = settings.choices_or_all("precision", precision_names);
  const std::vector<std::string> methods = settings.choices_or_all("method", extreme_method_names());
  const std::int64_t queries = settings.trials("queries", 1, 1 << 20, options.trials);
  const std::int64_t one_in = settings.integer("one_in_at_50_digits", 1, 1 << 20);
  const double tolerance = settings.number("tolerance", {.lower = 1, .upper = 1e6, .unit = "epsilon"});
  const std::vector<Place> places = make_places(settings);
  if (places.size() * pairs.size() * precisions.size() > most_cells) {
    settings.complain(
        "axis", fmt::format("fewer: {} values on these axes, for {} pairs and {} precisions, make more than {} cells",
                            places.size(), pairs.size(), precisions.size(), most_cells));
  }

  std::vector<Row> cells;  // a pair and a precision at a place: one unit, on all methods
  std::vector<Task<std::vector<Tally>>> tasks;
  const auto has = [](const auto& names, std::string_view name) {
    return std::ranges::find(names, name) != names.end();
  };
  for (const ExtremePair& pair : extreme_pairs()) {
    for (std::size_t p = 0; p < precision_count; ++p) {
      const Precision& precision = all_precisions()[p];
      if (!has(pairs, pair.name) || !has(precisions, precision.name) || pair.ask[p] == nullptr) continue;
      const std::int64_t count = precision.is_wide ? (queries + one_in - 1) / one_in : queries;
      for (const Place& place : places) {
        if (place.axis == ExtremeAxis::thickness && !pair.has_box) continue;
        const ExtremeInquiry inquiry = {place, count, options.seed, methods, tolerance};
        cells.push_back({&pair, p, place, {}});
        tasks.push_back(
            {fmt::format("{} {} {} {}", pair.name, precision.name, info(place.axis).name, exact_text(place.value)),
             count, [ask = pair.ask[p], inquiry] { return ask(inquiry); }});
      }
    }
  }
  if (cells.empty()) {
    settings.complain("precision", "\"float\" or \"double\" too: the pairs that are chosen are asked in no other");
  }
  const auto finish = [cells](const Done<std::vector<Tally>>& done) {
    std::vector<Row> rows;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      for (const Tally& tally : done.results[i])
        rows.push_back({cells[i].pair, cells[i].precision, cells[i].place, tally});
    }
    return outcome_of(rows);
  };
  return make_run(finish, std::move(tasks));
}

}  // namespace

Experiment extremes_experiment() {
  return {
      "extremes",
      "At which scale, distance, speed, thickness, offset, angle or size ratio does each way to find a time of impact break, "
      "in float, double, long double and at 50 digits?",
      embedded_toml("extremes"), configure};
}

}  // namespace thinwall
