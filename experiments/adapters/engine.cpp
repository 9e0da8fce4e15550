#include <thinwall/experiments/adapters/engine.hpp>

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include <thinwall/experiments/lab/manifest.hpp>

namespace thinwall {

std::vector<Engine> engine_list(const EngineChoices& choices) {
#define THINWALL_MAKE_ENGINE(make) make(choices),
  std::vector<Engine> engines = {THINWALL_ENGINES(THINWALL_MAKE_ENGINE)};
#undef THINWALL_MAKE_ENGINE
  const BuildRecord build = this_build();
  for (Engine& engine : engines) {
    for (const auto& [library, version] : build.libraries) {
      if (library == engine.called) engine.version = version;
    }
    engine.remedy = fmt::format("install {}, if it is missing, and configure with -DTHINWALL_PEERS=ON", engine.package);
  }
  engines.back().version = build.version;
  const std::vector<Engine> others = npm_engines();
  engines.insert(engines.end() - 1, others.begin(), others.end());
  return engines;
}

ChosenEngines choose_engines(const Settings& settings) {
  const std::vector<Engine> engines = engine_list(
      {.swept_radius = settings.numbers("swept_radius", {.lower = 0, .upper = 1, .lower_open = true}),
       .motion_threshold = settings.number("motion_threshold", {.lower = 0, .upper = 1000, .lower_open = true}),
       .substeps = settings.integers("substeps", 2, 1000)});
  std::vector<std::string_view> allowed;
  for (const Engine& engine : engines) allowed.push_back(engine.name);
  allowed.emplace_back("all");
  const std::vector<std::string> names = settings.choices("engine", allowed);
  const auto asked = [&](std::string_view name) { return std::ranges::find(names, name) != names.end(); };
  ChosenEngines chosen;
  for (const Engine& engine : engines) {
    if (!asked("all") && !asked(engine.name)) continue;
    for (const EngineMode& mode : engine.modes) chosen.setups.push_back({engine, mode});
    if (engine.is_there()) continue;
    if (asked(engine.name)) {
      settings.complain("engine", fmt::format("only what this program was built with, and {} is not in it: {}",
                                              engine.called, engine.remedy));
    }
    chosen.missing.push_back(fmt::format("{} is left out: {}", engine.called, engine.remedy));
  }
  return chosen;
}

}  // namespace thinwall
