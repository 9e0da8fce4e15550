/// Queries of the experiment that once missed the accuracy contract, each of them alone.

#include <gtest/gtest.h>

#include <string_view>

#include <thinwall/experiments/accuracy/model.hpp>

namespace thinwall {
namespace {

AccuracyTally ask(std::string_view pair_name, Inquiry inquiry, std::int64_t number) {
  for (const AccuracyPair& pair : accuracy_pairs()) {
    if (pair.name == pair_name) return pair.ask(inquiry, 0, number, 1);
  }
  ADD_FAILURE() << "no pair is called " << pair_name;
  return {};
}

TEST(AccuracyHardQueries, graze_in_turned_axes_is_asked_again) {
  EXPECT_LE(ask("capsule_obb", Inquiry::verdicts, 4139).largest_wrong, 1);
}

TEST(AccuracyHardQueries, turned_axes_lose_nothing_of_the_time) {
  for (const std::int64_t number : {23856, 55465}) {
    const AccuracyTally tally = ask("obb_obb", Inquiry::in_double, number);
    ASSERT_EQ(tally.hits, 1) << number;
    EXPECT_LE(tally.forward.largest(), 4) << number;
  }
  const AccuracyTally tally = ask("capsule_obb", Inquiry::in_double, 5567);
  ASSERT_EQ(tally.hits, 1);
  EXPECT_LE(tally.forward.largest(), 4);
}

}  // namespace
}  // namespace thinwall
