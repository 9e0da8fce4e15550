#include <thinwall/experiments/crossing_bullets/totals.hpp>

#include <algorithm>

namespace thinwall {

namespace {

void add(CrossingTally& sum, const CrossingTally& t) {
  sum.shots += t.shots;
  sum.touching += t.touching;
  sum.missed += t.missed;
  sum.false_hits += t.false_hits;
  sum.undecided += t.undecided;
  sum.evaluations += t.evaluations;
  sum.timed += t.timed;
  sum.lateness += t.lateness;
  sum.causes.inside += t.causes.inside;
  sum.causes.too_early += t.causes.too_early;
  sum.causes.too_late += t.causes.too_late;
  sum.causes.beside += t.causes.beside;
  sum.latest = std::max(sum.latest, t.latest);
  sum.earliest = std::min(sum.earliest, t.earliest);
}

}  // namespace

std::vector<CrossingTotal> totals(const std::vector<CrossingLine>& lines, const std::vector<double>& seconds) {
  std::vector<CrossingTotal> all;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const CrossingLine& line = lines[i];
    auto found = std::find_if(all.begin(), all.end(), [&](const CrossingTotal& t) { return t.rule == line.rule; });
    if (found == all.end()) {
      all.emplace_back().rule = line.rule;
      found = all.end() - 1;
    }
    add(found->tally, line.tally);
    found->seconds += seconds[i];
    const std::optional<double> share = missed_share_theory(line);
    found->has_theory &= share.has_value();
    if (!share) continue;
    found->missed_theory += *line.expected.missed * static_cast<double>(line.tally.shots);
    found->least_missed = std::min(found->least_missed, *share);
    found->most_missed = std::max(found->most_missed, *share);
  }
  return all;
}

Table rules_table(const std::vector<CrossingTotal>& totals) {
  Table table;
  table.name = "rules";
  table.description = "Each rule over all of its cells, every cell with the same number of encounters.";
  table.in_report = true;
  table.columns = {
      {"rule", ColumnType::text, "", "How a hit is found."},
      {"shots", ColumnType::integer, "1", "Encounters."},
      {"touching", ColumnType::integer, "1", "True hits."},
      {"missed", ColumnType::integer, "1", "Of those, not seen."},
      {"missed_expected", ColumnType::number, "1", "By theory; missing where it has no formula for every cell."},
      {"missed_least", ColumnType::number, "1", "Share of true hits missed, by theory, in the cell where it is least."},
      {"missed_most", ColumnType::number, "1", "The same where it is most."},
      {"false_hits", ColumnType::integer, "1", "Hits reported although the balls do not touch."},
      {"lateness_max", ColumnType::number, "step", "Latest answer, of all cells; missing where it gives no time."},
  };
  for (const CrossingTotal& t : totals) {
    const auto theory = [&](double x) { return t.has_theory ? Value(x) : Value(); };
    table.rows.push_back({t.rule, t.tally.shots, t.tally.touching, t.tally.missed, theory(t.missed_theory),
                          theory(t.least_missed), theory(t.most_missed), t.tally.false_hits,
                          t.tally.timed > 0 ? Value(t.tally.latest) : Value()});
  }
  return table;
}

Table rule_timings_table(const std::vector<CrossingTotal>& totals) {
  Table table;
  table.name = "timings";
  table.description = "Time an encounter, on this machine, with every core at work.";
  table.is_timing = true;
  table.columns = {{"rule", ColumnType::text, "", "How a hit is found."},
                   {"nanoseconds_per_shot", ColumnType::number, "ns", "Drawing and the exact motion included."}};
  for (const CrossingTotal& t : totals) {
    table.rows.push_back({t.rule, 1e9 * t.seconds / static_cast<double>(t.tally.shots)});
  }
  return table;
}

}  // namespace thinwall
