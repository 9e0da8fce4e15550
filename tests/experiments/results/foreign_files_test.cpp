/// What is not ours, in a folder that a command is given, stays as it is.

#include <gtest/gtest.h>

#include <filesystem>

#include "support/toy_program.hpp"

namespace thinwall {
namespace {

namespace fs = std::filesystem;

struct ForeignFiles : ToyProgram {
  void expect_refusal(const Reply& reply, const std::map<std::string, std::string>& before) const {
    EXPECT_EQ(reply.status, 2) << reply.out << reply.err;
    EXPECT_EQ(std::ranges::count(reply.err, '\n'), 1) << reply.err;
    EXPECT_EQ(files_in(folder.path()), before);
  }
};

TEST_F(ForeignFiles, under_our_names_are_refused_and_kept) {
  for (const char* name : {"journal.tsv", "journal.old.tsv", "manifest.json", "manifest.old.json", "report.html"}) {
    SCOPED_TRACE(name);
    fs::create_directories(out + "/.staging");
    write_text(out + "/" + name, "mine\n");
    write_text(out + "/.staging/also", "mine\n");
    expect_refusal(run(), files_in(folder.path()));
    fs::remove_all(out);
    fs::create_directories(out + "/" + name + "/folder");
    expect_refusal(run(), files_in(folder.path()));
    fs::remove_all(out);
  }
}

TEST_F(ForeignFiles, that_a_manifest_names_outside_its_folder_are_no_files_of_a_result) {
  ASSERT_EQ(run().status, 0);
  write_text(folder / "mine", "mine\n");
  for (const std::string& outside : {std::string("../mine"), folder / "mine", std::string("data/../../mine")}) {
    nlohmann::json json = manifest();
    json["files"][outside] = "0";
    fs::remove(out + "/manifest.json");
    write_text(out + "/manifest.old.json", json.dump());
    expect_refusal(run(), files_in(folder.path()));
    fs::rename(out + "/manifest.old.json", out + "/manifest.json");
    expect_refusal(call({"reproduce", out}), files_in(folder.path()));
    json["files"].erase(outside);
    write_text(out + "/manifest.json", json.dump());
  }
}

TEST_F(ForeignFiles, in_the_way_of_a_rerun_are_not_removed_with_it) {
  ASSERT_EQ(run().status, 0);
  fs::create_directories(out + ".again");
  write_text(out + ".again/notes.txt", "mine\n");
  expect_refusal(call({"reproduce", out}), files_in(folder.path()));
  expect_refusal(call({"reproduce", out, "--out", out}), files_in(folder.path()));
  expect_refusal(call({"reproduce", out, "--out", out + "/deeper"}), files_in(folder.path()));
}

struct MineBesideOurs : ForeignFiles {
  const std::vector<std::string> names = {
      ".staging/notes",         ".drawing/notes", "journal.tsv.new", "journal.rank-my",
      "journal.rank-notes.tsv", "notes",          "data/notes",      ".thinwall-0123456789/notes",
      "plots/mine.gp",          "plots/mine.pdf"};

  void put() const {
    for (const std::string& name : names) {
      fs::create_directories(fs::path(out + "/" + name).parent_path());
      write_text(out + "/" + name, "mine\n");
    }
  }
  void expect_kept(const std::string& where) const {
    for (const std::string& name : names) EXPECT_EQ(read_text(where + "/" + name), "mine\n") << name;
  }
};

TEST_F(MineBesideOurs, stay_whatever_a_run_does) {
  ASSERT_EQ(run().status, 0);
  put();
  EXPECT_NE(run().err.find("complete already"), std::string::npos);
  expect_kept(out);
  fs::remove(out + "/data/cells.csv");
  EXPECT_EQ(run().status, 0) << "it is replaced";
  EXPECT_TRUE(fs::exists(out + "/data/cells.csv"));
  expect_kept(out);
  EXPECT_EQ(call({"report", out, "--figures", "pdf"}).err.find("mine"), std::string::npos);
  expect_kept(out);
}

TEST_F(MineBesideOurs, stay_in_a_rerun_that_went_on) {
  ASSERT_EQ(run().status, 0);
  ToyControl::interrupt_after = 8;
  ASSERT_EQ(call({"reproduce", out, "--threads", "1"}).status, 130);
  write_text(out + ".again/notes.txt", "mine\n");
  const Reply reply = call({"reproduce", out});
  EXPECT_EQ(reply.status, 0) << reply.err;
  EXPECT_NE(reply.err.find(out + ".again: stays, for it holds what the rerun did not write\n"), std::string::npos);
  EXPECT_EQ(files_in(out + ".again"), (std::map<std::string, std::string>{{"notes.txt", "mine\n"}}));
}

TEST_F(ForeignFiles, that_a_run_would_write_over_are_refused_while_it_is_unfinished) {
  for (const char* name : {"report.html", "trace.jsonl", "data/mine.csv", "journal.rank-1.tsv"}) {
    ToyControl::interrupt_after = 3;
    ASSERT_EQ(run({"--threads", "1"}).status, 130);
    fs::create_directories(fs::path(out + "/" + name).parent_path());
    write_text(out + "/" + name, "mine\n");
    expect_refusal(run(), files_in(folder.path()));
    fs::remove_all(out);
  }
}

TEST_F(ForeignFiles, are_not_followed_where_they_are_links) {
  fs::create_directories(folder / "mine");
  write_text(folder / "mine/cells.csv", "mine\n");
  const auto mine = files_in(folder / "mine");
  fs::create_directories(out);
  fs::create_directory_symlink(folder / "mine", out + "/data");
  EXPECT_EQ(run().err, "--out " + out + ": holds 'data', which is not ours; name another folder\n");
  fs::remove_all(out);
  ToyControl::interrupt_after = 3;
  ASSERT_EQ(run({"--threads", "1"}).status, 130);
  fs::create_symlink(folder / "none", out + "/report.html");
  expect_refusal(run(), files_in(folder.path()));
  fs::remove(out + "/report.html");
  fs::rename(out + "/journal.tsv", folder / "journal");
  fs::create_symlink(folder / "journal", out + "/journal.tsv");
  expect_refusal(run(), files_in(folder.path()));
  EXPECT_EQ(files_in(folder / "mine"), mine);
}

TEST_F(ForeignFiles, are_kept_when_a_complete_result_is_cleared_up) {
  ASSERT_EQ(run().status, 0);
  for (const char* name : {"journal.tsv", "journal.old.tsv", "manifest.old.json"})
    write_text(out + "/" + name, "mine\n");
  const auto before = files_in(folder.path());
  EXPECT_EQ(run().status, 0);
  EXPECT_EQ(files_in(folder.path()), before);
}

TEST_F(ForeignFiles, do_not_hide_that_a_table_of_times_was_lost) {
  ASSERT_EQ(run().status, 0);
  fs::remove(out + "/data/timings.csv");
  ToyControl::computed = 0;
  EXPECT_EQ(run().status, 0);
  EXPECT_GT(ToyControl::computed, 0);
  EXPECT_TRUE(fs::exists(out + "/data/timings.csv"));
}

}  // namespace
}  // namespace thinwall
