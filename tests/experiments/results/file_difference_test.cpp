#include <gtest/gtest.h>

#include <thinwall/experiments/lab/comparison.hpp>

namespace thinwall {
namespace {

std::string difference(const std::string& file, const std::string& recorded, const std::string& rerun) {
  const auto found = first_difference(file, recorded, rerun);
  return found ? to_text(*found) : "none";
}

TEST(FileDifference, names_row_column_and_both_values_of_a_table) {
  const std::string a = "name,hits\n\"a, \"\"b\"\"\",1\n\"two\nlines\",2\nc,\n";
  EXPECT_EQ(difference("t.csv", a, a), "none");
  EXPECT_EQ(difference("t.csv", a, "name,hits\n\"a, \"\"b\"\"\",1\n\"two\nlines\",3\nd,9\n"),
            "t.csv: row 2, column 'hits': recorded 2, rerun 3");
  EXPECT_EQ(difference("t.csv", a, "name,hits\n\"a, \"\"b\"\"\",1\n\"two\nlines\",2\nc,7\n"),
            "t.csv: row 3, column 'hits': recorded nothing, rerun 7");
  EXPECT_EQ(difference("t.csv", a, "name,hits\n\"a, \"\"c\"\"\",1\n"),
            "t.csv: row 1, column 'name': recorded a, \"b\", rerun a, \"c\"");
}

TEST(FileDifference, tells_missing_rows_and_other_columns) {
  EXPECT_EQ(difference("t.csv", "x\n1\n2\n", "x\n1\n"), "t.csv: row 2: recorded 2, rerun nothing");
  EXPECT_EQ(difference("t.csv", "x\n1\n", "x\n1\n2\n"), "t.csv: row 2: recorded nothing, rerun 2");
  EXPECT_EQ(difference("t.csv", "x,y\n1,2\n", "x\n1\n"), "t.csv: the columns: recorded x,y, rerun x");
  EXPECT_EQ(difference("t.csv", "", "x\n1\n"), "t.csv: the columns: recorded nothing, rerun x");
  EXPECT_EQ(difference("t.csv", "x\n1\n", "x\n\"1\"\n"), "t.csv: line 2: recorded 1, rerun \"1\"");
}

TEST(FileDifference, names_the_line_of_any_other_file_and_shows_where_it_differs) {
  EXPECT_EQ(difference("a.md", "one\ntwo\n", "one\n2\n"), "a.md: line 2: recorded two, rerun 2");
  EXPECT_EQ(difference("a.md", "one\n", "one\ntwo\n"), "a.md: line 2: recorded nothing, rerun two");
  EXPECT_EQ(difference("a.md", "one\n", "one"), "a.md: line 1: recorded the end, rerun another end of the last line");
  const std::string same(200, '=');
  EXPECT_EQ(difference("a.md", same + "1", same + "2"),
            "a.md: line 1: recorded ...====================1, rerun ...====================2");
}

TEST(FileDifference, forgives_a_citation_its_day_and_its_program) {
  const std::string a = "@misc{a,\n  note   = {run 5, commit abc},\n  date   = {2026-11-22}\n}\n";
  EXPECT_EQ(difference("cite.bib", a, "@misc{a,\n  note   = {run 5, commit def},\n  date   = {2027-01-01}\n}\n"),
            "none");
  EXPECT_NE(difference("cite.bib", a, "@misc{a,\n  note   = {run 6, commit abc},\n  date   = {2026-11-22}\n}\n"),
            "none");
  EXPECT_NE(difference("cite.txt", a, "@misc{a,\n  note   = {run 5, commit def},\n  date   = {2026-11-22}\n}\n"),
            "none");
}

}  // namespace
}  // namespace thinwall
