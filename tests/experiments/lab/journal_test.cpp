#include <algorithm>

#include <gtest/gtest.h>

#include <thinwall/experiments/lab/journal.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/lab/shards.hpp>

#include "support/program.hpp"
#include "support/said.hpp"

namespace thinwall {

namespace {

struct JournalTest : testing::Test {
  TemporaryFolder folder;
  std::string file = folder / "journal.tsv";

  void write_three() const {
    Journal journal(file, "the run");
    journal.add("a", {0.1, "1 2 3"});
    journal.add("b", {0.2, "tab\there"});
    journal.add("c", {0.3, ""});
  }
};

TEST_F(JournalTest, gives_back_what_was_added) {
  write_three();
  const Journal journal(file, "the run");
  ASSERT_EQ(journal.finished().size(), 3u);
  EXPECT_EQ(journal.finished().find("a")->second.result, "1 2 3");
  EXPECT_EQ(journal.finished().find("b")->second.result, "tab\there");
  EXPECT_EQ(journal.finished().find("b")->second.seconds, 0.2);
  EXPECT_EQ(journal.finished().find("c")->second.result, "");
  EXPECT_TRUE(journal.damage().empty());
}

TEST_F(JournalTest, knows_whose_it_is) {
  EXPECT_EQ(read_journal(file).identity, "");
  write_three();
  EXPECT_EQ(read_journal(file).identity, "the run");
  write_text(file, "something else\n");
  EXPECT_EQ(read_journal(file).identity, "");
}

TEST_F(JournalTest, drops_a_torn_last_row_wherever_it_was_torn) {
  write_three();
  const std::string whole = read_text(file);
  const auto end_of_b = whole.rfind('\n', whole.size() - 2) + 1;
  for (auto length = end_of_b; length < whole.size(); ++length) {
    write_text(file, whole.substr(0, length));
    Journal journal(file, "the run");
    EXPECT_EQ(journal.finished().size(), 2u) << length;
    EXPECT_TRUE(journal.damage().empty());
    journal.add("c", {0.3, ""});
    EXPECT_EQ(read_text(file), whole);
  }
}

TEST_F(JournalTest, names_a_damaged_row_and_forgets_it) {
  write_three();
  std::string text = read_text(file);
  text[text.find("1 2 3")] = '7';
  write_text(file, text);
  const Journal journal(file, "the run");
  EXPECT_EQ(journal.finished().size(), 2u);
  EXPECT_FALSE(journal.finished().contains("a"));
  ASSERT_EQ(journal.damage().size(), 1u);
  EXPECT_EQ(journal.damage()[0],
            file + ":2: the row of 'a' is damaged, or of another run; that unit is computed again");
  EXPECT_TRUE(Journal(file, "the run").damage().empty());  // the row is gone
}

TEST_F(JournalTest, takes_no_row_of_another_run) {
  Journal(folder / "other.tsv", "another run").add("b", {0.2, "theirs"});
  Journal(file, "the run").add("a", {0.1, "ours"});
  const std::string other = read_text(folder / "other.tsv");
  write_text(file, read_text(file) + other.substr(other.find('\n') + 1));
  const Journal journal(file, "the run");
  EXPECT_EQ(journal.finished().size(), 1u);
  EXPECT_EQ(
      journal.damage(),
      std::vector<std::string>{file + ":3: the row of 'b' is damaged, or of another run; that unit is computed again"});
}

TEST_F(JournalTest, follows_no_link_and_overwrites_nothing_of_others) {
  write_text(folder / "mine", "mine\n");
  std::filesystem::create_symlink("mine", file + ".new");
  std::filesystem::create_symlink("mine", folder / "link.tsv");
  write_three();
  EXPECT_THROW(Journal(folder / "link.tsv", "the run"), std::system_error);
  EXPECT_THROW(Journal(folder / "mine", "the run"), std::system_error);
  EXPECT_EQ(read_text(folder / "mine"), "mine\n");
  EXPECT_TRUE(std::filesystem::is_symlink(file + ".new"));
  std::filesystem::create_symlink("journal.tsv", folder / "linked.tsv");  // to a journal, too
  EXPECT_THROW(Journal(folder / "linked.tsv", "the run"), std::system_error);
}

TEST_F(JournalTest, cannot_be_written_where_nothing_can) {
  write_text(file, "");
  EXPECT_THROW(Journal(file + "/below.tsv", "the run"), std::system_error);
}

TEST(Shard, is_written_as_it_is_read) {
  EXPECT_EQ(parse_shard("2/4"), (Shard{2, 4}));
  EXPECT_EQ(to_text(parse_shard("1000/1000")), "1000/1000");
}

TEST(Shard, counts_from_one) {
  for (const char* text : {"0/4", "5/4", "1/0", "a/b", "2", "/4", "2/", "2/4/6", "-1/4", "1/1000001", "", " 1/2"}) {
    EXPECT_TRUE(holds(error_of<UsageError>([&] { parse_shard(text); }),
                      "--shard: '" + std::string(text) + "' is not allowed; i/N"));
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
