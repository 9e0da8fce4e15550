/// What a run does with what it finds in its folder: go on, answer at once, start over, or refuse.

#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <thinwall/experiments/lab/comparison.hpp>
#include <thinwall/experiments/lab/result_folder.hpp>

#include "support/toy.hpp"

namespace thinwall {

namespace {

using ResultFolderTest = ToyProgram;

TEST_F(ResultFolderTest, goes_on_after_an_interruption_and_ends_with_the_same_bytes) {
  ASSERT_EQ(run({"--threads", "1"}).status, 0);
  const auto whole = files_in(out);
  out = folder / "interrupted";
  ToyControl::interrupt_after = 8;
  const Reply reply = run({"--threads", "1"});
  EXPECT_EQ(reply.status, 130);
  EXPECT_EQ(reply.out, "");
  EXPECT_TRUE(holds(reply.err, "to continue:\nthinwall run toy --out " + out + " --threads 1\n"));
  EXPECT_EQ(files_in(out).size(), 1u) << "the journal alone";
  expect_reply(run({"--threads", "1"}), 0, {"goes on: 8 of 20 units are done\n"});
  EXPECT_EQ(ToyControl::computed, 12);
  EXPECT_EQ(read_text(out + "/data/cells.csv"), whole.at("data/cells.csv"));
  EXPECT_EQ(read_text(out + "/datapackage.json"), whole.at("datapackage.json"));
  EXPECT_EQ(manifest().at("resumed_units"), 8);
}

TEST_F(ResultFolderTest, keeps_what_was_finished_when_a_unit_fails) {
  ToyControl::fail_at = 5;
  expect_reply(run({"--threads", "1"}), 1, {"failed: unit 'cell 4' failed: no luck\n"});
  ToyControl::fail_at = 0;
  EXPECT_EQ(run({"--threads", "1"}).status, 0);
  EXPECT_EQ(ToyControl::computed, 16) << "but for the four before it";
}

TEST_F(ResultFolderTest, computes_a_damaged_row_again_and_says_so) {
  interrupt(8);
  std::string journal = read_text(out + "/journal.tsv");
  journal[journal.find("cell 3\t") + 8] ^= 1;
  write_text(out + "/journal.tsv", journal);
  expect_reply(
      run(), 0,
      {out + "/journal.tsv:5: the row of 'cell 3' is damaged, or of another run; that unit is computed again\n",
       "goes on: 7 of 20 units are done\n"});
}

TEST_F(ResultFolderTest, answers_at_once_where_the_result_lies_already) {
  const Reply first = run();
  const auto files = files_in(out);
  const Reply second = run({"--threads", "1"});
  EXPECT_EQ(second.status, 0);
  EXPECT_EQ(second.out, first.out);
  EXPECT_EQ(ToyControl::computed, 0);
  EXPECT_EQ(files_in(out), files);
}

TEST_F(ResultFolderTest, mends_a_result_that_lost_a_file_but_overwrites_no_change) {
  ASSERT_EQ(run().status, 0);
  const auto files = files_in(out);
  for (const char* file : {"/data/cells.csv", "/data/timings.csv"}) {
    std::filesystem::remove(out + file);
    EXPECT_EQ(run().status, 0);
    EXPECT_EQ(ToyControl::computed, 20);
    EXPECT_TRUE(std::filesystem::exists(out + file));
  }
  EXPECT_EQ(read_text(out + "/data/cells.csv"), files.at("data/cells.csv"));
  write_text(out + "/report.html", "");
  EXPECT_EQ(run().status, 0);
  EXPECT_FALSE(read_text(out + "/report.html").empty());
  write_text(out + "/plots/squares.gp", "# my own\n");
  std::filesystem::remove(out + "/data/cells.csv");
  EXPECT_EQ(
      refusal(run()),
      "--out " + out + ": plots/squares.gp was changed since the run wrote it; name another folder, or move it away\n");
  EXPECT_EQ(read_text(out + "/plots/squares.gp"), "# my own\n");
}

TEST_F(ResultFolderTest, refuses_the_folder_of_another_run) {
  ASSERT_EQ(run({"--seed", "1"}).status, 0);
  const auto files = files_in(out);
  EXPECT_EQ(refusal(run({"--seed", "2"})),
            "--out " + out + ": holds another run (seed = 1, not 2); name another folder, or delete this one\n");
  EXPECT_EQ(files_in(out), files);
  out = folder / "unfinished";
  interrupt(3);
  EXPECT_EQ(run({"--trials", "5"}).status, 2);
}

TEST_F(ResultFolderTest, refuses_a_folder_where_another_run_is_at_work) {
  FolderLock other;
  std::filesystem::create_directories(out);
  ASSERT_TRUE(other.take(out));
  EXPECT_EQ(refusal(run()), "--out " + out + ": another run is at work here; wait for it or name another folder\n");
}

/// As another build of the program leaves it that was interrupted at the same run.
void begin_by(const std::string& program, const std::string& journal) {
  const RunIdentity theirs{"toy", R"({"cells":20,"experiment":"toy","speed":[1,10],"trials":10})", 0, std::nullopt,
                           program};
  std::filesystem::create_directories(std::filesystem::path(journal).parent_path());
  Journal(journal, identity_text(theirs)).add("cell 1", {0.1, "777000"});
}

TEST_F(ResultFolderTest, starts_over_where_another_build_of_the_program_was_at_work) {
  begin_by("another", out + "/journal.tsv");
  expect_reply(run(), 0, {"begun by another build of the program; it is kept as journal.old.tsv"});
  EXPECT_FALSE(holds(read_text(out + "/data/cells.csv"), "777000"));
  EXPECT_FALSE(std::filesystem::exists(out + "/journal.old.tsv"));
}

/// Which has begun a run of its own there, or nothing yet.
TEST_F(ResultFolderTest, goes_on_with_its_own_journal_that_another_build_has_set_aside) {
  for (const bool has_begun : {true, false}) {
    interrupt(8);
    std::filesystem::rename(out + "/journal.tsv", out + "/journal.old.tsv");
    if (has_begun) {
      begin_by("another", out + "/journal.tsv");
      interrupt(1);
      EXPECT_TRUE(holds(read_text(out + "/journal.old.tsv"), "777000")) << "the other's";
    }
    expect_reply(run(), 0, {fmt::format("goes on: {} of 20 units are done\n", has_begun ? 9 : 8)});
    EXPECT_EQ(files_in(out).count("journal.old.tsv"), 0u);
    std::filesystem::remove_all(out);
  }
}

TEST_F(ResultFolderTest, refuses_to_set_aside_a_journal_in_the_place_of_a_third_builds) {
  begin_by("another", out + "/journal.tsv");
  begin_by("a third", out + "/journal.old.tsv");
  expect_refused({"run", "toy", "--out", out}, {"holds two journals that this program cannot go on with"});
}

TEST_F(ResultFolderTest, leaves_what_another_build_has_begun_beside_a_complete_result) {
  ASSERT_EQ(run().status, 0);
  begin_by("another", out + "/journal.tsv");
  const auto before = files_in(out);
  expect_reply(run(), 0, {"complete already", "begun by another build of the program, whose command continues it"});
  EXPECT_EQ(files_in(out), before);
}

TEST_F(ResultFolderTest, computes_nothing_into_a_folder_that_has_taken_the_place_of_its_own) {
  RunIdentity ours{"toy", "{}", 0, std::nullopt, "program"};
  ResultFolder result(out, ours);
  std::filesystem::rename(out, out + ".moved");
  ResultFolder other(out, ours);
  const auto said = [](const auto& act) { return error_of<std::runtime_error>(act); };
  for (const std::string& line : {said([&] { result.stage("report.html", "a page"); }), said([&] { result.publish(); }),
                                  said([&] { result.gather_rank_journals(""); }), said([&] { result.seal({}); })}) {
    EXPECT_TRUE(holds(line, out + ": was moved away, and another is in its place, while the run was at work"));
  }
  EXPECT_EQ(files_in(out).size(), 1u) << "the journal of the other";
}

TEST_F(ResultFolderTest, leaves_a_journal_alone_whose_run_it_cannot_read) {  // as one of a later version may be
  std::filesystem::create_directories(out);
  Journal(out + "/journal.tsv", "of a later version").add("cell 1", {0.1, "777000"});
  const std::string before = read_text(out + "/journal.tsv");
  EXPECT_TRUE(holds(refusal(run()), "holds another run (something that cannot be read)"));
  EXPECT_EQ(read_text(out + "/journal.tsv"), before);
}

TEST_F(ResultFolderTest, starts_over_where_the_first_row_of_the_journal_is_damaged) {
  interrupt(3);
  std::string journal = read_text(out + "/journal.tsv");
  journal[journal.find("toy")] ^= 1;
  write_text(out + "/journal.tsv", journal);
  expect_reply(run(), 0, {"its first row is damaged; it is kept as journal.old.tsv: delete it if it is of no use\n"});
  EXPECT_EQ(read_text(out + "/journal.old.tsv"), journal) << "it may be another run's";
}

TEST_F(ResultFolderTest, clears_what_a_run_left_that_was_killed_while_it_wrote) {
  interrupt(3);
  const std::string left = out + "/" + temporary_name();
  write_text(left + "/data/half.csv", "half");
  write_text(out + "/" + temporary_name(), "half a journal");
  EXPECT_EQ(run().status, 0);
  EXPECT_FALSE(std::filesystem::exists(out + "/data/half.csv"));
  for (const auto& [name, text] : files_in(out)) EXPECT_FALSE(name.starts_with(".")) << name;
}

// ---- A manifest from anywhere: whatever it holds, every command that reads it answers in a line.

struct ManifestTest : ToyProgram {
  std::string good;

