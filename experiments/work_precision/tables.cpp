#include <thinwall/experiments/work_precision/tables.hpp>

#include <algorithm>
#include <cmath>

namespace thinwall {

namespace {

std::vector<Column> key_columns() {
  return {{"set", ColumnType::text, "", "The pair of shapes."},
          {"class", ColumnType::text, "", "Hits, misses or grazes."},
          {"scalar", ColumnType::text, "", "Floating-point type of the shapes."},
          {"method", ColumnType::text, "", "Way to find the time of impact."},
          {"option", ColumnType::number, "1", "Its tolerance or number of poses; missing where it has none."}};
}

std::vector<Value> key_of(const Heat& heat, const Racer& racer) {
  return {std::string(heat.set->name), std::string(name(heat.kind)), heat.scalar, racer.method,
          racer.option ? Value(*racer.option) : Value()};
}

/// Missing where nothing touches, or where so many are missed that it is infinite.
Value number(double x, const Racer& racer) { return racer.touching > 0 && std::isfinite(x) ? Value(x) : Value(); }

void append(std::vector<Value>& row, std::vector<Value> more) {
  std::move(more.begin(), more.end(), std::back_inserter(row));
}

void append(std::vector<Column>& columns, std::vector<Column> more) {
  std::move(more.begin(), more.end(), std::back_inserter(columns));
}

}  // namespace

Table errors_table(const std::vector<Heat>& heats) {
  Table table;
  table.name = "errors";
  table.description =
      "Verdicts and errors of the time of impact against the oracle at 50 digits, and evaluations, for every method and "
      "setting. A contact that is missed counts as an infinite error; a quantile that is infinite is left out.";
  table.columns = key_columns();
  append(table.columns, {{"queries", ColumnType::integer, "1", "Queries put."},
                         {"touching", ColumnType::integer, "1", "Of those, that touch during the step, by the oracle."},
                         {"missed", ColumnType::integer, "1", "Touching, and said to be apart."},
                         {"false_hits", ColumnType::integer, "1", "Not touching, and said to hit."},
                         {"gave_up", ColumnType::integer, "1", "Not decided."},
                         {"error_median", ColumnType::number, "step", "Median error of the time of impact."},
                         {"error_p99", ColumnType::number, "step", "99th percentile of the same."},
                         {"error_max", ColumnType::number, "step", "Largest of the same."},
                         {"length_median", ColumnType::number, "m", "Median error along the relative path."},
                         {"length_p99", ColumnType::number, "m", "99th percentile of the same."},
                         {"length_max", ColumnType::number, "m", "Largest of the same."},
                         {"latest", ColumnType::number, "step",
                          "Answer that is latest after first contact; negative: all are before."},
                         {"earliest", ColumnType::number, "step", "Answer that is earliest; positive: all are after."},
                         {"evaluations", ColumnType::number, "1",
                          "Separations, overlap tests, rays or closed forms a query, on average."},
                         {"most_evaluations", ColumnType::integer, "1", "The most that a query took."}});
  for (const Heat& heat : heats) {
    for (const Racer& r : heat.racers) {
      std::vector<Value> row = key_of(heat, r);
      append(row,
             {r.queries, r.touching, r.missed, r.false_hits, r.gave_up, number(r.time.median, r), number(r.time.p99, r),
              number(r.time.max, r), number(r.length.median, r), number(r.length.p99, r), number(r.length.max, r),
              number(r.latest, r), number(r.earliest, r), r.evaluations, r.most_evaluations});
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

Table times_table(const std::vector<Heat>& heats) {
  Table table;
  table.name = "timings";
  table.description =
      "Time a query on this machine: the median over interleaved rounds, with its 95 % bootstrap interval.";
  table.is_timing = true;
  table.columns = key_columns();
  append(table.columns,
         {{"nanoseconds", ColumnType::number, "ns", "A query; median over the rounds.", "lower", "upper"},
          {"lower", ColumnType::number, "ns", "Lower end of its interval."},
          {"upper", ColumnType::number, "ns", "Upper end of its interval."},
          {"rounds", ColumnType::integer, "1", "Rounds timed."},
          {"on_front", ColumnType::boolean, "", "Nobody is both finer and faster."}});
  for (const Heat& heat : heats) {
    const std::vector<const Racer*> front = pareto_front(heat);
    for (const Racer& r : heat.racers) {
      const Estimate time = nanoseconds(r);
      std::vector<Value> row = key_of(heat, r);
      append(row,
             {time.median, time.interval.lower, time.interval.upper, static_cast<std::int64_t>(r.nanoseconds.size()),
              std::find(front.begin(), front.end(), &r) != front.end()});
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

Table trailing_table(const std::vector<Heat>& heats) {
  Table table;
  table.name = "trailing";
  table.description =
      "Each method at its roughest setting with a 99th percentile error of at most 1e-12 of a step (1e-6 in "
      "float), or else its finest; and how many times as long as the closed form it takes. Hits alone.";
  table.is_timing = true;
  table.in_report = true;
  table.columns = key_columns();
  append(table.columns,
         {{"missed", ColumnType::integer, "1", "Contacts that it does not see."},
          {"false_share", ColumnType::number, "1", "Share of the misses, asked apart, that it calls a hit."},
          {"error_median", ColumnType::number, "step", "Median error of the time of impact."},
          {"error_p99", ColumnType::number, "step", "99th percentile of the same; missing: it misses more than 1 %."},
          {"evaluations", ColumnType::number, "1", "A query, on average."},
          {"nanoseconds", ColumnType::number, "ns", "A query; median over the rounds."},
          {"times_closed_form", ColumnType::number, "1",
           "Its time over that of the closed form, round by round; median.", "lower", "upper"},
          {"lower", ColumnType::number, "1", "Lower end of the 95 % bootstrap interval of the same."},
          {"upper", ColumnType::number, "1", "Upper end of the same."}});
  for (const Heat& heat : heats) {
    if (heat.kind != QueryClass::hit) continue;
    const Racer* exact = closed_form_of(heat);
    for (const Racer* r : one_a_method(heat)) {
      std::vector<Value> row = key_of(heat, *r);
      const std::optional<double> wrong = false_share(heats, heat, *r);
      append(row, {r->missed, wrong ? Value(*wrong) : Value(), number(r->time.median, *r), number(r->time.p99, *r),
                   r->evaluations, nanoseconds(*r).median});
      if (exact != nullptr) {
        const Estimate ratio = slowdown(*r, *exact);
        append(row, {ratio.median, ratio.interval.lower, ratio.interval.upper});
      } else {
        append(row, {Value(), Value(), Value()});
      }
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

}  // namespace thinwall
