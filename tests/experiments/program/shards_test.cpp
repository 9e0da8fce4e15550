/// Shards of a run and their merging, from the command line to the files.

#include <algorithm>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <thinwall/experiments/lab/draw.hpp>
#include <thinwall/experiments/lab/shards.hpp>

#include "support/program.hpp"
#include "support/thorough.hpp"
#include "support/toy.hpp"

namespace thinwall {

namespace {

struct ShardProgram : ToyProgram {
  std::string shard(int index, int count) const {
    return folder / ("part" + std::to_string(index) + "of" + std::to_string(count));
  }

  Reply run_shard(int index, int count, const Words& more = {}) const {
    const std::string which = std::to_string(index) + "/" + std::to_string(count);
    return call(joined({"run", "toy", "--out", shard(index, count), "--shard", which}, more));
  }

  Reply merge(const Words& folders, const Words& more = {}) const {
    return call(joined(joined({"merge", "--out", out}, folders), more));
  }

  std::vector<std::string> run_shards(int count) const {
    std::vector<std::string> folders;
    for (int index = count; index >= 1; --index) {
      EXPECT_EQ(run_shard(index, count).status, 0);
      folders.push_back(shard(index, count));
    }
    return folders;
  }

  /// As if that program had computed those rows: whole to look at, but for what it holds.
  static void reseal(const std::string& path, const Journal::Rows& rows, const std::string& program) {
    RunRecord run;
    static_cast<RunIdentity&>(run) = parse_seal(read_text(path + "/shard.json"))->identity;
    std::filesystem::remove_all(path);
    run.program = program;
    ResultFolder other(path, run);
    other.journal().add(rows);
    other.seal(run);
  }

