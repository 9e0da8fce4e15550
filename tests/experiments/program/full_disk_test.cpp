/// A disk that is full, and a folder that cannot be written: named, nothing lost, and the same command goes on.
/// The disk is a small tmpfs in a mount namespace of its own, which ends with the shell that made it.

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <sstream>

#include <thinwall/experiments/lab/draw.hpp>

#include "support/small_wall.hpp"

namespace thinwall {
namespace {

namespace fs = std::filesystem;

struct FullDiskTest : testing::Test {
  TemporaryFolder folder;

  FullDiskTest() {
    write_text(folder / "my.toml", small_wall);
    fs::create_directory(folder / "disk");
  }

  ProcessResult in_namespace(const std::string& script) const {
    const char* const how = ::geteuid() == 0 ? "-m" : "-rm";
    return run_process({"unshare", how, "sh", "-c", script}, folder.path());
  }

  /// Why there can be no disk; empty if there can.
  std::string trouble() const {
    const ProcessResult probe = in_namespace("mount -t tmpfs -o size=64k none disk");
    return probe.status == 0 ? "" : "a tmpfs cannot be mounted here: " + probe.output;
  }

  /// Runs into a disk with those `limits` until it ends, twice; then writes nothing to it, then makes room and runs again.
  /// Leaves what each said in 1, 2, read_only and 3, and the result in `result`.
  std::string fill(const std::string& limits) const {
    const std::string run =
        std::string("'") + THINWALL_PROGRAM + "' run my.toml --out disk/out --threads 2 --seed 11 >/dev/null 2>";
    const ProcessResult end = in_namespace("mount -t tmpfs -o " + limits + " none disk\n" +         //
                                           run + "1; echo $? >status\n" +                           //
                                           "cp disk/out/journal.tsv kept\n" +                       //
                                           run + "2; echo $? >>status\n" +                          //
                                           "mount -o remount,ro disk\n" +                           //
                                           run + "read_only; echo $? >>status\n" +                  //
                                           "mount -o remount,rw,size=64m,nr_inodes=10000 disk\n" +  //
                                           run + "3; echo $? >>status\n" +                          //
                                           "cp -r disk/out result\n");
    EXPECT_EQ(end.status, 0) << end.output;
    return read_text(folder / "status");
  }

  std::string last_line(const std::string& file) const {
    std::istringstream lines(read_text(folder / file));
    std::string last;
    for (std::string line; std::getline(lines, line);) last = line;
    return last;
  }

  void expect_survival(const std::string& limits, const std::string& where) {
    SCOPED_TRACE(limits);
    EXPECT_EQ(fill(limits), "1\n1\n2\n0\n") << read_text(folder / "1") << read_text(folder / "2");
    EXPECT_TRUE(last_line("1").starts_with("failed: disk/out/" + where)) << last_line("1");
    EXPECT_NE(last_line("1").find(": No space left on device; what was finished is kept"), std::string::npos);
    EXPECT_NE(last_line("2").find(": No space left on device"), std::string::npos) << last_line("2");
    EXPECT_EQ(read_text(folder / "read_only"), "--out disk/out: cannot be written: Read-only file system\n");
    const std::string journal = read_text(folder / "kept");
    const bool publishing = journal.find("\n\t") != journal.npos;          // a row without a key
    const auto rows = std::ranges::count(journal, '\n') - 1 - publishing;  // a torn one has no end
    EXPECT_GT(rows, 0);
    std::istringstream continued(read_text(folder / "3"));
    long read = 0;
    for (std::string line; std::getline(continued, line);) {
      if (line.ends_with("units were read from the journal")) read = std::stol(line);
    }
    EXPECT_GE(read, rows);
    EXPECT_EQ(lasting_files(folder / "result"), expected_);
    fs::remove_all(folder / "result");
  }

  std::map<std::string, std::string> expected_;
};

TEST_F(FullDiskTest, is_named_and_loses_nothing_wherever_it_fills) {
  if (const std::string why = trouble(); !why.empty()) GTEST_SKIP() << why;
  const ProcessResult whole = run_process(
      {THINWALL_PROGRAM, "run", "my.toml", "--out", "whole", "--threads", "2", "--seed", "11"}, folder.path());
  ASSERT_EQ(whole.status, 0) << whole.output;
  expected_ = lasting_files(folder / "whole");
  expect_survival("size=16k", "journal.tsv");
  expect_survival("size=300k", ".thinwall-");
  const auto entries =
      std::distance(fs::recursive_directory_iterator(folder / "whole"), fs::recursive_directory_iterator());
  // Room for the root, the result folder, the journal, the folder for staging and all it holds; none for a folder beside it.
  expect_survival("nr_inodes=" + std::to_string(4 + entries), "data");
}

TEST_F(FullDiskTest, is_no_bad_input_when_there_is_no_room_for_the_first_row) {
  if (const std::string why = trouble(); !why.empty()) GTEST_SKIP() << why;
  const ProcessResult end = in_namespace(
      "mount -t tmpfs -o nr_inodes=2 none disk\n"
      "'" THINWALL_PROGRAM "' run my.toml --out disk/out; echo $?; ls -A disk/out");
  EXPECT_EQ(end.output, "failed: --out disk/out: cannot be written: No space left on device\n1\n");
}

}  // namespace
}  // namespace thinwall
