/// `thinwall validate` as the user calls it: what it counts, what it refuses, and its exit codes; the published queries and the
/// published set of what turns whole.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include <sys/stat.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <thinwall/experiments/validate/validate.hpp>

#include "support/program.hpp"
#include "support/reply.hpp"
#include "support/turning_rows.hpp"

namespace thinwall {
namespace {

using nlohmann::json;
using std::filesystem::path;

Reply call_validate(const std::string& folder, const Words& more = {}) {
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
    EXPECT_EQ(refusal(call_validate(folder / "bad")), file + said + "\n");
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
  const Reply reply = call_validate(folder / "set", {"--json"});
  EXPECT_EQ(reply.status, 0) << reply.err;
  const json said = json::parse(reply.out);
  EXPECT_EQ(said["read"], 5);
  EXPECT_EQ(said["checked"], 3);
  EXPECT_EQ(said["hits"], 2);
  EXPECT_EQ(said["skipped"], 2);
  EXPECT_EQ(said["skipped_not_rigid"], 1);
  EXPECT_EQ(said["skipped_not_double"], 1);
  EXPECT_EQ(said["false_negatives"], 0);
  EXPECT_EQ(said["false_positives"], 0);
  EXPECT_GT(said["median_ns"], 0);
  EXPECT_EQ(said["families"].size(), 2U);
  const std::string text = call_validate(folder / "set").out;
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
  const json said = json::parse(call_validate(folder / "set", {"--json"}).out);
  EXPECT_EQ(said["rounded"], 1);  // passes the plane by 2^-55, and touches it once rounded: a hit twice
  EXPECT_EQ(said["skipped_rounding_decides"], 1);  // stops 2^-55 before the plane, and touches it once rounded
  EXPECT_EQ(said["skipped_not_double"], 1);
}

TEST_F(ValidateTest, a_wrong_answer_is_status_1_and_is_named) {
  const std::string file = write("set/vertex-face/a.csv", falling("1,2", 1) + falling("1,2", 0));
  const Reply reply = call_validate(folder / "set");
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
  const Reply reply = call_validate(folder / "set", {"--json"});
  EXPECT_EQ(reply.status, 0) << reply.err;
  EXPECT_EQ(json::parse(reply.out)["checked"], 3);
}

TEST_F(ValidateTest, folders_without_queries_are_refused) {
  const std::string none = folder / "none", empty = folder.path().string();
  EXPECT_EQ(refusal(call_validate(none)), none + ": there is no such folder\n");
  EXPECT_EQ(refusal(call_validate(empty)), empty + ": has no CSV files of queries\n");
  const std::string stray = write("a.csv", falling("1,2", 1));
  EXPECT_EQ(refusal(call_validate(stray)), stray + ": is not a folder\n");
  EXPECT_TRUE(holds(refusal(call_validate(empty)), stray + ": is in no folder named"));
  EXPECT_TRUE(holds(refusal(call_validate("")), "a folder of published queries is missing"));
}

TEST_F(ValidateTest, what_is_no_regular_file_is_named_and_refused) {
  write("set/vertex-face/a.csv", falling("1,2", 1));
  const std::string pipe = folder / "set/vertex-face/b.csv";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(refusal(call_validate(folder / "set")), pipe + ": is not a regular file; no other is read\n");
}

// ---- The published queries themselves, where they are at hand: no false negative and no false positive.

path published_folder() {
  if (const char* const named = std::getenv("THINWALL_CCD_QUERIES")) return named;
  const auto root = path(__FILE__).parent_path().parent_path().parent_path().parent_path();
  return root.parent_path() / "shared" / "data" / "ccd-queries";
}

TEST(PublishedQueries, are_all_answered_right) {
  const path folder = published_folder();
  if (!exists(folder)) {
    GTEST_SKIP() << "no published queries in " << folder.string()
                 << "; THINWALL_CCD_QUERIES may name the place, docs/validate.md says where to get them";
  }
  const Validation validation = validate(folder);
  const QueryCounts& total = validation.total;
  for (const std::string& wrong : validation.wrongs) ADD_FAILURE() << wrong;
  EXPECT_EQ(total.wrong(), 0);
  EXPECT_GT(total.checked, 0);
  EXPECT_EQ(total.read, total.checked + total.all_skipped());
  if (total.read != 7279) return;  // another selection
  EXPECT_EQ(total.checked, 1377);
  EXPECT_EQ(total.hits, 230);
  EXPECT_EQ(total.rounded, 77);
}

// ---- `--turning`: the published set whole, what it counts, what a wrong file looks like, and what it refuses.

Reply validate_turning(const std::string& place, const Words& more = {}) {
  return call_program(joined({"validate", "--turning", place}, more));
}

const json& of_method(const json& methods, const std::string& name) {
  return *std::ranges::find_if(methods, [&](const json& m) { return m["method"] == name; });
}

/// A ball flies at a rod that turns about its own length: they touch at 5/8 of the step.
struct PublishedTurningFile : ValidateTest {
  Turning<Capsule<double>> rod{{{-2, 0, 0}, {2, 0, 0}, 0.5}, {0, 0, 0}, {3.25, 0, 0}};
  Turning<Sphere<double>> ball{{{0.5, 4, 0}, 1}, {0, -4, 0}, {0, 0, 0}};
  std::string header = testing::turning_header(rod, ball);

