/// `thinwall validate` as the user calls it: what it counts, what it refuses, and its exit codes; the published queries and the
/// published set of what turns whole; and its judge itself.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <random>

#include <sys/stat.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <thinwall/experiments/validate/exact_verdict.hpp>
#include <thinwall/experiments/validate/validate.hpp>
#include <thinwall/swept/time_of_impact.hpp>

#include "support/numbers_of.hpp"
#include "support/program.hpp"
#include "support/real.hpp"
#include "support/reply.hpp"

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
    write_text(folder / below, text);
    return folder / below;
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
  expect_members(said, {{"read", 5}, {"checked", 3}, {"hits", 2}, {"rounded", 0}, {"skipped", 2}});
  expect_members(said, {{"skipped_not_rigid", 1}, {"skipped_not_double", 1}, {"skipped_rounding_decides", 0}});
  expect_members(said, {{"false_negatives", 0}, {"false_positives", 0}, {"undecided", 0}, {"file_differs", 0}});
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
  const std::string file = write("set/vertex-face/a.csv", falling("1,2", 1) + falling("1,2", 0) + falling("-1,2", 1));
  const Reply reply = call_validate(folder / "set");
  expect_reply(reply, 1, {"1 false negatives, 1 false positives", "the file is wrong 2 times"});
  EXPECT_EQ(reply.err, file + ":9: the file says miss, exact arithmetic hit; false positive\n" + file +
                           ":17: the file says hit, exact arithmetic miss; false negative\n");
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
  EXPECT_TRUE(holds(refusal(call_validate(std::string(300, 'a'))), ": cannot be read: File name too long\n"));
  const std::string stray = write("a.csv", falling("1,2", 1));
  EXPECT_EQ(refusal(call_validate(stray)), stray + ": is not a folder\n");
  EXPECT_EQ(refusal(call_validate(empty)), stray +
                                               ": is in no folder named vertex-face or edge-edge; queries of shapes "
                                               "that turn need --turning\n");
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
    expect_members(method, {{"queries", 10'000}, {"late", 0}, {"missed", 0}, {"false", method["near"]}});
    EXPECT_GT(method["touching"], 4000) << name;
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
  expect_reply(right, 0, {"Every method keeps what it claims."});
  EXPECT_EQ(right.err, "");
  const auto expect_wrong = [&](const testing::TurningAnswer& answer, const std::string& said) {
    expect_reply(reply_to(answer), 1, {(folder / "a.csv") + ":2: " + said + "\n"});
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
  rod.shape.radius = -1;
  refused(row({"hit", "0.625", ""}), "A is no valid capsule");
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
  EXPECT_GT(of_method(said["methods"], "conservative_advancement")["largest_error"], 0) << "though it is early";
  EXPECT_EQ(testing::shortest_text(rod.shape.radius), "0.49999999999999994");
}

// ---- The judge, on cases that a person can check, each touch with a miss beside it; and the closed form against it.

const Rational half = Rational(1) / 2, tiny = Rational(1) / Rational(Integer(1) << 2000);

/// A point that touches the right triangle or the square of side 2 in the plane z = 0 at that time, and if it starts `aside`, never.
void expect_touch(FlatSet set, const RationalPoint& start, const RationalPoint& displacement, const Rational& time,
                  const RationalPoint& aside) {
  const RationalPoint beside = {start[0] + aside[0], start[1] + aside[1], start[2] + aside[2]};
  EXPECT_EQ(first_contact({set, start, displacement, {2, 0, 0}, {0, 2, 0}}), time);
  EXPECT_EQ(first_contact({set, beside, displacement, {2, 0, 0}, {0, 2, 0}}), std::nullopt);
}

TEST(ExactVerdict, of_a_touch_and_a_miss_beside_it) {
  constexpr FlatSet triangle = FlatSet::triangle, square = FlatSet::parallelogram;
  const RationalPoint up{0, 0, tiny}, down{0, 0, -tiny}, right{tiny, 0, 0}, behind{0, tiny, 0}, before{0, -tiny, 0};
  expect_touch(triangle, {half, half, 1}, {0, 0, -2}, half, {2, 0, 0});  // across the plane
  expect_touch(triangle, {half, half, 1}, {0, 0, -1}, 1, up);            // at the end of the step
  expect_touch(triangle, {half, half, 0}, {0, 0, -1}, 0, down);          // and at its start
  EXPECT_EQ(first_contact({triangle, {half, half, 1}, {0, 0, 2}, {2, 0, 0}, {0, 2, 0}}), std::nullopt);
  expect_touch(triangle, {1, 1, 1}, {0, 0, -2}, half, behind);  // on the rim
  expect_touch(triangle, {2, 0, 1}, {0, 0, -2}, half, right);
  expect_touch(triangle, {0, 0, 1}, {0, 0, -2}, half, before);
  expect_touch(square, {2, 2, 1}, {0, 0, -2}, half, behind);
  expect_touch(triangle, {-1, half, 0}, {2, 0, 0}, half, up);   // within the plane
  expect_touch(triangle, {-1, 2, 0}, {2, 0, 0}, half, behind);  // past the corner only
  expect_touch(triangle, {-1, 0, 0}, {2, 0, 0}, half, before);  // along an edge
  expect_touch(square, {3, 2, 0}, {-2, 0, 0}, half, behind);
  expect_touch(triangle, {1, half, 0}, {0, 0, 0}, 0, up);  // without motion
  expect_touch(triangle, {1, 1, 0}, {0, 0, 0}, 0, behind);
}

TEST(ExactVerdict, sets_without_area) {
  const auto line = [](FlatSet set, const RationalPoint& start, const RationalPoint& displacement) {
    return first_contact({set, start, displacement, {2, 2, 0}, {-1, -1, 0}});
  };
  for (const FlatSet set : {FlatSet::triangle, FlatSet::parallelogram}) {
    EXPECT_EQ(line(set, {1, 1, 1}, {0, 0, -2}), half);
    EXPECT_EQ(line(set, {1, 1 + tiny, 1}, {0, 0, -2}), std::nullopt);
    EXPECT_EQ(line(set, {-1, -1, 1}, {0, 0, -2}), half);
    EXPECT_EQ(line(set, {-1 - tiny, -1 - tiny, 1}, {0, 0, -2}), std::nullopt);
    EXPECT_EQ(line(set, {4, 4, 0}, {-4, -4, 0}), half);
    EXPECT_EQ(first_contact({set, {1, 2, 3}, {-2, -4, -6}, {0, 0, 0}, {0, 0, 0}}), half);
    EXPECT_EQ(first_contact({set, {1, 2, 3 + tiny}, {-2, -4, -6}, {0, 0, 0}, {0, 0, 0}}), std::nullopt);
  }
  EXPECT_EQ(first_contact({FlatSet::triangle, {3, 0, 1}, {0, 0, -1}, {2, 0, 0}, {1, 0, 0}}), std::nullopt);
  EXPECT_EQ(first_contact({FlatSet::parallelogram, {3, 0, 1}, {0, 0, -1}, {2, 0, 0}, {1, 0, 0}}), 1);
}

// ---- The closed form against exact arithmetic where published queries hardly go: exact touches, made on a grid of small
// integers so that every number involved is one, and their neighbors one unit in the last place away.

using Vector = Vec3<double>;

RationalPoint exact(const Vector& v) { return {Rational(v[0]), Rational(v[1]), Rational(v[2])}; }

std::vector<Vector> directions() {
  return {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {1, 1, 0}, {2, -1, 0}, {0, 1, -1}, {-1, 1, 1}, {3, 1, 2}, {-2, -2, 0}};
}

/// A point that passes a flat set at the origin, both moving on with the same `drift`.
struct Touch {
  FlatSet set;
  Vector start, displacement, e1, e2;
};

Toi<double> library_answer(const Touch& touch) {
  const Vector place(4, -7, 2), drift(1, -2, 3);
  const Vector start = place + touch.start, moved = touch.displacement + drift;
  if (touch.set == FlatSet::triangle) {
    const Triangle<double> face{place, place + touch.e1, place + touch.e2};
    return time_of_impact(Moving{Sphere<double>{start, 0}, moved}, Moving{face, drift});
  }
  const Capsule<double> first{place, place + touch.e1, 0}, second{start, start - touch.e2, 0};
  return time_of_impact(Moving{first, drift}, Moving{second, moved});
}

struct Wrongs {
  int queries = 0, hits = 0, verdicts = 0, starts = 0, times = 0, normals = 0;
};

void judge(const Touch& touch, Wrongs& wrongs) {
  const auto exactly = first_contact({touch.set, exact(touch.start), exact(touch.displacement), exact(touch.e1),  //
                                      exact(touch.e2)});
  const Toi<double> toi = library_answer(touch);
  ++wrongs.queries;
  wrongs.hits += exactly.has_value();
  const bool hit = toi.status == ToiStatus::hit || toi.status == ToiStatus::overlapping;
  wrongs.verdicts += hit != exactly.has_value();
  if (!hit || !exactly) return;
  wrongs.starts += (toi.status == ToiStatus::overlapping) != (*exactly == 0);
  wrongs.times += abs(Rational(toi.time) - *exactly) > *exactly * Rational(std::ldexp(1, -51));
  const double advance = toi.normal.dot(touch.displacement) * (touch.set == FlatSet::triangle ? 1 : -1);
  if (toi.status == ToiStatus::hit) wrongs.normals += !(advance > 0) || std::abs(toi.normal.norm() - 1) > 1e-15;
}

void expect_none(const Wrongs& wrongs) {
  EXPECT_EQ(wrongs.verdicts, 0) << "of " << wrongs.queries << " queries, " << wrongs.hits << " of them hits";
  EXPECT_EQ(wrongs.starts, 0) << "touching at the start is overlapping, and nothing else is";
  EXPECT_EQ(wrongs.times, 0) << "by more than two units in the last place";
  EXPECT_EQ(wrongs.normals, 0) << "unit, and against the motion";
}

/// Every touch at the start, in the middle and at the end of the step: of corners, edges and faces, of sets with and
/// without area, across the plane, within it, along an edge, and without motion.
template <class Use> void for_each_touch(FlatSet set, const Use& use) {
  const std::array<std::array<double, 2>, 6> places{{{0, 0}, {1, 0}, {0, 1}, {0.5, 0.5}, {0, 0.5}, {0.25, 0.25}}};
  for (const Vector& e1 : directions()) {
    for (const Vector& e2 : directions()) {
      for (const Vector& displacement : directions()) {
        for (const auto& [alpha, beta] : places) {
          for (const double time : {0.0, 0.5, 1.0}) {
            use(Touch{set, e1 * alpha + e2 * beta - displacement * time, displacement, e1, e2});
          }
        }
      }
    }
  }
}

class Touches : public ::testing::TestWithParam<FlatSet> {};

TEST_P(Touches, are_hits) {
  Wrongs wrongs;
  for_each_touch(GetParam(), [&](const Touch& touch) { judge(touch, wrongs); });
  EXPECT_EQ(wrongs.queries, wrongs.hits);
  EXPECT_GT(wrongs.hits, 10000);
  expect_none(wrongs);
}

TEST_P(Touches, one_unit_aside_are_what_exact_arithmetic_says) {
  Wrongs wrongs;
  int turn = 0;
  for_each_touch(GetParam(), [&](Touch touch) {
    if (++turn % 3 != 0) return;  // a third of them: exact arithmetic takes its time
    const int axis = (turn / 3) % 3;
    const double unit = std::ldexp(turn % 2 == 0 ? 1 : -1, -49);  // of the place that the query is moved to
    touch.start[axis] += unit;
    judge(touch, wrongs);
  });
  EXPECT_GT(wrongs.hits, 500);
  EXPECT_GT(wrongs.queries - wrongs.hits, 500);
  expect_none(wrongs);
}

/// How many touches the kernel misses; the front door computes float in double, where all of this is exact too.
template <class S> int kernel_misses(FlatSet set) {
  const FlatShape shape = set == FlatSet::triangle ? FlatShape::triangle : FlatShape::parallelogram;
  int misses = 0, turn = 0;
  for_each_touch(set, [&](const Touch& t) {
    if (++turn % 5 != 0) return;
    const auto entry = flat_entry<S>(shape, t.start.template cast<S>(), t.displacement.template cast<S>(),
                                     t.e1.template cast<S>(), t.e2.template cast<S>(), S(1));
    misses += !entry.inside && !(entry.time <= S(1));
  });
  return misses;
}

TEST_P(Touches, are_hits_for_the_kernel_at_every_scalar) {
  EXPECT_EQ(kernel_misses<float>(GetParam()), 0);
  EXPECT_EQ(kernel_misses<long double>(GetParam()), 0);
  EXPECT_EQ(kernel_misses<testing::Wide>(GetParam()), 0);
}

/// Small integers times powers of two from one end of the scalar's range to the other, or all of them near 1.
template <class S> class FarApart {
 public:
  int pick(int low, int high) { return std::uniform_int_distribution(low, high)(generator_); }
  S number(bool near) {
    using Limits = std::numeric_limits<S>;
    const int exponent = near ? 0 : pick(Limits::min_exponent - Limits::digits, Limits::max_exponent - 8);
    return std::ldexp(S(pick(-3, 3)), pick(0, 2) == 0 ? 0 : exponent);
  }
  Vec3<S> vector(bool near) { return {number(near), number(near), number(near)}; }

 private:
  std::mt19937 generator_{7};
};

template <class S> void judge_far_apart(FlatSet set) {
  const FlatShape shape = set == FlatSet::triangle ? FlatShape::triangle : FlatShape::parallelogram;
  FarApart<S> draw;
  int hits = 0, wrong = 0;
  for (int i = 0; i < 6000; ++i) {
    const bool near = i % 4 == 0;
    const Vec3<S> v = draw.vector(near), e1 = draw.vector(near);
    const Vec3<S> e2 = i % 3 == 0 ? times_power_of_two<S>(e1, draw.pick(-100, 100)) : draw.vector(near);
    const Vec3<S> p = i % 2 == 0 ? Vec3<S>(e1 / S(2) - v / S(2)) : draw.vector(near);
    if (!is_finite(e2)) continue;
    const auto exactly = first_contact({set, exact(p.template cast<double>()), exact(v.template cast<double>()),
                                        exact(e1.template cast<double>()), exact(e2.template cast<double>())});
    const auto entry = flat_entry<S>(shape, p, v, e1, e2, S(1));
    hits += exactly.has_value();
    wrong +=
        exactly.has_value() != (entry.inside || entry.time <= S(1)) || (exactly && entry.inside != (*exactly == 0));
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(hits, 500);
}

TEST_P(Touches, of_numbers_however_far_apart_are_what_exact_arithmetic_says) {
  judge_far_apart<double>(GetParam());
  judge_far_apart<float>(GetParam());
}

INSTANTIATE_TEST_SUITE_P(, Touches, ::testing::Values(FlatSet::triangle, FlatSet::parallelogram),
                         [](const auto& chosen) {
                           return chosen.param == FlatSet::triangle ? "vertex_face" : "edge_edge";
                         });

}  // namespace
}  // namespace thinwall
