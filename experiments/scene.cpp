#include <thinwall/experiments/scene.hpp>

#include <memory>
#include <utility>

#include <fmt/format.h>

#include <thinwall/experiments/scenes/playback.hpp>
#include <thinwall/experiments/scenes/scene_results.hpp>
#include <thinwall/experiments/scenes/trace.hpp>
#include <thinwall_embedded.hpp>

namespace thinwall {

namespace {

/// One unit: a step needs the one before it.
class SceneRun final : public Run {
 public:
  explicit SceneRun(Scene scene) : scene_(std::move(scene)) {}

  std::vector<Unit> units() const override {
    return {{fmt::format("scene {}", scene_.name), scene_.steps, [this] { return to_line(play(scene_)); }}};
  }

  Outcome finish(const std::vector<std::string>& results, const std::vector<double>&) const override {
    Outcome out = scene_outcome(scene_, plan(scene_.bodies, scene_.options), playback_from_line(results.front()));
    if (scene_.trace) out.files.push_back({"trace.jsonl", trace_of(scene_)});
    return out;
  }

 private:
  Scene scene_;
};

std::unique_ptr<Run> configure(const Settings& settings, const RunOptions& options) {
  return std::make_unique<SceneRun>(read_scene(settings, options));
}

}  // namespace

Experiment scene_experiment() { return {"scene", "What happens in this scene?", embedded_toml("scene"), configure}; }

}  // namespace thinwall
