#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <boost/math/distributions/binomial.hpp>

#include <thinwall/experiments/lab/judge.hpp>
#include <thinwall/experiments/lab/random.hpp>
#include <thinwall/experiments/lab/statistics.hpp>

#include "support/experiment_run.hpp"
#include "support/thorough.hpp"

namespace thinwall {

namespace {

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

/// 200 cells whose true probabilities run from 0.05 to 0.85, each with its own independent shots.
std::vector<CellCount> simulated(std::uint64_t seed, double (*claimed)(double)) {
  std::vector<CellCount> cells;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const double truth = 0.05 + 0.004 * static_cast<double>(i);
    CellCount cell = {"method", "double", 500, 0, claimed(truth)};
    for (std::uint64_t shot = 0; shot < 500; ++shot)
      cell.counted += uniform(random_words({seed, i}, shot, 0)[0]) < truth;
    cells.push_back(cell);
  }
  return cells;
}

/// 30 methods each of 40 cells: judged one by one, 2 in 1000 each, a right run would fail every 17 times.
TEST(SelfTest, passes_a_right_run_of_many_methods_999_times_in_1000) {
  constexpr int runs = testing::slow_build ? 50 : 1000;
  std::mt19937_64 random(20261123);
  int failed = 0;
  for (int run = 0; run < runs; ++run) {
    std::vector<CellCount> cells;
    for (int method = 0; method < 30; ++method) {
      for (int cell = 0; cell < 40; ++cell) {
        const double theory = 0.02 + 0.96 * cell / 40;
        cells.push_back(
            {std::to_string(method), "double", 500, std::binomial_distribution(500, theory)(random), theory});
      }
    }
    failed += all_passed(self_test(cells)) ? 0 : 1;
  }
  EXPECT_LE(failed, 5);  // more than 5 of 1000 at 1 in 1000: 6 in 10 000
}

TEST(SelfTest, fails_a_theory_that_is_five_percent_off) {
  EXPECT_FALSE(all_passed(self_test(simulated(1, [](double truth) { return 1.05 * truth; }))));
}

/// So many of 200 cells with one residual, all others with another: whether the self-test passes, and the test of residuals alone.
std::pair<bool, bool> passed(int far, double residual, double other) {
  std::vector<CellCount> cells;
  ResidualTest alone;
  for (int i = 0; i < 200; ++i) {
    alone.add(i < far ? residual : other);
    cells.push_back({"method", "double", 10000, 5000 + std::llround(50 * (i < far ? residual : other)), 0.5});
  }
  const SelfTest test = self_test(cells)[0];
  EXPECT_EQ(test.chi_square_allowed.upper, chi_square_range(200, 1 - 0.001 / 2).upper);
  return {test.passed(), alone.passed()};
}

TEST(SelfTest, fails_residuals_that_spread_as_no_normal_numbers_do) {
  EXPECT_EQ(passed(10, 2.1, 0.9), std::pair(true, true));
  EXPECT_EQ(passed(40, 2.1, 0.3), std::pair(false, true)) << "too many intervals without the theory";
  EXPECT_EQ(passed(10, -2.1, 0.1), std::pair(false, false)) << "too good: phases spread evenly by mistake";
  EXPECT_EQ(passed(10, 6, 0.9), std::pair(false, false)) << "too far off";
}

TEST(SelfTest, wants_certain_counts_to_be_exact) {
  EXPECT_TRUE(all_passed(self_test({{"m", "double", 1000, 0, 0}, {"m", "double", 1000, 1000, 1}})));
  EXPECT_FALSE(all_passed(self_test({{"m", "double", 1000, 1, 0}})));
  EXPECT_FALSE(all_passed(self_test({{"m", "double", 1000, 999, 1}})));
}

TEST(SelfTest, judges_no_cell_with_fewer_than_five_expected) {
  const auto tests = self_test({{"m", "double", 1000, 40, 0.0049}, {"m", "double", 1000, 0, 0.9951}});
  EXPECT_EQ(tests[0].other_cells, 2);
  EXPECT_EQ(tests[0].judged_cells, 0);
  EXPECT_TRUE(tests[0].passed());
  EXPECT_TRUE(can_be_judged(1000, 0.005));
  EXPECT_TRUE(can_be_judged(1000, 0.995));
}

TEST(SelfTest, keeps_methods_and_scalars_apart) {
  const auto tests = self_test({{"a", "float", 10, 0, 0}, {"a", "double", 10, 1, 0}, {"b", "float", 10, 0, 0}});
  ASSERT_EQ(tests.size(), 3U);
  EXPECT_TRUE(tests[0].passed());
  EXPECT_FALSE(tests[1].passed());
  EXPECT_EQ(tests[2].name, "b");
}

TEST(SelfTest, names_the_cell_that_is_farthest_off_where_it_fails) {
  const auto text = [](const std::vector<CellCount>& cells) { return self_test_text(self_test(cells)); };
  EXPECT_TRUE(
      holds(text({{"m", "double", 1000, 500, 0.5}, {"m", "double", 1000, 400, 0.5}, {"m", "double", 1000, 530, 0.5}}),
            "FAILED; farthest off is a cell with 400 of 1000 where 500 are expected"));
  EXPECT_TRUE(holds(text({{"m", "double", 1000, 400, 0.5}, {"m", "double", 90, 0, 0}, {"m", "double", 80, 2, 0}}),
                    "with 2 of 80 where 0 are expected"));
  EXPECT_FALSE(holds(text({{"m", "double", 1000, 512, 0.5}, {"m", "double", 10, 0, 0}}), "farthest"));
}

/// A known answer of Philox4x64-10, from the file kat_vectors of Random123, and one with every part of key and counter.
TEST(Random, words_are_philox_at_key_and_counter) {
  EXPECT_EQ(random_words({0, 0}, 0, 0),
            (RandomWords{0x16554d9eca36314c, 0xdb20fe9d672d0fdc, 0xd7e772cee186176b, 0x7e68b68aec7ba23b}));
  const auto words = r123::Philox4x64()({{5, 6, 0, 0}}, {{3, 4}});
  EXPECT_EQ(random_words({3, 4}, 5, 6), (RandomWords{words[0], words[1], words[2], words[3]}));
}

TEST(Random, uniform_reaches_zero_but_not_one) {
  EXPECT_EQ(uniform(0), 0);
  EXPECT_EQ(uniform(std::numeric_limits<std::uint64_t>::max()), 1 - 0x1p-53);
  EXPECT_EQ(uniform(std::uint64_t(1) << 63), 0.5);
}

/// Each word of the block on its own.
TEST(Random, uniform_is_uniform) {
  for (std::size_t word = 0; word < 4; ++word) {
    SCOPED_TRACE(word);
    expect_uniform(64, 128000, [&](std::uint64_t trial) { return uniform(random_words({7, 11}, trial, 0)[word]); });
  }
}

TEST(Random, streams_differ_in_every_factor_and_not_in_the_sign_of_zero) {
  const auto stream = [](std::vector<double> factors) { return stream_of(factors); };
  std::vector<std::uint64_t> streams = {stream({}),     stream({0}),    stream({0, 0}), stream({1, 0}),
                                        stream({0, 1}), stream({1, 2}), stream({2, 1}), stream({1, 2 + 0x1p-51})};
  std::sort(streams.begin(), streams.end());
  EXPECT_EQ(std::adjacent_find(streams.begin(), streams.end()), streams.end());
  EXPECT_EQ(stream({-0.0}), stream({0.0}));
  EXPECT_EQ(stream({}), 0xcbf29ce484222325);  // FNV-1a of nothing is its offset basis
}

}  // namespace

}  // namespace thinwall
