#include <thinwall/experiments/scenes/comparison.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include <thinwall/experiments/scenes/scene.hpp>

namespace thinwall {

namespace {

constexpr double most_exact_steps = 1e7;  // of one run

}  // namespace

std::string Contender::label() const {
  std::string text(name_of(policy));
  if (policy == TimePolicy::substeps) text += fmt::format("_{}", substeps);
  return text;
}

CompareKeys read_compare_keys(const Settings& settings) {
  CompareKeys keys;
  keys.policies = settings.choices("compare.policy", policy_names);
  keys.steps = settings.numbers("compare.dt", {.lower = 0, .upper = 1e6, .lower_open = true, .unit = "s"});
  std::sort(keys.steps.begin(), keys.steps.end());
  keys.finer = static_cast<int>(settings.integer("compare.finer", 1, 1000));
  keys.repeats = static_cast<int>(settings.integer("compare.repeats", 1, 100));
  return keys;
}

Comparison read_comparison(const Settings& settings, const RunOptions& options) {
  Comparison out;
  out.scene = read_scene(settings, options);
  out.scene.options.threads = 1;  // contenders run side by side, and each is timed
  const CompareKeys keys = read_compare_keys(settings);
  for (const std::string& policy : keys.policies) {
    for (const double dt : keys.steps) out.contenders.push_back({policy_named(policy), out.scene.options.substeps, dt});
  }
  out.repeats = keys.repeats;
  out.exact = {TimePolicy::event_driven, 1, keys.steps.front() / keys.finer};
  if (keys.steps.back() > out.scene.duration())
    settings.complain("compare.dt", fmt::format("at most the scene's {} s", out.scene.duration()));
  if (out.scene.duration() / out.exact.dt > most_exact_steps)
    settings.complain("compare.dt", fmt::format("at most {:.0f} steps of the exact run", most_exact_steps));
  return out;
}

Scene scene_for(const Comparison& comparison, const Contender& contender) {
  Scene scene = comparison.scene;
  scene.options.policy = contender.policy;
  scene.options.substeps = contender.substeps;
  scene.dt = contender.dt;
  scene.steps = std::max<std::int64_t>(1, std::llround(comparison.scene.duration() / contender.dt));
  return scene;
}

std::optional<double> Trial::met(std::uint32_t first, std::uint32_t second) const {
  const auto ids = [](const FirstMeeting& m) { return std::pair(m.first, m.second); };
  const auto found = std::ranges::lower_bound(meetings, std::pair(first, second), {}, ids);
  return found != meetings.end() && ids(*found) == std::pair(first, second) ? std::optional(found->time) : std::nullopt;
}

bool Trial::same_outcome(const Trial& other) const {
  return meetings == other.meetings && tunneled == other.tunneled && hits == other.hits && hash == other.hash;
}

Trial run_trial(const Scene& scene) {
  Trial trial;
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> meetings;
  const Playback playback = play(scene, [&meetings](const World& world) {
    for (const CollisionEvent& event : world.events().events()) {
      if (event.kind == CollisionEventKind::begin) meetings.try_emplace({event.first, event.second}, event.time);
    }
  });
  for (const auto& [ids, time] : meetings) trial.meetings.push_back({ids.first, ids.second, time});
  trial.hits = playback.sums().hits;
  trial.sweeps = playback.sums().sweeps;
  trial.tunneled = playback.all_missed;
  trial.energy = playback.energy;
  trial.energy_end = playback.rows.back().energy;
  trial.hash = playback.hash;
  trial.seconds = playback.phases.back().total;
  return trial;
}

Contest contest(const Contender& contender, const std::vector<Trial>& repeats, const Trial& exact, double duration) {
  Contest out;
  out.contender = contender;
  out.trial = repeats.front();
  for (const Trial& repeat : repeats) {
    out.seconds.push_back(repeat.seconds);
    out.repeated_alike &= repeat.same_outcome(out.trial);
  }
  for (const auto& [first, second, time] : exact.meetings) {
    if (const auto here = out.trial.met(first, second)) {
      ++out.met;
      out.errors.push_back(std::abs(*here - time));
    } else if (time <= duration - contender.dt) {
      ++out.unmet;
    }
  }
  out.extra = static_cast<std::int64_t>(out.trial.meetings.size()) - out.met;
  std::sort(out.errors.begin(), out.errors.end());
  return out;
}

}  // namespace thinwall
