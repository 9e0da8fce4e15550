/// `thinwall advise`, as the user calls it.

#include <gtest/gtest.h>

#include <algorithm>

#include "support/toy_program.hpp"

namespace thinwall {
namespace {

struct AdviseProgram : testing::Test {
  TemporaryFolder folder;

  static Reply advise(std::vector<std::string> more, const std::string& thickness = "0.01") {
    std::vector<std::string> words = {"advise", "--speed", "10", "--radius", "0.02", "--thickness", thickness};
    words.insert(words.end(), more.begin(), more.end());
    return ToyProgram::call(words);
  }

  /// `said`: what the one line must start with.
  static void expect_refusal(const Reply& reply, const std::string& said) {
    EXPECT_EQ(reply.status, 2) << reply.err;
    EXPECT_EQ(reply.out, "");
    EXPECT_TRUE(reply.err.starts_with(said)) << reply.err;
    EXPECT_EQ(std::ranges::count(reply.err, '\n'), 1) << reply.err;
  }
};

TEST_F(AdviseProgram, answers_in_json_and_writes_the_experiment) {
  const std::string file = folder / "check.toml";
  const Reply reply = advise({"--fps", "60", "--json", "--toml", file});
  EXPECT_EQ(reply.status, 0) << reply.err;
  EXPECT_NE(reply.err.find("thinwall run " + file), std::string::npos) << reply.err;
  const nlohmann::json json = nlohmann::json::parse(reply.out);
  EXPECT_EQ(json["toml"], file);
  EXPECT_EQ(json["step_s"], 1.0 / 60);
  EXPECT_TRUE(json["method"].is_string());
  const std::string written = read_text(file);
  EXPECT_EQ(advise({"--step", "0.016666666666666666", "--toml", "-"}).out, written) << "fps and step are the same";
  EXPECT_NE(written.find("speed = [10]"), std::string::npos);
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path())) ++files;
  EXPECT_EQ(files, 1U);
}

TEST_F(AdviseProgram, replaces_an_experiment_of_its_own_and_nothing_else) {
  const std::string file = folder / "check.toml";
  write_text(file, "# mine\n");
  expect_refusal(advise({"--fps", "60", "--toml", file}), "--toml " + file + ": is there already");
  EXPECT_EQ(read_text(file), "# mine\n");
  write_text(file, advise({"--fps", "30", "--toml", "-"}).out);
  EXPECT_EQ(advise({"--fps", "60", "--json", "--toml", file}).status, 0);
  EXPECT_EQ(read_text(file), advise({"--fps", "60", "--toml", "-"}).out);
}

TEST_F(AdviseProgram, names_what_is_wrong) {
  expect_refusal(ToyProgram::call({"advise", "--radius", "1"}),
                 "--speed is missing; a number > 0 and <= 1000000000 [m/s]");
  expect_refusal(advise({}), "--step [s] or --fps [1/s] is missing");
  expect_refusal(advise({"--step", "0.1", "--fps", "10"}), "--step and --fps say the same thing twice");
  expect_refusal(advise({"--fps", "60"}, "-1"), "--thickness: '-1' is not allowed; a number >= 0");
  expect_refusal(advise({"--fps", "60"}, "1mm"), "--thickness: '1mm' is not allowed");
  expect_refusal(advise({"--fps", "60"}, ""), "--thickness: '' is not allowed");
  for (const std::string bad : {"0", "-1", "nan", "inf", "-inf", "1e999", "0x10"}) {
    expect_refusal(ToyProgram::call({"advise", "--speed", bad}), "--speed: '" + bad + "' is not allowed; a number > 0");
    expect_refusal(advise({"--step", bad}), "--step: '" + bad + "' is not allowed; a number > 0");
    expect_refusal(advise({"--fps", bad}), "--fps: '" + bad + "' is not allowed; a number >= 0.001");
  }
  for (const std::string bad : {"90", "89.95", "-10", "nan"}) {
    expect_refusal(advise({"--fps", "60", "--angle", bad}),
                   "--angle: '" + bad + "' is not allowed; a number >= 0 and <= 89.9");
  }
  for (const std::string bad : {"1.01", "-0.1", "nan", "5%"}) {
    expect_refusal(advise({"--fps", "60", "--miss", bad}),
                   "--miss: '" + bad + "' is not allowed; a number >= 0 and <= 1");
  }
  expect_refusal(
      ToyProgram::call({"advise", "--speed", "1e-300", "--radius", "1", "--thickness", "1", "--step", "1e-5"}),
      "--speed 1e-300: in a step of 1e-05 s the ball moves 1e-305 m; at least 1e-30 m is needed");
  expect_refusal(advise({"--fps", "60", "--late", "-1"}), "--late: '-1' is not allowed; a number >= 0 [m]");
  expect_refusal(advise({"--fps", "60", "--toml", ""}), "--toml: ''");
  expect_refusal(advise({"--fps", "60", "--toml", "-", "--json"}), "--toml - and --json");
  expect_refusal(advise({"--fps", "60", "--toml", folder.path().string()}),
                 "--toml " + folder.path().string() + ": is a folder");
  expect_refusal(advise({"--fps", "60", "--toml", folder / "no/where.toml"}),
                 "--toml " + (folder / "no/where.toml") + ": cannot be");
}

}  // namespace
}  // namespace thinwall
