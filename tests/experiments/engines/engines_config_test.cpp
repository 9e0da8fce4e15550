/// The settings of the experiment engines.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/experiments/engines/engine_list.hpp>

#include "experiments/engines/engines_run.hpp"

namespace thinwall {
namespace {

std::string refusal(const std::string& text) {
  try {
    engines_run(text);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

TEST(EnginesConfig, unit_keys_are_unique_and_trials_override_the_shots) {
  std::vector<std::string> keys;
  for (const Unit& unit : engines_run("")->units()) keys.push_back(unit.key);
  std::sort(keys.begin(), keys.end());
  EXPECT_EQ(std::adjacent_find(keys.begin(), keys.end()), keys.end());
  EXPECT_EQ(engines_run("", {.seed = 1, .trials = 7})->units().front().trials, 7);
  EXPECT_THROW(engines_run("", {.seed = 1, .trials = most_engine_shots + 1}), UsageError);
}

TEST(EnginesConfig, paths_are_sorted_and_engines_keep_their_order) {
  const EnginePlan plan = engine_plan("path = [2, 0.5, 1]\nwall_size = [300, 250]\nengine = ['all']");
  ASSERT_EQ(plan.cells.size(), 6U);
  EXPECT_EQ(plan.cells[0].path, 0.5);
  EXPECT_EQ(plan.cells[0].wall_size, 300);
  EXPECT_EQ(plan.setups.back().label(), "thinwall event_driven");
}

TEST(EnginesConfig, names_the_setting_that_is_out_of_range) {
  for (const auto& [key, text] : {std::pair{"path", "path = [0]"},
                                  {"path", "path = []"},
                                  {"path", "path = [0.01]"},
                                  {"path", "path = [1e6]\nwall_size = [1e6]"},
                                  {"step", "step = 0"},
                                  {"radius", "radius = 0"},
                                  {"thickness", "thickness = -1"},
                                  {"wall_size", "wall_size = [100]"},
                                  {"angle_deg", "angle_deg = 90"},
                                  {"steps", "steps = 3"},
                                  {"steps", "steps = 1001"},
                                  {"shots", "shots = 0"},
                                  {"swept_radius", "swept_radius = [0]"},
                                  {"swept_radius", "swept_radius = [1.5]"},
                                  {"motion_threshold", "motion_threshold = 0"},
                                  {"substeps", "substeps = [1]"},
                                  {"engine", "engine = ['havok']"}}) {
    const std::string said = refusal(text);
    EXPECT_NE(said.find("key '" + std::string(key) + "'"), std::string::npos) << text << ": " << said;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  }
  EXPECT_NE(refusal("wall_size = [100]").find("at least 201 m"), std::string::npos) << refusal("wall_size = [100]");
  EXPECT_NE(refusal("path = [0.01]").find("at least 0.0275 m"), std::string::npos) << refusal("path = [0.01]");
}

TEST(EnginesConfig, an_engine_asked_for_by_name_is_there_or_refused_with_what_brings_it) {
  for (const Engine& engine : engine_list()) {
    const std::string said = refusal("engine = ['" + engine.name + "']");
    if (engine.is_there) {
      EXPECT_EQ(said, "");
    } else {
      EXPECT_NE(said.find(engine.package), std::string::npos) << said;
    }
  }
}

TEST(EnginesConfig, an_engine_with_no_path_that_it_can_do_is_refused) {
  const auto engines = engine_list();
  for (const Engine& engine : engines) {
    if (engine.name != "box2d" || !engine.is_there) continue;
    const std::string said = refusal("engine = ['box2d']\npath = [3, 5]");
    EXPECT_NE(said.find("one of at most 2 m"), std::string::npos) << said;
    return;
  }
  GTEST_SKIP() << "box2d is not in this build: libbox2d-dev and -DTHINWALL_PEERS=ON bring it";
}

}  // namespace
}  // namespace thinwall
