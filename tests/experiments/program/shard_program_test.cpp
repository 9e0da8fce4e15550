/// Shards of a run and their merging, from the command line to the files.

#include <gtest/gtest.h>

#include <algorithm>

#include <thinwall/experiments/lab/shards.hpp>

#include "support/toy_program.hpp"

namespace thinwall {
namespace {

struct ShardProgram : ToyProgram {
  std::string shard(int index, int count) const {
    return folder / ("part" + std::to_string(index) + "of" + std::to_string(count));
  }

  Reply run_shard(int index, int count, std::vector<std::string> more = {}) const {
    std::vector<std::string> words = {
        "run", "toy", "--out", shard(index, count), "--shard", std::to_string(index) + "/" + std::to_string(count)};
    words.insert(words.end(), more.begin(), more.end());
    return call(words);
  }

  Reply merge(std::vector<std::string> folders, std::vector<std::string> more = {}) const {
    folders.insert(folders.begin(), "merge");
    folders.insert(folders.end(), {"--out", out});
    folders.insert(folders.end(), more.begin(), more.end());
    return call(folders);
  }

  std::vector<std::string> run_shards(int count) const {
    std::vector<std::string> folders;
    for (int index = count; index >= 1; --index) {
      EXPECT_EQ(run_shard(index, count).status, 0);
      folders.push_back(shard(index, count));
    }
    return folders;
  }

  /// One line that has all of `said`, and no result.
  void expect_refusal(const std::vector<std::string>& folders, const std::vector<std::string>& said) const {
    const Reply reply = merge(folders);
    EXPECT_EQ(reply.status, 2) << reply.err;
    EXPECT_EQ(reply.out, "");
    EXPECT_EQ(std::ranges::count(reply.err, '\n'), 1) << reply.err;
    for (const std::string& part : said) EXPECT_NE(reply.err.find(part), std::string::npos) << reply.err;
    EXPECT_FALSE(std::filesystem::exists(out));
  }

