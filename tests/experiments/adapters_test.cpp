/// What speaks to a program that answers in lines of JSON; and the shape casts of engines that are npm packages.

#include <string>
#include <vector>

#include <unistd.h>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <thinwall/experiments/adapters/engine.hpp>
#include <thinwall/experiments/adapters/speaker.hpp>

#include "support/said.hpp"

namespace thinwall {

namespace {

/// What a shell says to `question`, or what is wrong with it.
std::string said(const char* script, const nlohmann::json& question = {{"id", 1}}, double seconds = 60) {
  try {
    Speaker speaker("It", {"sh", "-c", script}, "/");
    return speaker.ask(question, seconds).dump();
  } catch (const SpeakerError& error) {
    return error.what();
  }
}

TEST(Speakers, answer_in_lines_of_json) {
  EXPECT_EQ(said("cat"), R"({"id":1})");
  const nlohmann::json much = std::vector<int>(500'000, 7);
  EXPECT_TRUE(said("cat", much) == much.dump()) << "more than a pipe holds, both ways";
  EXPECT_EQ(said("read line; printf '[1,'; sleep 0.1; echo '2]'"), "[1,2]");
}

/// Ctrl-C is for this program, which then tells its speakers: a volley that is being played is played to its end.
TEST(Speakers, are_in_a_process_group_of_their_own) {
  Speaker speaker("It", {"sh", "-c", "cut -d' ' -f5 /proc/$$/stat"}, "/");
  EXPECT_NE(speaker.hear(5).get<int>(), getpgrp());
}

TEST(Speakers, that_die_hang_or_talk_nonsense_are_named_errors) {
  EXPECT_EQ(said("exit 3"), "It has died");
  EXPECT_EQ(said("read line; kill -9 $$"), "It has died");
  EXPECT_EQ(said("exec sleep 100", 1, 0.5), "It has said nothing for 0.5 s");
  EXPECT_EQ(said("read line; echo garbage"), "It says what is not JSON: \"garbage\"");
  EXPECT_EQ(error_of<SpeakerError>([] { Speaker("It", {"/no/such/program"}, "/").hear(5); }),
            "It cannot be started: is /no/such/program installed?");
}

/// A ball and boxes that meet after 1.7, 1.4 and 1.4 of 4 m, and a ball that stays in front.
TEST(EngineCasts, of_npm_meet_what_they_fly_at_and_nothing_else) {
  const auto shape = [](const char* kind, const nlohmann::json& size, double x) -> nlohmann::json {
    return {{kind, size}, {"at", {x, 0, 0}}, {"turn", {0, 0, 0, 1}}, {"by", {4, 0, 0}}};
  };
  const nlohmann::json ball = shape("sphere", 0.1, -2), box = shape("box", {0.1, 0.1, 0.1}, -2),
                       large = shape("sphere", 0.2, 0), wall = shape("box", {0.5, 0.3, 0.2}, 0);
  const nlohmann::json pairs = {{ball, wall}, {shape("sphere", 0.1, -6), wall}, {ball, large}, {box, wall}};
  std::string missing;
  for (const Engine& engine : npm_engines()) {
    if (!engine.is_there()) {
      missing += fmt::format("{} is not in this build: {}\n", engine.called, engine.remedy);
      continue;
    }
    Speaker speaker(engine.called, {"node", "serve.mjs", engine.name}, THINWALL_SOURCE "/experiments/adapters/npm");
    const nlohmann::json offer = speaker.hear(60);
    EXPECT_EQ(offer.at("casts").empty(), engine.name == "mujoco");
    for (const nlohmann::json& cast : offer.at("casts")) {
      nlohmann::json asked = pairs;
      if (engine.name == "box2d3") asked.erase(3);  // its cast is built of a ball alone
      const nlohmann::json answer = speaker.ask({{"id", 1}, {"cast", cast}, {"pairs", asked}}, 60);
      const nlohmann::json& times = answer.at("times");
      ASSERT_EQ(times.size(), asked.size()) << engine.called;
      EXPECT_TRUE(times[1].is_null()) << engine.called;
      constexpr double off = 0.005 / 4 * 1.01;  // Box2D's slop is 5 mm
      EXPECT_NEAR(times[0].get<double>(), 1.4 / 4, off) << engine.called;
      EXPECT_NEAR(times[2].get<double>(), 1.7 / 4, off) << engine.called;
      if (asked.size() == 4) {
        EXPECT_NEAR(times[3].get<double>(), 1.4 / 4, off) << engine.called;
      }
      EXPECT_GT(answer.at("seconds").get<double>(), 0);
      EXPECT_GT(answer.at("call_seconds").get<double>(), 0);
    }
    EXPECT_TRUE(speaker.ask({{"id", 2}, {"cast", "nonsense"}, {"pairs", pairs}}, 60).contains("error"));
  }
  if (!missing.empty()) GTEST_SKIP() << missing;
}

}  // namespace

}  // namespace thinwall
