#include <thinwall/experiments/bouncing/line.hpp>

#include <algorithm>
#include <cmath>

namespace thinwall {

namespace {

constexpr double normal_95 = 1.959963984540054, central = 0.999;
constexpr std::int64_t least_for_mean = 30, least_for_spread = 100;

void add(BounceTest& test, const BounceLine& line) {
  const double expected = line.theory.mean(), rounding = rounding_of(line.cell);
  if (is_certain(line)) {
    ++test.certain_cells;
    const double allowed = rounding + 4 * line.theory.sigma();
    if (!(line.tally.most - expected <= allowed && expected - line.tally.least <= allowed)) ++test.certain_wrong;
    return;
  }
  const auto mean = mean_residual(line), spread = variance_residual(line);
  if (line.tally.trials < least_for_mean || !mean) {
    ++test.other_cells;
    return;
  }
  ++test.judged_cells;
  test.mean_chi_square += *mean * *mean;
  if (std::abs(*mean) <= normal_95) ++test.covered;
  if (!spread) return;
  ++test.spread_cells;
  test.spread_chi_square += *spread * *spread;
}

}  // namespace

double standard_error(const BounceLine& line) {
  return line.theory.sigma() / std::sqrt(static_cast<double>(line.tally.trials));
}

Interval mean_interval(const BounceLine& line) {
  const double half = normal_95 * line.tally.sigma() / std::sqrt(static_cast<double>(line.tally.trials));
  return {line.tally.mean - half, line.tally.mean + half};
}

bool is_certain(const BounceLine& line) { return line.theory.sigma() <= rounding_of(line.cell); }

std::optional<double> mean_residual(const BounceLine& line) {
  if (is_certain(line)) return std::nullopt;
  const double difference = line.tally.mean - line.theory.mean();
  const double beyond = std::max(0.0, std::abs(difference) - rounding_of(line.cell));
  return std::copysign(beyond / standard_error(line), difference);
}

std::optional<double> variance_residual(const BounceLine& line) {
  if (is_certain(line) || line.tally.trials < least_for_spread) return std::nullopt;
  const double n = static_cast<double>(line.tally.trials), s = line.tally.sigma() / line.theory.sigma();
  return (s * s - 1) / std::sqrt((line.theory.kurtosis() - (n - 3) / (n - 1)) / n);
}

std::vector<BounceLine> make_bounce_lines(const std::vector<BounceCell>& cells,
                                          const std::vector<BouncePolicy>& policies,
                                          const std::vector<BounceTally>& tallies) {
  std::vector<BounceLine> lines;
  lines.reserve(tallies.size());
  for (const BounceCell& cell : cells) {
    for (const BouncePolicy& policy : policies) {
      lines.push_back(
          {cell, policy.name, bounce_theory(policy.name, delta(cell), cell.restitution), tallies[lines.size()]});
    }
  }
  return lines;
}

bool BounceTest::passed() const {
  return certain_wrong == 0 &&
         (judged_cells == 0 ||
          (covered_allowed.contains(static_cast<double>(covered)) && mean_allowed.contains(mean_chi_square))) &&
         (spread_cells == 0 || spread_allowed.contains(spread_chi_square));
}

std::vector<BounceTest> bounce_tests(const std::vector<BounceLine>& lines) {
  std::vector<BounceTest> tests;
  for (const BounceLine& line : lines) {
    auto found = std::find_if(tests.begin(), tests.end(), [&](const BounceTest& t) { return t.policy == line.policy; });
    if (found == tests.end()) {
      tests.emplace_back().policy = line.policy;
      found = tests.end() - 1;
    }
    add(*found, line);
  }
  for (BounceTest& test : tests) {
    if (test.judged_cells > 0) {
      test.covered_allowed = binomial_range(test.judged_cells, 0.95, central);
      test.mean_allowed = chi_square_range(test.judged_cells, central);
    }
    if (test.spread_cells > 0) test.spread_allowed = chi_square_range(test.spread_cells, central);
  }
  return tests;
}

bool all_passed(const std::vector<BounceTest>& tests) {
  return std::all_of(tests.begin(), tests.end(), [](const BounceTest& t) { return t.passed(); });
}

}  // namespace thinwall