  /// Every file of a result that must be the same in every run.
  std::map<std::string, std::string> hashed_files(const std::string& result) const {
    std::map<std::string, std::string> files;
    const auto manifest = nlohmann::json::parse(read_text(result + "/manifest.json"));
    for (const auto& [name, hash] : manifest.at("files").items()) files[name] = read_text(result + "/" + name);
    files.erase("cite.bib");  // holds a date
    return files;
  }
};

TEST_F(ShardProgram, merged_are_the_bytes_of_one_run) {
  ASSERT_EQ(run({"--seed", "3", "--trials", "7"}).status, 0);
  const auto whole = hashed_files(out);
  EXPECT_TRUE(whole.contains("data/cells.csv"));
  for (const int count : {1, 2, 3, 7, 25}) {  // more shards than units: some are empty
    std::vector<std::string> folders;
    for (int index = 1; index <= count; ++index) {
      const Reply reply = run_shard(index, count, {"--seed", "3", "--trials", "7"});
      ASSERT_EQ(reply.status, 0) << reply.err;
      folders.push_back(shard(index, count));
    }
    out = folder / ("merged" + std::to_string(count));
    ToyControl::computed = 0;
    const Reply reply = merge(folders, {"--json"});
    ASSERT_EQ(reply.status, 0) << reply.err;
    EXPECT_EQ(ToyControl::computed, 0);
    EXPECT_EQ(hashed_files(out), whole) << count;
    EXPECT_EQ(nlohmann::json::parse(reply.out).at("units"), 20);
    EXPECT_EQ(manifest().at("shards").size(), static_cast<std::size_t>(count));
    EXPECT_EQ(manifest().at("seed"), 3);
    EXPECT_EQ(manifest().at("trials"), 7);
    EXPECT_EQ(files_in(out).count("journal.tsv"), 0u);
  }
}

TEST_F(ShardProgram, of_a_configuration_of_its_own_are_merged_too) {
  write_text(folder / "my.toml", "experiment = \"toy\"\nspeed = [0.0001, 1e300, 3]\ncells = 3\n");
  ASSERT_EQ(call({"run", folder / "my.toml", "--out", out}).status, 0);
  const auto whole = hashed_files(out);
  const std::string id = manifest().at("run_id");
  ASSERT_EQ(call({"run", folder / "my.toml", "--shard", "1/1", "--out", shard(1, 1)}).status, 0);
  out = folder / "merged";
  const Reply reply = merge({shard(1, 1)});
  ASSERT_EQ(reply.status, 0) << reply.err;
  EXPECT_EQ(hashed_files(out), whole);
  EXPECT_EQ(manifest().at("run_id"), id);
}

TEST_F(ShardProgram, merged_again_is_complete_already) {
  const auto folders = run_shards(2);
  ASSERT_EQ(merge(folders).status, 0);
  const Reply again = merge(folders);
  EXPECT_EQ(again.status, 0);
  EXPECT_NE(again.err.find("complete already"), std::string::npos) << again.err;
}

TEST_F(ShardProgram, says_what_it_did) {
  const Reply text = run_shard(2, 4, {"--threads", "2"});
  EXPECT_EQ(text.out, "shard 2/4 of toy is finished, in " + shard(2, 4) +
                          "\nwith all 4 of them: thinwall merge SHARD... --out DIR\n");
  EXPECT_EQ(text.err, "toy: 5 units, 50 trials on 2 threads\n");
  EXPECT_EQ(files_in(shard(2, 4)).size(), 2u) << "journal.tsv and shard.json";
  const auto json = nlohmann::json::parse(run_shard(3, 4, {"--json"}).out);
  EXPECT_EQ(json.at("shard"), "3/4");
  EXPECT_EQ(json.at("units"), 5);
}

TEST_F(ShardProgram, goes_on_where_it_was_and_is_finished_once) {
  ToyControl::interrupt_after = 4;
  EXPECT_EQ(run_shard(1, 2, {"--threads", "1"}).status, 130);
  expect_refusal({shard(1, 2)}, {shard(1, 2) + ": shard 1/2 is unfinished; run the shard again"});
  ToyControl::computed = 0;
  EXPECT_EQ(run_shard(1, 2).status, 0);
  EXPECT_EQ(ToyControl::computed, 6);
  const Reply again = run_shard(1, 2);
  EXPECT_EQ(again.status, 0);
  EXPECT_NE(again.err.find("finished already; nothing was computed"), std::string::npos) << again.err;
  EXPECT_EQ(ToyControl::computed, 6);
}

TEST_F(ShardProgram, refuses_what_is_no_shard) {
  const auto folders = run_shards(2);
  expect_refusal({}, {"the folders of the shards are missing"});
  expect_refusal({folders[0], folder / "none"}, {folder / "none: there is no such folder"});
  write_text(folder / "file", "");
  expect_refusal({folders[0], folder / "file"}, {folder / "file: is not a folder"});
  std::filesystem::create_directory(folder / "empty");
  expect_refusal({folders[0], folder / "empty"}, {folder / "empty: is not a shard of a run: it has no shard.json"});
  const std::string whole = folder / "whole";
  ASSERT_EQ(call({"run", "toy", "--out", whole}).status, 0);
  expect_refusal({folders[0], whole}, {whole + ": holds a whole result, not a shard"});
}

TEST_F(ShardProgram, refuses_shards_that_do_not_go_together) {
  run_shards(2);
  run_shards(3);
  expect_refusal({shard(1, 2), shard(2, 3)},
                 {shard(2, 3) + ": is shard 2/3, but " + shard(1, 2) + " is shard 1/2: one run is cut one way"});
  expect_refusal({shard(1, 3), shard(3, 3), shard(1, 3)}, {shard(1, 3) + ": is shard 1/3, and so is " + shard(1, 3)});
  expect_refusal({shard(1, 3), shard(3, 3)}, {"missing: shard 2/3; 2 of 3 were given"});
  expect_refusal({shard(1, 3)}, {"missing: shards 2/3, 3/3; 1 of 3 were given"});
  std::filesystem::remove_all(shard(2, 2));
  ASSERT_EQ(run_shard(2, 2, {"--seed", "9"}).status, 0);
  expect_refusal({shard(1, 2), shard(2, 2)},
                 {shard(2, 2) + ": is a shard of another run than " + shard(1, 2) + " (seed = 9, not 0)"});
  std::filesystem::remove_all(shard(2, 2));
  ASSERT_EQ(run_shard(2, 2, {"--trials", "9"}).status, 0);
  expect_refusal({shard(1, 2), shard(2, 2)}, {"is a shard of another run", "(trials = 9, not none)"});
  write_text(folder / "my.toml", "experiment = \"toy\"\nspeed = [1, 11]\n");
  const std::string other = folder / "other";
  ASSERT_EQ(call({"run", folder / "my.toml", "--shard", "2/2", "--out", other}).status, 0);
  expect_refusal({shard(1, 2), other}, {other + ": is a shard of another run", "(speed = [1,11], not [1,10])"});
}

TEST_F(ShardProgram, refuses_shards_of_another_build) {
  run_shards(2);
  const auto rebuild = [&](const std::string& path) {  // as another build of the program would have left it
    RunIdentity identity = parse_seal(read_text(path + "/shard.json"))->identity;
    const Journal::Rows rows = read_journal(path + "/journal.tsv").rows;
    std::filesystem::remove_all(path);
    identity.program = "another";
    ResultFolder other(path, identity);
    other.journal().add(rows);
    seal_shard(other, identity, {});
  };
  rebuild(shard(2, 2));
  expect_refusal({shard(1, 2), shard(2, 2)},
                 {shard(2, 2) + ": was computed by another build of the program than " + shard(1, 2)});
  rebuild(shard(1, 2));
  expect_refusal({shard(1, 2), shard(2, 2)},
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
    expect_refusal(folders, {part + ": " + what, "; run the shard again"});
    ToyControl::computed = 0;
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

TEST_F(ShardProgram, refuses_a_shard_with_the_wrong_units) {
  run_shards(2);
  const auto reseal = [&](const Journal::Rows& rows) {  // whole to look at, but for what it holds
    const RunIdentity identity = parse_seal(read_text(shard(1, 2) + "/shard.json"))->identity;
    std::filesystem::remove_all(shard(1, 2));
    ResultFolder other(shard(1, 2), identity);
    other.journal().add(rows);
    seal_shard(other, identity, {});
  };
  Journal::Rows rows = read_journal(shard(1, 2) + "/journal.tsv").rows;
  const auto lost = rows.extract(rows.begin());
  reseal(rows);
  expect_refusal({shard(1, 2), shard(2, 2)}, {shard(1, 2) + ": lacks the unit '" + lost.key() + "'"});
  rows[lost.key()] = lost.mapped();
  rows["cell 1000"] = lost.mapped();
  reseal(rows);
  expect_refusal({shard(1, 2), shard(2, 2)}, {shard(1, 2) + ": has units that are not its own"});
}

TEST_F(ShardProgram, keeps_folders_apart) {
  const auto folders = run_shards(2);
  EXPECT_NE(call({"run", "toy", "--out", folders[0]}).err.find("holds another run (shard = \"2/2\", not none)"),
            std::string::npos);
  EXPECT_NE(call({"run", "toy", "--shard", "1/2", "--out", folders[0]}).err.find("(shard = \"2/2\", not \"1/2\")"),
            std::string::npos);
  out = folders[0];
  EXPECT_EQ(merge(folders).status, 2);
  out = folder / "used";
  write_text(folder / "my.toml", "experiment = \"toy\"\ncells = 5\n");
  ASSERT_EQ(call({"run", folder / "my.toml", "--out", out}).status, 0);
  const auto before = files_in(out);
  const Reply reply = merge(folders);
  EXPECT_EQ(reply.status, 2);
  EXPECT_NE(reply.err.find("--out " + out + ": holds another run (cells = 5, not 20)"), std::string::npos) << reply.err;
  EXPECT_EQ(files_in(out), before);
  EXPECT_EQ(call({"run", "toy", "--shard", "1/2", "--out", out}).status, 2);
  EXPECT_EQ(files_in(out), before);
}

TEST_F(ShardProgram, dry_run_counts_the_shard_alone) {
  const Reply reply = run_shard(7, 7, {"--dry-run", "--threads", "1"});
  EXPECT_TRUE(reply.out.starts_with("toy: 2 units, 20 trials on 1 thread\n")) << reply.out;
  EXPECT_FALSE(std::filesystem::exists(shard(7, 7)));
}

}  // namespace
}  // namespace thinwall
