#include <thinwall/experiments/extremes/tables.hpp>

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <thinwall/experiments/extremes/breaks.hpp>
#include <thinwall/experiments/text/numbers.hpp>

namespace thinwall {

namespace {

Value number(double x) { return std::isfinite(x) ? Value(x) : Value(); }
Value number(const std::optional<double>& x) { return x ? Value(*x) : Value(); }
std::string title_of(std::size_t precision) { return std::string(all_precisions()[precision].name); }

std::string name_of(PairSet pairs) { return pairs == PairSet::rounded ? "with a ball" : "two boxes"; }

/// "1e+08 verdict", "-" where it survives.
std::string long_text(const Survival& s) {
  if (!s.broken) return s.survived ? "-" : "";
  return fmt::format("{} {}", rounded_text(*s.broken, 3), name(s.flaw));
}

std::vector<Column> key_columns() {
  return {{"pair", ColumnType::text, "", "The two shapes."},
          {"precision", ColumnType::text, "", "Floating-point type the kernels ran in."},
          {"axis", ColumnType::text, "", "What is extreme."},
          {"value", ColumnType::number, "1", "How extreme: of lengths in sizes of the pair, R."},
          {"method", ColumnType::text, "", "Way to find the time of impact; textbook is a foil."}};
}

std::vector<Value> key_of(const ExtremeLine& line) {
  return {std::string(line.pair->name), title_of(line.precision), std::string(info(line.place.axis).name),
          line.place.value, line.tally.method};
}

}  // namespace

Table ladder_table(const std::vector<ExtremeLine>& lines) {
  Table table;
  table.name = "ladder";
  table.description =
      "The first value of each axis at which a method breaks, and why: a verdict wrong by more than 4 u, an error of the time "
      "of more than 100 u kappa t, no number, or out of budget; a dash where it survives the whole axis. Run time beside it. "
      "The textbook forms are foils.";
  table.is_timing = true;
  table.in_report = true;
  table.columns = {{"method", ColumnType::text, "", "Way to find the time of impact."},
                   {"precision", ColumnType::text, "", "Floating-point type the kernels ran in."},
                   {"pairs", ColumnType::text, "", "With a ball, three pairs; or two boxes, which have no radius."},
                   {"nanoseconds", ColumnType::number, "ns", "A query; median over pairs and places."}};
  for (const Arm& arm : all_arms()) {
    table.columns.push_back({std::string(arm.name), ColumnType::text, "",
                             fmt::format("First break along {}, towards {} values.", info(arm.axis).title,
                                         arm.side > 0 ? "greater" : "lesser")});
  }
  for (const std::string_view method : extreme_method_names()) {
    for (const std::size_t p : precisions_of(lines)) {
      for (const PairSet pairs : {PairSet::rounded, PairSet::boxes}) {
        const double time = nanoseconds_of(lines, method, p, pairs);
        if (time == 0) continue;
        std::vector<Value> row = {std::string(method), title_of(p), name_of(pairs), time};
        for (const Arm& arm : all_arms()) row.emplace_back(long_text(survival(lines, arm, method, p, pairs)));
        table.rows.push_back(std::move(row));
      }
    }
  }
  return table;
}

Table ladder_test_table(const std::vector<LadderTest>& tests) {
  Table table;
  table.name = "self_test";
  table.description =
      "The contract of the closed form, and the theory of the textbook's loss between two balls, by precision.";
  table.in_report = true;
  table.columns = {{"what", ColumnType::text, "", "What theory says something about; docs/extremes.md has the units."},
                   {"precision", ColumnType::text, "", "Floating-point type."},
                   {"cells", ColumnType::integer, "1", "Cells it is held against."},
                   {"measured", ColumnType::number, "1", "The worst of them; missing: there is none."},
                   {"least", ColumnType::number, "1", "Least allowed."},
                   {"most", ColumnType::number, "1", "Most allowed; missing: no bound."},
                   {"where", ColumnType::text, "", "The worst cell."},
                   {"passed", ColumnType::boolean, "", "Within what is allowed."}};
  for (const LadderTest& t : tests) {
    table.rows.push_back(
        {t.what, title_of(t.precision), t.cells, number(t.measured), t.least, number(t.most), t.where, t.passed()});
  }
  return table;
}

Table breaks_table(const std::vector<ExtremeLine>& lines) {
  Table table;
  table.name = "breaks";
  table.description = "How far each method gets along each axis, on the pairs that every method is asked.";
  table.columns = {{"axis", ColumnType::text, "", "What is extreme."},
                   {"side", ColumnType::text, "", "Towards greater or lesser values."},
                   {"precision", ColumnType::text, "", "Floating-point type."},
                   {"method", ColumnType::text, "", "Way to find the time of impact; textbook is a foil."},
                   {"pairs", ColumnType::text, "", "With a ball, three pairs; or two boxes."},
                   {"survived", ColumnType::number, "1", "Last value before the first break; missing: none."},
                   {"broken", ColumnType::number, "1", "First value at which it breaks; missing: none."},
                   {"why", ColumnType::text, "", "A wrong verdict, an error, nan or gave_up."},
                   {"pair", ColumnType::text, "", "On which shapes."}};
  for (const Arm& arm : all_arms()) {
    for (const std::size_t p : precisions_of(lines)) {
      for (const std::string_view method : methods_of(lines, p)) {
        for (const PairSet pairs : {PairSet::rounded, PairSet::boxes}) {
          const Survival s = survival(lines, arm, method, p, pairs);
          if (!s.broken && !s.survived) continue;
          table.rows.push_back({std::string(info(arm.axis).name), std::string(arm.side > 0 ? "greater" : "lesser"),
                                title_of(p), std::string(method), name_of(pairs), number(s.survived), number(s.broken),
                                s.broken ? Value(std::string(name(s.flaw))) : Value(std::string()),
                                std::string(s.pair)});
        }
      }
    }
  }
  return table;
}

Table extreme_cells_table(const std::vector<ExtremeLine>& lines) {
  Table table;
  table.name = "cells";
  table.description = "Every method on every pair, in every precision, at every value of every axis.";
  table.columns = key_columns();
  for (Column& column : std::vector<Column>{
           {"queries", ColumnType::integer, "1", "That the precision can hold."},
           {"touching", ColumnType::integer, "1", "Of those, that touch, by the oracle."},
           {"changed", ColumnType::integer, "1", "Whose verdict rounding the input has changed, whatever the method."},
           {"wrong", ColumnType::integer, "1", "Verdicts that are wrong, by however little."},
           {"far_wrong", ColumnType::integer, "1", "Verdicts that are wrong by more than 4 u."},
           {"worst_wrong", ColumnType::number, "u",
            "The worst wrong verdict: the change of its input that makes it right."},
           {"gave_up", ColumnType::integer, "1", "Out of evaluations."},
           {"invalid", ColumnType::integer, "1", "No number, or called invalid."},
           {"timed", ColumnType::integer, "1", "Hits whose time is judged."},
           {"forward_median", ColumnType::number, "u kappa t", "Median error of the time."},
           {"forward_max", ColumnType::number, "u kappa t", "Largest error of the time."},
           {"backward_median", ColumnType::number, "u", "Median backward error."},
           {"backward_max", ColumnType::number, "u", "Largest backward error."},
           {"loss_rms", ColumnType::number, "1", "Root mean square of the error along the normal over u d^2 / (2 R)."},
           {"loss_max", ColumnType::number, "1", "Largest of the same; missing where no radius is."}}) {
    table.columns.push_back(std::move(column));
  }
  for (const ExtremeLine& line : lines) {
    const ExtremeTally& t = line.tally;
    if (t.queries == 0) continue;
    const auto timed = [&](double x) { return t.timed > 0 ? Value(x) : Value(); };
    const auto lost = [&](double x) { return t.loss_max > 0 ? Value(x) : Value(); };
    std::vector<Value> row = key_of(line);
    for (const Value& value :
         std::vector<Value>{t.queries, t.touching, t.changed, t.wrong, t.far_wrong, t.worst_wrong, t.gave_up, t.invalid,
                            t.timed, timed(t.forward_median), timed(t.forward_max), timed(t.backward_median),
                            timed(t.backward_max), lost(t.loss_rms), lost(t.loss_max)}) {
      row.push_back(value);
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table extreme_timings_table(const std::vector<ExtremeLine>& lines) {
  Table table;
  table.name = "timings";
  table.description = "Time a query on this machine: the median over up to nine passes of the cell's queries.";
  table.is_timing = true;
  table.columns = key_columns();
  table.columns.push_back({"nanoseconds", ColumnType::number, "ns", "A query."});
  for (const ExtremeLine& line : lines) {
    if (line.tally.queries == 0) continue;
    std::vector<Value> row = key_of(line);
    row.emplace_back(line.tally.nanoseconds);
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace thinwall
