/// Where does each way to find a time of impact break, at which scale, distance, speed, thickness, offset, angle or size ratio, and
/// in which precision? See docs/extremes.md.
#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/extremes/model.hpp>
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

/// "long double", "50 digits".
std::string title_of(Precision precision) { return spaced(std::string(name(precision))); }

/// How far a contender gets along each arm, of those on pairs that every method is asked.
struct Rung : ExtremeContender {
  double nanoseconds;          ///< a query: the median over pairs and places
  std::vector<Survival> arms;  ///< in the order of all_arms

  /// On most arms, at their first value, where little or nothing is extreme.
  bool breaks_at_once() const {
    const auto at_once = [](const Survival& s) { return s.broken && !s.survived; };
    return 2 * std::ranges::count_if(arms, at_once) > std::ranges::count_if(arms, &Survival::is_asked);
  }
};

std::vector<Rung> rungs_of(const std::vector<Row>& rows) {
  std::vector<Rung> rungs;
  for (const std::string_view method : extreme_method_names()) {
    for (const Precision precision : all_precisions) {
      for (const PairSet set : {PairSet::rounded, PairSet::boxes}) {
        const auto its = only(rows, [&](const Row& row) {
          return row.tally.method == method && row.precision == precision && row.pair->set == set;
        });
        if (its.empty()) continue;
        std::vector<double> times;
        for (const Row& row : its) times.push_back(row.tally.nanoseconds);
        Rung& rung = rungs.emplace_back(Rung{{std::string(method), precision, set}, median(times), {}});
        for (const Arm& arm : all_arms) rung.arms.push_back(survival(its, arm, rung));
      }
    }
  }
  return rungs;
}

// What the tables show.

/// "1e+08 verdict", "-" where it survives, empty where it was not asked.
std::string break_text(const Survival& s) {
  if (!s.broken) return s.survived ? "-" : "";
  return fmt::format("{} {}", rounded_text(*s.broken, 3), name(*s.flaw));
}

/// The power of ten and what is wrong: "4v", "-10e"; "all e" where it breaks at the first value, "ok" where it survives.
std::string short_break_text(const Survival& s) {
  if (!s.broken) return s.survived ? "ok" : "";
  return fmt::format("{}{}", s.survived ? fmt::format("{:.0f}", std::log10(*s.broken)) : "all ", name(*s.flaw)[0]);
}

/// A column an arm.
template <class Text> void add_arms(Columns<Rung>& columns, const Text& text_of) {
  for (std::size_t i = 0; i < all_arms.size(); ++i) {
    const Arm& arm = all_arms[i];
    text(std::string(arm.name),
         fmt::format("First break along {}, towards {} values.", info(arm.axis).title, arm.side_name()),
         [i, text_of](const Rung& r) { return text_of(r.arms[i]); })
        .add_to(columns);
  }
}

