#include <thinwall/experiments/lab/judge.hpp>

#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/experiments/lab/random.hpp>

namespace thinwall {
namespace {

/// 200 cells whose true probabilities run from 0.05 to 0.85, each with its own independent shots.
std::vector<CellCount> simulated(std::uint64_t seed, double (*claimed)(double)) {
  std::vector<CellCount> cells;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const double truth = 0.05 + 0.004 * static_cast<double>(i);
    CellCount cell = {"method", "double", 500, 0, claimed(truth)};
    for (std::uint64_t shot = 0; shot < 500; ++shot)
      cell.tunneled += uniform(random_words({seed, i}, shot, 0)[0]) < truth;
    cells.push_back(cell);
  }
  return cells;
}

TEST(SelfTest, passes_what_is_true) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto tests = self_test(simulated(seed, [](double truth) { return truth; }));
    ASSERT_EQ(tests.size(), 1U);
    EXPECT_EQ(tests[0].judged_cells, 200);
    EXPECT_TRUE(tests[0].passed()) << "seed " << seed << ": covered " << tests[0].covered << ", chi-square "
                                   << tests[0].chi_square;
  }
}

TEST(SelfTest, fails_a_theory_that_is_five_percent_off) {
  EXPECT_FALSE(all_passed(self_test(simulated(1, [](double truth) { return 1.05 * truth; }))));
}

/// Phases spread evenly by mistake give counts that agree too well.
TEST(SelfTest, fails_counts_that_are_too_good) {
  auto cells = simulated(1, [](double truth) { return truth; });
  for (CellCount& cell : cells) cell.tunneled = std::llround(500 * cell.theory);
  const auto tests = self_test(cells);
  EXPECT_EQ(tests[0].covered, 200);
  EXPECT_FALSE(tests[0].passed());
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
  EXPECT_EQ(tests[2].method, "b");
}

TEST(SelfTest, table_has_a_value_for_every_column) {
  const Table table = self_test_table(self_test(simulated(1, [](double truth) { return truth; })));
  ASSERT_EQ(table.rows.size(), 1U);
  EXPECT_EQ(table.rows[0].size(), table.columns.size());
}

}  // namespace
}  // namespace thinwall
