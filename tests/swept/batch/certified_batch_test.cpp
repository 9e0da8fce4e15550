// A table of spheres, certified: every row is proven, at every width of vector, on the worst motions.

#include <cstdio>

#include <gtest/gtest.h>

#include <thinwall/swept/certified_batch.hpp>

#include "support/batch_rows.hpp"
#include "support/certified.hpp"
#include "support/thorough.hpp"

namespace thinwall::testing {
namespace {

using Ball = Sphere<double>;

struct CertifiedAnswers {
  std::vector<ToiStatus> verdict;
  std::vector<double> lower, upper;
  explicit CertifiedAnswers(std::size_t rows) : verdict(rows), lower(rows), upper(rows) {}
  CertifiedRows rows() { return {verdict, lower, upper}; }
};

TEST(CertifiedBatch, is_proven_by_the_integers_at_every_width) {
  Shaker<double> draw(1);
  RowTable<Moving<Ball>> a, b;
  const std::size_t count = thorough(4000);
  for (std::size_t i = 0; i < count; ++i) {
    const Motion<Ball, Ball> motion = i % 2 == 0 ? worst_motion<Ball, Ball>(draw) : plain_motion<Ball, Ball>(draw);
    a.push_back(motion.a);
    b.push_back(motion.b);
  }
  for_each_target([&](const std::string& target) {
    CertifiedAnswers answers(count);
    const BatchReport report = certified_time_of_impact(a.rows(), b.rows(), answers.rows(), {2});
    std::printf("%-7s %.2f %% asked again\n", target.c_str(), 100.0 * double(report.asked_again) / double(count));
    EXPECT_LT(report.asked_again, count / 2);
    for (std::size_t i = 0; i < count && !::testing::Test::HasFailure(); ++i) {
      SCOPED_TRACE(i);
      const CertifiedToi toi{answers.verdict[i], answers.lower[i], answers.upper[i], DecidedBy::filter};
      EXPECT_EQ(toi.verdict, certified_time_of_impact(a[i], b[i]).verdict);
      EXPECT_TRUE(judge_exactly(a[i], b[i], toi));
    }
  });
}

TEST(CertifiedBatch, names_what_is_wrong) {
  RowTable<Moving<Ball>> rows;
  rows.push_back({{{0, 0, 0}, -1}, {1, 0, 0}});
  CertifiedAnswers answers(1);
  certified_time_of_impact(rows[0], rows.rows(), answers.rows());
  EXPECT_EQ(answers.verdict[0], ToiStatus::invalid);
  EXPECT_THROW(certified_time_of_impact(rows[0], rows.rows(), {answers.verdict, answers.lower, answers.lower}),
               std::invalid_argument);
}

}  // namespace
}  // namespace thinwall::testing