Table ladder_table(const std::vector<Rung>& rungs) {
  auto columns =
      columns_of<Rung>(text("method", "Way to find the time of impact.", &Rung::method),
                       text("precision", "Floating-point type the kernels ran in.", &Rung::precision),
                       text("pairs", "With a ball, three pairs; or two boxes, which have no radius.", &Rung::pairs),
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
  const auto finite = [](double T::*part) {
    return [part](const T& t) { return std::isfinite(t.*part) ? std::optional(t.*part) : std::nullopt; };
  };
  return in_report(
      table("self_test",
            "The contract of the closed form, and the theory of the textbook's loss between two balls, by precision.",
            tests, text("what", "What theory says something about; docs/extremes.md has the units.", &T::what),
            text("precision", "Floating-point type.", &T::precision),
            value("cells", "1", "Cells it is held against.", &T::cells),
            value("measured", "1", "The worst of them; missing: there is none.", finite(&T::measured)),
            value("least", "1", "Least allowed.", &T::least),
            value("most", "1", "Most allowed; missing: no bound.", finite(&T::most)),
            text("where", "The worst cell.", &T::where), value("passed", "", "Within what is allowed.", &T::passed)));
}

/// By arm and precision.
Table breaks_table(const std::vector<Rung>& rungs) {
  using S = Survival;
  std::vector<S> breaks;
  for (const Rung& rung : rungs) std::ranges::copy_if(rung.arms, std::back_inserter(breaks), &S::is_asked);
  std::ranges::stable_sort(breaks, {}, [](const S& s) { return std::pair(s.arm, s.precision); });
  return table("breaks", "How far each method gets along each axis, on the pairs that every method is asked.", breaks,
               text("axis", "What is extreme.", [](const S& s) { return info(s.arm->axis).name; }),
               text("side", "Towards greater or lesser values.", [](const S& s) { return s.arm->side_name(); }),
               text("precision", "Floating-point type.", &S::precision),
               text("method", "Way to find the time of impact; textbook is a foil.", &S::method),
               text("pairs", "With a ball, three pairs; or two boxes.", &S::pairs),
               value("survived", "1", "Last value before the first break; missing: none.", &S::survived),
               value("broken", "1", "First value at which it breaks; missing: none.", &S::broken),
               text("why", "A wrong verdict, an error, nan or gave_up.", &S::flaw),
               text("pair", "On which shapes.", &S::pair));
}

Columns<Row> key_columns() {
  return columns_of<Row>(text("pair", "The two shapes.", [](const Row& r) { return r.pair->name; }),
                         text("precision", "Floating-point type the kernels ran in.", &Row::precision),
                         text("axis", "What is extreme.", [](const Row& r) { return info(r.place.axis).name; }),
                         value("value", "1", "How extreme: of lengths in sizes of the pair, R.",
                               [](const Row& r) { return r.place.value; }),
                         fields(&Row::tally, {"method"}));
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

/// The color of all values up to a limit.
struct HeatBin {
  std::string label, color;  ///< the color as #rrggbb
  double most = std::numeric_limits<double>::infinity();
};

/// What is seen of all that the rows of a cell add up to: nothing leaves it white.
struct Look {
  std::vector<HeatBin> bins;  ///< each darker than the one before, so that the order holds in gray
  std::function<std::optional<double>(const Tally&)> measure;
};

Look share_look(std::int64_t Tally::*part) {
  return {{{"none", "#e6eef6", 0},
           {"up to 1 %", "#f2b36b", 0.01},
           {"up to 10 %", "#e77a44", 0.1},
           {"up to half", "#d7301f", 0.5},
           {"more", "#7f0000"}},
          [part](const Tally& t) { return share_of(t.*part, t.queries); }};
}
Look error_look(double Tally::*error) {
  return {{{"up to 1", "#e6eef6", 1},
           {"up to 4", "#b4d6ee", 4},
           {"up to 100", "#eaa838", 100},
           {"up to 1e4", "#dc741a", 1e4},
           {"up to 1e8", "#b43f0a", 1e8},
           {"more than 1e8", "#571c06"}},
          [error](const Tally& t) { return t.timed > 0 ? std::optional(t.*error) : std::nullopt; }};
}
/// The share that gave up; where anything is no number, 1 more than the share of those.
Look silence_look() {
  return {{{"all answered", "#e6eef6", 0},
           {"gave up, up to 10 %", "#9e9ac8", 0.1},
           {"gave up, more", "#54278f", 1},
           {"NaN or invalid, up to 10 %", "#f5c48a", 1.1},
           {"NaN or invalid, more", "#d95f02"}},
          [](const Tally& t) { return share_of(t.invalid > 0 ? t.queries + t.invalid : t.gave_up, t.queries); }};
}

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
    std::map<Place, Tally> sums;
    for (const Row* row : heat_row) sums[row->place] += row->tally;
    for (std::size_t j = 0; j < places.size(); ++j) {
      const std::optional<double> measure = look.measure(sums[places[j]]);
      if (!measure) continue;
      const auto bin = std::ranges::lower_bound(look.bins, *measure, {}, &HeatBin::most) - look.bins.begin();
      panel.series[static_cast<std::size_t>(bin)].add(panel.x_tics[j].at, y);
    }
  }
  return panel;
}

