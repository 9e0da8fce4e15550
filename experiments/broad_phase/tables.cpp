#include <iterator>
#include <utility>

#include <thinwall/experiments/broad_phase/report.hpp>

namespace thinwall {

namespace {

std::vector<Column> key_columns() {
  return {{"placement", ColumnType::text, "", "Uniform, or clustered in heaps of about 100."},
          {"speed", ColumnType::number, "m", "Path of a ball in a step; balls are 1 m wide."}};
}

std::vector<Value> key_of(const CrowdFactors& f) { return {placement_name(f), f.speed}; }

template <class T> void append(std::vector<T>& list, std::vector<T> more) {
  std::move(more.begin(), more.end(), std::back_inserter(list));
}

Value false_share(const Survey& s) {
  if (s.pairs == 0) return {};
  return 1 - static_cast<double>(s.meetings) / static_cast<double>(s.pairs);
}

Value bytes_a_ball(const Finding& f, double count) {
  if (!f.bytes) return {};
  return static_cast<double>(*f.bytes) / count;
}

}  // namespace

Table crowds_table(const std::vector<SurveyLine>& lines) {
  Table table;
  table.name = "crowds";
  table.description = "The pairs of each world, on which every exact broad phase agrees, and how many of them meet.";
  table.in_report = true;
  table.columns = key_columns();
  append<Column>(
      table.columns,
      {{"count", ColumnType::integer, "1", "Balls."},
       {"pairs", ColumnType::integer, "1", "Pairs whose boxes touch during the step: the candidates."},
       {"meetings", ColumnType::integer, "1", "Of those, pairs of balls that touch during the step."},
       {"false_share", ColumnType::number, "1", "Share of the candidates that do not; missing without any."}});
  for (const SurveyLine& line : lines) {
    const Survey& s = line.survey;
    std::vector<Value> row = key_of(line.factors);
    append<Value>(row, {line.factors.count, s.pairs, s.meetings, false_share(s)});
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table finders_table(const std::vector<SurveyLine>& lines) {
  Table table;
  table.name = "timings";
  table.description =
      "Time to find all pairs of a world, median over interleaved rounds with its 95 % bootstrap interval, and memory.";
  table.is_timing = true;
  table.columns = key_columns();
  append<Column>(
      table.columns,
      {{"count", ColumnType::integer, "1", "Balls."},
       {"broad_phase", ColumnType::text, "", "Who finds the pairs."},
       {"milliseconds", ColumnType::number, "ms", "From boxes to all pairs; median over the rounds.", "lower", "upper"},
       {"lower", ColumnType::number, "ms", "Lower end of its interval."},
       {"upper", ColumnType::number, "ms", "Upper end of its interval."},
       {"rounds", ColumnType::integer, "1", "Rounds timed."},
       {"nanoseconds_a_ball", ColumnType::number, "ns", "The median over the count."},
       {"bytes_a_ball", ColumnType::number, "byte", "Working memory and pairs; missing where not known."},
       {"found", ColumnType::integer, "1", "Pairs found."},
       {"missing", ColumnType::integer, "1", "Pairs whose boxes touch and that were not found."},
       {"extra", ColumnType::integer, "1", "Pairs found whose boxes do not touch."}});
  for (const SurveyLine& line : lines) {
    const auto count = static_cast<double>(line.factors.count);
    for (const Finding& f : line.survey.findings) {
      const TimeEstimate time = time_of(f);
      std::vector<Value> row = key_of(line.factors);
      append<Value>(row, {line.factors.count, f.finder, time.median, time.interval.lower, time.interval.upper,
                          static_cast<std::int64_t>(f.milliseconds.size()), 1e6 * time.median / count,
                          bytes_a_ball(f, count), f.pairs, f.missing, f.extra});
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

Table growth_table(const std::vector<SurveyLine>& lines) {
  Table table;
  table.name = "growth";
  table.description =
      "The exponent p of time = c * count^p over counts of 10000 and more, by least squares on logarithms, with its 95 % "
      "interval.";
  table.is_timing = true;
  table.in_report = true;
  table.columns = key_columns();
  append<Column>(table.columns, {{"broad_phase", ColumnType::text, "", "Who finds the pairs."},
                                 {"counts", ColumnType::integer, "1", "Counts of 10000 and more."},
                                 {"exponent", ColumnType::number, "1", "p.", "lower", "upper"},
                                 {"lower", ColumnType::number, "1", "Lower end of its interval."},
                                 {"upper", ColumnType::number, "1", "Upper end of its interval."}});
  for (const Course& c : courses(lines)) {
    if (!c.growth) continue;
    std::int64_t counts = 0;
    for (const GrowthPoint& p : c.milliseconds) counts += p.count >= growth_from ? 1 : 0;
    std::vector<Value> row = key_of(c.factors);
    append<Value>(row, {c.finder, counts, c.growth->exponent, c.growth->interval.lower, c.growth->interval.upper});
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace thinwall
