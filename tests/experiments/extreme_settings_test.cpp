/// Values at the end of what a number can be: refused with the key's name and range, or computed rightly.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include <thinwall/experiments/experiment_list.hpp>

#include "support/experiment_run.hpp"

namespace thinwall {
namespace {

const Experiment& experiment(std::string_view name) {
  return *std::ranges::find(experiments(), name, &Experiment::name);
}

std::string refusal(std::string_view name, const std::string& text) {
  try {
    run_of(experiment(name), text);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

struct Refused {
  std::string_view experiment;
  std::string text, refusal;
};

class RefusedSettings : public testing::TestWithParam<Refused> {};

TEST_P(RefusedSettings, name_the_key_and_what_is_allowed) {
  const Refused& c = GetParam();
  const std::string complaint = refusal(c.experiment, c.text);
  EXPECT_TRUE(complaint.starts_with("test.toml:1: key '" + c.refusal)) << complaint;
}

INSTANTIATE_TEST_SUITE_P(
    Extremes, RefusedSettings,
    testing::Values(
        // Ended in words of Boost.
        Refused{"hitscan", "target = [1e-300]",
                "target': 1e-300 is not allowed; a list of numbers >= 1e-09 and <= 1000 [m]"},
        // Failed the self-test: the target's place has no such digits left.
        Refused{"hitscan", "target = [1e-9]\nradius = [0]",
                "target': [1e-09] is not allowed; such that target + radius is at least 1e-06 of the range"},
        // Took ceil(1 / path) steps, of which none got anywhere.
        Refused{"plan", "shot_path = [1e-300]",
                "shot_path': 1e-300 is not allowed; a list of numbers >= 0.01 and <= 1000"},
        Refused{"plan", "shot_path = [1e-9]", "shot_path': 1e-09 is not allowed"},
        // Ended the program by an assertion of ODE.
        Refused{"engines", "step = 1e-300", "step': 1e-300 is not allowed; a number >= 1e-09 and <= 1000 [s]"},
        // In proportion, but without a square.
        Refused{"thin_wall", "thickness = [1e-300]\nradius = [0]\nstep = [1]\nspeed = [1e-300]", "thickness'"},
        Refused{"crossing_bullets", "radius = 1e-300\nstep = 1\nspeed = [1e-300]", "radius'"},
        Refused{"stiff_contact", "thickness = 1e-300\nradius = 0\nspeed = 1e-300", "thickness'"}));

struct Crowded {
  std::string_view experiment, longest, other;
};

class CrowdedSettings : public testing::TestWithParam<Crowded> {};

TEST_P(CrowdedSettings, are_refused_before_they_are_built) {
  const auto list_of = [](int count) {
    std::string text;
    for (int i = 1; i <= count; ++i) text += std::to_string(i) + ",";
    return " = [" + text + "]\n";
  };
  const Crowded& c = GetParam();
  const std::string text = std::string(c.longest) + list_of(200000) + std::string(c.other) + list_of(20000);
  const std::string complaint = refusal(c.experiment, text);
  EXPECT_TRUE(complaint.starts_with("test.toml:1: key '" + std::string(c.longest) + "'")) << complaint.substr(0, 200);
  EXPECT_NE(complaint.find(std::string(c.longest) + " (200,000)"), std::string::npos) << complaint;
  EXPECT_NE(complaint.find(std::string(c.other) + " (20,000)"), std::string::npos) << complaint;
  EXPECT_TRUE(complaint.ends_with(" cells; at most 1,000,000")) << complaint;
}

INSTANTIATE_TEST_SUITE_P(
    Extremes, CrowdedSettings,
    testing::Values(Crowded{"thin_wall", "speed", "step"}, Crowded{"swept_bounds", "speed", "turn_deg"},
                    Crowded{"crossing_bullets", "offset", "speed"}, Crowded{"hitscan", "range", "wind"},
                    Crowded{"broad_phase", "count", "speed"}, Crowded{"engines", "path", "wall_size"},
                    Crowded{"bouncing", "step", "restitution"}, Crowded{"plan", "shot_path", "shot_gate"},
                    Crowded{"stiff_contact", "stiffness", "step"}));

TEST(ExtremeSettings, of_many_values_are_not_too_many) {
  std::string values;
  for (int i = 1; i <= 100000; ++i) values += std::to_string(i) + "e-5,";
  const auto run = run_of(experiment("crossing_bullets"),
                          "rule = ['closed_form']\nspeed = [10]\nangle_deg = [60]\n"
                          "offset = [1]\nratio = [" +
                              values + "]");
  EXPECT_EQ(run->units().size(), 100001u);
}

TEST(ExtremeSettings, of_accuracy_are_a_thousand_units_a_row) {
  const auto run = run_of(experiment("accuracy"), "pair = ['sphere_sphere']", {.seed = 1, .trials = 1'000'000'000});
  EXPECT_LE(run->units().size(), 5000u);
}

}  // namespace
}  // namespace thinwall
