/// A result run again from its manifest: the same, or what differs and why.

#include <filesystem>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <thinwall/experiments/lab/files.hpp>

#include "experiments/scenes/scene_text.hpp"
#include "support/toy.hpp"

namespace thinwall {

namespace {

namespace fs = std::filesystem;

struct ReproduceTest : ToyProgram {
  std::string again = out + ".again";

  Reply reproduce(const Words& more = {}) const { return call(joined({"reproduce", out}, more)); }
};

TEST_F(ReproduceTest, finds_the_same_and_leaves_no_trace) {
  ASSERT_EQ(run({"--seed", "5", "--trials", "7"}).status, 0);
  const auto files = files_in(folder.path());
  const Reply reply = reproduce({"--threads", "1"});
  EXPECT_EQ(reply.status, 0) << reply.out << reply.err;
  const auto count = std::to_string(manifest().at("files").size());
  EXPECT_EQ(reply.out, "identical: " + count + " files of " + out +
                           " came out the same\nby the same program on the same machine\n");
  EXPECT_EQ(ToyControl::computed, 20) << "it really ran";
  EXPECT_EQ(files_in(folder.path()), files);
}

TEST_F(ReproduceTest, runs_the_configuration_of_the_manifest) {
  write_text(folder / "my.toml", "experiment = \"toy\"\ncells = 5\nspeed = [2.5, 1e300]\n");
  ASSERT_EQ(call({"run", folder / "my.toml", "--out", out}).status, 0);
  EXPECT_EQ(manifest().at("reproduce"), "thinwall run resolved.toml --seed 0 --out ../again");
  EXPECT_EQ(reproduce().status, 0);
  EXPECT_EQ(ToyControl::computed, 5);
}

TEST_F(ReproduceTest, keeps_the_rerun_where_it_is_told_to_and_takes_no_result_for_one) {
  ASSERT_EQ(run().status, 0);
  const std::string there = folder / "there";
  EXPECT_EQ(reproduce({"--out", there}).status, 0);
  EXPECT_TRUE(fs::exists(there + "/manifest.json"));
  EXPECT_EQ(refusal(reproduce({"--out", there})),
            there + ": holds a result already; delete it, or name another folder with --out\n");
  EXPECT_EQ(reproduce({"--out", out}).status, 2);
}

TEST_F(ReproduceTest, names_what_differs_and_what_may_explain_it) {
  ASSERT_EQ(run().status, 0);
  std::string cells = read_text(out + "/data/cells.csv");
  cells.replace(cells.find("\n3,9,") + 1, 4, "3,8,");
  write_text(out + "/data/cells.csv", cells);
  change_manifest("/files/data~1cells.csv", sha256(cells));
  change_manifest("/program/compiler", "Another 1.0");
  change_manifest("/machine/cpu", "Another CPU");
  expect_reply(reproduce(), 1,
               {"differs: 1 of ", "  data/cells.csv: row 4, column 'square': recorded 8, rerun 9\n",
                "What may explain it:\n  compiler: recorded Another 1.0, rerun ", "  CPU: recorded Another CPU, rerun ",
                "The rerun is kept in " + again});
  EXPECT_TRUE(fs::exists(again + "/manifest.json"));
  fs::remove_all(again);
  const auto json = nlohmann::json::parse(reproduce({"--json"}).out);
  EXPECT_EQ(json.at("identical"), false);
  expect_members(json.at("differences").at(0), {{"row", 4}, {"column", "square"}});
  EXPECT_EQ(json.at("facts").at(0).at("fact"), "compiler");
}

TEST_F(ReproduceTest, says_when_nothing_recorded_explains_a_difference) {
  ASSERT_EQ(run().status, 0);
  const std::string cells = read_text(out + "/data/cells.csv") + "20,400,,,true\n";
  write_text(out + "/data/cells.csv", cells);
  change_manifest("/files/data~1cells.csv", sha256(cells));
  expect_reply(reproduce(), 1,
               {"data/cells.csv: row 21: recorded 20,400,,,true, rerun nothing\n", "Nothing recorded explains it"});
}

TEST_F(ReproduceTest, names_files_that_were_changed_or_lost_since) {
  ASSERT_EQ(run().status, 0);
  write_text(out + "/plots/squares.gp", "# my own\n");
  fs::remove(out + "/tables/cells.md");
  expect_reply(reproduce(), 1,
               {out + "/plots/squares.gp: was changed since it was written\n",
                out + "/tables/cells.md: was lost since it was written\n", "differs: 2 of ",
                "as it was written, the result came out the same"});
}

TEST_F(ReproduceTest, refuses_what_it_cannot_run) {
  expect_refused({"reproduce"}, {"reproduce: the folder of a result is missing"});
  ASSERT_EQ(run().status, 0);
  const std::string good = read_text(out + "/manifest.json");
  change_manifest("/config/cels", 3);
  expect_refused({"reproduce", out},
                 {out + "/manifest.json (config as TOML):3: key 'cels': unknown key; did you mean 'cells'?"});
  write_text(out + "/manifest.json", good);
  change_manifest("/experiment", "tyo");
  expect_refused({"reproduce", out}, {"'tyo' is not allowed; did you mean 'toy'?"});
}

// ---- Scenes from the command line: run, compare, plan; and what is said to what they cannot take.

struct SceneProgram : ToyProgram {
  std::string file = folder / "my.toml";
  SceneProgram() { write_text(file, bullet_text("policy = 'discrete'\n")); }
};

TEST_F(SceneProgram, run_leaves_a_full_folder_with_a_trace) {
  ASSERT_EQ(call({"run", file, "--out", out, "--trace", "--threads", "1"}).status, 0);
  for (const char* name :
       {"manifest.json", "report.html", "resolved.toml", "trace.jsonl", "data/steps.csv", "data/plan.csv",
        "data/events.csv", "data/tunneled.csv", "data/timings.csv", "plots/tracks.gp"}) {
    EXPECT_TRUE(std::filesystem::exists(out + "/" + name)) << name;
  }
  EXPECT_EQ(manifest()["experiment"], "scene");
  EXPECT_TRUE(holds(manifest()["answer"].get<std::string>(), "1 more went unseen"));
  EXPECT_EQ(manifest()["config"]["trace"], true);
  EXPECT_TRUE(manifest()["files"].contains("trace.jsonl"));
}

TEST_F(SceneProgram, draws_and_checks_bodies_of_any_name) {
  if (!gnuplot_is_there()) GTEST_SKIP() << "gnuplot is not installed";
  std::string text = "experiment = 'scene'\nscene = 'names'\nsteps = 2\n";
  for (const char* name : {"\\\"", "''", "'first", "]]>", "]]></text><script>x</script>", "a`b`"}) {
    text += "[[body]]\nshape = 'sphere'\nradius = 1\nvelocity = [1, 0, 0]\nname = \"" + std::string(name) + "\"\n";
  }
  write_text(file, text);
  const Reply reply = call({"run", file, "--out", out});
  ASSERT_EQ(reply.status, 0) << reply.err;
  EXPECT_FALSE(holds(reply.err, "not drawn"));
  EXPECT_TRUE(std::filesystem::exists(out + "/plots/tracks.svg"));
  EXPECT_EQ(call({"report", out, "--check"}).status, 0);
}

TEST_F(SceneProgram, what_a_folder_resolves_to_gives_it_again) {
  ASSERT_EQ(call({"run", file, "--out", out, "--plan", "full"}).status, 0);
  const std::string again = folder / "again";
  const Reply reply = call({"run", out + "/resolved.toml", "--out", again});
  ASSERT_EQ(reply.status, 0) << reply.err;
  for (const char* name : {"steps", "events", "bodies", "plan"}) {
    const std::string csv = std::string("/data/") + name + ".csv";
    EXPECT_EQ(read_text(out + csv), read_text(again + csv)) << name;
  }
}

TEST_F(SceneProgram, compare_answers_and_can_be_resumed) {
  write_text(file, bullet_text() + "\n[compare]\ndt = [0.02]\nrepeats = 1\n");
  const Reply reply = call({"compare", file, "--out", out, "--json"});
  ASSERT_EQ(reply.status, 0) << reply.err;
  EXPECT_EQ(nlohmann::json::parse(reply.out)["experiment"], "compare");
  EXPECT_TRUE(holds(call({"compare", file, "--out", out}).err, "complete already"));
  EXPECT_EQ(call({"run", out + "/resolved.toml", "--out", folder / "again"}).status, 0);
}

TEST_F(SceneProgram, plan_prints_what_is_left_out) {
  const Reply text = call({"plan", file}), full = call({"plan", file, "--plan", "full"});
  EXPECT_EQ(text.status, 0) << text.err;
  EXPECT_NE(text.out, full.out);
  const auto json = nlohmann::json::parse(call({"plan", file, "--json"}).out);
  EXPECT_EQ(json["scene"], "bullet");
  EXPECT_FALSE(json["lines"].empty());
  EXPECT_FALSE(json["full"].get<bool>());
}

TEST_F(SceneProgram, refuses_what_is_no_scene_or_plan) {
  expect_refused({"plan", file, "--plan", "fat"}, {"--plan: 'fat' is not allowed"});
  write_text(file, "experiment = 'toy'\n");
  expect_refused({"compare", file, "--out", out}, {"not a scene"});
  expect_refused({"plan", file}, {"not a scene"});
  write_text(file, "experiment = 'toy'\nscene = 'a'\n");
  expect_refused({"plan", file}, {"not a scene"});
  write_text(file, "experiment = 3\nscene = 'a'\n");
  expect_refused({"plan", file}, {":1: key 'experiment': 3 is not allowed"});
  expect_refused({"run", "toy", "--out", out, "--trace"}, {"--trace: only a scene has a trace"});
  expect_refused({"run", "toy", "--out", out, "--plan", "full"}, {"--plan: only a scene has a plan"});
  expect_refused({"plan", folder / "none.toml"}, {"there is no such file"});
  expect_refused({"compare"}, {"compare: the TOML file of a scene is missing"});
  expect_refused({"plan"}, {"plan: the TOML file of a scene is missing"});
  write_text(file, "radius = 1\n");
  expect_refused({"plan", file}, {"key 'experiment': missing"});
  expect_refused({"run", file, "--out", out}, {"key 'experiment': missing"});
}

}  // namespace

}  // namespace thinwall
