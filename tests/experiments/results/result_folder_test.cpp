/// What a run does with what it finds in its folder: go on, answer at once, start over, or refuse.

#include <gtest/gtest.h>

#include <thinwall/experiments/lab/result_folder.hpp>

#include "support/toy_program.hpp"

namespace thinwall {
namespace {

using ResultFolderTest = ToyProgram;

TEST_F(ResultFolderTest, goes_on_after_an_interruption_and_ends_with_the_same_bytes) {
  ASSERT_EQ(run({"--threads", "1"}).status, 0);
  const auto whole = files_in(out);
  out = folder / "interrupted";
  ToyControl::computed = 0;
  ToyControl::interrupt_after = 8;
  const Reply reply = run({"--threads", "1"});
  EXPECT_EQ(reply.status, 130);
  EXPECT_EQ(reply.out, "");
  EXPECT_NE(reply.err.find("to continue:\nthinwall run toy --out " + out + " --threads 1\n"), std::string::npos)
      << reply.err;
  EXPECT_EQ(files_in(out).size(), 1u) << "the journal alone";
  const Reply again = run({"--threads", "1"});
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_NE(again.err.find("8 of 20 units were read from the journal\n"), std::string::npos) << again.err;
  EXPECT_EQ(ToyControl::computed, 20);
  EXPECT_EQ(read_text(out + "/data/cells.csv"), whole.at("data/cells.csv"));
  EXPECT_EQ(read_text(out + "/datapackage.json"), whole.at("datapackage.json"));
  EXPECT_EQ(manifest().at("resumed_units"), 8);
}

TEST_F(ResultFolderTest, keeps_what_was_finished_when_a_unit_fails) {
  ToyControl::fail_at = 5;
  const Reply reply = run({"--threads", "1"});
  EXPECT_EQ(reply.status, 1);
  EXPECT_NE(reply.err.find("failed: unit 'cell 4' failed: no luck\n"), std::string::npos) << reply.err;
  ToyControl::fail_at = 0;
  ToyControl::computed = 0;
  EXPECT_EQ(run({"--threads", "1"}).status, 0);
  EXPECT_LE(ToyControl::computed, 19);
}

TEST_F(ResultFolderTest, computes_a_damaged_row_again_and_says_so) {
  ToyControl::interrupt_after = 8;
  ASSERT_EQ(run({"--threads", "1"}).status, 130);
  std::string journal = read_text(out + "/journal.tsv");
  journal[journal.find("cell 3\t") + 8] ^= 1;
  write_text(out + "/journal.tsv", journal);
  const Reply reply = run();
  EXPECT_EQ(reply.status, 0);
  EXPECT_NE(reply.err.find("journal.tsv:5: the row of 'cell 3' is damaged"), std::string::npos) << reply.err;
  EXPECT_NE(reply.err.find("7 of 20 units were read"), std::string::npos) << reply.err;
}

TEST_F(ResultFolderTest, answers_at_once_where_the_result_lies_already) {
  const Reply first = run();
  const auto files = files_in(out);
  ToyControl::computed = 0;
  const Reply second = run({"--threads", "1"});
  EXPECT_EQ(second.status, 0);
  EXPECT_EQ(second.out, first.out);
  EXPECT_EQ(ToyControl::computed, 0);
  EXPECT_EQ(files_in(out), files);
}

TEST_F(ResultFolderTest, mends_a_result_that_lost_a_file_but_overwrites_no_change) {
  ASSERT_EQ(run().status, 0);
  const std::string cells = read_text(out + "/data/cells.csv");
  std::filesystem::remove(out + "/data/cells.csv");
  EXPECT_EQ(run().status, 0);
  EXPECT_EQ(read_text(out + "/data/cells.csv"), cells);
  write_text(out + "/plots/squares.gp", "# my own\n");
  std::filesystem::remove(out + "/data/cells.csv");
  const Reply reply = run();
  EXPECT_EQ(reply.status, 2);
  EXPECT_EQ(
      reply.err,
      "--out " + out + ": plots/squares.gp was changed since the run wrote it; name another folder, or move it away\n");
  EXPECT_EQ(read_text(out + "/plots/squares.gp"), "# my own\n");
}

TEST_F(ResultFolderTest, refuses_the_folder_of_another_run) {
  ASSERT_EQ(run({"--seed", "1"}).status, 0);
  const auto files = files_in(out);
  const Reply reply = run({"--seed", "2"});
  EXPECT_EQ(reply.status, 2);
  EXPECT_EQ(reply.err,
            "--out " + out + ": holds another run (seed = 1, not 2); name another folder, or delete this one\n");
  EXPECT_EQ(files_in(out), files);
  out = folder / "unfinished";
  ToyControl::interrupt_after = 3;
  ASSERT_EQ(run().status, 130);
  EXPECT_EQ(run({"--trials", "5"}).status, 2);
}

TEST_F(ResultFolderTest, refuses_a_folder_that_holds_things_of_others) {
  std::filesystem::create_directories(out + "/data");
  const Reply reply = run();
  EXPECT_EQ(reply.status, 2);
  EXPECT_EQ(reply.err, "--out " + out + ": holds 'data', which is not ours; name another folder\n");
  write_text(out + "/manifest.json", "{}");
  EXPECT_EQ(run().err,
            "--out " + out +
                ": holds a manifest.json that is not ours (manifest.json: key 'thinwall_manifest': missing); "
                "name another folder\n");
}

TEST_F(ResultFolderTest, refuses_a_folder_where_another_run_is_at_work) {
  FolderLock other;
  std::filesystem::create_directories(out);
  ASSERT_TRUE(other.take(out));
  const Reply reply = run();
  EXPECT_EQ(reply.status, 2);
  EXPECT_EQ(reply.err, "--out " + out + ": another run is at work here; wait for it or name another folder\n");
}

TEST_F(ResultFolderTest, starts_over_where_another_build_of_the_program_was_at_work) {
  const RunIdentity theirs{"toy", R"({"cells":20,"experiment":"toy","speed":[1,10],"trials":10})", 0, std::nullopt,
                           "another"};
  std::filesystem::create_directories(out);
  Journal(out + "/journal.tsv", identity_text(theirs)).add("cell 1", {0.1, "777000"});
  const Reply reply = run();
  EXPECT_EQ(reply.status, 0);
  EXPECT_NE(reply.err.find("begun by another build of the program; it is kept as journal.old.tsv"), std::string::npos);
  EXPECT_EQ(read_text(out + "/data/cells.csv").find("777000"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(out + "/journal.old.tsv"));
}

TEST_F(ResultFolderTest, clears_what_a_run_left_that_was_killed_while_it_wrote) {
  ToyControl::interrupt_after = 3;
  ASSERT_EQ(run().status, 130);
  const std::string left = out + "/" + temporary_name();
  std::filesystem::create_directories(left + "/data");
  write_text(left + "/data/half.csv", "half");
  write_text(out + "/" + temporary_name(), "half a journal");
  EXPECT_EQ(run().status, 0);
  EXPECT_FALSE(std::filesystem::exists(out + "/data/half.csv"));
  for (const auto& [name, text] : files_in(out)) EXPECT_FALSE(name.starts_with(".")) << name;
}

TEST_F(ResultFolderTest, takes_no_row_of_another_seed) {
  ASSERT_EQ(run().status, 0);
  const std::string cells = read_text(out + "/data/cells.csv");
  std::map<std::string, std::string> journals;
  for (const char* seed : {"0", "99"}) {
    out = folder / seed;
    ToyControl::interrupt_after = 8;
    ASSERT_EQ(run({"--threads", "1", "--seed", seed}).status, 130);
    journals[seed] = read_text(out + "/journal.tsv");
  }
  out = folder / "0";
  const auto first_row = [](const std::string& text) { return text.find('\n') + 1; };
  write_text(out + "/journal.tsv",
             journals["0"].substr(0, first_row(journals["0"])) + journals["99"].substr(first_row(journals["99"])));
  const Reply reply = run();
  EXPECT_EQ(reply.status, 0) << reply.err;
  EXPECT_NE(reply.err.find("journal.tsv:2: the row of 'cell 0' is damaged, or of another run"), std::string::npos)
      << reply.err;
  EXPECT_EQ(read_text(out + "/data/cells.csv"), cells);
}

}  // namespace
}  // namespace thinwall