  void SetUp() override {
    ASSERT_EQ(run({"--seed", "3", "--trials", "7"}).status, 0);
    good = read_text(out + "/manifest.json");
  }

  /// Every command that reads the manifest, which says `text`, names `fault` in a line.
  void expect_fault(const std::string& text, const std::string& fault) const {
    SCOPED_TRACE(fault);
    write_text(out + "/manifest.json", text);
    for (const char* command : {"report", "cite", "reproduce"})
      EXPECT_EQ(refusal(call({command, out})), out + "/manifest.json: " + fault + "\n") << command;
    EXPECT_EQ(run().err, "--out " + out + ": holds a manifest.json that is not ours (manifest.json: " + fault +
                             "); name another folder\n");
    expect_reply(call({"report", out, "--check"}), 1, {"manifest.json: " + fault + "\n"});
    write_text(out + "/manifest.json", good);
  }

  /// The same, with `value` where `pointer` leads.
  void expect_fault(const std::string& pointer, const nlohmann::json& value, const std::string& fault) const {
    nlohmann::json json = nlohmann::json::parse(good);
    json[nlohmann::json::json_pointer(pointer)] = value;
    expect_fault(json.dump(), fault);
  }
};

TEST_F(ManifestTest, of_another_type_or_out_of_range_is_named_by_its_key) {
  const std::string trials = " is not allowed; a whole number from 1 to 9223372036854775807";
  expect_fault("/trials", 0, "key 'trials': 0" + trials);
  expect_fault("/trials", -5, "key 'trials': -5" + trials);
  expect_fault("/trials", 3.5, "key 'trials': 3.5" + trials);
  expect_fault("/trials", 0x1p70, "key 'trials': 1.1805916207174113e+21" + trials);
  expect_fault("/trials", "7", "key 'trials': \"7\"" + trials);
  expect_fault("/seed", -1, "key 'seed': -1 is not allowed; a whole number from 0 to 18446744073709551615");
  const std::string toml = " is not allowed; an object of what TOML can hold: no null, no whole number above 2^63 - 1";
  expect_fault("/config", nlohmann::json::array(), "key 'config': []" + toml);
  expect_fault("/config", {{"cells", nullptr}}, "key 'config': {\"cells\":null}" + toml);
  expect_fault("/experiment", "a\x1b{}", "key 'experiment': \"a\\u001b{}\" is not allowed; a name of a-z, 0-9 and _");
  expect_fault("/program/commit", "a}, note={b",
               "key 'program.commit': \"a}, note={b\" is not allowed; hexadecimal digits, or \"unknown\"");
  expect_fault("/run_id", "%", "key 'run_id': \"%\" is not allowed; hexadecimal digits");
  expect_fault("/finished", "2031", "key 'finished': \"2031\" is not allowed; a time as 2031-02-03T04:05:06Z");
  expect_fault("/self_test_passed", 1, "key 'self_test_passed': 1 is not allowed; true or false");
  expect_fault("/files", {{"a", 1}}, "key 'files': {\"a\":1} is not allowed; an object of texts");
  expect_fault("/machine", nlohmann::json(), "key 'machine': null is not allowed; an object");
  expect_fault("/thinwall_manifest", 2, "key 'thinwall_manifest': 2 is not allowed; a whole number from 1 to 1");
}

TEST_F(ManifestTest, nested_deeper_than_anything_could_print_is_refused) {
  const std::string deep = std::string(20000, '[') + std::string(20000, ']');
  std::string text = good;
  text.replace(text.find("\"cells\": 20"), 11, "\"cells\": " + deep);
  const std::string fault = "is not one JSON object, nested at most 64 deep";
  expect_fault(text, fault);
  expect_fault(deep, fault);
  expect_fault(good.substr(0, good.size() / 2), fault);
  write_text(out + "/datapackage.json", deep);
  EXPECT_EQ(call({"report", out, "--check"}).status, 1);
  const std::string shard = folder / "shard";
  ASSERT_EQ(call({"run", "toy", "--shard", "1/1", "--out", shard}).status, 0);
  text = read_text(shard + "/shard.json");
  text.replace(text.find("\"cells\": 20"), 11, "\"cells\": " + deep);
  write_text(shard + "/shard.json", text);
  EXPECT_TRUE(holds(call({"merge", shard}).err, "its shard.json is damaged, or not ours"));
}

// ---- What is not ours, in a folder that a command is given, stays as it is.

namespace fs = std::filesystem;

struct ForeignFiles : ToyProgram {
  void expect_refused_run() const { expect_refused({"run", "toy", "--out", out}); }
};

TEST_F(ForeignFiles, under_our_names_are_refused_and_kept) {
  for (const char* name : {"journal.tsv", "journal.old.tsv", "manifest.json", "manifest.old.json", "report.html"}) {
    SCOPED_TRACE(name);
    write_text(out + "/" + name, "mine\n");
    write_text(out + "/.staging/also", "mine\n");
    expect_refused_run();
    fs::remove_all(out);
    fs::create_directories(out + "/" + name + "/folder");
    expect_refused_run();
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
    expect_refused_run();
    fs::rename(out + "/manifest.old.json", out + "/manifest.json");
    expect_refused({"reproduce", out});
    json["files"].erase(outside);
    write_text(out + "/manifest.json", json.dump());
  }
}

TEST_F(ForeignFiles, in_the_way_of_a_rerun_are_not_removed_with_it) {
  ASSERT_EQ(run().status, 0);
  write_text(out + ".again/notes.txt", "mine\n");
  expect_refused({"reproduce", out});
  expect_refused({"reproduce", out, "--out", out});
  expect_refused({"reproduce", out, "--out", out + "/deeper"});
}

TEST_F(ForeignFiles, beside_ours_stay_whatever_a_run_does) {
  ASSERT_EQ(run().status, 0);
  const std::vector<std::string> names = {
      ".staging/notes",         ".drawing/notes", "journal.tsv.new", "journal.rank-my",
      "journal.rank-notes.tsv", "notes",          "data/notes",      ".thinwall-0123456789/notes",
      "plots/mine.gp",          "plots/mine.pdf"};
  for (const std::string& name : names) write_text(out + "/" + name, "mine\n");
  const auto expect_kept = [&] {
    for (const std::string& name : names) EXPECT_EQ(read_text(out + "/" + name), "mine\n") << name;
  };
  EXPECT_TRUE(holds(run().err, "complete already"));
  expect_kept();
  fs::remove(out + "/data/cells.csv");
  EXPECT_EQ(run().status, 0) << "it is replaced";
  EXPECT_TRUE(fs::exists(out + "/data/cells.csv"));
  expect_kept();
  EXPECT_FALSE(holds(call({"report", out, "--figures", "pdf"}).err, "mine"));
  expect_kept();
}

TEST_F(ForeignFiles, beside_ours_stay_in_a_rerun_that_went_on) {
  ASSERT_EQ(run().status, 0);
  ToyControl::interrupt_after = 8;
  expect_reply(call({"reproduce", out, "--threads", "1"}), 130, {"to continue:\nthinwall reproduce " + out});
  write_text(out + ".again/notes.txt", "mine\n");
  expect_reply(call({"reproduce", out}), 0, {out + ".again: stays, for it holds what the rerun did not write\n"});
  EXPECT_EQ(ToyControl::computed, 12);
  EXPECT_EQ(files_in(out + ".again"), (std::map<std::string, std::string>{{"notes.txt", "mine\n"}}));
}

TEST_F(ForeignFiles, that_a_run_would_write_over_are_refused_while_it_is_unfinished) {
  for (const char* name : {"report.html", "trace.jsonl", "data/mine.csv", "journal.rank-1.tsv"}) {
    interrupt(3);
    write_text(out + "/" + name, "mine\n");
    expect_refused_run();
    fs::remove_all(out);
  }
}

TEST_F(ForeignFiles, beside_what_another_build_has_begun_are_not_written_over) {
  begin_by("another", out + "/journal.tsv");
  write_text(out + "/report.html", "mine\n");
  run();
  EXPECT_EQ(read_text(out + "/report.html"), "mine\n");
}

TEST_F(ForeignFiles, that_come_while_a_run_is_at_work_are_not_written_over) {
  RunIdentity ours{"toy", "{}", 0, std::nullopt, "program"};
  fs::create_directories(folder / "mine");
  for (const bool is_link : {false, true}) {
    ResultFolder result(out, ours);
    result.stage("tables/cells.md", "ours\n");
    if (is_link) {
      fs::create_directory_symlink(folder / "mine", out + "/tables");
    } else {
      write_text(out + "/tables/cells.md", "mine\n");
    }
    EXPECT_TRUE(holds(error_of<UsageError>([&] { result.publish(); }), "'tables' has come while the run was at work"));
    EXPECT_EQ(is_link ? "mine\n" : read_text(out + "/tables/cells.md"), "mine\n");
    fs::remove_all(out);
  }
  EXPECT_TRUE(fs::is_empty(folder / "mine"));
}

TEST_F(ForeignFiles, in_the_place_of_a_shards_seal_are_kept) {
  write_text(out + "/shard.json", "{\"mine\": 1}\n");
  expect_refused({"run", "toy", "--out", out, "--shard", "1/2"}, {"holds 'shard.json', which is not ours"});
}

TEST_F(ForeignFiles, are_not_followed_where_they_are_links) {
  write_text(folder / "mine/cells.csv", "mine\n");
  const auto mine = files_in(folder / "mine");
  fs::create_directories(out);
  fs::create_directory_symlink(folder / "mine", out + "/data");
  EXPECT_EQ(run().err, "--out " + out + ": holds 'data', which is not ours; name another folder\n");
  fs::remove_all(out);
  interrupt(3);
  fs::create_symlink(folder / "none", out + "/report.html");
  expect_refused_run();
  fs::remove(out + "/report.html");
  fs::rename(out + "/journal.tsv", folder / "journal");
  fs::create_symlink(folder / "journal", out + "/journal.tsv");
  expect_refused_run();
  fs::remove_all(out);
  ASSERT_EQ(run().status, 0);
  fs::remove(out + "/data/cells.csv");
  fs::create_symlink(folder / "mine/cells.csv", out + "/data/cells.csv");
  expect_reply(run(), 0, {"complete already; nothing was computed (data/cells.csv was changed since"});
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

std::string difference(const std::string& file, const std::string& recorded, const std::string& rerun) {
  const auto found = first_difference(file, recorded, rerun);
  return found ? to_text(*found) : "none";
}

TEST(FileDifference, names_row_column_and_both_values_of_a_table) {
  const std::string a = "name,hits\n\"a, \"\"b\"\"\",1\n\"two\nlines\",2\nc,\n";
  EXPECT_EQ(difference("t.csv", a, a), "none");
  EXPECT_EQ(difference("t.csv", a, "name,hits\n\"a, \"\"b\"\"\",1\n\"two\nlines\",3\nd,9\n"),
            "t.csv: row 2, column 'hits': recorded 2, rerun 3");
  EXPECT_EQ(difference("t.csv", a, "name,hits\n\"a, \"\"b\"\"\",1\n\"two\nlines\",2\nc,7\n"),
            "t.csv: row 3, column 'hits': recorded nothing, rerun 7");
  EXPECT_EQ(difference("t.csv", a, "name,hits\n\"a, \"\"c\"\"\",1\n"),
            "t.csv: row 1, column 'name': recorded a, \"b\", rerun a, \"c\"");
}

TEST(FileDifference, tells_missing_rows_and_other_columns) {
  EXPECT_EQ(difference("t.csv", "x\n1\n2\n", "x\n1\n"), "t.csv: row 2: recorded 2, rerun nothing");
  EXPECT_EQ(difference("t.csv", "x\n1\n", "x\n1\n2\n"), "t.csv: row 2: recorded nothing, rerun 2");
  EXPECT_EQ(difference("t.csv", "x,y\n1,2\n", "x\n1\n"), "t.csv: the columns: recorded x,y, rerun x");
  EXPECT_EQ(difference("t.csv", "", "x\n1\n"), "t.csv: the columns: recorded nothing, rerun x");
  EXPECT_EQ(difference("t.csv", "x\n1\n", "x\n\"1\"\n"), "t.csv: line 2: recorded 1, rerun \"1\"");
}

TEST(FileDifference, names_the_line_of_any_other_file_and_shows_where_it_differs) {
  EXPECT_EQ(difference("a.md", "one\ntwo\n", "one\n2\n"), "a.md: line 2: recorded two, rerun 2");
  EXPECT_EQ(difference("a.md", "one\n", "one\ntwo\n"), "a.md: line 2: recorded nothing, rerun two");
  EXPECT_EQ(difference("a.md", "one\n", "one"), "a.md: line 1: recorded the end, rerun another end of the last line");
  const std::string same(200, '=');
  EXPECT_EQ(difference("a.md", same + "1", same + "2"),
            "a.md: line 1: recorded ...====================1, rerun ...====================2");
}

TEST(FileDifference, forgives_a_citation_its_day_and_its_program) {
  const std::string a = "@misc{a,\n  note   = {run 5, commit abc},\n  date   = {2026-11-22}\n}\n";
  EXPECT_EQ(difference("cite.bib", a, "@misc{a,\n  note   = {run 5, commit def},\n  date   = {2027-01-01}\n}\n"),
            "none");
  EXPECT_NE(difference("cite.bib", a, "@misc{a,\n  note   = {run 6, commit abc},\n  date   = {2026-11-22}\n}\n"),
            "none");
  EXPECT_NE(difference("cite.txt", a, "@misc{a,\n  note   = {run 5, commit def},\n  date   = {2026-11-22}\n}\n"),
            "none");
}

}  // namespace

}  // namespace thinwall
