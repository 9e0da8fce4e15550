#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include <thinwall/experiments/lab/runner.hpp>
#include <thinwall/experiments/lab/settings.hpp>

namespace thinwall {
namespace {

int computed = 0;  // by this process

std::string compute() {
  ++computed;
  return "";
}

std::string compute_forever() {
  for (volatile bool forever = true; forever;) continue;
  return "";
}

/// Ten units that trials cut, and some that they do not.
class UnevenRun final : public Run {
 public:
  UnevenRun(std::int64_t trials, std::vector<Unit> whole, std::string (*work)() = compute)
      : trials_(trials), whole_(std::move(whole)), work_(work) {}

  std::vector<Unit> units() const override {
    std::vector<Unit> units = whole_;
    for (int i = 0; i < 10; ++i) units.push_back({"cut " + std::to_string(i), trials_, work_});
    return units;
  }
  Outcome finish(const std::vector<std::string>&, const std::vector<double>&) const override { return {}; }

 private:
  std::int64_t trials_;
  std::vector<Unit> whole_;
  std::string (*work_)();
};

RunEstimate estimate_of(std::int64_t trials, const std::vector<Unit>& whole, double budget) {
  return estimate(
      UnevenRun(trials, whole).units(), [&](std::int64_t fewer) { return std::make_unique<UnevenRun>(fewer, whole); },
      budget);
}

TEST(Estimate, is_made_from_few_trials_and_by_another_process) {
  computed = 0;
  const RunEstimate told = estimate_of(std::int64_t(1) << 60, {{"whole", 3, compute}}, 0.2);
  EXPECT_EQ(computed, 0);
  EXPECT_EQ(told.unknown, 0);
  EXPECT_EQ(told.cut_tried, 10);
  EXPECT_EQ(told.whole, 1);
  EXPECT_EQ(told.whole_tried, 1);
  EXPECT_GT(told.seconds, 0);
}

TEST(Estimate, ends_where_a_unit_does_not) {
  const RunEstimate told =
      estimate_of(100, {{"endless", 3, compute_forever}, {"a", 1, compute}, {"b", 2, compute}}, 0.5);
  EXPECT_EQ(told.cut_tried, 10);
  EXPECT_EQ(told.whole, 3);
  EXPECT_EQ(told.whole_tried, 2);  // those of few trials come first
  EXPECT_EQ(told.unknown, 1);
  EXPECT_TRUE(basis_text(told).ends_with(", 2 of 3 units tried whole, 1 unit too long to try")) << basis_text(told);
}

TEST(Estimate, says_what_it_knows_nothing_of) {
  const RunEstimate told = estimate_of(100, {{"endless", 3, compute_forever}}, 0.2);
  EXPECT_EQ(told.unknown, 1);
  EXPECT_TRUE(basis_text(told).ends_with(", 1 unit too long to try")) << basis_text(told);
  const auto endless = [](std::int64_t trials) {
    return std::make_unique<UnevenRun>(trials, std::vector<Unit>(), compute_forever);
  };
  EXPECT_EQ(basis_text(estimate(endless(100)->units(), endless, 0.05)), "10 units too long to try");
}

TEST(Estimate, tries_no_unit_that_says_how_long_it_takes) {
  const auto tried = []() -> std::string { throw std::logic_error("it was tried"); };
  const RunEstimate told = estimate_of(1, {{"a", 1, tried, 3}, {"b", 1, tried, 3}}, 0.2);
  EXPECT_EQ(told.whole_tried, 12);
  EXPECT_GE(told.seconds, 6);
}

TEST(Estimate, passes_over_trials_that_are_too_few) {
  const UnevenRun run(1000, {});
  const auto again = [](std::int64_t trials) {
    if (trials < 10) throw UsageError("too few");
    return std::make_unique<UnevenRun>(trials, std::vector<Unit>());
  };
  EXPECT_GE(estimate(run.units(), again, 0.2).trials, 16);
}

TEST(Estimate, of_a_run_of_one_trial_is_the_run_itself) {
  const RunEstimate told = estimate_of(1, {}, 0.2);
  EXPECT_EQ(told.cut_tried, 0);
  EXPECT_EQ(told.whole_tried, 10);
  EXPECT_EQ(told.unknown, 0);
}

}  // namespace
}  // namespace thinwall