  std::string row(const testing::TurningAnswer& answer) const {
    return testing::turning_row(0, "any", "none", answer, rod, ball);
  }
  void expect_refusal(const std::string& text, const std::string& said) const {
    const std::string file = write("a.csv", text);
    EXPECT_EQ(refusal(validate_turning(file)), file + said + "\n");
  }
};

TEST(PublishedTurningSet, every_method_keeps_what_it_claims) {
  const Reply reply = validate_turning(THINWALL_TURNING_QUERIES, {"--json"});
  EXPECT_EQ(reply.status, 0) << reply.err;
  const json said = json::parse(reply.out);
  EXPECT_EQ(said["wrong"], 0);
  EXPECT_EQ(said["pairs"].size(), 8U);
  for (const char* name : {"conservative_advancement", "conservative_advancement, 2^-40", "certified"}) {
    const json& method = of_method(said["methods"], name);
    EXPECT_EQ(method["queries"], 10'000) << name;
    EXPECT_GT(method["touching"], 4000) << name;
    EXPECT_EQ(method["late"], 0) << name;
    EXPECT_EQ(method["missed"], 0) << name;
    EXPECT_EQ(method["false"], method["near"]) << name;
    EXPECT_LE(method["gave_up"], 100) << name;
  }
  EXPECT_EQ(of_method(said["methods"], "certified")["false"], 0);
  EXPECT_GT(of_method(said["methods"], "end_of_step")["missed"], 1000);
  EXPECT_GT(of_method(said["methods"], "linear_sweep")["missed"], 100);
  EXPECT_GT(of_method(said["methods"], "linear_sweep")["false"], 100);
  EXPECT_EQ(of_method(said["methods"], "speculative")["missed"], 0);
}

TEST_F(PublishedTurningFile, the_right_time_passes_and_a_wrong_one_is_noticed) {
  const auto reply_to = [&](const testing::TurningAnswer& answer) {
    return validate_turning(write("a.csv", header + "\n" + row(answer) + "\r\n"));
  };
  const Reply right = reply_to({"hit", "0.625", ""});
  EXPECT_EQ(right.status, 0) << right.err;
  EXPECT_EQ(right.err, "");
  EXPECT_TRUE(holds(right.out, "Every method keeps what it claims."));
  const auto expect_wrong = [&](const testing::TurningAnswer& answer, const std::string& said) {
    const Reply reply = reply_to(answer);
    EXPECT_EQ(reply.status, 1);
    EXPECT_TRUE(holds(reply.err, (folder / "a.csv") + ":2: " + said + "\n"));
  };
  expect_wrong({"hit", "0.624", ""}, "conservative_advancement: late by 1.0e-03 of a step");
  expect_wrong({"hit", "0.624", ""}, "certified: late by 1.0e-03 of a step");
  expect_wrong({"hit", "0.625000000001", ""}, "certified: proves a contact before that of the file");
  expect_wrong({"overlapping", "0", ""}, "speculative: late by 6.2e-01 of a step");
  expect_wrong({"apart", "", "1e-3"}, "certified: a hit of what stays apart");
  ball.displacement = {0, 4, 0};
  expect_wrong({"hit", "0.625", ""}, "conservative_advancement: missed");
}

TEST_F(PublishedTurningFile, malformed_files_are_refused_by_line) {
  const std::string good = row({"hit", "0.625", ""});
  expect_refusal("", ":1: the file is empty; a header and a line a query");
  expect_refusal("a,b,c\n", ":1: not the header of a pair of shapes that turn; see docs/data/README.md");
  expect_refusal(std::string("\0\x1b\n", 3),
                 ":1: not the header of a pair of shapes that turn; see docs/data/README.md");
  expect_refusal(header + "\n", ":1: no query follows the header");
  const auto refused = [&](const std::string& line, const std::string& said) {
    expect_refusal(header + "\n" + good + "\n" + line + "\n", ":3: " + said);
  };
  refused("1,2", "2 columns; 29 are needed");
  refused(row({"hits", "0.625", ""}), "column 4: 'hits' is no verdict; apart, hit or overlapping");
  refused(row({"hit", "", ""}), "column 5: '' is not a decimal number from 0 to 1");
  refused(row({"hit", "1.5", ""}), "column 5: '1.5' is not a decimal number from 0 to 1");
  refused(row({"hit", "0.1.2", ""}), "column 5: '0.1.2' is not a decimal number from 0 to 1");
  refused(row({"hit", "nan", ""}), "column 5: 'nan' is not a decimal number from 0 to 1");
  refused(row({"overlapping", "0.5", ""}), "column 5: '0.5' is not the start");
  refused(row({"hit", "0.5", "1"}), "column 6: '1' is too much: they touch");
  refused(row({"apart", "0.5", "1"}), "column 5: '0.5' is too much: they stay apart");
  refused(row({"apart", "", "-1"}), "column 6: '-1' is less than 0");
  refused(good.substr(0, good.rfind(',')) + ",inf", "column 29: 'inf' is not a finite number");
  refused(good.substr(0, good.rfind(',')) + ",1\x1b", "column 29: '1\\x1b' is not a finite number");
  ball.shape.radius = -1;
  refused(row({"hit", "0.625", ""}), "B is no valid sphere");
}

TEST_F(PublishedTurningFile, what_is_no_file_is_refused) {
  const std::string none = folder / "none", empty = folder.path().string();
  EXPECT_EQ(refusal(validate_turning(none)), none + ": there is no such file or folder\n");
  EXPECT_EQ(refusal(validate_turning(empty)), empty + ": has no CSV files of queries\n");
  EXPECT_EQ(refusal(validate_turning("")), "--turning: '' is not allowed; a CSV file, or a folder of them\n");
  const std::string pipe = folder / "pipe.csv";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  for (const std::string& place : {pipe, empty})
    EXPECT_EQ(refusal(validate_turning(place)), pipe + ": is not a regular file; no other is read\n");
  EXPECT_EQ(refusal(validate_turning(pipe, {"folder"})),
            "validate: --turning takes the place of the folder; give one of them\n");
}

TEST_F(PublishedTurningFile, numbers_are_written_and_read_to_the_bit) {
  rod.shape.radius = std::nextafter(0.5, 0);  // meets the ball 2^-56 later: the shortest text has it
  const Reply reply = validate_turning(write("a.csv", header + "\n" + row({"hit", "0.625", ""}) + "\n"), {"--json"});
  EXPECT_EQ(reply.status, 0) << reply.err;
  const json said = json::parse(reply.out);
  EXPECT_EQ(of_method(said["methods"], "certified")["touching"], 1);
  EXPECT_EQ(testing::shortest_text(rod.shape.radius), "0.49999999999999994");
}

}  // namespace
}  // namespace thinwall
