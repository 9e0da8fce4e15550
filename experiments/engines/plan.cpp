#include <thinwall/experiments/engines/plan.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <thinwall/experiments/engines/engine_list.hpp>
#include <thinwall/experiments/engines/fly.hpp>
#include <thinwall/experiments/text/numbers.hpp>

namespace thinwall {

namespace {

/// Poses lie on a grid that float holds, as thin_wall's do: a path must not be longer than this many times what it crosses.
constexpr double most_walls_a_path = 1e6;

/// What brings an engine that is not in this program.
std::string remedy(const Engine& engine) {
  return fmt::format("install {} and configure with -DTHINWALL_PEERS=ON", engine.package);
}

void choose_engines(const Settings& settings, EnginePlan& plan) {
  const EngineChoices choices = {
      .swept_radius = settings.numbers("swept_radius", {.lower = 0, .upper = 1, .lower_open = true}),
      .motion_threshold = settings.number("motion_threshold", {.lower = 0, .upper = 1000, .lower_open = true}),
      .substeps = settings.integers("substeps", 2, 1000)};
  const std::vector<Engine> engines = engine_list();
  std::vector<std::string_view> allowed;
  for (const Engine& engine : engines) allowed.push_back(engine.name);
  allowed.emplace_back("all");
  const std::vector<std::string> chosen = settings.choices("engine", allowed);
  const auto asked = [&](const std::string& name) {
    return std::find(chosen.begin(), chosen.end(), name) != chosen.end();
  };
  for (const Engine& engine : engines) {
    if (!asked("all") && !asked(engine.name)) continue;
    if (!engine.is_there) {
      if (asked(engine.name)) {
        settings.complain("engine", fmt::format("only what this program was built with, and {} is not in it: {}",
                                                engine.called, remedy(engine)));
      }
      plan.missing.push_back(engine);
      continue;
    }
    for (EngineMode& mode : engine.modes(choices)) plan.setups.push_back({engine, std::move(mode)});
  }
}

/// A ball that is not stopped is behind the wall in time.
void check_path(const Settings& settings, const EngineCell& cell) {
  const double thick = cell.thickness + 2 * cell.radius;
  const double ahead = cell.path * std::cos(cell.angle_deg * (std::numbers::pi / 180)) * (cell.steps - 2);
  if (ahead < thick) {
    settings.complain("path", fmt::format("long enough that {} steps cross the wall at {} deg: at least {} m",
                                          cell.steps, cell.angle_deg, rounded_text(thick / ahead * cell.path, 3)));
  }
  if (cell.path > most_walls_a_path * thick) {
    settings.complain(
        "path", fmt::format("at most {} times thickness + 2 * radius: not so at {} m", most_walls_a_path, cell.path));
  }
}

void check_wall(const Settings& settings, const EngineCell& cell) {
  if (cell.wall_size < least_wall_size(cell)) {
    settings.complain("wall_size",
                      fmt::format("at least {} m, so that no ball gets round it: path is {} m, steps is {}",
                                  rounded_text(std::ceil(least_wall_size(cell)), 6), cell.path, cell.steps));
  }
}

void choose_cells(const Settings& settings, EnginePlan& plan) {
  constexpr Range length = {.lower = 1e-9, .upper = 1e6, .unit = "m"};
  EngineCell cell = {.path = 0,
                     .step = settings.number("step", {.lower = 1e-9, .upper = 1e3, .unit = "s"}),
                     .radius = settings.number("radius", length),
                     .thickness = settings.number("thickness", length),
                     .wall_size = 0,
                     .angle_deg = settings.number("angle_deg", {.lower = 0, .upper = 89.9, .unit = "deg"}),
                     .steps = static_cast<int>(settings.integer("steps", 4, most_engine_steps))};
  std::vector<double> paths = settings.numbers("path", length);
  std::sort(paths.begin(), paths.end());
  for (const double wall_size : settings.numbers("wall_size", length)) {
    for (const double path : paths) {
      cell.path = path;
      cell.wall_size = wall_size;
      plan.cells.push_back(cell);
    }
  }
  for (const EngineCell& one : plan.cells) {
    check_path(settings, one);
    if (one.path == paths.back()) check_wall(settings, one);  // the longest needs the widest
  }
  for (const EngineSetup& setup : plan.setups) {
    if (setup.can_do(plan.cells.front())) return;
  }
  settings.complain("path", fmt::format("one of at most {} m: {} moves nothing further in a step ({})",
                                        plan.setups.front().engine.most_path, plan.setups.front().engine.called,
                                        plan.setups.front().engine.why_most_path));
}

}  // namespace

EnginePlan make_engine_plan(const Settings& settings, const RunOptions& options) {
  EnginePlan plan;
  choose_engines(settings, plan);
  plan.shots = settings.trials("shots", 1, most_engine_shots, options.trials);
  settings.limit_cells({"path", "wall_size"}, plan.setups.size() * engine_volleys(plan.shots).size());
  choose_cells(settings, plan);
  plan.seed = options.seed;
  return plan;
}

std::vector<std::string> missing_engines(const EnginePlan& plan) {
  std::vector<std::string> lines;
  for (const Engine& engine : plan.missing) {
    lines.push_back(fmt::format("{} is left out: {}", engine.called, remedy(engine)));
  }
  return lines;
}

}  // namespace thinwall
