#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include <thinwall/experiments/speed/bench_program.hpp>
#include <thinwall/experiments/speed/report.hpp>

namespace thinwall {

namespace {

std::vector<Column> speed_keys() {
  return {{"kind", ColumnType::text, "", "What is asked: a time of impact, a ray, a contact, a step of a world."},
          {"subject", ColumnType::text, "", "Of what: a pair of shapes, a world."},
          {"way", ColumnType::text, "", "Who answers, and how."},
          {"program", ColumnType::text, "", "Benchmark program that asked."}};
}

std::vector<Value> speed_key_of(const TimedWay& c) { return {c.kind, c.subject, c.way, c.program}; }

template <class T> void add_all(std::vector<T>& list, std::vector<T> more) {
  std::move(more.begin(), more.end(), std::back_inserter(list));
}

Value number_of(const TimedWay& c, const char* counter) {
  const std::optional<double> found = error_of(c, counter);
  return found ? Value(*found) : Value();
}

Value count_of(const TimedWay& c, const char* counter) {
  const std::optional<double> found = error_of(c, counter);
  return found ? Value(static_cast<std::int64_t>(*found)) : Value();
}

Value median_of(const std::vector<double>& values) { return values.empty() ? Value() : Value(median(values)); }

std::vector<Column> time_columns() {
  return {
      {"nanoseconds", ColumnType::number, "ns", "Processor time of an answer; median over rounds.", "lower", "upper"},
      {"lower", ColumnType::number, "ns", "Lower end of its 95 % bootstrap interval."},
      {"upper", ColumnType::number, "ns", "Upper end of the same."}};
}

std::vector<Value> times_of(const TimedWay& c) {
  const WayTime time = time_of(c);
  return {time.median, time.interval.lower, time.interval.upper};
}

}  // namespace

Table speed_errors_table(const SpeedResult& result) {
  Table table;
  table.name = "errors";
  table.description =
      "Verdicts and errors against the benchmark's oracle, of every row that has one. An error is that of a hit that was found: "
      "of a time in steps and as a length along the relative path, of a contact's depth as a length.";
  table.columns = speed_keys();
  add_all<Column>(table.columns,
                  {{"missed", ColumnType::integer, "1", "Hits of the set that are called misses."},
                   {"false_hits", ColumnType::integer, "1", "Misses of the set that are called hits."},
                   {"error_p99", ColumnType::number, "1", "99th percentile error, in steps; of a depth, a length."},
                   {"error_max", ColumnType::number, "1", "Largest of the same."},
                   {"length_p99", ColumnType::number, "m", "99th percentile error, as a length."},
                   {"length_max", ColumnType::number, "m", "Largest of the same."}});
  for (const TimedWay& c : result.ways) {
    if (!error_of(c, "missed")) continue;
    std::vector<Value> row = speed_key_of(c);
    add_all<Value>(row, {count_of(c, "missed"), count_of(c, "false"), number_of(c, "p99_error"),
                         number_of(c, "max_error"), number_of(c, "p99_length"), number_of(c, "max_length")});
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table speed_race_table(const SpeedResult& result) {
  Table table;
  table.name = "race";
  table.description =
      "Time of impact: what an answer costs and what is wrong with it, of 100 000 queries a pair. Length: the error of the time "
      "times the relative motion.";
  table.is_timing = true;
  table.in_report = true;
  table.columns = {{"subject", ColumnType::text, "", "The pair of shapes."},
                   {"who", ColumnType::text, "", "Who answers, and how."}};
  add_all<Column>(table.columns, time_columns());
  add_all<Column>(table.columns,
                  {{"to_floor", ColumnType::number, "1", "The time over the floor measured beside it."},
                   {"missed", ColumnType::integer, "1", "Hits that are called misses."},
                   {"false_hits", ColumnType::integer, "1", "Misses that are called hits."},
                   {"length_p99", ColumnType::number, "m", "99th percentile error of the hits that are found."},
                   {"length_max", ColumnType::number, "m", "Largest of the same."}});
  for (const TimedWay* c : drawn_ways(result.ways)) {
    std::vector<Value> row = {c->subject, name_of(*c)};
    add_all<Value>(row, times_of(*c));
    add_all<Value>(row, {median_of(c->to_floor), count_of(*c, "missed"), count_of(*c, "false"),
                         number_of(*c, "p99_length"), number_of(*c, "max_length")});
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table speed_timings_table(const SpeedResult& result) {
  Table table;
  table.name = "timings";
  table.description =
      "Every row of every benchmark program: processor time of an answer, median over rounds, each a process of its own.";
  table.is_timing = true;
  table.columns = speed_keys();
  add_all<Column>(table.columns, time_columns());
  add_all<Column>(table.columns, {{"rounds", ColumnType::integer, "1", "Rounds timed."},
                                  {"floor_ns", ColumnType::number, "ns",
                                   "The least that the same work could take; median over rounds."},
                                  {"to_floor", ColumnType::number, "1", "Time over floor, round by round; median."}});
  for (const TimedWay& c : result.ways) {
    std::vector<Value> row = speed_key_of(c);
    add_all<Value>(row, times_of(c));
    add_all<Value>(row,
                   {static_cast<std::int64_t>(c.nanoseconds.size()), median_of(c.floor_ns), median_of(c.to_floor)});
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table speed_floors_table(const SpeedResult& result) {
  Table table;
  table.name = "floors";
  table.description =
      "What the machine can do at best, measured by each start of a program; medians and extremes over all of them.";
  table.is_timing = true;
  table.in_report = true;
  table.columns = {{"floor", ColumnType::text, "", "What was measured."},
                   {"median", ColumnType::number, "1", "In the unit that its name ends with."},
                   {"least", ColumnType::number, "1", "Least of all starts."},
                   {"most", ColumnType::number, "1", "Most of all starts."}};
  std::map<std::string, std::vector<double>> floors;
  for (const BenchOutput& output : result.outputs) {
    for (const auto& [name, value] : output.floors) floors[name].push_back(value);
  }
  for (const auto& [name, values] : floors) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    table.rows.push_back({name, median(values), *least, *most});
  }
  return table;
}

Table speed_programs_table(const SpeedResult& result) {
  Table table;
  table.name = "programs";
  table.description = "Which benchmark programs and libraries took part.";
  table.in_report = true;
  table.columns = {{"program", ColumnType::text, "", "Benchmark program."},
                   {"rows", ColumnType::integer, "1", "Rows that it has."},
                   {"left_out", ColumnType::text, "", "What did not take part, and why; missing if all did."}};
  for (const std::string_view name : bench_program_names()) {
    for (const BenchOutput& output : result.outputs) {
      if (output.program != name) continue;
      std::string left_out = output.missing;
      for (const std::string& peer : output.peers_left_out)
        left_out += (left_out.empty() ? "built without " : ", ") + peer;
      if (!output.peers_left_out.empty())
        left_out += ": install their development packages, configure with -DTHINWALL_PEERS=ON and build again";
      table.rows.push_back({output.program, static_cast<std::int64_t>(output.rows.size()),
                            left_out.empty() ? Value() : Value(left_out)});
      break;  // every round has the same
    }
  }
  return table;
}

}  // namespace thinwall
