/// The completion scripts, read by the shells they are for.

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <sstream>

#include <thinwall/experiments/lab/draw.hpp>
#include <thinwall/experiments/program/command.hpp>
#include <thinwall/experiments/program/completion.hpp>

#include "support/temporary_folder.hpp"

namespace thinwall {
namespace {

namespace fs = std::filesystem;

struct CompletionTest : testing::Test {
  TemporaryFolder folder;

  ProcessResult in_folder(const std::vector<std::string>& words) const { return run_process(words, folder.path()); }

  std::string script(const std::string& shell) const {
    const ProcessResult reply = in_folder({THINWALL_PROGRAM, "completion", shell});
    EXPECT_EQ(reply.status, 0) << reply.output;
    return reply.output;
  }

  /// What bash offers for the last of the words.
  std::set<std::string> completed(const std::vector<std::string>& words) const {
    write_text(folder / ".completion", script("bash"));
    std::string line = "set -u; source .completion; COMP_WORDS=(";
    for (const std::string& word : words) line += "'" + word + "' ";
    line += "); COMP_CWORD=" + std::to_string(words.size() - 1) + "; _thinwall; printf '%s\\n' \"${COMPREPLY[@]}\"";
    const ProcessResult reply = in_folder({"bash", "--norc", "-c", line});
    EXPECT_EQ(reply.status, 0) << reply.output;
    std::set<std::string> out;
    std::istringstream lines(reply.output);
    for (std::string word; std::getline(lines, word);) {
      if (!word.empty()) out.insert(word);
    }
    return out;
  }

  using Words = std::set<std::string>;
};

TEST_F(CompletionTest, bash_completes_commands_experiments_and_options) {
  EXPECT_EQ(completed({"thinwall", "ru"}), Words{"run"});
  EXPECT_EQ(completed({"thinwall", "run", "thin_w"}), Words{"thin_wall"});
  EXPECT_EQ(completed({"thinwall", "run", "--tr"}), (Words{"--trials", "--trace"}));
  EXPECT_EQ(completed({"thinwall", "run", "thin_wall", "--plan", ""}), (Words{"lean", "full"}));
  EXPECT_EQ(completed({"thinwall", "completion", "z"}), Words{"zsh"});
  EXPECT_EQ(completed({"thinwall", "run", "--seed", ""}), Words{}) << "a number";
  EXPECT_EQ(completed({"thinwall", "nothing", ""}), Words{});
  const Words commands_offered = completed({"thinwall", ""});
  for (const Command& command : commands()) EXPECT_TRUE(commands_offered.contains(command.name)) << command.name;
}

TEST_F(CompletionTest, bash_completes_files_and_folders_where_they_may_stand) {
  write_text(folder / "thin my.toml", "");
  write_text(folder / "thin.txt", "");
  fs::create_directory(folder / "things");
  EXPECT_EQ(completed({"thinwall", "run", "thin"}), (Words{"thin_wall", "thin my.toml", "things"}));
  EXPECT_EQ(completed({"thinwall", "compare", "thi"}), (Words{"thin my.toml", "things"}));
  EXPECT_EQ(completed({"thinwall", "run", "thin_wall", "--out", "th"}), Words{"things"});
  EXPECT_EQ(completed({"thinwall", "reproduce", "th"}), Words{"things"});
}

TEST_F(CompletionTest, other_shells_can_read_their_scripts) {
  for (const char* shell : {"zsh", "fish"}) {
    const std::string text = script(shell);
    for (const Command& command : commands()) EXPECT_NE(text.find(command.name), std::string::npos) << command.name;
    write_text(folder / shell, text);
    const ProcessResult reply = in_folder({shell, "-n", folder / shell});
    if (!reply.found) {
      std::printf("%s is not installed: its script was not read by it\n", shell);
      continue;
    }
    EXPECT_EQ(reply.status, 0) << reply.output;
    EXPECT_EQ(reply.output, "");
  }
}

TEST_F(CompletionTest, refuses_a_shell_it_does_not_know) {
  const ProcessResult reply = in_folder({THINWALL_PROGRAM, "completion", "bsh"});
  EXPECT_EQ(reply.status, 2);
  EXPECT_EQ(reply.output, "completion: 'bsh' is not allowed; did you mean 'bash'? (allowed: bash, zsh, fish)\n");
}

TEST_F(CompletionTest, knows_every_option_of_every_command_and_its_meaning) {
  for (const CompletedCommand& command : completed_commands({})) {
    EXPECT_FALSE(command.summary.empty()) << command.name;
    EXPECT_TRUE(std::ranges::any_of(command.options, [](const auto& option) { return option.name == "--json"; }))
        << command.name << " replies to no script";
    for (const CompletedOption& option : command.options)
      EXPECT_FALSE(option.meaning.empty()) << command.name << " " << option.name;
  }
}

}  // namespace
}  // namespace thinwall