  void expect_refused(const Words& folders, const Words& said) const {
    ToyProgram::expect_refused(joined({"merge", "--out", out}, folders), said);
  }
};

TEST_F(ShardProgram, merged_are_the_bytes_of_one_run) {
  ASSERT_EQ(run({"--seed", "3", "--trials", "7"}).status, 0);
  const auto whole = lasting_files(out);
  for (const int count : {1, 2, 3, 7, 25}) {  // more shards than units: some are empty
    std::vector<std::string> folders;
    for (int index = 1; index <= count; ++index) {
      const Reply reply = run_shard(index, count, {"--seed", "3", "--trials", "7"});
      ASSERT_EQ(reply.status, 0) << reply.err;
      folders.push_back(shard(index, count));
    }
    out = folder / ("merged" + std::to_string(count));
    const Reply reply = merge(folders, {"--json"});
    ASSERT_EQ(reply.status, 0) << reply.err;
    EXPECT_EQ(ToyControl::computed, 0);
    EXPECT_EQ(lasting_files(out), whole) << count;
    EXPECT_EQ(nlohmann::json::parse(reply.out).at("units"), 20);
    EXPECT_EQ(manifest().at("shards").size(), static_cast<std::size_t>(count));
    expect_members(manifest(), {{"seed", 3}, {"trials", 7}});
    EXPECT_TRUE(holds(merge(folders).err, "complete already"));
  }
}

TEST_F(ShardProgram, of_a_configuration_of_its_own_are_merged_too) {
  write_text(folder / "my.toml", "experiment = \"toy\"\nspeed = [0.0001, 1e300, 3]\ncells = 3\n");
  ASSERT_EQ(call({"run", folder / "my.toml", "--out", out}).status, 0);
  const auto whole = lasting_files(out);
  const std::string id = manifest().at("run_id");
  ASSERT_EQ(call({"run", folder / "my.toml", "--shard", "1/1", "--out", shard(1, 1)}).status, 0);
  out = folder / "merged";
  const Reply reply = merge({shard(1, 1)});
  ASSERT_EQ(reply.status, 0) << reply.err;
  EXPECT_EQ(lasting_files(out), whole);
  EXPECT_EQ(manifest().at("run_id"), id);
}

TEST_F(ShardProgram, says_what_it_did) {
  const Reply text = run_shard(2, 4, {"--threads", "2"});
  EXPECT_EQ(text.out, "shard 2/4 of toy is finished, in " + shard(2, 4) +
                          "\nwith all 4 of them: thinwall merge SHARD... --out DIR\n");
  EXPECT_EQ(text.err, "toy: 5 units, 50 trials on 2 threads\n");
  EXPECT_EQ(files_in(shard(2, 4)).size(), 2u) << "journal.tsv and shard.json";
  expect_members(nlohmann::json::parse(run_shard(3, 4, {"--json"}).out), {{"shard", "3/4"}, {"units", 5}});
}

TEST_F(ShardProgram, goes_on_where_it_was_and_is_finished_once) {
  ToyControl::interrupt_after = 4;
  EXPECT_EQ(run_shard(1, 2, {"--threads", "1"}).status, 130);
  expect_refused({shard(1, 2)}, {shard(1, 2) + ": shard 1/2 is unfinished; run the shard again"});
  EXPECT_EQ(run_shard(1, 2).status, 0);
  EXPECT_EQ(ToyControl::computed, 6);
  expect_reply(run_shard(1, 2), 0, {"finished already; nothing was computed"});
  EXPECT_EQ(ToyControl::computed, 0);
}

TEST_F(ShardProgram, refuses_what_is_no_shard) {
  const auto folders = run_shards(2);
  expect_refused({}, {"the folders of the shards are missing"});
  expect_refused({folders[0], folder / "none"}, {folder / "none: there is no such folder"});
  expect_refused({folders[0], folder / std::string(300, 'x')}, {"x: cannot be read: File name too long"});
  write_text(folder / "file", "");
  expect_refused({folders[0], folder / "file"}, {folder / "file: is not a folder"});
  std::filesystem::create_directory(folder / "empty");
  expect_refused({folders[0], folder / "empty"}, {folder / "empty: is not a shard of a run: it has no shard.json"});
  const std::string whole = folder / "whole";
  ASSERT_EQ(call({"run", "toy", "--out", whole}).status, 0);
  expect_refused({folders[0], whole}, {whole + ": holds a whole result, not a shard"});
}

TEST_F(ShardProgram, refuses_shards_that_do_not_go_together) {
  run_shards(2);
  run_shards(3);
  expect_refused({shard(1, 2), shard(2, 3)},
                 {shard(2, 3) + ": is shard 2/3, but " + shard(1, 2) + " is shard 1/2: one run is cut one way"});
  expect_refused({shard(1, 3), shard(3, 3), shard(1, 3)}, {shard(1, 3) + ": is shard 1/3, and so is " + shard(1, 3)});
  expect_refused({shard(1, 3), shard(3, 3)}, {"missing: shard 2/3; 2 of 3 were given"});
  expect_refused({shard(1, 3)}, {"missing: shards 2/3, 3/3; 1 of 3 were given"});
  std::filesystem::remove_all(shard(2, 2));
  ASSERT_EQ(run_shard(2, 2, {"--seed", "9"}).status, 0);
  expect_refused({shard(1, 2), shard(2, 2)},
                 {shard(2, 2) + ": is a shard of another run than " + shard(1, 2) + " (seed = 9, not 0)"});
  std::filesystem::remove_all(shard(2, 2));
  ASSERT_EQ(run_shard(2, 2, {"--trials", "9"}).status, 0);
  expect_refused({shard(1, 2), shard(2, 2)}, {"is a shard of another run", "(trials = 9, not none)"});
  write_text(folder / "my.toml", "experiment = \"toy\"\nspeed = [1, 11]\n");
  const std::string other = folder / "other";
  ASSERT_EQ(call({"run", folder / "my.toml", "--shard", "2/2", "--out", other}).status, 0);
  expect_refused({shard(1, 2), other}, {other + ": is a shard of another run", "(speed = [1,11], not [1,10])"});
}

TEST_F(ShardProgram, refuses_shards_of_another_build) {
  run_shards(2);
  const auto rebuild = [&](const std::string& path) {  // as another build of the program would have left it
    reseal(path, read_journal(path + "/journal.tsv").rows, "another");
  };
  rebuild(shard(2, 2));
  expect_refused({shard(1, 2), shard(2, 2)},
                 {shard(2, 2) + ": was computed by another build of the program than " + shard(1, 2)});
  rebuild(shard(1, 2));
  expect_refused({shard(1, 2), shard(2, 2)},
                 {shard(1, 2) + ": was computed by another build of the program than this one"});
  ASSERT_EQ(run_shard(1, 2).status, 0) << "starts over";
  ASSERT_EQ(run_shard(2, 2).status, 0);
  EXPECT_EQ(merge({shard(1, 2), shard(2, 2)}).status, 0);
}

TEST_F(ShardProgram, refuses_damage_which_running_the_shard_again_mends) {
  const auto folders = run_shards(2);
  const std::string part = shard(2, 2), journal = part + "/journal.tsv", seal = part + "/shard.json";
  const std::string rows = read_text(journal), sealed = read_text(seal);
  const auto expect_damage = [&](const std::string& what) {
    expect_refused(folders, {part + ": " + what, "; run the shard again"});
    ASSERT_EQ(run_shard(2, 2).status, 0);
    EXPECT_LE(ToyControl::computed, 10);
    ASSERT_EQ(merge(folders).status, 0);
    std::filesystem::remove_all(out);
    write_text(journal, rows);
    write_text(seal, sealed);
  };
  std::string torn = rows;
  torn[torn.rfind('\t') - 1] ^= 1;
  write_text(journal, torn);
  expect_damage(journal + ":11: the row of 'cell ");
  write_text(journal, rows.substr(0, rows.rfind('\n', rows.size() - 2) + 1));
  expect_damage("its journal.tsv was changed since the shard was finished");
  std::string headless = rows;
  headless[headless.find('\n') - 1] ^= 1;
  write_text(journal, headless);
  expect_damage("the first row of its journal.tsv is damaged");
  std::filesystem::remove(seal);
  expect_damage("shard 2/2 is unfinished");
  write_text(seal, sealed.substr(0, sealed.size() / 2));
  expect_damage("its shard.json is damaged, or not ours");
}

TEST_F(ShardProgram, seals_all_rows_even_if_their_file_was_removed_or_cut_off_meanwhile) {
  ASSERT_EQ(run_shard(1, 2).status, 0);
  const Journal::Rows rows = read_journal(shard(1, 2) + "/journal.tsv").rows;
  RunRecord run;
  static_cast<RunIdentity&>(run) = parse_seal(read_text(shard(1, 2) + "/shard.json"))->identity;
  for (const bool is_cut : {true, false}) {
    std::filesystem::remove_all(shard(1, 2));
    ResultFolder result(shard(1, 2), run);
    result.journal().add(rows);
    const std::string file = shard(1, 2) + "/journal.tsv";
    if (is_cut) {
      std::filesystem::resize_file(file, std::filesystem::file_size(file) - 30);
    } else {
      std::filesystem::remove(file);
    }
    result.seal(run);
    EXPECT_EQ(read_journal(file).rows.size(), rows.size());
    EXPECT_TRUE(is_sealed(result, run));
  }
}

TEST_F(ShardProgram, refuses_a_shard_with_the_wrong_units) {
  run_shards(2);
  Journal::Rows rows = read_journal(shard(1, 2) + "/journal.tsv").rows;
  const auto lost = rows.extract(rows.begin());
  reseal(shard(1, 2), rows, this_program_sha256());
  expect_refused({shard(1, 2), shard(2, 2)}, {shard(1, 2) + ": lacks the unit '" + lost.key() + "'"});
  rows[lost.key()] = lost.mapped();
  rows["cell 1000"] = lost.mapped();
  reseal(shard(1, 2), rows, this_program_sha256());
  expect_refused({shard(1, 2), shard(2, 2)}, {shard(1, 2) + ": has units that are not its own"});
}

TEST_F(ShardProgram, keeps_folders_apart) {
  const auto folders = run_shards(2);
  expect_refusal(call({"run", "toy", "--out", folders[0]}), {"holds another run (shard = \"2/2\", not none)"});
  expect_refusal(call({"run", "toy", "--shard", "1/2", "--out", folders[0]}), {"(shard = \"2/2\", not \"1/2\")"});
  expect_refusal(call({"run", "toy", "--shard", "1/2", "--figures", "pdf"}), {"--figures: a shard has none"});
  out = folders[0];
  EXPECT_EQ(merge(folders).status, 2);
  out = folder / "used";
  write_text(folder / "my.toml", "experiment = \"toy\"\ncells = 5\n");
  ASSERT_EQ(call({"run", folder / "my.toml", "--out", out}).status, 0);
  const auto before = files_in(out);
  expect_refusal(merge(folders), {"--out " + out + ": holds another run (cells = 5, not 20)"});
  EXPECT_EQ(files_in(out), before);
  EXPECT_EQ(call({"run", "toy", "--shard", "1/2", "--out", out}).status, 2);
  EXPECT_EQ(files_in(out), before);
}

TEST_F(ShardProgram, dry_run_counts_the_shard_alone) {
  const Reply reply = run_shard(7, 7, {"--dry-run", "--threads", "1"});
  EXPECT_TRUE(reply.out.starts_with("toy: 2 units, 20 trials on 1 thread\n")) << reply.out;
  EXPECT_FALSE(std::filesystem::exists(shard(7, 7)));
}

// ---- The program as it is, cut into shards and shared among the ranks of mpirun: the bytes of one run.

struct LeavingOneMachine : ::testing::Test {
  TemporaryFolder folder;

