/// `thinwall validate` as the user calls it: what it counts, what it refuses, and its exit codes.

#include <filesystem>

#include <sys/stat.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/program.hpp"
#include "support/reply.hpp"

namespace thinwall {
namespace {

using std::filesystem::path;

Reply validate(const std::string& folder, const Words& more = {}) {
  return call_program(joined({"validate", folder}, more));
}

/// Eight rows; `vertices` are triples of ratios, `answer` is put behind each.
std::string query(const std::vector<std::string>& vertices, int answer) {
  std::string text;
  for (const std::string& vertex : vertices) text += vertex + "," + std::to_string(answer) + "\n";
  return text;
}

/// A vertex falls from 1 to -1 past a resting face at the ratio `x`.
std::string falling(const std::string& x, int answer) {
  const std::vector<std::string> face{"0,1,0,1,0,1", "2,1,0,1,0,1", "0,1,2,1,0,1"};
  return query({x + ",1,2,1,1", face[0], face[1], face[2], x + ",1,2,-1,1", face[0], face[1], face[2]}, answer);
}

struct ValidateTest : ::testing::Test {
  TemporaryFolder folder;

  std::string write(const std::string& below, const std::string& text) const {
    const path file = folder / below;
    std::filesystem::create_directories(file.parent_path());
    write_text(file, text);
    return file.string();
  }
  void expect_refusal(const std::string& text, const std::string& said) const {
    const std::string file = write("bad/vertex-face/a.csv", text);
    EXPECT_EQ(refusal(validate(folder / "bad")), file + said + "\n");
  }
};

TEST_F(ValidateTest, counts_what_it_reads_checks_and_skips) {
  const std::string third = query({"1,3,0,1,5,1", "0,1,0,1,0,1", "2,1,0,1,0,1", "0,1,2,1,0,1",  //
                                   "1,3,0,1,4,1", "0,1,0,1,0,1", "2,1,0,1,0,1", "0,1,2,1,0,1"},
                                  0);
  const std::string turning = query({"0,1,0,1,5,1", "0,1,0,1,0,1", "2,1,0,1,0,1", "0,1,2,1,0,1",  //
                                     "0,1,0,1,4,1", "0,1,0,1,1,1", "2,1,0,1,0,1", "0,1,2,1,0,1"},
                                    0);
  write("set/falls/vertex-face/a.csv", falling("1,2", 1) + falling("-1,2", 0) + third + turning);
  const std::string start = "0,1,0,1,0,1", end = "1,1,0,1,0,1", below = "1,2,-1,1,1,1", above = "1,2,1,1,1,1",
                    end_below = "1,2,-1,1,0,1", end_above = "1,2,1,1,0,1";  // touch at the end of the step
  write("set/edges/edge-edge/a.csv", query({start, end, below, above, start, end, end_below, end_above}, 1));
  const Reply reply = validate(folder / "set", {"--json"});
  EXPECT_EQ(reply.status, 0) << reply.err;
  const auto json = nlohmann::json::parse(reply.out);
  EXPECT_EQ(json["read"], 5);
  EXPECT_EQ(json["checked"], 3);
  EXPECT_EQ(json["hits"], 2);
  EXPECT_EQ(json["skipped"], 2);
  EXPECT_EQ(json["skipped_not_rigid"], 1);
  EXPECT_EQ(json["skipped_not_double"], 1);
  EXPECT_EQ(json["false_negatives"], 0);
  EXPECT_EQ(json["false_positives"], 0);
  EXPECT_GT(json["median_ns"], 0);
  EXPECT_EQ(json["families"].size(), 2U);
  const std::string text = validate(folder / "set").out;
  EXPECT_TRUE(holds(text, "0 false negatives, 0 false positives"));
}

TEST_F(ValidateTest, a_displacement_without_a_double_is_rounded_or_left) {
  const std::string face = "0,1,0,1,0,1", b = "2,1,0,1,0,1", c = "0,1,2,1,0,1";
  const std::string huge = "36028797018963969";  // 2^55 + 1: from 1, by -(2^55 + 1) / 2^55, to -1 / 2^55
  const auto fall = [&](const std::string& end, int answer) {
    return query({"1,2,1,2,1,1", face, b, c, "1,2,1,2," + end, face, b, c}, answer);
  };
  write("set/vertex-face/a.csv", fall("-1,36028797018963968", 1) + fall("1,36028797018963968", 0) +
                                     query({"1,2,1,2,-" + huge + ",1", face, b, c, "1,2,1,2,-1,1", face, b, c}, 0));
  const auto json = nlohmann::json::parse(validate(folder / "set", {"--json"}).out);
  EXPECT_EQ(json["rounded"], 1);  // passes the plane by 2^-55, and touches it once rounded: a hit twice
  EXPECT_EQ(json["skipped_rounding_decides"], 1);  // stops 2^-55 before the plane, and touches it once rounded
  EXPECT_EQ(json["skipped_not_double"], 1);
}

TEST_F(ValidateTest, a_wrong_answer_is_status_1_and_is_named) {
  const std::string file = write("set/vertex-face/a.csv", falling("1,2", 1) + falling("1,2", 0));
  const Reply reply = validate(folder / "set");
  EXPECT_EQ(reply.status, 1);
  EXPECT_TRUE(holds(reply.out, "0 false negatives, 1 false positives"));
  EXPECT_EQ(reply.err, file + ":9: the file says miss, exact arithmetic hit; false positive\n");
}

TEST_F(ValidateTest, malformed_files_are_refused_by_line) {
  const std::string good = falling("1,2", 1);
  expect_refusal("", ":1: the file is empty; 8 rows a query");
  expect_refusal(good + "1,1,1,1,1,1\n", ":9: 6 columns; 7 are needed");
  expect_refusal(good + "\n", ":9: 1 columns; 7 are needed");
  expect_refusal("1,1,x,1,1,1,0\n", ":1: column 3: 'x' is not an integer");
  expect_refusal("1,1,0.5,1,1,1,0\n", ":1: column 3: '0.5' is not an integer");
  expect_refusal("1,1,,1,1,1,0\n", ":1: column 3: '' is not an integer");
  expect_refusal("1,1,\x1b,1,1,1,0\n", ":1: column 3: '\\x1b' is not an integer");
  expect_refusal("1,1,1,0,1,1,0\n", ":1: column 4: a denominator of zero");
  expect_refusal("1,1,1,1,1,1,2\n", ":1: column 7: '2'; 0 or 1");
  expect_refusal("1,1,1,1,1,1,1\n1,1,1,1,1,1,0\n", ":2: column 7: differs within the 8 rows of a query");
  expect_refusal(good + "1,1,1,1,1,1,1\n", ":9: the file ends after 1 of the 8 rows of a query");
  expect_refusal(std::string(20000, '1') + ",1,1,1,1,1,1\n", ":1: column 1: more than 10000 digits");
}

TEST_F(ValidateTest, line_ends_long_ratios_and_signs_are_read) {
  std::string text = falling("10000000000000000000000000000000000000000,20000000000000000000000000000000000000000", 1) +
                     falling("-1,-2", 1) + falling("08,016", 1);
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.insert(at, "\r");
  write("set/vertex-face/a.csv", text);
  const Reply reply = validate(folder / "set", {"--json"});
  EXPECT_EQ(reply.status, 0) << reply.err;
  EXPECT_EQ(nlohmann::json::parse(reply.out)["checked"], 3);
}

TEST_F(ValidateTest, folders_without_queries_are_refused) {
  const std::string none = folder / "none", empty = folder.path().string();
  EXPECT_EQ(refusal(validate(none)), none + ": there is no such folder\n");
  EXPECT_EQ(refusal(validate(empty)), empty + ": has no CSV files of queries\n");
  const std::string stray = write("a.csv", falling("1,2", 1));
  EXPECT_EQ(refusal(validate(stray)), stray + ": is not a folder\n");
  EXPECT_TRUE(holds(refusal(validate(empty)), stray + ": is in no folder named"));
  EXPECT_TRUE(holds(refusal(validate("")), "a folder of published queries is missing"));
}

TEST_F(ValidateTest, what_is_no_regular_file_is_named_and_refused) {
  write("set/vertex-face/a.csv", falling("1,2", 1));
  const std::string pipe = folder / "set/vertex-face/b.csv";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(refusal(validate(folder / "set")), pipe + ": is not a regular file; no other is read\n");
}

}  // namespace
}  // namespace thinwall
