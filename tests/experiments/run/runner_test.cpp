#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>

#include <thinwall/experiments/lab/journal.hpp>
#include <thinwall/experiments/lab/runner.hpp>

#include "support/temporary_folder.hpp"

namespace thinwall {
namespace {

struct RunnerTest : testing::Test {
  TemporaryFolder folder;
  std::string file = folder / "journal.tsv";
  std::atomic<int> computed = 0;

  std::vector<Unit> squares(int count) {
    std::vector<Unit> units;
    for (int i = 0; i < count; ++i) {
      units.push_back({"unit " + std::to_string(i), i + 1, [this, i] {
                         ++computed;
                         return std::to_string(i * i);
                       }});
    }
    return units;
  }
};

TEST_F(RunnerTest, keeps_the_order_of_the_units_for_any_thread_count) {
  const auto units = squares(200);
  for (const int threads : {1, 2, 3, 8}) {
    Journal journal(folder / std::to_string(threads), "the run");
    const UnitResults results = compute_units(units, journal, {.threads = threads, .stop = {}, .on_progress = {}});
    EXPECT_TRUE(results.complete);
    for (std::size_t i = 0; i < units.size(); ++i) EXPECT_EQ(results.results[i], std::to_string(i * i));
  }
}

TEST_F(RunnerTest, stops_between_units_and_goes_on_where_it_was) {
  const auto units = squares(50);
  std::size_t kept = 0;
  {
    Journal journal(file, "the run");
    const auto stop = [&] { return computed >= 20; };
    const UnitResults results = compute_units(units, journal, {.threads = 2, .stop = stop, .on_progress = {}});
    EXPECT_FALSE(results.complete);
  }
  kept = static_cast<std::size_t>(computed);
  EXPECT_GE(kept, 20u);
  EXPECT_LE(kept, 22u);
  Journal journal(file, "the run");
  std::vector<Progress> seen;
  const UnitResults results = compute_units(
      units, journal,
      {.threads = 2, .stop = {}, .on_progress = [&](const Progress& progress) { seen.push_back(progress); }});
  EXPECT_TRUE(results.complete);
  EXPECT_EQ(results.resumed, kept);
  EXPECT_EQ(computed, 50);
  for (std::size_t i = 0; i < units.size(); ++i) EXPECT_EQ(results.results[i], std::to_string(i * i));
  ASSERT_EQ(seen.size(), 51 - kept);
  EXPECT_EQ(seen.front().units_done, kept);
  EXPECT_EQ(seen.front().trials_done, seen.front().trials_resumed);
  EXPECT_EQ(seen.back().trials_done, seen.back().trials);
  EXPECT_EQ(seen.back().trials, 50 * 51 / 2);
}

TEST_F(RunnerTest, names_a_unit_that_fails_and_keeps_the_others) {
  auto units = squares(5);
  units[4].compute = []() -> std::string { throw std::runtime_error("no luck"); };
  {
    Journal journal(file, "the run");
    try {
      compute_units(units, journal, {.threads = 1, .stop = {}, .on_progress = {}});
      FAIL();
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "unit 'unit 4' failed: no luck");
    }
  }
  EXPECT_EQ(Journal(file, "the run").finished().size(), 4u);
}

TEST_F(RunnerTest, refuses_two_units_of_one_name) {
  auto units = squares(2);
  units[1].key = units[0].key;
  Journal journal(file, "the run");
  EXPECT_THROW(compute_units(units, journal, {.threads = 1, .stop = {}, .on_progress = {}}), std::logic_error);
}

TEST(RunIdentity, tells_what_differs) {
  const RunIdentity ours{"toy", R"({"radius":1,"speed":[1,2]})", 7, std::nullopt, "program"};
  EXPECT_EQ(identity_difference(identity_text(ours), ours), "");
  EXPECT_TRUE(same_program(identity_text(ours), ours));
  auto theirs = ours;
  theirs.program = "another";
  EXPECT_EQ(identity_difference(identity_text(theirs), ours), "");
  EXPECT_FALSE(same_program(identity_text(theirs), ours));
  theirs.trials = 5;
  EXPECT_EQ(identity_difference(identity_text(theirs), ours), "trials = 5, not none");
  theirs.seed = 8;
  EXPECT_EQ(identity_difference(identity_text(theirs), ours), "seed = 8, not 7");
  theirs = ours;
  theirs.config = R"({"radius":1,"speed":[1,3]})";
  EXPECT_EQ(identity_difference(identity_text(theirs), ours), "speed = [1,3], not [1,2]");
  theirs.config = R"({"radius":1,"speed":[1,2],"more":1})";
  EXPECT_EQ(identity_difference(identity_text(theirs), ours), "keys that are unknown here");
  EXPECT_EQ(identity_difference("garbage", ours), "something that cannot be read");
}

}  // namespace
}  // namespace thinwall
