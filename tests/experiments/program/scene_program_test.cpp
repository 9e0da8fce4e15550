/// Scenes from the command line: run, compare, plan; and what is said to what they cannot take.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "experiments/scenes/scene_text.hpp"
#include "support/toy_program.hpp"

namespace thinwall {
namespace {

struct SceneProgram : ToyProgram {
  std::string file = folder / "my.toml";
  SceneProgram() { write_text(file, bullet_text("policy = 'discrete'\n")); }

  void expect_refusal(const std::vector<std::string>& words, const std::string& said) const {
    const Reply reply = call(words);
    EXPECT_EQ(reply.status, 2) << reply.err;
    EXPECT_NE(reply.err.find(said), std::string::npos) << reply.err;
    EXPECT_EQ(std::ranges::count(reply.err, '\n'), 1) << reply.err;
    EXPECT_FALSE(std::filesystem::exists(out));
  }
};

TEST_F(SceneProgram, run_leaves_a_full_folder_with_a_trace) {
  const Reply reply = call({"run", file, "--out", out, "--trace", "--threads", "1"});
  ASSERT_EQ(reply.status, 0) << reply.err;
  EXPECT_NE(reply.out.find("1 pair went through each other unseen"), std::string::npos) << reply.out;
  for (const char* name :
       {"manifest.json", "report.html", "resolved.toml", "trace.jsonl", "data/steps.csv", "data/plan.csv",
        "data/events.csv", "data/tunneled.csv", "data/timings.csv", "plots/tracks.gp"}) {
    EXPECT_TRUE(std::filesystem::exists(out + "/" + name)) << name;
  }
  EXPECT_EQ(manifest()["experiment"], "scene");
  EXPECT_EQ(manifest()["config"]["trace"], true);
  EXPECT_TRUE(manifest()["files"].contains("trace.jsonl"));
}

TEST_F(SceneProgram, draws_and_checks_bodies_of_any_name) {
  if (std::system("command -v gnuplot >/dev/null") != 0) GTEST_SKIP() << "gnuplot is not installed";
  std::string text = "experiment = 'scene'\nscene = 'names'\nsteps = 2\n";
  for (const char* name : {"\\\"", "''", "'first", "]]>", "]]></text><script>x</script>", "a`b`"}) {
    text += "[[body]]\nshape = 'sphere'\nradius = 1\nvelocity = [1, 0, 0]\nname = \"" + std::string(name) + "\"\n";
  }
  write_text(file, text);
  const Reply reply = call({"run", file, "--out", out});
  ASSERT_EQ(reply.status, 0) << reply.err;
  EXPECT_EQ(reply.err.find("not drawn"), std::string::npos) << reply.err;
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
  EXPECT_NE(call({"compare", file, "--out", out}).err.find("complete already"), std::string::npos);
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

TEST_F(SceneProgram, refuses_what_is_no_scene) {
  write_text(file, "experiment = 'toy'\n");
  expect_refusal({"compare", file, "--out", out}, "not a scene");
  expect_refusal({"run", "toy", "--out", out, "--trace"}, "--trace: only a scene has a trace");
  expect_refusal({"run", "toy", "--out", out, "--plan", "full"}, "--plan: only a scene has a plan");
  expect_refusal({"plan", folder / "none.toml"}, "there is no such file");
  expect_refusal({"compare"}, "compare: the TOML file of a scene is missing");
  expect_refusal({"plan"}, "plan: the TOML file of a scene is missing");
  write_text(file, "radius = 1\n");
  expect_refusal({"plan", file}, "key 'radius': unknown key");
  expect_refusal({"run", file, "--out", out}, "key 'experiment': missing");
}

TEST_F(SceneProgram, names_what_is_wrong_in_a_scene) {
  expect_refusal({"plan", file, "--plan", "fat"}, "--plan: 'fat' is not allowed");
  write_text(file, bullet_text("polcy = 'clamp'\n"));
  expect_refusal({"run", file, "--out", out}, "my.toml:3: key 'polcy': unknown key; did you mean 'policy'?");
  write_text(file, bullet_text() + "mass = 0\n");
  expect_refusal({"run", file, "--out", out}, "key 'body.mass'");
}

}  // namespace
}  // namespace thinwall
