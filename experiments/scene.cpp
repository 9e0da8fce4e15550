#include <thinwall/experiments/scene.hpp>

#include <memory>
#include <utility>

#include <fmt/format.h>

#include <thinwall/experiments/lab/tasks.hpp>
#include <thinwall/experiments/scenes/comparison.hpp>
#include <thinwall/experiments/scenes/scene.hpp>
#include <thinwall_embedded.hpp>

namespace thinwall {

namespace {

/// One unit: a step needs the one before it.
std::unique_ptr<Run> configure(const Settings& settings, const RunOptions& options) {
  const auto scene = std::make_shared<const Scene>(read_scene(settings, options));
  std::vector<Task<Playback>> tasks = {
      {fmt::format("scene {}", scene->name), scene->steps, [scene] { return play(*scene); }}};
  const auto finish = [scene](const Done<Playback>& done) {
    Outcome out = scene_outcome(*scene, plan(scene->bodies, scene->options), done.results.front());
    if (scene->trace) out.files.push_back({"trace.jsonl", trace_of(*scene)});
    return out;
  };
  return make_run(finish, std::move(tasks));
}

}  // namespace

Experiment scene_experiment() { return {"scene", "What happens in this scene?", embedded_toml("scene"), configure}; }

}  // namespace thinwall
