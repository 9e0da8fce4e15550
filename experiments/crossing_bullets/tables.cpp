#include <thinwall/experiments/crossing_bullets/tables.hpp>

#include <algorithm>
#include <functional>

#include <thinwall/swept/methods.hpp>

namespace thinwall {

namespace {

/// A column, and what a line writes into it.
struct Field {
  Column column;
  std::function<Value(const CrossingLine&)> read;
};

Value maybe(const std::optional<double>& x) { return x ? Value(*x) : Value(); }

Interval missed_interval(const CrossingLine& l) { return wilson(l.tally.missed, l.tally.touching); }

/// Of the encounters that do not touch, if there are any.
std::optional<double> false_share(const CrossingLine& l, double count) {
  const std::int64_t apart = l.tally.shots - l.tally.touching;
  if (apart == 0) return std::nullopt;
  return count / static_cast<double>(apart);
}

std::vector<Field> factors() {
  using enum ColumnType;
  return {
      {{"rule", text, "", "How a hit is found."}, [](const CrossingLine& l) { return l.rule; }},
      {{"speed", number, "m/s", "Of the faster ball."}, [](const CrossingLine& l) { return l.crossing.speed; }},
      {{"step", number, "s", "Time step."}, [](const CrossingLine& l) { return l.crossing.step; }},
      {{"radius", number, "m", "Of both balls."}, [](const CrossingLine& l) { return l.crossing.radius; }},
      {{"ratio", number, "1", "Speed of the slower ball over the faster one's."},
       [](const CrossingLine& l) { return l.crossing.ratio; }},
      {{"angle_deg", number, "deg", "Between the motions: 0 is a chase, 180 is head-on; 0 if the slower ball rests."},
       [](const CrossingLine& l) { return l.crossing.angle_deg; }},
      {{"offset", number, "contact distances", "Radius of the disc that closest approach is uniform over."},
       [](const CrossingLine& l) { return l.crossing.offset; }},
      {{"relative_path", number, "m", "Length of the relative motion in a step."},
       [](const CrossingLine& l) { return relative_path(l.crossing).norm(); }},
  };
}

std::vector<Field> verdicts() {
  using enum ColumnType;
  return {
      {{"shots", integer, "1", "Encounters."}, [](const CrossingLine& l) { return l.tally.shots; }},
      {{"touching", integer, "1", "True hits: the balls touch during the step, by the exact relative motion."},
       [](const CrossingLine& l) { return l.tally.touching; }},
      {{"touching_theory", number, "1", "Expected number of them: shots / offset^2."},
       [](const CrossingLine& l) { return l.theory.touch * static_cast<double>(l.tally.shots); }},
      {{"missed", integer, "1", "True hits that the rule does not see."},
       [](const CrossingLine& l) { return l.tally.missed; }},
      {{"missed_share", number, "1", "missed / touching; missing if nothing touches.", "missed_lower", "missed_upper"},
       [](const CrossingLine& l) { return maybe(missed_share(l)); }},
      {{"missed_lower", number, "1", "Lower end of its 95 % Wilson interval."},
       [](const CrossingLine& l) { return l.tally.touching > 0 ? Value(missed_interval(l).lower) : Value(); }},
      {{"missed_upper", number, "1", "Upper end of it."},
       [](const CrossingLine& l) { return l.tally.touching > 0 ? Value(missed_interval(l).upper) : Value(); }},
      {{"missed_theory", number, "1", "Share of true hits missed, by theory; missing where no formula holds."},
       [](const CrossingLine& l) { return maybe(missed_share_theory(l)); }},
      {{"false_hits", integer, "1", "Hits reported although the balls do not touch."},
       [](const CrossingLine& l) { return l.tally.false_hits; }},
      {{"false_share", number, "1", "false_hits over the encounters that do not touch; missing if all do."},
       [](const CrossingLine& l) { return maybe(false_share(l, static_cast<double>(l.tally.false_hits))); }},
      {{"false_theory", number, "1", "The same by theory; missing where no formula holds or all touch."},
       [](const CrossingLine& l) {
         if (!l.expected.false_hits || l.theory.touch >= 1) return Value();
         return Value(*l.expected.false_hits / (1 - l.theory.touch));
       }},
      {{"undecided", integer, "1", "Encounters that the method gave up on."},
       [](const CrossingLine& l) { return l.tally.undecided; }},
      {{"evaluations", integer, "1", "Overlap tests, rays and closed forms they took."},
       [](const CrossingLine& l) { return l.tally.evaluations; }},
  };
}

std::vector<Field> causes_and_times() {
  using enum ColumnType;
  const auto timed = [](double CrossingTally::*field) {
    return [field](const CrossingLine& l) { return l.tally.timed > 0 ? Value(l.tally.*field) : Value(); };
  };
  const auto cause = [](std::int64_t MissCauses::*field) {
    return [field](const CrossingLine& l) {
      return l.rule == SweepThenConfirm<double>::name ? Value(l.tally.causes.*field) : Value();
    };
  };
  const auto confirmed = [](double ConfirmedTheory::*field) {
    return [field](const CrossingLine& l) {
      return l.rule == SweepThenConfirm<double>::name ? Value(l.theory.confirmed.*field) : Value();
    };
  };
  return {
      {{"missed_beside", integer, "1", "Missed by sweep_then_confirm: the center's ray does not enter the track."},
       cause(&MissCauses::beside)},
      {{"missed_early", integer, "1", "Missed since the ray enters the track before the other ball arrives."},
       cause(&MissCauses::too_early)},
      {{"missed_late", integer, "1", "Missed since it enters after the other ball has gone."},
       cause(&MissCauses::too_late)},
      {{"missed_inside", integer, "1", "Missed since the ray starts inside the track and looks at the start alone."},
       cause(&MissCauses::inside)},
      {{"lateness_mean", number, "step", "Mean time from first contact to the answer, of the true hits it sees."},
       [](const CrossingLine& l) { return maybe(mean_lateness(l)); }},
      {{"lateness_theory", number, "step", "The same by theory, of sweep_then_confirm."},
       confirmed(&ConfirmedTheory::lateness_mean)},
      {{"lateness_max", number, "step", "The latest answer."}, timed(&CrossingTally::latest)},
      {{"lateness_min", number, "step", "The earliest; below 0 by rounding, or by a tolerance."},
       timed(&CrossingTally::earliest)},
      {{"gap_max", number, "m", "Widest gap between the balls at the answered time; above 0 by rounding, or false."},
       timed(&CrossingTally::widest)},
  };
}

Table make_table(const std::vector<CrossingLine>& lines) {
  Table table;
  table.rows.resize(lines.size());
  for (const auto& group : {factors(), verdicts(), causes_and_times()}) {
    for (const Field& field : group) {
      table.columns.push_back(field.column);
      for (std::size_t i = 0; i < lines.size(); ++i) table.rows[i].push_back(field.read(lines[i]));
    }
  }
  return table;
}

}  // namespace

Table crossings_table(const std::vector<CrossingLine>& lines) {
  Table table = make_table(lines);
  table.name = "cells";
  table.description =
      "Every cell at every rule: true hits, what the rule misses, where it sees one that is none, how late.";
  return table;
}

Table head_on_table(const std::vector<CrossingLine>& lines) {
  std::vector<CrossingLine> selected;
  std::copy_if(lines.begin(), lines.end(), std::back_inserter(selected),
               [](const CrossingLine& l) { return l.crossing == head_on; });
  Table table = make_table(selected);
  table.name = "head_on";
  table.description = "Two bullets at 10 m/s and 60 steps a second that meet head-on; every pair truly touches.";
  table.in_report = true;
  return table;
}

Table counts_test_table(const std::vector<SelfTest>& tests) {
  Table table = self_test_table(tests);
  table.description = "Counts of independent encounters against theory, over all cells of a rule and event at once.";
  for (Column& column : table.columns) {
    if (column.name == "method") column = {"rule", ColumnType::text, "", "How a hit is found."};
    if (column.name == "scalar") column = {"event", ColumnType::text, "", "What is counted."};
    if (column.name == "judged_cells") column.description = "Cells with at least 5 expected events and 5 without.";
  }
  return table;
}

Table timing_test_table(const std::vector<TimingTest>& tests) {
  Table table;
  table.name = "times";
  table.description = "Times of impact against what they can be, for the rules that claim that a hit is one.";
  table.in_report = true;
  table.columns = {
      {"rule", ColumnType::text, "", "How a hit is found."},
      {"cells", ColumnType::integer, "1", "Cells in which it gave a time."},
      {"apart", ColumnType::integer, "1", "Of those, cells with a time at which the balls are apart; must be 0."},
      {"wrong_time", ColumnType::integer, "1",
       "Cells with a time later than contact can last, for closed_form than it begins; must be 0."},
      {"judged_cells", ColumnType::integer, "1", "Cells whose mean lateness is held against theory."},
      {"chi_square", ColumnType::number, "1", "Sum of squared standard residuals of the mean lateness."},
      {"chi_square_lower", ColumnType::number, "1", "Least allowed: central 99.9 % of the chi-square distribution."},
      {"chi_square_upper", ColumnType::number, "1", "Most allowed."},
      {"passed", ColumnType::boolean, "", "All of the above hold."},
  };
  for (const TimingTest& t : tests) {
    const auto judged = [&](double x) { return t.judged > 0 ? Value(x) : Value(); };
    table.rows.push_back({t.rule, t.cells, t.apart, t.wrong_time, t.judged, judged(t.chi_square),
                          judged(t.chi_square_allowed.lower), judged(t.chi_square_allowed.upper), t.passed()});
  }
  return table;
}

}  // namespace thinwall
