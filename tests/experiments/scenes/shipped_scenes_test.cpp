/// The scenes that come with the program: each is read, and gives the same bits whatever its plan leaves out.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include <thinwall/experiments/scenes/comparison.hpp>
#include <thinwall/experiments/scenes/scene.hpp>

#include "experiments/scenes/scene_text.hpp"
#include "support/temporary_folder.hpp"

namespace thinwall {
namespace {

std::vector<std::filesystem::path> shipped() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(THINWALL_SCENES)) {
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// The scene, short, and of the many alike only some: a test is not a benchmark.
Scene shortened(const std::filesystem::path& file, const std::string& plan) {
  Settings settings = scene_settings(read_text(file));
  settings.assign("plan", plan);
  Scene scene = read_scene(settings, {.seed = 1, .trials = 40});
  std::vector<Body> few;
  for (const Body& body : scene.bodies) {
    if (body.is_static || few.size() < 120) few.push_back(body);
  }
  scene.bodies = few;
  return scene;
}

TEST(ShippedScenes, are_nine_with_names_of_their_files) {
  std::set<std::string> names;
  for (const auto& file : shipped()) {
    const Scene scene = read_scene(scene_settings(read_text(file)), {});
    EXPECT_EQ(scene.name, file.stem()) << file;
    names.insert(scene.name);
    EXPECT_NO_THROW(read_comparison(scene_settings(read_text(file)), {})) << file;
  }
  EXPECT_EQ(names.size(), 9U);
}

TEST(ShippedScenes, rain_is_of_a_hundred_thousand) {
  const Scene scene = read_scene(scene_settings(read_text(std::string(THINWALL_SCENES) + "/rain.toml")), {});
  EXPECT_EQ(scene.bodies.size(), 100'001U);
}

TEST(ShippedScenes, give_the_same_bits_lean_or_full) {
  for (const auto& file : shipped()) {
    const Playback lean = play(shortened(file, "lean")), full = play(shortened(file, "full"));
    EXPECT_EQ(lean.hash, full.hash) << file;
    EXPECT_EQ(lean.events, full.events) << file;
    EXPECT_EQ(lean.all_missed, full.all_missed) << file;
  }
}

TEST(ShippedScenes, let_nothing_through_as_they_are) {
  for (const auto& file : shipped()) {
    const Scene scene = shortened(file, "lean");
    EXPECT_EQ(play(scene).all_missed, 0) << file;
  }
}

/// Twenty discrete steps of a room of thin walls, or of bullets: something gets through.
TEST(ShippedScenes, let_things_through_when_discrete) {
  for (const char* name : {"thin_wall_gallery", "bullet_against_bullet"}) {
    Scene scene = shortened(std::string(THINWALL_SCENES) + "/" + name + ".toml", "lean");
    scene.options.policy = TimePolicy::discrete;
    EXPECT_GT(play(scene).all_missed, 0) << name;
  }
}

}  // namespace
}  // namespace thinwall