  LeavingOneMachine() { write_text(folder / "wall.toml", small_wall); }

  ProcessResult call(const Words& words) const { return run_process(joined({THINWALL_PROGRAM}, words), folder.path()); }
};

TEST_F(LeavingOneMachine, merged_shards_are_the_bytes_of_one_run) {
  ASSERT_EQ(call({"run", "wall.toml", "--seed", "5", "--out", "whole"}).status, 0);
  for (const std::string index : {"2", "1", "3"}) {
    const Words shard = {"--shard", index + "/3", "--out", "part" + index, "--threads", index};
    ASSERT_EQ(call(joined({"run", "wall.toml", "--seed", "5"}, shard)).status, 0);
  }
  ASSERT_EQ(call({"merge", "--out", "merged", "part2", "part1", "part3"}).status, 0);
  EXPECT_EQ(lasting_files(folder / "merged"), lasting_files(folder / "whole"));
}

struct Mpi : LeavingOneMachine {
  void SetUp() override {
    if (!run_process({"mpirun", "--version"}, folder.path()).found) GTEST_SKIP() << "mpirun is not installed";
#ifndef THINWALL_HAS_MPI
    GTEST_SKIP() << "the program was built without MPI";
#endif
  }

  /// Open MPI itself leaks; and in a container it may not read the memory of its neighbors.
  static Words mpirun(int ranks, const Words& words) {
    const Words mpi = {"/usr/bin/env", "mpirun", "--allow-run-as-root", "--oversubscribe"};
    const Words memory = {"--mca", "btl_vader_single_copy_mechanism", "none", "-x", "ASAN_OPTIONS=detect_leaks=0"};
    return joined(joined(joined(mpi, memory), {"-n", std::to_string(ranks), THINWALL_PROGRAM}), words);
  }

