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
std::unique_ptr<Run> configure_scene(const Settings& settings, const RunOptions& options) {
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

Outcome outcome_of(const Comparison& comparison, const std::vector<Trial>& trials) {
  const std::size_t count = comparison.contenders.size();
  const Trial& exact = trials.back();
  std::vector<Contest> contests;
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<Trial> repeats;
    for (std::size_t at = i; at + 1 < trials.size(); at += count) repeats.push_back(trials[at]);
    contests.push_back(contest(comparison.contenders[i], repeats, exact, comparison.scene.duration()));
  }
  return compare_outcome(comparison, exact, contests);
}

/// A unit for each repeat of each contender, repeats outermost so that they lie apart in time; the exact run last.
std::unique_ptr<Run> configure_compare(const Settings& settings, const RunOptions& options) {
  const auto comparison = std::make_shared<const Comparison>(read_comparison(settings, options));
  std::vector<Task<Trial>> tasks;
  const auto add = [&](const Contender& c, std::string key) {
    tasks.push_back({std::move(key), scene_for(*comparison, c).steps,
                     [comparison, c] { return run_trial(scene_for(*comparison, c)); }});
  };
  for (int repeat = 0; repeat < comparison->repeats; ++repeat) {
    for (const Contender& c : comparison->contenders) add(c, fmt::format("{} {} repeat {}", c.label(), c.dt, repeat));
  }
  add(comparison->exact, fmt::format("exact {}", comparison->exact.dt));
  return make_run([comparison](const Done<Trial>& done) { return outcome_of(*comparison, done.results); },
                  std::move(tasks));
}

}  // namespace

Experiment scene_experiment() {
  return {"scene", "What happens in this scene?", embedded_toml("scene"), configure_scene};
}

Experiment compare_experiment() {
  return {"compare", "Discrete or swept, on this scene: what is missed, how far off, and at what run time?",
          embedded_toml("scene"), configure_compare};
}

}  // namespace thinwall
