#include <thinwall/experiments/hitscan/line.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace thinwall {

namespace {

std::optional<double> quotient(double part, double whole) {
  if (whole <= 0) return std::nullopt;
  return part / whole;
}
std::optional<double> quotient(std::int64_t part, std::int64_t whole) {
  return quotient(static_cast<double>(part), static_cast<double>(whole));
}
std::optional<double> mean_of(const HitscanSpread& spread, double unit) {
  if (spread.count == 0) return std::nullopt;
  return mean(spread, unit);
}

HitscanMomentTest& test_of(std::vector<HitscanMomentTest>& tests, const HitscanRule& rule, const char* quantity) {
  const auto found = std::find_if(tests.begin(), tests.end(), [&](const HitscanMomentTest& t) {
    return t.rule == rule.name && t.quantity == quantity;
  });
  if (found != tests.end()) return *found;
  tests.push_back({.rule = std::string(rule.name), .quantity = quantity});
  return tests.back();
}

void judge(HitscanMomentTest& test, const HitscanSpread& spread, double unit,
           const std::optional<HitscanMoments>& theory, const Interval& allowed) {
  if (spread.count == 0) return;
  ++test.cells;
  if (!allowed.contains(spread.least) || !allowed.contains(spread.most)) ++test.out_of_bounds;
  constexpr std::int64_t enough = 50;  // for a mean to be normal
  if (!theory || theory->sigma <= 0 || spread.count < enough) return;
  ++test.judged;
  const double residual =
      (mean(spread, unit) - theory->mean) / (theory->sigma / std::sqrt(static_cast<double>(spread.count)));
  test.chi_square += residual * residual;
}

/// [s] What the moment of a report can be after first contact, which is within the window.
Interval possible_lateness(const HitscanLine& line) {
  const HitscanCell& c = line.cell;
  const HitscanWindow window = contact_window(c);
  const double across = window.until - window.from;
  switch (line.rule.report) {
    case ReportTime::firing: return {-window.until, -window.from};
    case ReportTime::end_of_step:  // a ray of a step may be some of the next step long, as the bullet slows down
      return {c.step - dragged_time(c.drag, c.step) - across, c.step + across};
    case ReportTime::in_step: break;
  }
  return {-across, across};
}

}  // namespace

std::string_view known_name(const HitscanCell& c) {
  for (const KnownShot& known : known_shots) {
    if (known.cell == c) return known.name;
  }
  return {};
}

std::optional<double> missed_share(const HitscanLine& line) { return quotient(line.tally.missed, line.tally.touching); }
std::optional<double> missed_share_theory(const HitscanLine& line) {
  return quotient(line.expected.missed, line.expected.touch);
}
std::optional<double> false_share(const HitscanLine& line) {
  return quotient(line.tally.false_hits, line.tally.reported());
}
std::optional<double> false_share_theory(const HitscanLine& line) {
  return quotient(line.expected.false_hits, line.expected.reported);
}

std::optional<double> mean_lateness(const HitscanLine& line) {
  return mean_of(line.tally.lateness, time_unit(line.cell));
}
std::optional<double> mean_point_error(const HitscanLine& line) {
  return mean_of(line.tally.point_error, length_unit(line.cell));
}
double mean_path_error(const HitscanLine& line) { return mean(line.tally.path_error, length_unit(line.cell)); }

std::vector<HitscanLine> make_hitscan_lines(const std::vector<HitscanCell>& cells,
                                            const std::vector<HitscanRule>& rules,
                                            const std::vector<std::vector<HitscanTally>>& tallies) {
  std::vector<HitscanLine> lines;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (std::size_t k = 0; k < rules.size(); ++k) {
      lines.push_back({cells[i], rules[k], expected_of(rules[k], cells[i]), tallies[i][k]});
    }
  }
  return lines;
}

std::vector<CellCount> counts_of(const std::vector<HitscanLine>& lines) {
  std::vector<CellCount> counts;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const HitscanTally& t = lines[i].tally;
    const HitscanExpected& e = lines[i].expected;
    const std::string rule(lines[i].rule.name);
    if (i == 0 || lines[i - 1].cell != lines[i].cell) {
      counts.push_back({"exact arc", "touching", t.shots, t.touching, e.touch});
    }
    counts.push_back({rule, "reported", t.shots, t.reported(), e.reported});
    counts.push_back({rule, "missed", t.shots, t.missed, e.missed});
    counts.push_back({rule, "false", t.shots, t.false_hits, e.false_hits});
  }
  return counts;
}

bool HitscanMomentTest::passed() const {
  return out_of_bounds == 0 && (judged == 0 || chi_square_allowed.contains(chi_square));
}

std::vector<HitscanMomentTest> moment_tests(const std::vector<HitscanLine>& lines) {
  std::vector<HitscanMomentTest> tests;
  for (const HitscanLine& line : lines) {
    const HitscanCell& c = line.cell;
    const double rounding = 64 * std::numeric_limits<double>::epsilon() * (c.range + length_unit(c));
    const double least = line.rule.path == FlightPath::line ? deflection(c) : 0;  // the ray's is the same in every shot
    judge(test_of(tests, line.rule, "path error"), line.tally.path_error, length_unit(c), line.expected.path_error,
          {least - rounding, line.expected.path_error_most + rounding});
    judge(test_of(tests, line.rule, "lateness"), line.tally.lateness, time_unit(c), line.expected.lateness,
          possible_lateness(line));
  }
  for (HitscanMomentTest& test : tests) {
    if (test.judged > 0) test.chi_square_allowed = chi_square_range(test.judged, 0.999);
  }
  return tests;
}

}  // namespace thinwall
