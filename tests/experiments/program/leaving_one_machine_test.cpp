/// The program as it is, cut into shards and shared among the ranks of mpirun: the bytes of one run.

#include <gtest/gtest.h>

#include <algorithm>

#include <nlohmann/json.hpp>

#include <thinwall/experiments/lab/draw.hpp>

#include "support/program_process.hpp"
#include "support/small_wall.hpp"
#include "support/temporary_folder.hpp"

namespace thinwall {
namespace {

constexpr const char* small_bouncing = R"(experiment = "bouncing"
step = [0.03333333333333333, 0.016666666666666666, 0.06666666666666667]
restitution = [0.5, 1]
bounces = 200
runs = 4
run_bounces = 8
rounds = 1
mass_ratio = [1]
scenario = ["zeno", "walls", "masses"]
digits = 2
)";

struct LeavingOneMachine : testing::Test {
  TemporaryFolder folder;

  LeavingOneMachine() {
    write_text(folder / "wall.toml", small_wall);
    write_text(folder / "bouncing.toml", small_bouncing);
  }

  ProcessResult call(std::vector<std::string> words) const {
    words.insert(words.begin(), THINWALL_PROGRAM);
    return run_process(words, folder.path());
  }

  /// Every file that the manifest hashes, but for the date in one.
  std::map<std::string, std::string> hashed_files(const std::string& result) const {
    std::map<std::string, std::string> files;
    const auto manifest = nlohmann::json::parse(read_text(folder / result + "/manifest.json"));
    for (const auto& [name, hash] : manifest.at("files").items()) files[name] = read_text(folder / result + "/" + name);
    files.erase("cite.bib");
    EXPECT_GT(files.size(), 5u);
    return files;
  }
};

TEST_F(LeavingOneMachine, merged_shards_are_the_bytes_of_one_run) {
  for (const char* config : {"wall.toml", "bouncing.toml"}) {
    const std::string name = config;
    ASSERT_EQ(call({"run", config, "--seed", "5", "--out", name + ".whole"}).status, 0);
    std::vector<std::string> merge = {"merge", "--out", name + ".merged"};
    for (const char* index : {"2", "1", "3"}) {
      const std::string part = name + "." + index;
      const ProcessResult shard =
          call({"run", config, "--seed", "5", "--shard", std::string(index) + "/3", "--out", part, "--threads", index});
      ASSERT_EQ(shard.status, 0) << shard.output;
      merge.push_back(part);
    }
    const ProcessResult merged = call(merge);
    ASSERT_EQ(merged.status, 0) << merged.output;
    EXPECT_EQ(hashed_files(name + ".merged"), hashed_files(name + ".whole"));
  }
}

struct Mpi : LeavingOneMachine {
  void SetUp() override {
    if (!run_process({"mpirun", "--version"}, folder.path()).found) GTEST_SKIP() << "mpirun is not installed";
#ifndef THINWALL_HAS_MPI
    GTEST_SKIP() << "the program was built without MPI";
#endif
  }

  /// Open MPI itself leaks; and in a container it may not read the memory of its neighbors.
  static std::vector<std::string> mpirun(int ranks, const std::vector<std::string>& words) {
    std::vector<std::string> line = {"/usr/bin/env",
                                     "mpirun",
                                     "--allow-run-as-root",
                                     "--oversubscribe",
                                     "--mca",
                                     "btl_vader_single_copy_mechanism",
                                     "none",
                                     "-x",
                                     "ASAN_OPTIONS=detect_leaks=0",
                                     "-n",
                                     std::to_string(ranks),
                                     THINWALL_PROGRAM};
    line.insert(line.end(), words.begin(), words.end());
    return line;
  }

