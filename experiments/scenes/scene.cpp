#include <thinwall/experiments/scenes/scene.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <map>

#include <fmt/format.h>

#include <thinwall/experiments/scenes/bodies.hpp>
#include <thinwall/experiments/scenes/comparison.hpp>
#include <thinwall/experiments/text/escape.hpp>
#include <thinwall/experiments/text/spelling.hpp>
#include <thinwall/experiments/world/plan.hpp>
#include <thinwall/experiments/world/step/pair_finder.hpp>
#include <thinwall/experiments/world/world.hpp>

namespace thinwall {

namespace {

constexpr std::array policies = {TimePolicy::discrete, TimePolicy::substeps, TimePolicy::clamp,
                                 TimePolicy::event_driven};
constexpr std::array<std::string_view, 3> view_names = {"xy", "xz", "zy"};
constexpr std::array<std::string_view, 2> plan_names = {"lean", "full"};
constexpr std::string_view push_defaults = "time = 0\nbody = \"\"\nvelocity = [0, 0, 0]\n";
constexpr double most_positions = 4e6;  // of a trace: some 200 MB of text

std::string scene_name(const Settings& settings) {
  const std::string name = settings.text("scene");
  constexpr std::string_view plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-";
  if (name.empty() || name.size() > 60 || name.find_first_not_of(plain) != std::string::npos)
    settings.complain("scene", "a name of 1 to 60 letters, digits, _ and -");
  return name;
}

WorldOptions world_options(const Settings& settings, int threads) {
  WorldOptions options;
  const std::vector<double> gravity =
      settings.vector("gravity", 3, {.lower = -most_of_a_scene, .upper = most_of_a_scene, .unit = "m/s^2"});
  options.gravity = {gravity[0], gravity[1], gravity[2]};
  options.policy = policy_named(settings.choice("policy", policy_names()));
  options.substeps = static_cast<int>(settings.integer("substeps", 1, 1000));
  options.max_events = static_cast<int>(settings.integer("max_events", 1, 1'000'000));
  options.contact_rounds = static_cast<int>(settings.integer("contact_rounds", 0, 1000));
  options.correction = settings.number("correction", {.lower = 0, .upper = 1});
  std::vector<std::string_view> broad_phases = {"auto"};
  broad_phases.insert(broad_phases.end(), PairFinder::names().begin(), PairFinder::names().end());
  options.broad_phase = settings.choice("broad_phase", broad_phases);
  options.response = settings.flag("response");
  options.end_after = static_cast<int>(settings.integer("end_after", 1, 1'000'000));
  options.gate = settings.number("gate", {.lower = 0});
  options.full_plan = settings.choice("plan", plan_names) == "full";
  options.threads = threads;
  options.max_pairs = static_cast<std::size_t>(settings.integer("max_pairs", 1, std::int64_t(1) << 40));
  return options;
}

/// The bodies that a push may name; nothing where two share a name.
using Pushable = std::map<std::string_view, const Body*>;

Pushable pushable(const std::vector<Body>& bodies) {
  Pushable out;
  for (const Body& body : bodies) {
    if (body.is_static || body.name.empty()) continue;
    if (const auto [at, is_new] = out.emplace(body.name, &body); !is_new) at->second = nullptr;
  }
  return out;
}

Push read_push(const Settings& push, const Pushable& bodies) {
  push.reject_unknown_keys();
  push.require("body", "the name of the body that is pushed");
  const std::string name = push.text("body");
  const auto found = bodies.find(name);
  if (found == bodies.end()) {
    std::vector<std::string_view> names;
    for (auto at = bodies.begin(); at != bodies.end() && names.size() < 20; ++at) names.push_back(at->first);
    push.complain("body", "a body that moves, by its name; " + spelling_hint(name, names));
  }
  if (!found->second) push.complain("body", "a name that one moving body alone has; several have this one");
  const std::vector<double> velocity = push.vector("velocity", 3, scene_speed);
  return {push.number("time", {.lower = 0, .unit = "s"}), found->second->id, {velocity[0], velocity[1], velocity[2]}};
}

void check_trace(const Settings& settings, const Scene& scene) {
  if (!scene.trace) return;
  const auto moving = static_cast<double>(std::count_if(scene.bodies.begin(), scene.bodies.end(), can_move));
  const double frames = static_cast<double>(scene.steps) / static_cast<double>(scene.trace_every) + 1;
  if (moving * frames > most_positions) {
    settings.complain("trace_every",
                      fmt::format("at least {:.0f}: a trace has at most {:.0f} positions",
                                  static_cast<double>(scene.steps) * moving / most_positions + 1, most_positions));
  }
}

}  // namespace

std::vector<std::string_view> policy_names() {
  std::vector<std::string_view> names;
  for (const TimePolicy policy : policies) names.push_back(name_of(policy));
  return names;
}

TimePolicy policy_named(std::string_view name) {
  for (const TimePolicy policy : policies) {
    if (name_of(policy) == name) return policy;
  }
  return TimePolicy::event_driven;
}

constexpr std::int64_t most_steps = 10'000'000;

Scene read_scene(const Settings& settings, const RunOptions& options) {
  Scene scene;
  scene.name = scene_name(settings);
  settings.text("question");
  scene.dt = settings.number("dt", {.lower = 0, .upper = 1e6, .lower_open = true, .unit = "s"});
  scene.steps = options.trials.value_or(settings.integer("steps", 1, most_steps));
  if (scene.steps > most_steps) {
    throw UsageError(fmt::format("--trials: {} is not allowed; of a scene, its steps: a whole number from 1 to {}",
                                 scene.steps, most_steps));
  }
  scene.options = world_options(settings, options.threads);
  scene.bodies = read_bodies(settings, options.seed);
  if (const std::vector<Settings> pushes = settings.tables("push", push_defaults); !pushes.empty()) {
    const Pushable bodies = pushable(scene.bodies);
    for (const Settings& push : pushes) scene.pushes.push_back(read_push(push, bodies));
  }
  std::stable_sort(scene.pushes.begin(), scene.pushes.end(),
                   [](const Push& a, const Push& b) { return a.time < b.time; });
  scene.trace = settings.flag("trace");
  scene.trace_every = settings.integer("trace_every", 1, 10'000'000);
  check_trace(settings, scene);
  const std::string view = settings.choice("view", view_names);
  scene.across = view[0] - 'x';
  scene.up = view[1] - 'x';
  read_compare_keys(settings);  // they are kept with the result, be it of `run`
  try {
    plan(scene.bodies, scene.options);
  } catch (const WorldError& error) {  // the world knows best
    throw UsageError(fmt::format("scene '{}': {}", scene.name, one_line(error.what())));
  }
  return scene;
}

}  // namespace thinwall
