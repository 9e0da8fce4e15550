/// The programs that speed starts: those beside ours, or of a folder that the command line names; none that a file names, and
/// none on a dry run.

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include <thinwall/experiments/program/program.hpp>

#include "experiments/speed_run.hpp"
#include "support/toy_program.hpp"

namespace thinwall {
namespace {

struct BenchmarksTest : testing::Test {
  TemporaryFolder folder;
  std::string config = folder / "speed.toml", out = folder / "out";

  BenchmarksTest() {
    std::filesystem::create_directory(folder / "theirs");
    write_script(folder / "theirs", "pairs",
                 "touch " + folder / "started" + "\ncat >\"$out\" <<'END'\n" +
                     bench_json(bench_row("raycast/aabb/front_door", 30, 0, 0, 1e-15)) + "\nEND");
  }

  static Reply call(std::vector<std::string> words) {
    const std::vector<Experiment> experiments = {speed_experiment(), toy_experiment()};
    words.insert(words.begin(), "thinwall");
    std::ostringstream reply, notes;
    const int status = run_program(words, experiments, reply, notes);
    return {status, reply.str(), notes.str()};
  }

  bool started() const { return std::filesystem::remove(folder / "started"); }
};

TEST_F(BenchmarksTest, are_started_only_if_the_command_line_names_their_folder) {
  const std::string rest = "experiment = \"speed\"\nprograms = [\"pairs\"]\nrounds = 1\n";
  write_text(config, rest + "benchmarks = \"" + folder / "theirs" + "\"\n");
  for (const char* more : {"--json", "--dry-run"}) {
    const Reply reply = call({"run", config, "--out", out, more});
    EXPECT_EQ(reply.status, 2);
    EXPECT_EQ(reply.err,
              config + ":4: key 'benchmarks': '" + folder / "theirs" +
                  "' is not allowed; \"\"; to start the programs of that folder, say so: --benchmarks DIR\n");
    EXPECT_FALSE(started());
  }
  const Reply dry = call({"run", config, "--benchmarks", folder / "theirs", "--dry-run"});
  EXPECT_EQ(dry.status, 0) << dry.err;
  EXPECT_FALSE(started()) << "on a dry run";
  EXPECT_EQ(call({"run", config, "--benchmarks", folder / "theirs", "--out", out}).status, 0);
  EXPECT_TRUE(started());
  EXPECT_EQ(call({"reproduce", out}).status, 2);
  EXPECT_FALSE(started());
  EXPECT_EQ(call({"reproduce", out, "--benchmarks", folder / "theirs"}).status, 0);
  EXPECT_TRUE(started());
  EXPECT_EQ(call({"run", "toy", "--benchmarks", folder / "theirs"}).err,
            "--benchmarks: only speed starts other programs\n");
}

}  // namespace
}  // namespace thinwall
