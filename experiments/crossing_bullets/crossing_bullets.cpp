/// Two fast bodies cross: how many false hits and how many misses come of sweeping both and testing, against the exact
/// relative motion? See docs/crossing_bullets.md.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include <thinwall/experiments/crossing_bullets/rules.hpp>
#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/lab/columns.hpp>
#include <thinwall/experiments/lab/plot.hpp>
#include <thinwall/experiments/lab/tasks.hpp>
#include <thinwall/experiments/lab/terminal.hpp>
#include <thinwall/experiments/lab/text.hpp>
#include <thinwall/swept/methods.hpp>
#include <thinwall_embedded.hpp>

namespace thinwall {

namespace {

using Row = CrossingRow;
using Tally = CrossingTally;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::string_view confirming = SweepThenConfirm<double>::name, exact = ClosedForm<double>::name;

bool confirms(const Row& row) { return row.rule == confirming; }
bool has_times(const Tally& tally) { return tally.lateness.count > 0; }

/// [m] How well double holds the gap of a cell: a few coordinates as large as the paths, the disc and the balls.
double resolution(const Crossing& c) {
  const double size = 2 * faster_path(c).norm() + (2 * c.offset + 2) * contact_distance(c);
  return 16 * std::numeric_limits<double>::epsilon() * size;
}

/// Of the true hits; nothing where no formula holds.
std::optional<double> missed_share_theory(const Row& row) {
  return row.expected.missed ? std::optional(*row.expected.missed / row.theory.touch) : std::nullopt;
}

/// Standard errors between the mean lateness and theory, where there are enough times.
std::optional<double> lateness_residual(const Row& row) {
  const RealSum& late = row.tally.lateness;
  const ConfirmedTheory& theory = row.theory.confirmed;
  if (!confirms(row) || late.count < 50 || theory.lateness_sigma <= 0) return std::nullopt;
  const double error = theory.lateness_sigma / std::sqrt(static_cast<double>(late.count));
  return (*late.mean() - theory.lateness_mean) / error;
}

// What the tables show.

Columns<Row> row_columns() {
  const auto apart = [](const Row& r) { return r.tally.apart() > 0; };
  const auto confirmed = [](double ConfirmedTheory::*field) {
    return [field](const Row& r) { return r.theory.confirmed.*field; };
  };
  return columns_of<Row>(
      text("rule", "How a hit is found.", &Row::rule), crossing_factors.columns(&Row::cell),
      value("relative_path", "m", "Length of the relative motion in a step.",
            [](const Row& r) { return relative_path(r.cell).norm(); }),
      fields(&Row::tally, {"shots", "touching"}),
      value("touching_theory", "1", "Expected number of them: shots / offset^2.",
            [](const Row& r) { return r.theory.touch * static_cast<double>(r.tally.shots); }),
      fields(&Row::tally, {"missed"}),
      share(
          "missed_share", "missed / touching; missing if nothing touches.", [](const Row& r) { return r.tally.missed; },
          [](const Row& r) { return r.tally.touching; }, "missed_"),
      value("missed_theory", "1", "Share of true hits missed, by theory; missing where no formula holds.",
            missed_share_theory),
      fields(&Row::tally, {"false_hits"}),
      where(apart, value("false_share", "1", "false_hits over the encounters that do not touch; missing if all do.",
                         [](const Row& r) { return share_of(r.tally.false_hits, r.tally.apart()); })),
      value("false_theory", "1", "The same by theory; missing where no formula holds or all touch.",
            [](const Row& r) -> std::optional<double> {
              if (!r.expected.false_hits || r.theory.touch >= 1) return std::nullopt;
              return *r.expected.false_hits / (1 - r.theory.touch);
            }),
      fields(&Row::tally, {"undecided", "evaluations"}),
      where(confirms, fields(&Row::tally, {"missed_beside", "missed_early", "missed_late", "missed_inside"})),
      value("lateness_mean", "step", "Mean time from first contact to the answer, of the true hits it sees.",
            [](const Row& r) { return r.tally.lateness.mean(); }),
      where(confirms, value("lateness_theory", "step", "The same by theory, of sweep_then_confirm.",
                            confirmed(&ConfirmedTheory::lateness_mean))),
      fields(&Row::tally, {"lateness_max", "lateness_min"}),
      where([](const Row& r) { return has_times(r.tally); }, fields(&Row::tally, {"gap_max"})));
}

/// A rule over all of its cells.
struct Total {
  std::string rule;
  Tally tally;
  double missed_theory = 0;                  ///< expected number of misses
  bool has_theory = true;                    ///< in every cell
  double least_missed = 1, most_missed = 0;  ///< [1] of the true hits, by theory, in the cell where that is so
  double seconds = 0;
};

std::vector<Total> totals_of(const std::vector<Row>& rows) {
  std::vector<Total> totals;
  for (const Group<Row>& group : group_by(rows, &Row::rule)) {
    Total& total = totals.emplace_back();
    total.rule = group[0]->rule;
    total.tally = total_of(group, &Row::tally);
    for (const Row* row : group) {
      total.seconds += row->seconds;
      const std::optional<double> share = missed_share_theory(*row);
      total.has_theory &= share.has_value();
      if (!share) continue;
      total.missed_theory += *row->expected.missed * static_cast<double>(row->tally.shots);
      total.least_missed = std::min(total.least_missed, *share);
      total.most_missed = std::max(total.most_missed, *share);
    }
  }
  return totals;
}

Table rules_table(const std::vector<Total>& totals) {
  return in_report(
      table("rules", "Each rule over all of its cells, every cell with the same number of encounters.", totals,
            text("rule", "How a hit is found.", &Total::rule), fields(&Total::tally, {"shots", "touching", "missed"}),
            where(&Total::has_theory,
                  columns_of<Total>(
                      value("missed_expected", "1", "By theory; missing where it has no formula for every cell.",
                            &Total::missed_theory),
                      value("missed_least", "1", "Share of true hits missed, by theory, in the cell where it is least.",
                            &Total::least_missed),
                      value("missed_most", "1", "The same where it is most.", &Total::most_missed))),
            fields(&Total::tally, {"false_hits", "lateness_max"})));
}

Table rule_timings_table(const std::vector<Total>& totals) {
  return timing(table("timings", "Time an encounter, on this machine, the threads of the run at work.", totals,
                      text("rule", "How a hit is found.", &Total::rule),
                      value("nanoseconds_per_shot", "ns", "Drawing and the exact motion included.",
                            [](const Total& t) { return 1e9 * t.seconds / static_cast<double>(t.tally.shots); })));
}

Table counts_test_table(const std::vector<SelfTest>& tests) {
  return self_test_table(tests,
                         "Counts of independent encounters against theory, over all cells of a rule and event at once.",
                         {"rule", "How a hit is found."}, {"event", "What is counted."});
}

Table timing_test_table(const std::vector<TimingTest>& tests) {
  using T = TimingTest;
  return in_report(table(
      "times", "Times of impact against what they can be, for the rules that claim that a hit is one.", tests,
      text("rule", "How a hit is found.", &T::rule), value("cells", "1", "Cells in which it gave a time.", &T::cells),
      value("apart", "1", "Of those, cells with a time at which the balls are apart; must be 0.", &T::apart),
      value("wrong_time", "1",
            "Cells with a time later than contact can last, for closed_form than it begins; must be 0.",
            &T::wrong_time),
      residual_columns("Cells whose mean lateness is held against theory.",
                       "Sum of squared standard residuals of the mean lateness.", &T::lateness),
      value("passed", "", "All of the above hold.", &T::passed)));
}

// What the pictures show: shares over the angle, a series for each ratio of speeds.

/// The same for a measurement and for theory.
struct Quantity {
  std::function<std::optional<Measured>(const Row&)> measured;
  std::function<double(const Crossing&)> theory;
};

std::vector<double> sorted_values(const std::vector<Row>& rows, double Crossing::*factor) {
  auto values = distinct(rows, [factor](const Row& row) { return row.cell.*factor; });
  std::ranges::sort(values);
  return values;
}

/// One curve a ratio over the angle, as one series with gaps.
Series theory_curves(const std::vector<Row>& rows, const Quantity& quantity) {
  constexpr double curve_step = 5, end_step = 2;  // [deg], finer within 10 degrees of the ends
  Series series = {.label = "theory", .mark = Mark::line};
  for (const double ratio : sorted_values(rows, &Crossing::ratio)) {
    Crossing c = rows.front().cell;
    c.ratio = ratio;
    double angle = ratio == 1 ? end_step : 0;
    while (angle <= 180) {
      c.angle_deg = ratio == 0 ? 0 : angle;
      series.add(angle, quantity.theory(c));
      angle += angle < 10 || angle >= 170 ? end_step : curve_step;
    }
    series.end_line();
  }
  return series;
}

/// Rows of one speed and offset. Of one ratio the marks are the same in every figure.
Panel panel(std::vector<Row> rows, std::string y_label, const Quantity& quantity) {
  std::ranges::stable_sort(rows, {}, [](const Row& r) { return r.cell.ratio; });
  Panel panel =
      plot(rows, value("angle", "", "", [](const Row& r) { return r.cell.angle_deg; }),
           text("ratio", "",
                [](const Row& r) {
                  return r.cell.ratio == 0 ? "slower ball at rest" : fmt::format("speed ratio {}", r.cell.ratio);
                }),
           measured("y", "", "", quantity.measured))
          .x("angle", Axis::linear, "angle between the motions [deg], 180 is head-on")
          .y("y", Axis::linear, std::move(y_label))
          .by("ratio");
  panel.series.push_back(theory_curves(rows, quantity));
  return panel;
}

/// The least and the greatest, or the only one.
std::vector<double> ends(const std::vector<double>& values) {
  if (values.size() <= 1) return values;
  return {values.front(), values.back()};
}

/// A panel for the slowest and the fastest speed, at the narrowest disc.
std::vector<Panel> by_speed(const std::vector<Row>& rows, const std::string& y_label, const Quantity& quantity) {
  std::vector<Panel> panels;
  for (const double speed : ends(sorted_values(rows, &Crossing::speed))) {
    const auto as_fast = only(rows, [&](const Row& r) { return r.cell.speed == speed; });
    const double narrowest = sorted_values(as_fast, &Crossing::offset).front();
    const auto drawn = only(as_fast, [&](const Row& r) { return r.cell.offset == narrowest; });
    const Crossing& c = drawn.front().cell;
    const double path = c.speed * c.step / contact_distance(c);
    panels.push_back(panel(drawn, fmt::format("{}, path {:.3g} R", y_label, path), quantity));
  }
  return panels;
}

Figure missed_figure(const std::vector<Row>& rows) {
  const Quantity missed = {[](const Row& r) { return measured_share(r.tally.missed, r.tally.touching); },
                           [](const Crossing& c) { return 1 - confirmed_theory(c).share / touch_theory(c); }};
  return {.name = "missed",
          .title = "What the tutorial's rule for two bodies misses",
          .caption =
              "Share of true hits that sweep_then_confirm does not see, with 95 % Wilson intervals, and the theory. "
              "Above the slowest, below the fastest ball; R is the contact distance.",
          .panels = by_speed(rows, "missed [1]", missed)};
}

Figure lateness_figure(const std::vector<Row>& rows) {
  const auto share = [](const Row& r) -> std::optional<Measured> {
    const RealSum& late = r.tally.lateness;
    if (!late.mean()) return std::nullopt;
    return normal_mean(*late.mean(), r.theory.confirmed.lateness_sigma, late.count).times(1 / longest_contact(r.cell));
  };
  const auto theory = [](const Crossing& c) {
    const ConfirmedTheory t = confirmed_theory(c);
    return t.share > 0 ? t.lateness_mean / longest_contact(c) : nan;
  };
  return {.name = "lateness",
          .title = "How late the hits of the tutorial's rule are",
          .caption =
              "Mean time from first contact to the answer of sweep_then_confirm, of the true hits it sees, over the "
              "longest time in contact, with 95 % intervals, and the theory. R is the contact distance.",
          .panels = by_speed(rows, "mean lateness / longest contact [1]", {share, theory})};
}

/// A panel for the narrowest and the widest disc that leaves room to pass, at the fastest speed.
Figure false_hits_figure(const std::vector<Row>& rows) {
  const double fastest = sorted_values(rows, &Crossing::speed).back();
  const auto drawn = only(rows, [&](const Row& r) { return r.cell.speed == fastest && r.cell.offset > 1; });
  const Quantity quantity = {[](const Row& r) { return measured_share(r.tally.false_hits, r.tally.apart()); },
                             [](const Crossing& c) { return false_overlap_theory(c) / (1 - touch_theory(c)); }};
  Figure figure = {.name = "false_hits",
                   .title = "False hits of sweeping both balls and testing what they sweep",
                   .caption = fmt::format(
                       "Share of the encounters that do not touch in which the two swept volumes overlap, at {:g} m/s, "
                       "with 95 % Wilson intervals, and the theory. The centers pass within a disc whose radius is in "
                       "contact distances R.",
                       fastest),
                   .panels = {}};
  for (const double offset : ends(sorted_values(drawn, &Crossing::offset))) {
    const auto those = only(drawn, [&](const Row& r) { return r.cell.offset == offset; });
    figure.panels.push_back(panel(those, fmt::format("false hits [1], passing within {:g} R", offset), quantity));
  }
  return figure;
}

std::vector<Figure> figures_of(const std::vector<Row>& rows) {
  // The head-on bullets belong into the pictures only where the settings fire at their speed too.
  const bool with_head_on = std::ranges::any_of(rows, [](const Row& r) {
    const Crossing& c = r.cell;
    return c != head_on && c.speed == head_on.speed && c.step == head_on.step && c.radius == head_on.radius;
  });
  const auto of_rule = [&](std::string_view rule) {
    return only(rows, [&](const Row& r) { return r.rule == rule && (with_head_on || r.cell != head_on); });
  };
  std::vector<Figure> figures;
  const auto confirm = of_rule(confirming), swept = of_rule("swept_overlap");
  if (!confirm.empty()) figures.push_back(missed_figure(confirm));
  if (!swept.empty()) figures.push_back(false_hits_figure(swept));
  if (!confirm.empty()) figures.push_back(lateness_figure(confirm));
  std::erase_if(figures, [](const Figure& figure) { return figure.panels.empty(); });
  return figures;
}

// What it says.

std::string confirm_answer(const std::vector<Row>& rows, const Total& total) {
  const Tally& t = total.tally;
  std::string text = fmt::format(
      "Of {} true hits the tutorial's rule for two bodies misses {} (theory {}; {} to {} from cell to cell)",
      grouped_text(t.touching), percent_text(share_of(t.missed, t.touching)),
      percent_text(share_of(total.missed_theory, t.touching)), percent_text(total.least_missed),
      percent_text(total.most_missed));
  for (const Row& row : rows) {
    if (row.cell == head_on && row.rule == total.rule) {
      text += fmt::format(", and {} where two bullets meet head-on",
                          percent_text(share_of(row.tally.missed, row.tally.touching)));
    }
  }
  text += fmt::format(
      ". It looks once, when a ray from the faster center enters the slower one's track. In {} of the misses the ray, which "
      "has no radius, does not enter during the step; in {} it enters before the other ball arrives, in {} after that has "
      "gone, and in {} it starts inside the track and looks at the start alone. ",
      percent_text(share_of(t.beside, t.missed)), percent_text(share_of(t.early, t.missed)),
      percent_text(share_of(t.late, t.missed)), percent_text(share_of(t.inside, t.missed)));
  if (has_times(t)) {
    text += fmt::format("Its {} hits come {:.3g} of a step late on average, and up to {:.3g}. ",
                        grouped_text(t.lateness.count), *t.lateness.mean(), t.latest);
  }
  return text;
}

std::string answer_of(const std::vector<Row>& rows, const std::vector<Total>& totals) {
  std::string rule, sweeping, closed_form;
  for (const Total& total : totals) {
    const Tally& t = total.tally;
    if (total.rule == confirming && t.touching > 0) rule = confirm_answer(rows, total);
    if (total.rule == "swept_overlap") {
      sweeping = fmt::format(
          "Sweeping both and testing what they sweep misses {} of {} true hits, and calls {} of {} encounters that do not "
          "touch a hit ({}). ",
          grouped_text(t.missed), grouped_text(t.touching), grouped_text(t.false_hits), grouped_text(t.apart()),
          percent_text(share_of(t.false_hits, t.apart())));
    }
    if (total.rule == exact) {
      closed_form = fmt::format("The closed form of the relative motion is wrong on {} of {}.",
                                grouped_text(t.missed + t.false_hits + t.undecided), grouped_text(t.shots));
    }
  }
  const std::string text = rule + sweeping + closed_form;
  if (!text.empty()) return text;
  const Total& first = totals.front();
  return fmt::format("{} misses {} of {} true hits and makes {} false ones.", first.rule,
                     grouped_text(first.tally.missed), grouped_text(first.tally.touching),
                     grouped_text(first.tally.false_hits));
}

Outcome outcome_of(const std::vector<Row>& rows) {
  const std::vector<Total> totals = totals_of(rows);
  const std::vector<SelfTest> counts = self_test(counts_of(rows));
  const std::vector<TimingTest> times = timing_test(rows);
  const Table all = table(
      "cells", "Every cell at every rule: true hits, what the rule misses, where it sees one that is none, how late.",
      row_columns(), rows);
  const Table meeting = in_report(
      table("head_on", "Two bullets at 10 m/s and 60 steps a second that meet head-on; every pair truly touches.",
            row_columns(), only(rows, [](const Row& r) { return r.cell == head_on; })));
  const Table rules = rules_table(totals);
  return {
      .answer = answer_of(rows, totals),
      .summary = terminal(meeting, {"rule", "touching", "missed", "missed_share", "missed_theory", "lateness_max"}) +
                 "\n" + terminal(rules) +
                 fmt::format("\nSelf-test: counts {}, times {}.\n", verdict_text(all_passed(counts)),
                             verdict_text(all_passed(times))),
      .tables = {meeting, rules, counts_test_table(counts), timing_test_table(times), all, rule_timings_table(totals)},
      .figures = figures_of(rows),
      .sections = {{"Self-test", self_test_text(counts)}},
      .self_test_passed = all_passed(counts) && all_passed(times)};
}

std::unique_ptr<Run> configure(const Settings& settings, const RunOptions& options) {
  const std::vector<CrossingRule> rules = chosen(settings, "rule", all_crossing_rules());
  const std::int64_t shots = settings.trials("shots", 1, std::int64_t(1) << 30, options.trials);
  std::vector<Row> rows;
  std::vector<Task<Tally>> tasks;
  for (const Crossing& cell : make_crossings(settings, rules.size())) {
    for (const CrossingRule& rule : rules) {
      rows.push_back({.cell = cell, .rule = rule.name, .theory = {}, .expected = {}, .tally = {}});
      tasks.push_back({fmt::format("{} {}", crossing_factors.key(cell), rule.name), shots,
                       [cell, rule, shots, seed = options.seed] { return ask_all(rule, cell, seed, shots); }});
    }
  }
  const auto finish = [rows, rules](const Done<Tally>& done) {
    std::vector<Row> all = rows;
    for (std::size_t i = 0; i < all.size(); ++i) {
      all[i].theory = i % rules.size() == 0 ? theory_of(all[i].cell) : all[i - 1].theory;
      all[i].expected = rules[i % rules.size()].expects(all[i].theory);
      all[i].tally = done.results[i];
      all[i].seconds = done.seconds[i];
    }
    return outcome_of(all);
  };
  return make_run(finish, std::move(tasks));
}

}  // namespace

std::vector<CellCount> counts_of(const std::vector<CrossingRow>& rows) {
  std::vector<CellCount> counts;
  const auto add = [&](const Row& row, std::string_view rule, const char* event, std::int64_t count,
                       const std::optional<double>& theory) {
    if (theory) counts.push_back({std::string(rule), event, row.tally.shots, count, *theory});
  };
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Row& row = rows[i];
    const bool first_of_cell = i == 0 || rows[i - 1].cell != row.cell;
    if (first_of_cell) add(row, "exact motion", "touching", row.tally.touching, row.theory.touch);
    add(row, row.rule, "reported", row.tally.reported(), row.expected.reported);
    add(row, row.rule, "missed", row.tally.missed, row.expected.missed);
    add(row, row.rule, "false", row.tally.false_hits, row.expected.false_hits);
  }
  return counts;
}

std::vector<TimingTest> timing_test(const std::vector<CrossingRow>& rows) {
  std::vector<Row> timed = only(rows, [](const Row& row) { return row.expected.reported && has_times(row.tally); });
  std::vector<TimingTest> tests;
  for (const Group<Row>& group : group_by(timed, &Row::rule)) {
    TimingTest& test = tests.emplace_back();
    test.rule = group[0]->rule;
    for (const Row* row : group) {
      const double rounding = resolution(row->cell);
      const double latest = longest_contact(row->cell) + rounding / relative_path(row->cell).norm();
      const bool is_wrong = row->rule == exact ? row->tally.deepest < -rounding : row->tally.latest > latest;
      ++test.cells;
      test.apart += row->tally.widest > rounding ? 1 : 0;
      test.wrong_time += is_wrong ? 1 : 0;
      if (const auto residual = lateness_residual(*row)) test.lateness.add(*residual);
    }
  }
  return tests;
}

Experiment crossing_bullets_experiment() {
  return {"crossing_bullets",
          "Two fast bodies cross: how many false hits and misses come of sweeping both and testing, against the exact "
          "relative motion?",
          embedded_toml("crossing_bullets"), configure};
}

}  // namespace thinwall
