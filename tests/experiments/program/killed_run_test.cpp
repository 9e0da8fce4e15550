/// Killed at any moment, from before its first unit until the last file has its place, a run goes on by the same command
/// and ends with the same bytes.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <random>

#include <thinwall/experiments/lab/files.hpp>
#include <thinwall/experiments/lab/journal.hpp>

#include "support/program_process.hpp"
#include "support/small_wall.hpp"

namespace thinwall {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct KilledRunTest : testing::Test {
  TemporaryFolder folder;

  KilledRunTest() { write_text(folder / "my.toml", small_wall); }

  std::vector<std::string> words(const std::string& out) const {
    return {THINWALL_PROGRAM, "run", folder / "my.toml", "--out", folder / out, "--threads", "2", "--seed", "11"};
  }

  std::string notes() const { return read_text(folder / "notes"); }

  std::uintmax_t journal_size(const std::string& out) const {
    std::error_code none;
    const auto size = fs::file_size(folder / out + "/journal.tsv", none);
    return none ? 0 : size;
  }

  /// True while a file of the result waits for its place.
  bool is_staged(const std::string& out, const std::string& name) const {
    std::error_code none;
    for (fs::directory_iterator entry(folder / out, none), end; !none && entry != end; entry.increment(none)) {
      if (is_temporary_name(entry->path().filename().string()) && fs::exists(entry->path() / name, none)) return true;
    }
    return false;
  }

  void run_to_the_end(const std::string& out) const {
    const int status = ProgramProcess(words(out), folder / "notes").wait();
    ASSERT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status << notes();
  }
};

TEST_F(KilledRunTest, ends_with_the_same_bytes_after_fifty_kills) {
  constexpr int kills = sanitized ? 10 : 50;
  constexpr int moments = 4;
  std::uintmax_t largest_journal = 0;
  const auto start = Clock::now();
  {
    ProgramProcess whole(words("whole"), folder / "notes");
    while (whole.running()) {
      largest_journal = std::max(largest_journal, journal_size("whole"));
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    ASSERT_EQ(whole.wait(), 0) << notes();
  }
  const auto whole_time = Clock::now() - start;
  const auto expected = lasting_files(folder / "whole");
  ASSERT_GT(largest_journal, 0u);
  std::vector<std::string> names;
  for (const auto& [name, text] : files_in(folder / "whole")) names.push_back(name);

  std::mt19937_64 random(20261122);
  const auto below = [&](auto count) {
    return static_cast<decltype(count)>(random() % static_cast<std::uint64_t>(count));
  };
  std::array<int, moments> killed{};
  int done = 0, folders = 0;
  std::string out = "0";
  for (int attempt = 0; done < kills; ++attempt) {
    ASSERT_LT(attempt, 20 * kills) << "too few runs live long enough to be killed";
    const int kind = below(moments);
    const auto when = Clock::now() + below(whole_time.count()) * Clock::duration(1);
    const auto size = below(largest_journal);
    const std::string name = names[below(names.size())];
    const auto moment = [&] {
      switch (kind) {
        case 0: return Clock::now() >= when;
        case 1: return journal_size(out) > size;
        case 2: return is_staged(out, name);
        default: return fs::exists(folder / out + "/" + name);
      }
    };
    ProgramProcess run(words(out), folder / "notes");
    const bool reached = run.wait_until(moment, std::chrono::microseconds(kind < 2 ? 100 : 0));
    const int status = reached ? run.end_with(SIGKILL) : run.wait();
    if (WIFSIGNALED(status)) {
      ++done;
      ++killed[static_cast<std::size_t>(kind)];
      const bool complete = fs::exists(folder / out + "/manifest.json");
      for (const auto& [file, text] : expected) {  // whatever has its own name is whole; with a manifest, all is there
        const fs::path there = folder / out + "/" + file;
        ASSERT_TRUE(!complete || fs::exists(there)) << file;
        if (file == "cite.bib" || !fs::exists(there)) continue;
        ASSERT_EQ(read_text(there), text) << file;
      }
      if (kind < 2) continue;
      run_to_the_end(out);
    } else {
      ASSERT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status << notes();
    }
    ASSERT_EQ(lasting_files(folder / out), expected);
    out = std::to_string(++folders);
  }
  run_to_the_end(out);
  EXPECT_EQ(lasting_files(folder / out), expected);
  std::printf(
      "killed %d times by the clock, %d in the units, %d before and %d after files had their place; %d folders\n",
      killed[0], killed[1], killed[2], killed[3], folders + 1);
  EXPECT_GT(*std::ranges::min_element(killed), 0);
}

TEST_F(KilledRunTest, clears_up_after_a_kill_between_the_manifest_and_the_end) {
  run_to_the_end("out");
  const auto expected = lasting_files(folder / "out");
  Journal(folder / "out/journal.tsv", "left");
  fs::create_directories(folder / "out/" + temporary_name() + "/data");
  run_to_the_end("out");
  EXPECT_NE(notes().find("complete already"), std::string::npos) << notes();
  EXPECT_EQ(lasting_files(folder / "out"), expected);
}

TEST_F(KilledRunTest, forgets_no_file_of_a_result_that_it_was_replacing) {
  run_to_the_end("out");
  const auto expected = lasting_files(folder / "out");
  std::string manifest = read_text(folder / "out/manifest.json");
  manifest.insert(manifest.find("\"files\": {") + 10, "\"data/gone.csv\": \"" + sha256("old\n") + "\", ");
  fs::remove(folder / "out/manifest.json");  // killed after its first moves, replacing a result with one file more
  write_text(folder / "out/manifest.old.json", manifest);
  write_text(folder / "out/data/gone.csv", "old\n");
  run_to_the_end("out");
  EXPECT_NE(notes().find("an earlier result was being replaced here"), std::string::npos) << notes();
  EXPECT_EQ(lasting_files(folder / "out"), expected);
}

TEST_F(KilledRunTest, heeds_an_interrupt_at_once_in_the_midst_of_a_long_unit) {
  write_text(
      folder / "my.toml",
      "experiment = \"thin_wall\"\nshots = 4194304\nspeed = [10]\nstep = [0.016666666666666666]\nradius = [0.02]\n"
      "thickness = [0.01]\nangle_deg = [0]\nwall = [\"infinite\"]\nmethod = [\"inclusion\"]\nscalar = [\"double\"]\n");
  ProgramProcess run(words("long"), folder / "notes");
  ASSERT_TRUE(
      run.wait_until([&] { return notes().find("units, ") != std::string::npos; }, std::chrono::milliseconds(5)))
      << notes();
  std::this_thread::sleep_for(std::chrono::milliseconds(200));  // the units are under way
  const int status = run.end_with(SIGINT);
  const std::string journal = read_text(folder / "long/journal.tsv");
  EXPECT_LE(std::ranges::count(journal, '\n'), 2) << "the long unit was waited for";  // the other has 1009 shots
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 130) << status;
  EXPECT_NE(notes().find("to continue:\n"), std::string::npos) << notes();
}

}  // namespace
}  // namespace thinwall
