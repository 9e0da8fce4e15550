/// Every command of the README, run as it stands there, prints what the README shows.

#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>

#include <thinwall/experiments/lab/draw.hpp>

#include "support/program.hpp"
#include "support/thorough.hpp"

namespace thinwall {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::string indented(const std::vector<std::string>& lines) {
  std::string out;
  for (const std::string& line : lines) out += "  | " + line + "\n";
  return out;
}

TEST(Console, finds_commands_output_and_files) {
  const Document document =
      read_document("text\n```console\n$ a b\nx\n...\n$ c\n```\n```toml\n# my.toml\nk = 1\n```\n");
  ASSERT_EQ(document.commands.size(), 2u);
  EXPECT_EQ(document.commands[0].line, "a b");
  EXPECT_EQ(document.commands[0].output, (std::vector<std::string>{"x", "..."}));
  EXPECT_TRUE(document.commands[1].output.empty());
  EXPECT_EQ(document.files.at("my.toml"), "# my.toml\nk = 1\n");
}

TEST(Console, three_points_stand_for_any_text) {
  EXPECT_TRUE(line_matches("a ... c", "a b c"));
  EXPECT_TRUE(line_matches("a...", "a"));
  EXPECT_FALSE(line_matches("a ... c", "a b d"));
  EXPECT_FALSE(line_matches("a", "a b"));
  EXPECT_TRUE(lines_match({"x", "...", "z"}, {"x", "y", "y", "z"}));
  EXPECT_TRUE(lines_match({"...", "z"}, {"z"}));
  EXPECT_FALSE(lines_match({"x", "...", "z"}, {"x", "y"}));
  EXPECT_FALSE(lines_match({"x"}, {"x", "y"}));
}

TEST(Readme, every_command_prints_what_is_shown) {
  if (testing::slow_build)
    GTEST_SKIP() << "the commands take minutes under the sanitizers; the release build runs them";
  const std::filesystem::path root = THINWALL_SOURCE;
  const Document readme = read_document(read_text(root / "README.md"));
  ASSERT_GE(readme.commands.size(), 10u);
  TemporaryFolder folder;  // as a fresh clone looks to the commands, after the build
  for (const char* name : {"experiments", "docs"})
    std::filesystem::create_directory_symlink(root / name, folder / name);
  std::filesystem::create_directories(folder / "build/release");
  std::filesystem::create_symlink(THINWALL_PROGRAM, folder / "build/release/thinwall");
  for (const auto& [name, text] : readme.files) write_text(folder / name, text);

  for (const auto& [line, output] : readme.commands) {
    SCOPED_TRACE(line);
    if (line.starts_with("./") || line.starts_with("git ")) {
      std::cout << "not run here but by ./check itself, or before it: " << line << "\n";
      continue;
    }
    const ProcessResult result = run_process({"sh", "-c", line + " 2>/dev/null"}, folder.path());
    EXPECT_EQ(result.status, 0);
    if (output.empty()) continue;
    const std::vector<std::string> printed = lines_of(result.output);
    EXPECT_TRUE(lines_match(output, printed)) << "the README shows\n"
                                              << indented(output) << "but it prints\n"
                                              << indented(printed);
  }
}

}  // namespace
}  // namespace thinwall
