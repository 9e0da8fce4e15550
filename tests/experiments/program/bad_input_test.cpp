/// What the program says, as the user calls it, to what it cannot take: one line, exit code 2, and nothing written.

#include <gtest/gtest.h>

#include <algorithm>

#include <thinwall/experiments/lab/draw.hpp>

#include "support/temporary_folder.hpp"

namespace thinwall {
namespace {

struct BadInputTest : testing::Test {
  TemporaryFolder folder;

  /// `said`: every part that the one line must have.
  void expect_refusal(std::vector<std::string> words, const std::vector<std::string>& said) const {
    words.insert(words.begin(), THINWALL_PROGRAM);
    const ProcessResult result = run_process(words, folder.path());
    EXPECT_EQ(result.status, 2) << result.output;
    EXPECT_EQ(std::ranges::count(result.output, '\n'), 1) << result.output;
    for (const std::string& part : said) EXPECT_NE(result.output.find(part), std::string::npos) << result.output;
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
    EXPECT_FALSE(std::filesystem::exists(folder / "results"));
  }

  void expect_refused_config(const std::string& text, const std::vector<std::string>& said) const {
    write_text(folder / "my.toml", "experiment = \"thin_wall\"\n" + text + "\n");
    expect_refusal({"run", "my.toml", "--out", "out"}, said);
  }
};

TEST_F(BadInputTest, configurations) {
  expect_refused_config("raduis = [0.1]", {"my.toml:2: key 'raduis': unknown key", "did you mean 'radius'?"});
  expect_refused_config("radius = \"big\"", {"my.toml:2: key 'radius': 'big'", "[m]"});
  expect_refused_config("radius = [-0.1]", {"my.toml:2: key 'radius': -0.1 is not allowed", "[m]"});
  expect_refused_config("step = [0]", {"my.toml:2: key 'step': 0 is not allowed", "numbers > 0", "[s]"});
  expect_refused_config("speed = [nan]", {"my.toml:2: key 'speed': nan is not allowed", "[m/s]"});
  expect_refused_config("speed = []", {"my.toml:2: key 'speed': an empty list is not allowed"});
  expect_refused_config(
      "method = [\"end_of_stp\"]",
      {"my.toml:2: key 'method': 'end_of_stp' is not allowed; did you mean 'end_of_step'? (allowed: "});
  expect_refused_config("radius = [0.1", {"my.toml:2: not TOML, at column "});
}

TEST_F(BadInputTest, experiments) {
  expect_refusal({"run", "thin_wal", "--out", "out"}, {"'thin_wal': unknown experiment; did you mean 'thin_wall'?"});
  write_text(folder / "my.toml", "experiment = \"thinwall\"\n");
  expect_refusal({"run", "my.toml", "--out", "out"},
                 {"my.toml:1: key 'experiment': 'thinwall' is not allowed; did you mean 'thin_wall'?"});
  write_text(folder / "my.toml", "radius = [0.1]\n");
  expect_refusal({"run", "my.toml", "--out", "out"}, {"my.toml:1: key 'experiment': missing"});
  expect_refusal({"run", "none.toml", "--out", "out"}, {"none.toml: there is no such file"});
  expect_refusal({"run", ".", "--out", "out"}, {".: is not a file"});
}

TEST_F(BadInputTest, folders) {
  write_text(folder / "file", "");
  expect_refusal({"run", "thin_wall", "--out", "file/below"}, {"--out file/below: cannot be written: Not a directory"});
  expect_refusal({"run", "thin_wall", "--out", "/proc/thinwall"}, {"--out /proc/thinwall: cannot be written: "});
  expect_refusal({"run", "thin_wall", "--out", ""}, {"--out: '' is not allowed"});
}

TEST_F(BadInputTest, command_lines) {
  expect_refusal({}, {"a command is missing"});
  expect_refusal({"rnu"}, {"'rnu': unknown command; did you mean 'run'?"});
  expect_refusal({"run"}, {"an experiment's name or a TOML file is missing"});
  expect_refusal({"run", "thin_wall", "--sed", "1"}, {"'--sed': unknown option; did you mean '--seed'?"});
  expect_refusal({"run", "thin_wall", "more"}, {"'more': one word too many"});
  expect_refusal({"run", "thin_wall", "--seed", "-1"}, {"--seed: '-1' is not allowed; a whole number from 0 to "});
  expect_refusal({"run", "thin_wall", "--trials", "0"}, {"--trials: '0' is not allowed; a whole number from 1 to "});
  expect_refusal({"run", "thin_wall", "--threads", "0"}, {"--threads: '0' is not allowed; a whole number from 1 to "});
  expect_refusal({"run", "thin_wall", "--trials"}, {"--trials: exactly one value is needed"});
  expect_refusal({"run", "thin_wall", "--json=yes"}, {"--json: takes no value"});
}

TEST_F(BadInputTest, help_is_no_error_and_opens_with_examples) {
  for (const std::vector<std::string>& words : {std::vector<std::string>{"--help"}, {"run", "--help"}, {"-h"}}) {
    std::vector<std::string> call = {THINWALL_PROGRAM};
    call.insert(call.end(), words.begin(), words.end());
    const ProcessResult result = run_process(call, folder.path());
    EXPECT_EQ(result.status, 0);
    EXPECT_LT(result.output.find("Examples:"), result.output.find("Usage:")) << result.output;
  }
  const ProcessResult version = run_process({THINWALL_PROGRAM, "--version"}, folder.path());
  EXPECT_EQ(version.status, 0);
  EXPECT_TRUE(version.output.starts_with("thinwall ")) << version.output;
}

}  // namespace
}  // namespace thinwall