/// A panel a precision.
std::vector<Panel> heat_panels(const std::vector<Row>& rows, const std::vector<Place>& places, const Look& look,
                               const auto& label_of) {
  std::vector<Panel> panels;
  for (const Precision precision : all_precisions) {
    const auto its = only(rows, [&](const Row& row) { return row.precision == precision; });
    if (its.empty()) continue;
    panels.push_back(heat_panel(title_of(precision), places, its, label_of, look, panels.empty()));
  }
  return panels;
}

/// The foil's loss between two balls, with u (d/R)^2 / 2.
Figure loss_figure(const std::vector<Row>& rows) {
  std::vector<Row> drawn;
  for (const Precision precision : all_precisions) {
    for (const std::string_view method : {"textbook", "closed_form"}) {
      for (const Row& row : two_balls(rows, method, precision)) {
        if (row.place.value >= 10 && row.tally.timed > 0) drawn.push_back(row);
      }
    }
  }
  const auto unit = [](const Row& r) { return unit_of(r.precision) * r.place.value * r.place.value / 2; };
  return {
      "textbook_loss",
      "What the textbook's quadratic loses between two balls",
      "Root mean square of the error of the place of contact along the normal, over the radius, where it finds one. The "
      "lines are u (d/R)^2 / 2, one a precision; points leave them where verdicts go wrong, at d/R = 1/sqrt(u). The "
      "closed form's stay at u d/R, whose slope is half.",
      {plot(drawn,
            text("who", "", [](const Row& r) { return fmt::format("{}, {}", title_of(r.precision), r.tally.method); }),
            value("distance", "1", "", [](const Row& r) { return r.place.value; }),
            where([](const Row& r) { return r.tally.loss_rms != 0; },
                  value("loss", "1", "", [=](const Row& r) { return r.tally.loss_rms * unit(r); })),
            where([](const Row& r) { return r.tally.method == "textbook"; }, value("theory", "1", "", unit)))
           .x("distance", Axis::log, "distance / R [1]")
           .y("loss", Axis::log, "error along the normal / R [1]")
           .by("who")
           .through("theory", "theory")}};
}

/// `all` are the rows and those for which the precision can hold no query.
std::vector<Figure> figures_of(const std::vector<Row>& all, const std::vector<Row>& rows) {
  std::vector<Place> places = distinct(all, &Row::place);
  std::ranges::sort(places);
  const std::string columns =
      " Columns are the values of seven axes, one extreme at a time; rows are methods. White: not asked, as the precision "
      "cannot hold the query or the axis does not concern the pair.";
  const std::string balls = " Three pairs with a ball, together." + columns,
                    boxes = " Two boxes, which have no radius to give them a normal where they touch." + columns;
  const std::string wrong = "Share of the queries whose verdict is wrong by more than 4 u of its input.",
                    contract = "The contract of the closed form is 4.", timed = " White, too: no hit to time.";
  const Look verdict = share_look(&Tally::far_wrong), forward = error_look(&Tally::forward_max);
  const auto with_ball = only(rows, [](const Row& row) { return row.pair->set == PairSet::rounded; });
  const auto two_boxes = only(rows, [](const Row& row) { return row.pair->set == PairSet::boxes; });
  const auto all_four = only(rows, [](const Row& row) { return row.pair->set != PairSet::closed_form_alone; });
  const auto closed_form = only(rows, [](const Row& row) { return row.tally.method == "closed_form"; });
  const auto panels = [&](const std::vector<Row>& of, const Look& look) {
    return heat_panels(of, places, look, [](const Row& row) {
      return row.tally.method + (row.tally.method == "textbook" ? " (foil)" : "");
    });
  };
  return only_measured(
      {{"verdicts", "Wrong verdicts, by more than 4 u", wrong + balls, panels(with_ball, verdict)},
       {"forward", "Largest forward error of the time of a hit [u kappa t]", contract + balls + timed,
        panels(with_ball, forward)},
       {"backward", "Largest backward error of a hit [u]", contract + balls + timed,
        panels(with_ball, error_look(&Tally::backward_max))},
       {"no_answer", "NaN, invalid, and gave up", "Of all four pairs. Where both occur, the NaN is shown." + columns,
        panels(all_four, silence_look())},
       {"verdicts_boxes", "Two boxes: wrong verdicts, by more than 4 u", wrong + boxes, panels(two_boxes, verdict)},
       {"forward_boxes", "Two boxes: largest forward error of the time of a hit [u kappa t]", contract + boxes + timed,
        panels(two_boxes, forward)},
       {"closed_form_pairs", "The closed form on every pair: largest forward error [u kappa t]",
        "A row is a pair of shapes. White: no hit to time, or a value that does not concern the pair, or that the "
        "precision cannot hold.",
        heat_panels(closed_form, places, forward, [](const Row& row) { return std::string(row.pair->name); })},
       {"representation",
        "Verdicts that rounding the input alone changes",
        "Share of the queries, drawn in doubles, whose true answer is another one once they are rounded to the precision. "
        "No method is at fault: every method is judged by the answer to the rounded query.",
        {heat_panel(
            "precision", places, all, [](const Row& row) { return title_of(row.precision); },
            share_look(&Tally::changed), true)}},
       loss_figure(rows)});
}

