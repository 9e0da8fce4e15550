#include <gtest/gtest.h>

#include <algorithm>

#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/lab/shards.hpp>

namespace thinwall {
namespace {

TEST(Shard, is_written_as_it_is_read) {
  EXPECT_EQ(parse_shard("2/4"), (Shard{2, 4}));
  EXPECT_EQ(to_text(parse_shard("1000/1000")), "1000/1000");
}

TEST(Shard, counts_from_one) {
  for (const char* text : {"0/4", "5/4", "1/0", "a/b", "2", "/4", "2/", "2/4/6", "-1/4", "1/1000001", "", " 1/2"}) {
    try {
      parse_shard(text);
      ADD_FAILURE() << text;
    } catch (const UsageError& error) {
      EXPECT_NE(std::string(error.what()).find("--shard: '" + std::string(text) + "' is not allowed; i/N"),
                std::string::npos)
          << error.what();
    }
  }
}

TEST(Shard, has_its_units_for_itself_and_as_many_as_any_other) {
  for (const std::size_t units : {0u, 1u, 20u, 1000u}) {
    for (const int count : {1, 2, 3, 7, 50}) {
      std::vector<int> owners(units);
      for (int index = 1; index <= count; ++index) {
        const auto mine = units_of({index, count}, units);
        const auto fair = units / static_cast<std::size_t>(count);
        EXPECT_TRUE(mine.size() == fair || mine.size() == fair + 1) << mine.size();
        EXPECT_TRUE(std::ranges::is_sorted(mine));
        for (const std::size_t i : mine) ++owners[i];
      }
      EXPECT_EQ(std::ranges::count(owners, 1), static_cast<std::ptrdiff_t>(units));
    }
  }
}

TEST(Shard, mixes_units_that_repeat_in_a_pattern) {
  for (const int count : {2, 3, 4, 8}) {  // every second unit is dear: none must get them all
    int dear = 0;
    for (const std::size_t i : units_of({1, count}, 4800)) dear += i % 2 == 0 ? 1 : 0;
    EXPECT_NEAR(dear * count, 2400, 240) << count;
  }
}

TEST(Shard, is_the_same_units_on_every_machine) {
  EXPECT_EQ(units_of({1, 3}, 10), (std::vector<std::size_t>{1, 3, 7, 8}));
}

}  // namespace
}  // namespace thinwall
