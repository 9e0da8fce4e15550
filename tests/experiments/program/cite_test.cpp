/// BibTeX on stdout: of the software, and of a result.

#include <gtest/gtest.h>

#include <algorithm>

#include <thinwall/experiments/lab/result_folder.hpp>

#include "support/toy_program.hpp"

namespace thinwall {
namespace {

using CiteTest = ToyProgram;

TEST_F(CiteTest, cites_the_software_as_its_citation_file_does) {
  const Reply reply = call({"cite"});
  EXPECT_EQ(reply.status, 0) << reply.err;
  EXPECT_TRUE(reply.out.starts_with("@software{thinwall,\n  author  = {{The thinwall authors}},\n")) << reply.out;
  EXPECT_NE(reply.out.find("  title   = {thinwall: continuous collision detection and tunneling research},\n"),
            std::string::npos);
  EXPECT_NE(reply.out.find("  version = {" + this_software().version + "},\n"), std::string::npos);
  EXPECT_EQ(std::ranges::count(reply.out, '{'), std::ranges::count(reply.out, '}'));
}

TEST_F(CiteTest, cites_a_result_as_its_folder_does) {
  ASSERT_EQ(run({"--seed", "3"}).status, 0);
  const Reply reply = call({"cite", out});
  EXPECT_EQ(reply.status, 0) << reply.err;
  EXPECT_EQ(reply.out, read_text(out + "/cite.bib"));
  const std::string run_id = manifest().at("run_id");
  EXPECT_NE(reply.out.find("@misc{thinwall_toy_" + run_id + ","), std::string::npos) << reply.out;
  EXPECT_NE(reply.out.find("{What is a square?}"), std::string::npos);
  EXPECT_NE(reply.out.find("run " + run_id + ", seed 3, commit "), std::string::npos);
}

TEST_F(CiteTest, replies_in_json) {
  ASSERT_EQ(run({"--seed", "3"}).status, 0);
  const auto json = nlohmann::json::parse(call({"cite", out, "--json"}).out);
  EXPECT_EQ(json.at("result").at("title"), "What is a square?");
  EXPECT_EQ(json.at("result").at("run_id"), manifest().at("run_id"));
  EXPECT_EQ(json.at("result").at("commit"), manifest().at("program").at("commit"));
  EXPECT_EQ(json.at("result").at("date"), manifest().at("finished").get<std::string>().substr(0, 10));
  EXPECT_FALSE(nlohmann::json::parse(call({"cite", "--json"}).out).contains("result"));
}

TEST_F(CiteTest, keeps_the_version_and_date_of_the_program_that_made_the_result) {
  ASSERT_EQ(run().status, 0);
  auto json = manifest();
  json["program"]["version"] = "9.8.7";
  json["program"]["release_date"] = "2031-02-03";
  write_text(out + "/manifest.json", json.dump());
  const std::string cited = call({"cite", out}).out;
  EXPECT_NE(cited.find("  version = {9.8.7},\n  date    = {2031-02-03},\n  year    = {2031},\n"), std::string::npos);
}

TEST_F(CiteTest, escapes_every_field) {
  const std::string entry = bibtex(ResultCitation{.experiment = "a_b",
                                                  .question = "100 %?",
                                                  .run_id = "1}",
                                                  .seed = 1,
                                                  .commit = "a}, note={",
                                                  .dirty = false,
                                                  .date = "2031}%"});
  for (const char* part : {"@misc{thinwall_a_b_1,", "100 \\%?", "run 1\\},", "commit a\\}, note=\\{}", "{2031\\}\\%}"})
    EXPECT_NE(entry.find(part), std::string::npos) << part << " in\n" << entry;
}

TEST_F(CiteTest, refuses_what_holds_no_result) {
  const auto expect_refusal = [](const std::string& target, const std::string& why) {
    const Reply reply = call({"cite", target});
    EXPECT_EQ(reply.status, 2);
    EXPECT_TRUE(reply.out.empty());
    EXPECT_NE(reply.err.find(target + ": " + why), std::string::npos) << reply.err;
    EXPECT_EQ(std::ranges::count(reply.err, '\n'), 1);
  };
  expect_refusal(folder / "none", "there is no such folder");
  expect_refusal(folder.path().string(), "holds no manifest.json");
  write_text(folder / "journal.tsv", "");
  expect_refusal(folder.path().string(), "holds a run that is not finished");
  write_text(folder / "manifest.json", "{\"thinwall_manifest\": 1}");
  EXPECT_EQ(call({"cite", folder.path().string()}).err, folder / "manifest.json: key 'program': missing\n");
  expect_refusal(folder / "manifest.json", "is not a folder");
  const Reply nameless = call({"cite", ""});
  EXPECT_EQ(nameless.status, 2);
  EXPECT_EQ(nameless.err, "cite: the folder of a result is empty; name one, or none\n");
}

}  // namespace
}  // namespace thinwall