// What it says.

/// 0.1, 30, 10^8, 3 x 10^-7.
std::string spoken(double x) {
  const std::string text = power_text(x, " x 10^", 0.1, 1000);
  return text.starts_with("1 x ") ? text.substr(4) : text;
}

std::string in_precision(Precision precision) {
  return fmt::format("{} {}", precision == Precision::at_50_digits ? "at" : "in", title_of(precision));
}

/// ", and it breaks in float at distance 10^7 R and thickness 10^-8": the first of each arm; nothing if it is on no arm.
std::string closed_form_breaks(const std::vector<Row>& rows) {
  const auto its = only(rows, [](const Row& row) {
    return row.tally.method == "closed_form" && row.pair->set != PairSet::closed_form_alone;
  });
  if (its.empty()) return "";
  std::vector<std::string> breaks;
  for (const Precision precision : all_precisions) {
    std::vector<std::string> places;
    for (const Arm& arm : all_arms) {
      const Survival s = survival(only(its, [&](const Row& row) { return row.precision == precision; }), arm);
      const AxisInfo& axis = info(arm.axis);
      const char* unit = axis.allowed.unit == "R" ? " R" : "";
      if (s.broken) places.push_back(fmt::format("{} {}{}", axis.name, spoken(*s.broken), unit));
    }
    if (!places.empty()) breaks.push_back(fmt::format("{} at {}", in_precision(precision), listed(places)));
  }
  return breaks.empty() ? ", and it breaks nowhere" : fmt::format(", and it breaks {}", fmt::join(breaks, ", "));
}

/// Between two balls, along the distance: where the foil's verdicts first go wrong.
std::string foil_answer(const std::vector<Row>& rows) {
  std::vector<std::string> parts;
  for (const Precision precision : all_precisions) {
    const std::vector<Row> asked = two_balls(rows, "textbook", precision);
    if (asked.empty()) continue;
    const auto first = std::ranges::find_if(asked, [](const Row& row) { return row.tally.far_wrong > 0; });
    parts.push_back(first == asked.end()
                        ? "at no distance "
                        : fmt::format("from {} R {}", spoken(first->place.value), parts.empty() ? "apart " : ""));
    parts.back() += in_precision(precision);
  }
  return parts.empty() ? "" : fmt::format("The textbook's formula gets two balls wrong {}. ", listed(parts));
}