  ProcessResult on_ranks(int ranks, const std::vector<std::string>& words) const {
    return run_process(mpirun(ranks, words), folder.path());
  }
};

TEST_F(Mpi, ranks_1_2_and_4_give_the_bytes_of_one_process_and_one_of_them_speaks) {
  ASSERT_EQ(call({"run", "wall.toml", "--out", "whole"}).status, 0);
  for (const int ranks : {1, 2, 4}) {
    const std::string out = "ranks" + std::to_string(ranks);
    const ProcessResult result = on_ranks(ranks, {"run", "wall.toml", "--out", out, "--threads", "1"});
    ASSERT_EQ(result.status, 0) << result.output;
    const std::string size = ranks == 1 ? " on 1 thread\n" : " on " + std::to_string(ranks) + " ranks of 1 thread\n";
    EXPECT_NE(result.output.find(size), std::string::npos) << result.output;
    EXPECT_EQ(result.output.find("report: "), result.output.rfind("report: ")) << result.output;
    EXPECT_EQ(hashed_files(out), hashed_files("whole"));
    EXPECT_EQ(files_in(folder / out).count("journal.tsv"), 0u);
    EXPECT_EQ(files_in(folder / out).count("journal.rank-1.tsv"), 0u);
  }
}

TEST_F(Mpi, a_run_whose_ranks_were_killed_goes_on_with_any_number_of_them_or_with_none) {
  const std::string trials = sanitized ? "1500" : "30000";
  ASSERT_EQ(call({"run", "wall.toml", "--trials", trials, "--out", "whole"}).status, 0);
  const auto rows = [&](const std::string& file) {
    std::ifstream in(folder / ("killed/" + file));
    std::ptrdiff_t count = 0;
    for (std::string line; std::getline(in, line);) ++count;
    return std::max<std::ptrdiff_t>(count - 1, 0);
  };
  for (const int ranks : {3, 2}) {
    ProgramProcess process(mpirun(ranks, {"run", (folder / "wall.toml"), "--trials", trials, "--threads", "1", "--out",
                                          (folder / "killed")}),
                           folder / "notes");
    const auto before = rows("journal.tsv");
    ASSERT_TRUE(process.wait_until([&] { return rows("journal.tsv") > before && rows("journal.rank-1.tsv") > 0; },
                                   std::chrono::microseconds(500)));
    process.end_with(SIGTERM);
    EXPECT_FALSE(std::filesystem::exists(folder / "killed/manifest.json"));
  }
  const auto kept = rows("journal.tsv") + rows("journal.rank-1.tsv");
  const ProcessResult rest = call({"run", "wall.toml", "--trials", trials, "--out", "killed"});
  ASSERT_EQ(rest.status, 0) << rest.output;
  const auto note = rest.output.find(" units were read from the journal");
  ASSERT_NE(note, std::string::npos) << rest.output;
  EXPECT_GE(std::stol(rest.output.substr(rest.output.rfind('\n', note) + 1)), kept);
  EXPECT_EQ(hashed_files("killed"), hashed_files("whole"));
}

TEST_F(Mpi, a_folder_of_another_run_is_refused_once_and_no_rank_is_left_waiting) {
  ASSERT_EQ(call({"run", "wall.toml", "--out", "used"}).status, 0);
  const auto before = files_in(folder / "used");
  const ProcessResult refused = on_ranks(2, {"run", "wall.toml", "--seed", "7", "--out", "used"});
  EXPECT_EQ(refused.status, 2);
  const std::string line = "--out used: holds another run (seed = 0, not 7)";
  EXPECT_NE(refused.output.find(line), std::string::npos) << refused.output;
  EXPECT_EQ(refused.output.find(line), refused.output.rfind(line)) << refused.output;
  EXPECT_EQ(files_in(folder / "used"), before);
  EXPECT_EQ(on_ranks(2, {"run", "wall.toml", "--out", "used"}).status, 0) << "complete already";
}

TEST_F(Mpi, other_commands_run_once) {
  const ProcessResult list = on_ranks(3, {"list"});
  EXPECT_EQ(list.status, 0);
  EXPECT_EQ(list.output.find("\nbouncing "), list.output.rfind("\nbouncing ")) << list.output;
  const ProcessResult shard = on_ranks(2, {"run", "wall.toml", "--shard", "1/2", "--out", "shard"});
  EXPECT_EQ(shard.status, 2);
  EXPECT_NE(shard.output.find("--shard: mpirun shares a run out"), std::string::npos) << shard.output;
  ASSERT_EQ(call({"run", "wall.toml", "--out", "whole"}).status, 0);
  const ProcessResult again = on_ranks(2, {"reproduce", "whole"});
  EXPECT_EQ(again.status, 0) << again.output;
}

#ifndef THINWALL_HAS_MPI
TEST_F(LeavingOneMachine, a_program_without_mpi_says_so_when_mpirun_starts_it) {
  const ProcessResult result = run_process({"/usr/bin/env", "OMPI_COMM_WORLD_SIZE=4", "OMPI_COMM_WORLD_RANK=0",
                                            THINWALL_PROGRAM, "run", "wall.toml", "--out", "out"},
                                           folder.path());
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.output.find("started as one of 4 processes by mpirun"), std::string::npos) << result.output;
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}
#endif

}  // namespace
}  // namespace thinwall
