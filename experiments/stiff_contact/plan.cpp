#include <thinwall/experiments/stiff_contact/plan.hpp>

#include <algorithm>

#include <fmt/format.h>

namespace thinwall {

namespace {

// Growth is told from decay over ten decades of damping; see growth.hpp.
constexpr double least_ratio = 1e-5, greatest_ratio = 1e5;
constexpr Range positive_steps = {.lower = 1e-6, .upper = 1e6, .unit = "1/omega"};
// A bounce takes about pi / step steps.
constexpr Range bounce_steps = {.lower = 1e-3, .upper = 1e6, .unit = "1/omega"};
constexpr double least_path =
    0x1p-30;  // of the distance from first contact to the middle: 22 bits are left for the phase
constexpr double least_reach = 1e-9;  // [m]
constexpr Range race_steps = {.lower = 1e-3, .upper = 2, .unit = "1/omega"};

std::vector<double> ascending(std::vector<double> list) {
  std::sort(list.begin(), list.end());
  return list;
}

void check(const Settings& settings, const StiffPlan& plan) {
  for (const double ratio : plan.ratios) {
    if (ratio != 0 && ratio < least_ratio) {
      settings.complain("damping_ratio",
                        fmt::format("0, or {:g} to {:g}; one is {:g}", least_ratio, greatest_ratio, ratio));
    }
  }
  if (reach(plan.approach) < least_reach) {
    settings.complain("thickness", fmt::format("such that radius + thickness / 2 is at least {:g} m", least_reach));
  }
  const double omega = frequency(spring_of(plan.approach.mass, plan.stiffest(), 0));
  const double path = plan.approach.speed * std::min(plan.bounce_steps.front(), plan.race_steps.back()) / omega;
  if (path < least_path * reach(plan.approach)) {
    settings.complain("stiffness",
                      fmt::format("such that the ball moves, in the shortest step, at least 2^-30 of radius + "
                                  "thickness / 2; at {:g} it moves {:.3g} m",
                                  plan.stiffest(), path));
  }
}

}  // namespace

std::string key(const LimitCell& c) {
  return fmt::format("limit {} stiffness {} ratio {}", name(c.scheme), c.stiffness, c.ratio);
}

std::string key(const BounceSeries& s) {
  return fmt::format("bounce {} {} stiffness {} ratio {}", name(s.scheme), name(s.detection), s.stiffness, s.ratio);
}

StiffPlan make_stiff_plan(const Settings& settings, const RunOptions& options) {
  const auto positive = [](double upper, std::string_view unit) {
    return Range{.lower = 0, .upper = upper, .lower_open = true, .unit = unit};
  };
  settings.limit_cells({"stiffness", "damping_ratio", "step"}, all_schemes.size());
  settings.limit_cells({"stiffness", "bounce_damping", "bounce_step"}, all_schemes.size() * all_detections.size());
  StiffPlan plan;
  plan.seed = options.seed;
  plan.approach.mass = settings.number("mass", {.lower = 1e-12, .upper = 1e12, .unit = "kg"});
  plan.stiffness = ascending(settings.numbers("stiffness", {.lower = 1e-12, .upper = 1e18, .unit = "N/m"}));
  plan.ratios = ascending(settings.numbers("damping_ratio", {.lower = 0, .upper = greatest_ratio}));
  plan.steps = ascending(settings.numbers("step", positive_steps));
  plan.approach.speed = settings.number("speed", positive(1e6, "m/s"));
  plan.approach.radius = settings.number("radius", {.lower = 0, .upper = 1e6, .unit = "m"});
  plan.approach.thickness = settings.number("thickness", {.lower = 0, .upper = 1e6, .unit = "m"});
  plan.approach.blow_up =
      settings.number("blow_up", {.lower = 1, .upper = 1e9, .lower_open = true, .unit = "incoming speeds"});
  plan.bounce_ratios = ascending(settings.numbers("bounce_damping", {.lower = 0, .upper = 100}));
  plan.bounce_steps = ascending(settings.numbers("bounce_step", bounce_steps));
  plan.bounces = settings.trials("bounces", 1, 1 << 24, options.trials);
  plan.race_steps = ascending(settings.numbers("race_step", race_steps));
  std::reverse(plan.race_steps.begin(), plan.race_steps.end());
  plan.race_bounces = settings.integer("race_bounces", 1, 1 << 20);
  plan.rounds = settings.integer("rounds", 1, 1 << 20);
  check(settings, plan);
  return plan;
}

std::vector<LimitCell> limit_cells(const StiffPlan& plan) {
  std::vector<LimitCell> cells;
  for (const Scheme scheme : all_schemes) {
    for (const double stiffness : plan.stiffness) {
      for (const double ratio : plan.ratios) cells.push_back({scheme, stiffness, ratio});
    }
  }
  return cells;
}

std::vector<BounceSeries> bounce_series(const StiffPlan& plan) {
  std::vector<BounceSeries> all;
  for (const Scheme scheme : all_schemes) {
    for (const double ratio : plan.bounce_ratios) {
      for (const double stiffness : plan.stiffness) {
        for (const Detection detection : all_detections) all.push_back({scheme, detection, stiffness, ratio});
      }
    }
  }
  return all;
}

}  // namespace thinwall
