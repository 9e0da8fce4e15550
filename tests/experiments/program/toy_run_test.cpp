/// The whole way of a run, from the command line to the files, with an experiment made for it.

#include <gtest/gtest.h>

#include <cstdlib>

#include <thinwall/experiments/lab/files.hpp>

#include "support/toy_program.hpp"

namespace thinwall {
namespace {

using ToyRunTest = ToyProgram;

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

TEST_F(ToyRunTest, hashes_every_file_but_timings_their_figures_report_and_manifest) {
  ASSERT_EQ(run().status, 0);
  auto files = files_in(out);
  for (const char* name :
       {"data/timings.csv", "plots/cost.gp", "plots/cost.dat", "plots/cost.json", "report.html", "manifest.json"}) {
    EXPECT_EQ(files.erase(name), 1u);
  }
  files.erase("plots/cost.svg");  // there only if gnuplot is
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
  EXPECT_NE(reply.out.find(" s (16 units tried with "), std::string::npos) << reply.out;
  EXPECT_EQ(ToyControl::computed, 0);
  EXPECT_FALSE(std::filesystem::exists(out));
  const auto json = nlohmann::json::parse(run({"--dry-run", "--json"}).out);
  EXPECT_EQ(json.at("trials"), 200);
  EXPECT_GE(json.at("estimated_seconds"), 0);
  EXPECT_EQ(json.at("units_left_out_of_estimate"), 0);
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
  EXPECT_EQ(manifest().at("reproduce"), "thinwall run resolved.toml --seed 0 --out ../again");
  const std::string again = folder / "again";
  ASSERT_EQ(call({"run", out + "/resolved.toml", "--out", again}).status, 0);
  EXPECT_EQ(read_text(again + "/data/cells.csv"), read_text(out + "/data/cells.csv"));
}

}  // namespace
}  // namespace thinwall