  ProcessResult on_ranks(int ranks, const Words& words) const {
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
    EXPECT_TRUE(holds(result.output, size));
    EXPECT_EQ(result.output.find("report: "), result.output.rfind("report: ")) << result.output;
    EXPECT_EQ(lasting_files(folder / out), lasting_files(folder / "whole"));
  }
}

TEST_F(Mpi, a_run_whose_ranks_were_killed_goes_on_with_any_number_of_them_or_with_none) {
  const std::string trials = testing::slow_build ? "1500" : "90000";
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
  EXPECT_GE(units_read(rest.output), kept) << rest.output;
  EXPECT_EQ(lasting_files(folder / "killed"), lasting_files(folder / "whole"));
}

TEST_F(Mpi, a_folder_of_another_run_is_refused_once_and_no_rank_is_left_waiting) {
  ASSERT_EQ(call({"run", "wall.toml", "--out", "used"}).status, 0);
  const auto before = files_in(folder / "used");
  const ProcessResult refused = on_ranks(2, {"run", "wall.toml", "--seed", "7", "--out", "used"});
  EXPECT_EQ(refused.status, 2);
  const std::string line = "--out used: holds another run (seed = 0, not 7)";
  EXPECT_TRUE(holds(refused.output, line));
  EXPECT_EQ(refused.output.find(line), refused.output.rfind(line)) << refused.output;
  EXPECT_EQ(files_in(folder / "used"), before);
  EXPECT_EQ(on_ranks(2, {"run", "wall.toml", "--out", "used"}).status, 0) << "complete already";
}

TEST_F(Mpi, ranks_of_different_runs_compute_nothing_and_say_so) {
  Words words = mpirun(1, {"run", "wall.toml", "--out", "mixed"});
  words = joined(words, {":", "-n", "1", THINWALL_PROGRAM, "run", "wall.toml", "--seed", "7", "--out", "mixed"});
  const ProcessResult mixed = run_process(words, folder.path());
  EXPECT_EQ(mixed.status, 1) << mixed.output;
  EXPECT_TRUE(holds(mixed.output, "ank 1 of 2 was started with another configuration, seed or program than rank 0"));
}

TEST_F(Mpi, a_rank_says_what_is_wrong_with_its_own_words) {
  Words words = mpirun(1, {"run", "wall.toml", "--out", "mixed"});
  words = joined(words, {":", "-n", "1", THINWALL_PROGRAM, "run", "none.toml", "--out", "mixed"});
  EXPECT_TRUE(holds(run_process(words, folder.path()).output, "ank 1 of 2: none.toml: there is no such file"));
}

TEST_F(Mpi, a_process_that_another_mpirun_has_started_says_so) {
  const ProcessResult alone =
      run_process({"/usr/bin/env", "PMI_SIZE=4", "PMI_RANK=3", THINWALL_PROGRAM, "run", "wall.toml", "--out", "alone"},
                  folder.path());
  EXPECT_EQ(alone.status, 2);
  EXPECT_TRUE(holds(alone.output, "rank 3 of 4: started as one of 4 processes, but MPI as built in counts 1"));
}

TEST_F(LeavingOneMachine, what_is_left_in_the_environment_of_no_mpirun_is_passed_over) {
  const Words words = {"/usr/bin/env", "OMPI_COMM_WORLD_RANK=1", THINWALL_PROGRAM, "list"};
  EXPECT_TRUE(holds(run_process(words, folder.path()).output, "thin_wall"));
}

TEST_F(Mpi, other_commands_run_once) {
  const ProcessResult list = on_ranks(3, {"list"});
  EXPECT_EQ(list.status, 0);
  EXPECT_EQ(list.output.find("\nbouncing "), list.output.rfind("\nbouncing ")) << list.output;
  const ProcessResult shard = on_ranks(2, {"run", "wall.toml", "--shard", "1/2", "--out", "shard"});
  EXPECT_EQ(shard.status, 2);
  // not "--shard: ...": under load, mpirun has been seen to drop the first character of a rank's line
  EXPECT_TRUE(holds(shard.output, "shard: mpirun shares a run out"));
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
  EXPECT_TRUE(holds(result.output, "started as one of 4 processes by mpirun"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}
#endif

}  // namespace

}  // namespace thinwall
