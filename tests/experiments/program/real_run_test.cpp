/// The program as it is, with its headline experiment in small: the same bytes for any thread count, and after any end.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include <chrono>
#include <thread>

#include <thinwall/experiments/lab/draw.hpp>

#include "support/temporary_folder.hpp"

namespace thinwall {
namespace {

constexpr const char* small_config = R"(experiment = "thin_wall"
shots = 6000
speed = [10, 200]
step = [0.016666666666666666]
radius = [0.001, 0.02]
thickness = [0.01]
angle_deg = [0, 60]
)";

struct RealRunTest : testing::Test {
  TemporaryFolder folder;

  RealRunTest() { write_text(folder / "my.toml", small_config); }

  std::vector<std::string> words(const std::string& out, const std::string& threads) const {
    return {THINWALL_PROGRAM, "run", folder / "my.toml", "--out", folder / out, "--threads", threads, "--seed", "11"};
  }

  ProcessResult run(const std::string& out, const std::string& threads) const {
    return run_process(words(out, threads), folder.path());
  }

  /// Starts a run and ends it with `signal` once its journal has `rows` rows. Returns how it ended, as waitpid says it.
  int run_until(const std::string& out, std::size_t rows, int signal) const {
    std::vector<std::string> copies = words(out, "2");
    std::vector<char*> pointers;
    for (std::string& word : copies) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 2, (folder / "stderr").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0666);
    pid_t child = 0;
    EXPECT_EQ(::posix_spawn(&child, THINWALL_PROGRAM, &actions, nullptr, pointers.data(), environ), 0);
    posix_spawn_file_actions_destroy(&actions);
    int status = 0;
    bool sent = false;
    while (::waitpid(child, &status, WNOHANG) == 0) {
      if (!sent && finished_rows(out) >= rows) sent = ::kill(child, signal) == 0;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return status;
  }

  std::size_t finished_rows(const std::string& out) const {
    std::ifstream in(folder / out + "/journal.tsv");
    std::size_t rows = 0;
    for (std::string line; std::getline(in, line);) ++rows;
    return rows;
  }

  /// Everything that must not differ from run to run.
  std::map<std::string, std::string> lasting_files(const std::string& out) const {
    auto files = files_in(folder / out);
    for (const char* name : {"data/timings.csv", "report.html", "manifest.json"})
      EXPECT_EQ(files.erase(name), 1u) << name;
    return files;
  }
};

TEST_F(RealRunTest, gives_the_same_bytes_for_1_2_and_3_threads) {
  for (const char* threads : {"1", "2", "3"}) {
    const ProcessResult result = run(threads, threads);
    ASSERT_EQ(result.status, 0) << result.output;
  }
  EXPECT_EQ(lasting_files("1"), lasting_files("2"));
  EXPECT_EQ(lasting_files("1"), lasting_files("3"));
  EXPECT_TRUE(
      read_text(folder / "1/data/cells.csv").starts_with("method,scalar,speed,step,radius,thickness,angle_deg,"));
}

TEST_F(RealRunTest, keeps_what_was_finished_when_it_is_interrupted) {
  const int status = run_until("cut", 10, SIGINT);
  ASSERT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 130) << status;
  const std::string notes = read_text(folder / "stderr");
  EXPECT_NE(notes.find(std::string("to continue:\n") + THINWALL_PROGRAM + " run "), std::string::npos) << notes;
  EXPECT_EQ(files_in(folder / "cut").size(), 1u) << "the journal alone";
  const ProcessResult rest = run("cut", "1");
  ASSERT_EQ(rest.status, 0) << rest.output;
  EXPECT_NE(rest.output.find("units were read from the journal"), std::string::npos) << rest.output;
  ASSERT_EQ(run("whole", "2").status, 0);
  EXPECT_EQ(lasting_files("cut"), lasting_files("whole"));
}

TEST_F(RealRunTest, loses_nothing_it_counted_when_it_is_killed) {
  std::size_t rows = 0;
  for (const std::size_t more : {2u, 9u, 20u}) {
    const int status = run_until("killed", rows + more, SIGKILL);
    ASSERT_TRUE(WIFSIGNALED(status)) << status;
    EXPECT_GE(finished_rows("killed"), rows + more);
    rows = finished_rows("killed");
  }
  const ProcessResult rest = run("killed", "2");
  ASSERT_EQ(rest.status, 0) << rest.output;
  ASSERT_EQ(run("whole", "2").status, 0);
  EXPECT_EQ(lasting_files("killed"), lasting_files("whole"));
}

}  // namespace
}  // namespace thinwall