/// The others' breaks are the ladder's.
std::string answer_of(const std::vector<Row>& rows, const std::vector<LadderTest>& tests) {
  std::string text;
  const auto forward = only(tests, [](const LadderTest& t) { return t.what.starts_with("closed_form_forward"); });
  if (!forward.empty()) {
    text = fmt::format(
        "Where contact lasts long enough for a time to name it, the closed form is off by at most {:.2f} times what rounding "
        "its input changes{}. ",
        std::ranges::max(forward, {}, &LadderTest::measured).measured, closed_form_breaks(rows));
  }
  text += foil_answer(rows);
  if (text.empty()) return "Neither the closed form nor the textbook's formula was asked: see the ladder.";
  text.pop_back();  // the space between sentences
  return text;
}

/// A row a method; the names of those that break at once stand above.
std::string ladder_text(const std::vector<Rung>& rungs) {
  const auto at_once = distinct(only(rungs, &Rung::breaks_at_once), &Rung::method);
  const auto shown = only(rungs, std::not_fn(&Rung::breaks_at_once));
  const std::string title = fmt::format("{}, {}. At once: {}.", title_of(rungs[0].precision), name(rungs[0].pairs),
                                        at_once.empty() ? "none" : fmt::format("{}", fmt::join(at_once, ", ")));
  auto columns = columns_of<Rung>(text("method", "", &Rung::method),
                                  text("ns", "", [](const Rung& r) { return rounded_text(r.nanoseconds, 3); }));
  add_arms(columns, short_break_text);
  return (shown.empty() ? wrapped(title) : terminal(table("ladder", title, columns, shown))) + "\n";
}

std::string summary_of(const std::vector<Rung>& rungs, const std::vector<LadderTest>& tests) {
  std::string text;
  for (const PairSet pairs : {PairSet::rounded, PairSet::boxes}) {
    for (const Precision precision : all_precisions) {
      const auto its = only(rungs, [&](const Rung& r) { return r.precision == precision && r.pairs == pairs; });
      if (!its.empty()) text += ladder_text(its);
    }
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

Outcome outcome_of(const std::vector<Row>& all) {
  const std::vector<Row> rows = only(all, [](const Row& row) { return row.tally.queries > 0; });
  const std::vector<LadderTest> tests = ladder_tests(rows);
  const std::vector<Rung> rungs = rungs_of(rows);
  return {.answer = answer_of(rows, tests),
          .summary = summary_of(rungs, tests),
          .tables = {ladder_table(rungs), ladder_test_table(tests), breaks_table(rungs), cells_table(rows),
                     timings_table(rows)},
          .figures = figures_of(all, rows),
          .self_test_passed = all_passed(tests)};
}

std::unique_ptr<Run> configure(const Settings& settings, const RunOptions& options) {
  std::vector<std::string_view> precision_names;
  for (const Precision precision : all_precisions) precision_names.push_back(name(precision));
  const std::vector<std::string> pairs = settings.choices_or_all("pair", names_of(extreme_pairs()));
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
  for (const ExtremePair& pair : extreme_pairs()) {
    for (const Precision precision : all_precisions) {
      const AskExtreme ask = pair.asks[static_cast<std::size_t>(precision)];
      if (ask == nullptr || std::ranges::count(pairs, pair.name) == 0) continue;
      if (std::ranges::count(precisions, name(precision)) == 0) continue;
      const std::int64_t count = precision == Precision::at_50_digits ? (queries + one_in - 1) / one_in : queries;
      for (const Place& place : places) {
        if (place.axis == ExtremeAxis::thickness && !pair.has_box) continue;
        const ExtremeInquiry inquiry = {place, count, options.seed, methods, tolerance};
        cells.push_back({&pair, precision, place, {}});
        tasks.push_back(
            {fmt::format("{} {} {} {}", pair.name, name(precision), info(place.axis).name, exact_text(place.value)),
             count, [ask, inquiry] { return ask(inquiry); }});
      }
    }
  }
  if (cells.empty())
    settings.complain("precision", "\"float\" or \"double\" too: the pairs that are chosen are asked in no other");
  const auto finish = [cells](const Done<std::vector<Tally>>& done) {
    std::vector<Row> all;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      for (const Tally& tally : done.results[i])
        all.push_back({cells[i].pair, cells[i].precision, cells[i].place, tally});
    }
    return outcome_of(all);
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
