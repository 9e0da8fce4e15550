#include <thinwall/experiments/bouncing/theory.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <boost/math/quadrature/gauss.hpp>

namespace thinwall {

namespace {

BounceTheory operator+(const BounceTheory& a, const BounceTheory& b) { return {a.c0 + b.c0, a.c1 + b.c1, a.c2 + b.c2}; }
BounceTheory operator*(double factor, const BounceTheory& t) { return {factor * t.c0, factor * t.c1, factor * t.c2}; }

/// Speed after: e (V + g h u / 2), which the flight has half a step later than Euler says, so it has lost g h / 2.
BounceTheory late_speed(double delta, double e) { return {delta / 4 - e, e * e - e * delta / 2, e * e * delta / 4}; }

/// What the depth at the end of the step is worth: V s + g s^2 / 2 with s = (1 + u) h / 2.
BounceTheory depth(double delta) { return {1 + delta / 4, 1 + delta / 2, delta / 4}; }

constexpr double normal_95 = 1.959963984540054;
constexpr std::int64_t least_for_mean = 30, least_for_spread = 100;

/// Phases differ by no more than rounding: every bounce is the same.
bool is_certain(const BounceRow& row) { return row.theory.sigma() <= rounding_of(row.cell); }

void add(BounceTest& test, const BounceRow& row) {
  if (is_certain(row)) {
    const double expected = row.theory.mean(), allowed = rounding_of(row.cell) + 4 * row.theory.sigma();
    ++test.certain_cells;
    if (!(row.tally.most - expected <= allowed && expected - row.tally.least <= allowed)) ++test.certain_wrong;
    return;
  }
  const auto mean = mean_residual(row), variance = variance_residual(row);
  if (row.tally.trials < least_for_mean || !mean) {
    ++test.other_cells;
    return;
  }
  test.means.add(*mean);
  if (std::abs(*mean) <= normal_95) ++test.covered;
  if (variance) test.variances.add(*variance);
}

}  // namespace

// Moments of u, uniform on [-1, 1]: 0, 1/3, 0, 1/5.
double BounceTheory::mean() const { return c0 + c2 / 3; }
double BounceTheory::sigma() const { return std::sqrt(c1 * c1 / 3 + 4 * c2 * c2 / 45); }
double BounceTheory::kurtosis() const {
  const auto fourth = [&](double x) { return std::pow(at(x) - mean(), 4); };
  const double moment =
      boost::math::quadrature::gauss<double, 7>::integrate(fourth, -1.0, 1.0) / 2;  // exact to degree 13
  return moment / std::pow(sigma(), 4);
}

BounceTheory bounce_theory(std::string_view policy, double delta, double restitution) {
  const double e = restitution;
  if (policy == "project_flip") return late_speed(delta, e);
  if (policy == "flip_only") return late_speed(delta, e) + -1.0 * depth(delta);
  if (policy == "linear_toi") return late_speed(delta, e) + e * depth(delta);
  if (policy == "exact_project") return e * e * depth(delta);
  if (policy == "parabola_toi") return {};
  throw std::logic_error("no theory for the policy '" + std::string(policy) + "'");
}

double random_phase_mean(const BouncePolicy& policy, const BounceCell& cell, double bounces) {
  const double speed = 1 + policy.drift * delta(cell) * bounces / 2;
  return speed > 0 ? speed * speed : 0;
}

double random_phase_sigma(const BouncePolicy& policy, const BounceCell& cell, double bounces) {
  const double sigma = bounce_theory(policy.name, 0, 1).sigma();
  return std::sqrt(random_phase_mean(policy, cell, bounces) * bounces) * delta(cell) * sigma;
}

Measured measured_mean(const BounceRow& row) {
  const double half = normal_95 * row.tally.sigma() / std::sqrt(static_cast<double>(row.tally.trials));
  return {row.tally.mean, {row.tally.mean - half, row.tally.mean + half}};
}

std::optional<double> mean_residual(const BounceRow& row) {
  if (is_certain(row)) return std::nullopt;
  const double difference = row.tally.mean - row.theory.mean();
  const double beyond = std::max(0.0, std::abs(difference) - rounding_of(row.cell));
  const double standard_error = row.theory.sigma() / std::sqrt(static_cast<double>(row.tally.trials));
  return std::copysign(beyond / standard_error, difference);
}

std::optional<double> variance_residual(const BounceRow& row) {
  if (is_certain(row) || row.tally.trials < least_for_spread) return std::nullopt;
  const double n = static_cast<double>(row.tally.trials), s = row.tally.sigma() / row.theory.sigma();
  return (s * s - 1) / std::sqrt((row.theory.kurtosis() - (n - 3) / (n - 1)) / n);
}

std::optional<Interval> BounceTest::covered_allowed() const {
  return means.judged > 0 ? std::optional(binomial_range(means.judged, 0.95, 0.999)) : std::nullopt;
}

bool BounceTest::passed() const {
  const bool is_covered = means.judged == 0 || covered_allowed()->contains(static_cast<double>(covered));
  return certain_wrong == 0 && is_covered && means.passed() && variances.passed();
}

std::vector<BounceTest> bounce_tests(const std::vector<BounceRow>& rows) {
  std::vector<BounceTest> tests;
  for (const Group<BounceRow>& group : group_by(rows, &BounceRow::policy)) {
    BounceTest& test = tests.emplace_back(BounceTest{group[0]->policy});
    for (const BounceRow* row : group) add(test, *row);
  }
  return tests;
}

}  // namespace thinwall
