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
