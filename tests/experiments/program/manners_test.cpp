/// How the program talks: one JSON value on stdout where it is asked for, everything else as text on stderr, no escape
/// sequence where nobody watches, help that begins with an example, and exit codes as the documents say.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include <thinwall/experiments/lab/draw.hpp>
#include <thinwall/experiments/program/command.hpp>

#include "experiments/scenes/scene_text.hpp"
#include "support/toy_program.hpp"

namespace thinwall {
namespace {

struct MannersTest : ToyProgram {
  std::string scene = folder / "scene.toml";

  MannersTest() { write_text(scene, bullet_text("policy = 'discrete'\n")); }

  std::vector<std::vector<std::string>> calls() const {
    const std::string there = folder / "there";
    return {{"list"},
            {"run", "toy", "--out", out, "--threads", "1"},
            {"run", "toy", "--out", out},  // complete already
            {"run", "toy", "--dry-run"},
            {"run", "toy", "--list-cells"},
            {"run", scene, "--out", folder / "scene"},
            {"compare", scene, "--out", folder / "compare"},
            {"plan", scene},
            {"reproduce", out, "--out", there},
            {"completion", "bash"}};
  }
};

TEST_F(MannersTest, json_is_one_value_on_stdout_and_all_else_is_text_on_stderr) {
  for (std::vector<std::string> words : calls()) {
    words.emplace_back("--json");
    const Reply reply = call(words);
    EXPECT_EQ(reply.status, 0) << words[0] << reply.err;
    EXPECT_TRUE(nlohmann::json::accept(reply.out)) << words[0] << ": " << reply.out;
    EXPECT_EQ(std::ranges::count(reply.out, '\n'), 1) << words[0];
    EXPECT_FALSE(nlohmann::json::accept(reply.err)) << words[0] << ": " << reply.err;
  }
}

TEST_F(MannersTest, with_json_bad_input_is_still_a_line_of_text_on_stderr) {
  const std::vector<std::vector<std::string>> wrong = {
      {"run", "tyo"},        {"run", "toy", "--seed", "x"}, {"compare", "none.toml"}, {"plan", "none.toml"},
      {"reproduce", "none"}, {"validate", "none"},          {"completion", "csh"}};
  for (std::vector<std::string> words : wrong) {
    words.emplace_back("--json");
    const Reply reply = call(words);
    EXPECT_EQ(reply.status, 2) << words[0];
    EXPECT_EQ(reply.out, "") << words[0];
    EXPECT_EQ(std::ranges::count(reply.err, '\n'), 1) << words[0] << reply.err;
    EXPECT_FALSE(nlohmann::json::accept(reply.err)) << words[0];
  }
}

TEST_F(MannersTest, never_writes_an_escape_sequence_where_there_is_no_terminal) {
  ::setenv("TERM", "xterm-256color", 1);
  ::setenv("CLICOLOR_FORCE", "1", 1);
  for (std::vector<std::string> words : {std::vector<std::string>{"--help"},
                                         {"list"},
                                         {"run", "--help"},
                                         {"run", "none"},
                                         {"run", scene, "--out", folder / "escape"},
                                         {"plan", scene}}) {
    words.insert(words.begin(), THINWALL_PROGRAM);
    const ProcessResult result = run_process(words, folder.path());
    EXPECT_NE(result.output, "");
    EXPECT_EQ(result.output.find('\x1b'), std::string::npos) << words[1] << result.output;
    EXPECT_EQ(result.output.find('\r'), std::string::npos) << words[1] << result.output;
  }
}

TEST_F(MannersTest, every_command_has_a_help_that_begins_with_examples_of_itself) {
  for (const Command& command : commands()) {
    const Reply reply = call({command.name, "--help"});
    EXPECT_EQ(reply.status, 0);
    EXPECT_TRUE(reply.out.starts_with(std::string("Examples:\n  "))) << reply.out;
    EXPECT_NE(reply.out.find(std::string("thinwall ") + command.name), std::string::npos) << reply.out;
    EXPECT_LT(reply.out.find(std::string("thinwall ") + command.name), reply.out.find("Usage: thinwall ")) << reply.out;
    EXPECT_EQ(reply.err, "");
  }
}

TEST_F(MannersTest, lists_every_unit_and_writes_nothing) {
  const Reply reply = run({"--list-cells"});
  EXPECT_EQ(reply.status, 0);
  EXPECT_TRUE(reply.out.starts_with("          10  cell 0\n          10  cell 1\n")) << reply.out;
  EXPECT_EQ(std::ranges::count(reply.out, '\n'), 20);
  const auto json = nlohmann::json::parse(run({"--list-cells", "--json", "--trials", "7"}).out);
  EXPECT_EQ(json.at("units"), 20);
  EXPECT_EQ(json.at("trials"), 140);
  EXPECT_EQ(json.at("cells").size(), 20u);
  EXPECT_EQ(json.at("cells").at(19), nlohmann::json({{"key", "cell 19"}, {"trials", 7}}));
  EXPECT_EQ(ToyControl::computed, 0);
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(MannersTest, notices_that_its_output_is_lost) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
  const ProcessResult result = run_process({"sh", "-c", "'" THINWALL_PROGRAM "' list >/dev/full"}, folder.path());
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.output, "failed: stdout cannot be written\n");
}

}  // namespace
}  // namespace thinwall
