/// The whole way of a run, from the command line to the files, with an experiment made for it.

#include <gtest/gtest.h>

#include <sstream>

#include <nlohmann/json.hpp>

#include <thinwall/experiments/program/program.hpp>
#include <thinwall/experiments/text/sha256.hpp>

#include "support/temporary_folder.hpp"
#include "support/toy_experiment.hpp"

namespace thinwall {
namespace {

struct Reply {
  int status;
  std::string out, err;
};

struct ToyRunTest : testing::Test {
  TemporaryFolder folder;
  std::string out = folder / "out";

  ToyRunTest() {
    ToyControl::computed = ToyControl::interrupt_after = ToyControl::fail_at = 0;
    ToyControl::pass = true;
  }

  static Reply call(std::vector<std::string> words) {
    const std::vector<Experiment> experiments = {toy_experiment()};
    words.insert(words.begin(), "thinwall");
    std::ostringstream reply, notes;
    const int status = run_program(words, experiments, reply, notes);
    return {status, reply.str(), notes.str()};
  }

  Reply run(std::vector<std::string> more = {}) const {
    std::vector<std::string> words = {"run", "toy", "--out", out};
    words.insert(words.end(), more.begin(), more.end());
    return call(words);
  }

  nlohmann::json manifest() const { return nlohmann::json::parse(read_text(out + "/manifest.json")); }
};

TEST_F(ToyRunTest, leaves_a_whole_result_folder) {
  const Reply reply = run({"--threads", "2", "--seed", "3"});
  EXPECT_EQ(reply.status, 0) << reply.err;
  EXPECT_EQ(reply.out, "cells: 20\n\nThe squares & <their> sum.\n\nreport: " + out + "/report.html\n");
  const auto files = files_in(out);
  for (const char* name :
       {"cite.bib", "data/cells.csv", "data/timings.csv", "datapackage.json", "manifest.json", "plots/squares.dat",
        "plots/squares.gp", "report.html", "resolved.toml", "tables/cells.md", "tables/cells.tex"}) {
    EXPECT_TRUE(files.contains(name)) << name;
  }
  for (const auto& [name, text] : files) EXPECT_TRUE(name.find("journal") == name.npos && name[0] != '.') << name;
  EXPECT_TRUE(files.at("data/cells.csv").starts_with("cell,square,name,root,even\n0,3,\"a, \"\"b\"\"\",,true\n1,4,"));
}

TEST_F(ToyRunTest, hashes_every_file_but_timings_report_and_manifest) {
  ASSERT_EQ(run().status, 0);
  auto files = files_in(out);
  for (const char* name : {"data/timings.csv", "report.html", "manifest.json"}) EXPECT_EQ(files.erase(name), 1u);
  std::map<std::string, std::string> hashes;
  for (const auto& [name, text] : files) hashes[name] = sha256(text);
  EXPECT_EQ(manifest().at("files").get<decltype(hashes)>(), hashes);
}

TEST_F(ToyRunTest, says_in_its_manifest_where_it_came_from) {
  ASSERT_EQ(run({"--seed", "9007199254740993", "--trials", "7", "--threads", "1"}).status, 0);
  const auto json = manifest();
  EXPECT_EQ(json.at("experiment"), "toy");
  EXPECT_EQ(json.at("config").at("speed"), nlohmann::json::parse("[1,10]"));
  EXPECT_EQ(json.at("seed"), 9007199254740993u);
  EXPECT_EQ(json.at("trials"), 7);
  EXPECT_EQ(json.at("total_trials"), 140);
  EXPECT_EQ(json.at("threads"), 1);
  EXPECT_EQ(json.at("argv").at(0), "thinwall");
  EXPECT_EQ(json.at("reproduce"), "thinwall run toy --seed 9007199254740993 --trials 7 --out again");
  for (const char* key : {"version", "commit", "dirty", "compiler", "flags", "build_type", "sha256", "libraries"}) {
    EXPECT_TRUE(json.at("program").contains(key)) << key;
  }
  EXPECT_FALSE(json.at("machine").at("cpu").get<std::string>().empty());
  EXPECT_LE(json.at("started").get<std::string>(), json.at("finished").get<std::string>());
  EXPECT_EQ(json.at("started").get<std::string>().size(), std::string("2026-11-21T12:34:56Z").size());
}

TEST_F(ToyRunTest, writes_a_report_that_stands_alone) {
  ASSERT_EQ(run().status, 0);
  const std::string page = read_text(out + "/report.html");
  EXPECT_NE(page.find("The squares &amp; &lt;their&gt; sum."), std::string::npos);
  EXPECT_NE(page.find("<p>First.</p>\n<p>Second.</p>"), std::string::npos);
  for (const char* never : {"<script", "<img", "@import", "url(", "src="}) {
    EXPECT_EQ(page.find(never), std::string::npos) << never;
  }
  for (auto at = page.find("href=\""); at != std::string::npos; at = page.find("href=\"", at + 1)) {
    const std::string target = page.substr(at + 6, page.find('"', at + 6) - at - 6);
    EXPECT_TRUE(target == "data:," || std::filesystem::exists(out + "/" + target)) << target;
  }
}

TEST_F(ToyRunTest, gives_the_same_bytes_for_any_thread_count) {
  std::map<std::string, std::string> first;
  for (const char* threads : {"1", "2", "3"}) {
    out = folder / threads;
    ASSERT_EQ(run({"--threads", threads}).status, 0);
    auto files = files_in(out);
    for (const char* name : {"data/timings.csv", "report.html", "manifest.json"}) files.erase(name);
    if (first.empty()) first = files;
    EXPECT_EQ(files, first);
  }
}

TEST_F(ToyRunTest, goes_on_after_an_interruption_and_ends_with_the_same_bytes) {
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

TEST_F(ToyRunTest, keeps_what_was_finished_when_a_unit_fails) {
  ToyControl::fail_at = 5;
  const Reply reply = run({"--threads", "1"});
  EXPECT_EQ(reply.status, 1);
  EXPECT_NE(reply.err.find("failed: unit 'cell 4' failed: no luck\n"), std::string::npos) << reply.err;
  ToyControl::fail_at = 0;
  ToyControl::computed = 0;
  EXPECT_EQ(run({"--threads", "1"}).status, 0);
  EXPECT_LE(ToyControl::computed, 19);
}

TEST_F(ToyRunTest, computes_a_damaged_row_again_and_says_so) {
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

TEST_F(ToyRunTest, answers_at_once_where_the_result_lies_already) {
  const Reply first = run();
  const auto files = files_in(out);
  ToyControl::computed = 0;
  const Reply second = run({"--threads", "1"});
  EXPECT_EQ(second.status, 0);
  EXPECT_EQ(second.out, first.out);
  EXPECT_EQ(ToyControl::computed, 0);
  EXPECT_EQ(files_in(out), files);
}

TEST_F(ToyRunTest, mends_a_result_that_lost_a_file_but_overwrites_no_change) {
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

TEST_F(ToyRunTest, refuses_the_folder_of_another_run) {
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

TEST_F(ToyRunTest, refuses_a_folder_that_holds_things_of_others) {
  std::filesystem::create_directories(out + "/data");
  const Reply reply = run();
  EXPECT_EQ(reply.status, 2);
  EXPECT_EQ(reply.err, "--out " + out + ": holds 'data', which is not ours; name another folder\n");
  write_text(out + "/manifest.json", "{}");
  EXPECT_EQ(run().err, "--out " + out + ": holds a manifest.json that is not ours; name another folder\n");
}

TEST_F(ToyRunTest, reports_a_failed_self_test) {
  ToyControl::pass = false;
  const Reply reply = run();
  EXPECT_EQ(reply.status, 1);
  EXPECT_NE(reply.err.find("the self-test failed"), std::string::npos);
  EXPECT_NE(read_text(out + "/report.html").find("The self-test failed"), std::string::npos);
  EXPECT_EQ(run().status, 1) << "and still does when asked again";
}

TEST_F(ToyRunTest, draws_no_figure_where_gnuplot_is_absent_and_says_so) {
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", folder.path().c_str(), 1);
  const Reply reply = run();
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(reply.status, 0);
  EXPECT_NE(reply.err.find("figures were not drawn: gnuplot is not installed\n"), std::string::npos) << reply.err;
  EXPECT_NE(read_text(out + "/report.html").find("gnuplot is not installed"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(out + "/plots/squares.gp"));
}

TEST_F(ToyRunTest, writes_nothing_on_a_dry_run) {
  const Reply reply = run({"--dry-run", "--threads", "1"});
  EXPECT_EQ(reply.status, 0);
  EXPECT_TRUE(reply.out.starts_with("toy: 20 units, 200 trials on 1 thread\nabout ")) << reply.out;
  EXPECT_FALSE(std::filesystem::exists(out));
  const auto json = nlohmann::json::parse(run({"--dry-run", "--json"}).out);
  EXPECT_EQ(json.at("trials"), 200);
  EXPECT_GE(json.at("estimated_seconds"), 0);
}

TEST_F(ToyRunTest, replies_in_json) {
  const auto json = nlohmann::json::parse(run({"--json"}).out);
  EXPECT_EQ(json.at("experiment"), "toy");
  EXPECT_EQ(json.at("out"), out);
  EXPECT_EQ(json.at("units"), 20);
  EXPECT_EQ(json.at("trials"), 200);
  EXPECT_EQ(json.at("answer"), "The squares & <their> sum.");
  EXPECT_EQ(json.at("self_test_passed"), true);
  EXPECT_EQ(json.at("report"), out + "/report.html");
  EXPECT_EQ(nlohmann::json::parse(call({"list", "--json"}).out).at(0).at("name"), "toy");
}

TEST_F(ToyRunTest, runs_its_own_resolved_configuration) {
  write_text(folder / "my.toml", "experiment = \"toy\"\ncells = 5\n");
  ASSERT_EQ(call({"run", folder / "my.toml", "--out", out}).status, 0);
  EXPECT_EQ(manifest().at("reproduce"), "thinwall run resolved.toml --seed 0 --out again");
  const std::string again = folder / "again";
  ASSERT_EQ(call({"run", out + "/resolved.toml", "--out", again}).status, 0);
  EXPECT_EQ(read_text(again + "/data/cells.csv"), read_text(out + "/data/cells.csv"));
}

}  // namespace
}  // namespace thinwall
