#include <thinwall/experiments/lab/statistics.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <gtest/gtest.h>
#include <boost/math/distributions/binomial.hpp>

namespace thinwall {
namespace {

/// 10 of 100, by hand with z = 1.959963984540054.
TEST(Wilson, agrees_with_its_formula) {
  const Interval interval = wilson(10, 100);
  EXPECT_NEAR(interval.lower, 0.0552291370606751, 1e-14);
  EXPECT_NEAR(interval.upper, 0.17436566150491345, 1e-14);
}

/// The ends of the interval are the probabilities for which the count is 1.96 standard errors away.
TEST(Wilson, ends_are_a_normal_quantile_away) {
  const Interval interval = wilson(37, 1000);
  EXPECT_NEAR(standard_residual(37, 1000, interval.lower), 1.959963984540054, 1e-10);
  EXPECT_NEAR(standard_residual(37, 1000, interval.upper), -1.959963984540054, 1e-10);
}

TEST(Wilson, is_exact_at_the_ends) {
  for (const std::int64_t n : {1, 2, 3, 7, 10, 1000, 12345, 200000, 1000000007}) {
    EXPECT_EQ(wilson(0, n).lower, 0);
    EXPECT_EQ(wilson(n, n).upper, 1);
    EXPECT_GT(wilson(0, n).upper, 0);
    EXPECT_LT(wilson(n, n).lower, 1);
  }
}

TEST(ClopperPearson, bounds_what_was_never_seen) {
  const Interval none = clopper_pearson(0, 200000);
  EXPECT_EQ(none.lower, 0);
  EXPECT_NEAR(none.upper, 1.84442e-5, 1e-10);
  EXPECT_NEAR(none.upper, 1 - std::pow(0.025, 1.0 / 200000), 1e-15);
  EXPECT_EQ(clopper_pearson(200000, 200000).upper, 1);
  EXPECT_NEAR(clopper_pearson(200000, 200000).lower, std::pow(0.025, 1.0 / 200000), 1e-12);
}

/// By definition: at the ends, a count this extreme has probability 2.5 %.
TEST(ClopperPearson, ends_leave_the_tails_of_the_binomial) {
  const Interval interval = clopper_pearson(3, 50);
  using boost::math::binomial;
  EXPECT_NEAR(1 - cdf(binomial(50, interval.lower), 2), 0.025, 1e-10);
  EXPECT_NEAR(cdf(binomial(50, interval.upper), 3), 0.025, 1e-10);
}

/// Summed over all counts, not simulated: Wilson is near .95, Clopper-Pearson never below.
TEST(Intervals, cover_as_promised) {
  for (const double p : {0.001, 0.01, 0.1, 0.5}) {
    const boost::math::binomial counts(2000, p);
    double wilson_covers = 0, clopper_pearson_covers = 0;
    for (std::int64_t k = 0; k <= 2000; ++k) {
      const double weight = pdf(counts, static_cast<double>(k));
      if (weight < 1e-14) continue;
      if (wilson(k, 2000).contains(p)) wilson_covers += weight;
      if (clopper_pearson(k, 2000).contains(p)) clopper_pearson_covers += weight;
    }
    EXPECT_NEAR(wilson_covers, 0.95, 0.02) << p;
    EXPECT_GE(clopper_pearson_covers, 0.95) << p;
  }
}

TEST(Ranges, leave_no_more_than_the_tails) {
  const Interval range = binomial_range(100, 0.95, 0.999);
  const boost::math::binomial counts(100, 0.95);
  EXPECT_LE(cdf(counts, range.lower - 1), 0.0005);
  EXPECT_GT(cdf(counts, range.lower + 1), 0.0005);
  EXPECT_LE(1 - cdf(counts, range.upper), 0.0005);
  EXPECT_GT(1 - cdf(counts, range.upper - 2), 0.0005);
}

/// The sum of two squared standard normals is exponential: its quantile is -2 ln(1 - p).
TEST(Ranges, chi_square_of_two_is_exponential) {
  const Interval range = chi_square_range(2, 0.999);
  EXPECT_NEAR(range.lower, -2 * std::log(1 - 0.0005), 1e-12);
  EXPECT_NEAR(range.upper, -2 * std::log(0.0005), 1e-10);
}

TEST(Quantiles, are_values_of_the_list) {
  const std::vector<double> values = {3, 1, 2, 4};
  EXPECT_EQ(median(values), 2.5);
  EXPECT_EQ(median(std::vector<double>{5, 1, 3}), 3);
  EXPECT_EQ(quantile(values, 0.5), 2);
  EXPECT_EQ(quantile(values, 0.51), 3);
  EXPECT_EQ(quantile(values, 1), 4);
  EXPECT_EQ(quantile(values, 1e-9), 1);
  EXPECT_TRUE(std::isinf(quantile(std::vector<double>{1, std::numeric_limits<double>::infinity()}, 1)));
}

/// The median of an exponential variable is ln 2. The percentile bootstrap of 25 values covers it nearly as often as it says.
TEST(Bootstrap, covers_the_median) {
  int covered = 0;
  constexpr int lists = 400;
  for (std::uint64_t k = 0; k < lists; ++k) {
    std::vector<double> values;
    for (std::uint64_t i = 0; i < 25; ++i) values.push_back(-std::log(1 - uniform(random_words({7, k}, i, 0)[0])));
    const Interval interval = bootstrap_median(values, {8, k});
    EXPECT_LE(interval.lower, median(values));
    EXPECT_GE(interval.upper, median(values));
    covered += interval.contains(std::log(2.0)) ? 1 : 0;
  }
  EXPECT_GT(covered, 0.91 * lists);
  EXPECT_LT(covered, 0.99 * lists);
}

TEST(StandardResidual, counts_standard_errors) {
  EXPECT_DOUBLE_EQ(standard_residual(60, 100, 0.5), 2);
  EXPECT_DOUBLE_EQ(standard_residual(40, 100, 0.5), -2);
}

}  // namespace
}  // namespace thinwall
