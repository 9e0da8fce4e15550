#include <thinwall/experiments/crossing_bullets/line.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <thinwall/swept/methods.hpp>

namespace thinwall {

namespace {

/// [m] How well double holds the gap of a cell: a few coordinates as large as the paths, the disc and the balls.
double resolution(const Crossing& c) {
  const double size = 2 * faster_path(c).norm() + (2 * c.offset + 2) * contact_distance(c);
  return 16 * std::numeric_limits<double>::epsilon() * size;
}

}  // namespace

std::optional<double> missed_share(const CrossingLine& line) {
  if (line.tally.touching == 0) return std::nullopt;
  return static_cast<double>(line.tally.missed) / static_cast<double>(line.tally.touching);
}

std::optional<double> missed_share_theory(const CrossingLine& line) {
  if (!line.expected.missed) return std::nullopt;
  return *line.expected.missed / line.theory.touch;
}

std::optional<double> mean_lateness(const CrossingLine& line) {
  if (line.tally.timed == 0) return std::nullopt;
  return std::ldexp(static_cast<double>(line.tally.lateness), -32) / static_cast<double>(line.tally.timed);
}

std::optional<double> lateness_residual(const CrossingLine& line) {
  if (line.rule != SweepThenConfirm<double>::name || line.tally.timed < 50 ||
      line.theory.confirmed.lateness_sigma <= 0) {
    return std::nullopt;
  }
  const double error = line.theory.confirmed.lateness_sigma / std::sqrt(static_cast<double>(line.tally.timed));
  return (*mean_lateness(line) - line.theory.confirmed.lateness_mean) / error;
}

std::vector<CrossingLine> make_lines(const std::vector<Crossing>& cells, const std::vector<CrossingRule>& rules,
                                     const std::vector<CrossingTally>& tallies) {
  std::vector<CrossingLine> lines;
  lines.reserve(tallies.size());
  for (const Crossing& cell : cells) {
    const CrossingTheory theory = theory_of(cell);
    for (const CrossingRule& rule : rules) {
      lines.push_back({cell, rule.name, theory, rule.expects(theory), tallies[lines.size()]});
    }
  }
  return lines;
}

std::vector<CellCount> counts_of(const std::vector<CrossingLine>& lines) {
  std::vector<CellCount> counts;
  const auto add = [&](const CrossingLine& line, const std::string& rule, const char* event, std::int64_t count,
                       const std::optional<double>& theory) {
    if (theory) counts.push_back({rule, event, line.tally.shots, count, *theory});
  };
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const CrossingLine& line = lines[i];
    const bool first_of_cell = i == 0 || lines[i - 1].crossing != line.crossing;
    if (first_of_cell) add(line, "exact motion", "touching", line.tally.touching, line.theory.touch);
    add(line, line.rule, "reported", line.tally.reported(), line.expected.reported);
    add(line, line.rule, "missed", line.tally.missed, line.expected.missed);
    add(line, line.rule, "false", line.tally.false_hits, line.expected.false_hits);
  }
  return counts;
}

bool TimingTest::passed() const {
  return apart == 0 && wrong_time == 0 && (judged == 0 || chi_square_allowed.contains(chi_square));
}

std::vector<TimingTest> timing_test(const std::vector<CrossingLine>& lines) {
  std::vector<TimingTest> tests;
  for (const CrossingLine& line : lines) {
    if (!line.expected.reported || line.tally.timed == 0) continue;
    auto found = std::find_if(tests.begin(), tests.end(), [&](const TimingTest& t) { return t.rule == line.rule; });
    if (found == tests.end()) {
      tests.emplace_back().rule = line.rule;
      found = tests.end() - 1;
    }
    const double rounding = resolution(line.crossing);
    ++found->cells;
    if (line.tally.widest > rounding) ++found->apart;
    const bool exact = line.rule == ClosedForm<double>::name;
    const double latest = longest_contact(line.crossing) + rounding / relative_path(line.crossing).norm();
    if (exact ? line.tally.deepest < -rounding : line.tally.latest > latest) ++found->wrong_time;
    if (const auto residual = lateness_residual(line)) {
      ++found->judged;
      found->chi_square += *residual * *residual;
    }
  }
  for (TimingTest& test : tests) {
    if (test.judged > 0) test.chi_square_allowed = chi_square_range(test.judged, 0.999);
  }
  return tests;
}

}  // namespace thinwall
