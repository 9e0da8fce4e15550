/// The precision ladder's truth and theory: known separations, and a self-test that fails a wrong theory.
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/experiments/extremes/theory.hpp>
#include <thinwall/experiments/extremes/truth.hpp>

#include "experiments/extremes_run.hpp"

namespace thinwall {
namespace {

template <class A, class B> double margin_of(const Moving<A>& a, const Moving<B>& b) {
  const auto problem = oracle::pose<Digits110>(a, b);
  return static_cast<double>(least_margin<Digits110>(problem, ldexp(Digits110(1), -140), ldexp(Digits110(1), -60)));
}

/// One passes over the other, `height` above its center: contact below 2.
TEST(ExtremeTruth, margin_is_the_least_separation_over_its_scale) {
  const Sphere<double> ball = {{0, 0, 0}, 1};
  const Aabb<double> box = {{0, 0, 0}, {1, 1, 1}};
  for (const double height : {1.0, 1.75, 2.0, 3.0}) {
    const double margin = (height - 2) / (height + 2);  // over |n|.(|c| + h) + R
    const Moving above = {moved(ball, Vec3<double>(-4, height, 0)), Vec3<double>(8, 0, 0)};
    EXPECT_NEAR(margin_of(above, at_rest(ball)), margin, 1e-3 * std::abs(margin) + 1e-15) << height;
    const Moving boxed = {moved(box, Vec3<double>(-4, height, 0)), Vec3<double>(8, 0, 0)};
    EXPECT_NEAR(margin_of(boxed, at_rest(box)), margin, 1e-3 * std::abs(margin) + 1e-15) << height;
  }
}

TEST(ExtremeTruth, judges_a_time_by_how_late_and_by_how_deep) {
  const Sphere<double> ball = {{0, 0, 0}, 1};
  const Moving a = {moved(ball, Vec3<double>(-4, 0, 0)), Vec3<double>(4, 0, 0)};
  const auto b = at_rest(ball);
  Truth truth(a, b, Digits110(0.5 - 0x1p-30));
  ASSERT_EQ(truth.verdict(), oracle::Verdict::hit);
  const double u = 0x1p-53;
  // At t = 1/2, kappa t = (4 + 2 + 2) / 4 = 2.
  const AnswerErrors late = truth.errors({ToiStatus::hit, 1, 0.5 + 8 * u});
  EXPECT_NEAR(late.forward.value(), 4, 1e-6);
  EXPECT_NEAR(late.backward.value(), 4, 1e-6);
  EXPECT_FALSE(late.wrong);
  const AnswerErrors missed = truth.errors({ToiStatus::apart, 1});
  EXPECT_TRUE(missed.wrong);
  EXPECT_GT(missed.wrongness, 1e14);
}

bool all_passed(const std::vector<LadderTest>& tests) {
  return std::all_of(tests.begin(), tests.end(), [](const LadderTest& t) { return t.passed(); });
}

TEST(ExtremeTheory, holds_in_every_precision) {
  for (const std::size_t precision : {in_float, in_double, in_long_double}) {
    const auto tests = ladder_tests(loss_lines(precision));
    EXPECT_EQ(tests.size(), 7U);
    for (const LadderTest& t : tests) EXPECT_TRUE(t.passed()) << t.what << " " << t.measured << " at " << t.where;
  }
}

TEST(ExtremeTheory, fails_a_wrong_theory) {
  const std::vector<ExtremeLine> lines = loss_lines(in_double, {10, 100, 1000});
  EXPECT_TRUE(all_passed(ladder_tests(lines)));
  EXPECT_FALSE(all_passed(ladder_tests(lines, {.exponent = 1}))) << "as if it lost u d/R";
  EXPECT_FALSE(all_passed(ladder_tests(lines, {.exponent = 3})));
  EXPECT_FALSE(all_passed(ladder_tests(lines, {.most = 1}))) << "as if only one operation rounded";
}

/// The contract is not so wide that anything keeps it.
TEST(ExtremeTheory, fails_a_closed_form_that_is_the_textbooks) {
  std::vector<ExtremeLine> lines = loss_lines(in_double, {1000});
  std::erase_if(lines, [](const ExtremeLine& line) { return line.tally.method == "closed_form"; });
  lines.at(0).tally.method = "closed_form";
  EXPECT_FALSE(all_passed(ladder_tests(lines)));
}

/// Verdicts that go wrong a hundred times too near are not the theory's.
TEST(ExtremeTheory, knows_where_the_textbooks_verdicts_go_wrong) {
  std::vector<ExtremeLine> lines = loss_lines(in_float, {10, 1e4, 1e5});
  EXPECT_TRUE(all_passed(ladder_tests(lines)));
  for (ExtremeLine& line : lines) {
    if (line.place.value == 10 && line.tally.method == "textbook") line.tally.far_wrong = line.tally.queries;
  }
  EXPECT_FALSE(all_passed(ladder_tests(lines)));
  for (ExtremeLine& line : lines) line.tally.far_wrong = 0;
  EXPECT_FALSE(all_passed(ladder_tests(lines))) << "as if it never went wrong";
}

}  // namespace
}  // namespace thinwall
