/// `thinwall validate --turning`: the published set whole, what it counts, what a wrong file looks like, and what it refuses.

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <sys/stat.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/program.hpp"
#include "support/reply.hpp"
#include "support/turning_rows.hpp"

namespace thinwall {
namespace {

using nlohmann::json;

Reply validate_turning(const std::string& place, const Words& more = {}) {
  return call_program(joined({"validate", "--turning", place}, more));
}

const json& of_method(const json& methods, const std::string& name) {
  return *std::ranges::find_if(methods, [&](const json& m) { return m["method"] == name; });
}

/// A ball flies at a rod that turns about its own length: they touch at 5/8 of the step.
struct PublishedTurningFile : ::testing::Test {
  TemporaryFolder folder;
  Turning<Capsule<double>> rod{{{-2, 0, 0}, {2, 0, 0}, 0.5}, {0, 0, 0}, {3.25, 0, 0}};
  Turning<Sphere<double>> ball{{{0.5, 4, 0}, 1}, {0, -4, 0}, {0, 0, 0}};
  std::string header = testing::turning_header(rod, ball);

  std::string row(const testing::TurningAnswer& answer) const {
    return testing::turning_row(0, "any", "none", answer, rod, ball);
  }
  std::string write(const std::string& text, const std::string& name = "a.csv") const {
    write_text(folder.path() / name, text);
    return folder / name;
  }
  void expect_refusal(const std::string& text, const std::string& said) const {
    const std::string file = write(text);
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
    return validate_turning(write(header + "\n" + row(answer) + "\r\n"));
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
  const Reply reply = validate_turning(write(header + "\n" + row({"hit", "0.625", ""}) + "\n"), {"--json"});
  EXPECT_EQ(reply.status, 0) << reply.err;
  const json said = json::parse(reply.out);
  EXPECT_EQ(of_method(said["methods"], "certified")["touching"], 1);
  EXPECT_EQ(testing::shortest_text(rod.shape.radius), "0.49999999999999994");
}

}  // namespace
}  // namespace thinwall
