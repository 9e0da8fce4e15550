#include <gtest/gtest.h>

#include <array>
#include <string>

#include <thinwall/experiments/lab/settings.hpp>

#include "support/said.hpp"

namespace thinwall {
namespace {

constexpr const char* defaults = R"(experiment = "toy"
speed = [1, 10.5]
radius = 0.5
shots = 1000
exact = true
mode = "fast"
methods = ["ray", "sweep"]
[wall]
thickness = 0.1
)";

constexpr std::array<std::string_view, 3> methods = {"ray", "sweep", "closed_form"};

/// Reads every key, as an experiment does.
void read_all(const Settings& settings) {
  settings.reject_unknown_keys();
  settings.numbers("speed", {.lower = 0, .lower_open = true, .unit = "m/s"});
  settings.number("radius", {.lower = 0, .unit = "m"});
  settings.integer("shots", 1, 5000);
  settings.flag("exact");
  settings.choice("mode", std::array<std::string_view, 2>{"fast", "slow"});
  settings.choices("methods", methods);
  settings.number("wall.thickness", {.lower = 0, .unit = "m"});
}

std::string complaint(const std::string& text) {
  return error_of<UsageError>([&] { read_all(Settings(text, "my.toml", defaults)); });
}

struct BadInput {
  std::string text, complaint;
};

class BadSettings : public ::testing::TestWithParam<BadInput> {};

TEST_P(BadSettings, are_named_in_one_line) {
  EXPECT_EQ(complaint(GetParam().text), GetParam().complaint);
  EXPECT_EQ(GetParam().complaint.find('\n'), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(
    Settings, BadSettings,
    testing::Values(
        BadInput{"\nraduis = 1",
                 "my.toml:2: key 'raduis': unknown key; did you mean 'radius'? "
                 "(allowed: exact, experiment, methods, mode, radius, shots, speed, wall)"},
        BadInput{"[wall]\nthicknes = 1",
                 "my.toml:2: key 'wall.thicknes': unknown key; did you mean 'thickness'? (allowed: thickness)"},
        BadInput{"wall = 3", "my.toml:1: key 'wall': 3 is not allowed; a table"},
        BadInput{"[radius]\nx = 1", "my.toml:1: key 'radius': a table is not allowed; a number >= 0 [m]"},
        BadInput{"radius = -1", "my.toml:1: key 'radius': -1 is not allowed; a number >= 0 [m]"},
        BadInput{"radius = nan", "my.toml:1: key 'radius': nan is not allowed; a number >= 0 [m]"},
        BadInput{"radius = \"big\"", "my.toml:1: key 'radius': 'big' is not allowed; a number >= 0 [m]"},
        BadInput{"radius = [1]", "my.toml:1: key 'radius': [1] is not allowed; a number >= 0 [m]"},
        BadInput{"radius = 1979-05-27", "my.toml:1: key 'radius': a date or time is not allowed; a number >= 0 [m]"},
        BadInput{"speed = [\n 1,\n 0]", "my.toml:3: key 'speed': 0 is not allowed; a list of numbers > 0 [m/s]"},
        BadInput{"speed = [inf]", "my.toml:1: key 'speed': inf is not allowed; a list of numbers > 0 [m/s]"},
        BadInput{"speed = [true]", "my.toml:1: key 'speed': true is not allowed; a list of numbers > 0 [m/s]"},
        BadInput{"speed = []", "my.toml:1: key 'speed': an empty list is not allowed; a list of numbers > 0 [m/s]"},
        BadInput{"speed = 1", "my.toml:1: key 'speed': 1 is not a list; put it in brackets"},
        BadInput{"speed = -1", "my.toml:1: key 'speed': -1 is not a list; a list of numbers > 0 [m/s]"},
        BadInput{"speed = [1, 1.0]", "my.toml:1: key 'speed': 1 stands twice; every value once"},
        BadInput{"shots = 0", "my.toml:1: key 'shots': 0 is not allowed; a whole number from 1 to 5000"},
        BadInput{"shots = 1.5", "my.toml:1: key 'shots': 1.5 is not allowed; a whole number from 1 to 5000"},
        BadInput{"exact = 1", "my.toml:1: key 'exact': 1 is not allowed; true or false"},
        BadInput{"mode = \"fats\"",
                 "my.toml:1: key 'mode': 'fats' is not allowed; did you mean 'fast'? (allowed: fast, slow)"},
        BadInput{"mode = 7", "my.toml:1: key 'mode': 7 is not allowed; allowed: fast, slow"},
        BadInput{"methods = [\"closed_from\"]",
                 "my.toml:1: key 'methods': 'closed_from' is not allowed; "
                 "did you mean 'closed_form'? (allowed: ray, sweep, closed_form)"},
        BadInput{"methods = [\"ray\", \"ray\"]", "my.toml:1: key 'methods': 'ray' stands twice; every value once"},
        BadInput{"mode = \"a\\u001b[31m\"",
                 "my.toml:1: key 'mode': 'a\\x1b[31m' is not allowed; allowed: fast, slow"}));

TEST(Settings, name_the_place_of_broken_toml) {
  EXPECT_TRUE(complaint("radius = 1\nradius = 2").starts_with("my.toml:2: not TOML, at column "));
  EXPECT_TRUE(complaint("x = [1,\n2").starts_with("my.toml:2: not TOML, at column "));
  EXPECT_TRUE(complaint("\xff").starts_with("my.toml:1: not TOML, at column "));
}

TEST(Settings, let_the_user_override_the_defaults_one_by_one) {
  const Settings settings("radius = 2\nshots = 1e3\nwall.thickness = 3", "my.toml", defaults);
  EXPECT_NO_THROW(read_all(settings));
  EXPECT_EQ(settings.number("radius", {}), 2);
  EXPECT_EQ(settings.integer("shots", 0, 5000), 1000);
  EXPECT_EQ(settings.number("wall.thickness", {}), 3);
  EXPECT_EQ(settings.numbers("speed", {}), (std::vector<double>{1, 10.5}));
  EXPECT_EQ(settings.choices("methods", methods), (std::vector<std::string>{"ray", "sweep"}));
  EXPECT_TRUE(settings.has("mode"));
  EXPECT_FALSE(settings.has("nonsense"));
}

TEST(Settings, resolve_to_the_same_text_however_a_number_is_written) {
  const Settings plain("", "", defaults);
  EXPECT_EQ(plain.resolved_json(),
            R"({"exact":true,"experiment":"toy","methods":["ray","sweep"],"mode":"fast","radius":0.5,"shots":1000,)"
            R"("speed":[1,10.5],"wall":{"thickness":0.1}})");
  const Settings same("shots = 1e3\nspeed = [1.0, 1.05e1]\nwall.thickness = 1e-1", "my.toml", defaults);
  EXPECT_EQ(same.resolved_json(), plain.resolved_json());
  EXPECT_NE(Settings("radius = 0.25", "", defaults).resolved_json(), plain.resolved_json());
}

TEST(Settings, let_an_experiment_complain_of_its_own) {
  const Settings settings("\n\nradius = 2", "my.toml", defaults);
  EXPECT_EQ(error_of<UsageError>([&] { settings.complain("radius", "at most the wall's thickness"); }),
            "my.toml:3: key 'radius': 2 is not allowed; at most the wall's thickness");
}

TEST(Settings, blame_the_users_file_for_what_does_not_go_with_a_default) {
  const Settings settings("\nshots = 3", "my.toml", defaults);
  EXPECT_EQ(error_of<UsageError>([&] { settings.complain("radius", "at most a third of the shots"); }),
            "my.toml:1: key 'radius', left at its default: 0.5 is not allowed; at most a third of the shots");
}

TEST(Settings, take_trials_in_the_range_of_the_key) {
  const Settings settings("shots = 3", "my.toml", defaults);
  EXPECT_EQ(settings.trials("shots", 1, 5000, {}), 3);
  EXPECT_EQ(settings.trials("shots", 1, 5000, 4), 4);
  EXPECT_EQ(error_of<UsageError>([&] { settings.trials("shots", 1, 5000, 5001); }),
            "--trials: 5001 is not allowed; in the place of the key 'shots' a whole number from 1 to 5000");
}

/// A list of the numbers 1, 2, ...
std::string list_of(std::size_t count) {
  std::string text;
  for (std::size_t i = 1; i <= count; ++i) text += std::to_string(i) + ",";
  return "[" + text + "]";
}

TEST(Settings, limit_the_cells_that_lists_make) {
  const Settings settings("\nspeed = " + list_of(2000), "my.toml", defaults);
  EXPECT_NO_THROW(settings.limit_cells({"speed", "methods"}, 250));
  EXPECT_NO_THROW(settings.limit_cells({"speed", "radius"}));  // which is no list: that is for another complaint
  const auto complaint_of = [&](auto... arguments) {
    return error_of<UsageError>([&] { settings.limit_cells(arguments...); });
  };
  using Lists = std::initializer_list<std::string_view>;
  EXPECT_EQ(
      complaint_of(Lists{"methods", "speed"}, 251U),
      "my.toml:2: key 'speed': methods (2) x speed (2,000) x 251 for each make 1,004,000 cells; at most 1,000,000");
  const std::string many = complaint_of(Lists{"speed", "speed", "speed", "speed", "speed", "speed"});  // 2^64 is 1.8e19
  EXPECT_TRUE(holds(many, "make 6.4e+19 cells"));
}

TEST(Settings, take_no_more_values_than_there_may_be_cells) {
  EXPECT_EQ(complaint("speed = " + list_of(most_cells + 1)),
            "my.toml:1: key 'speed': 1,000,001 values; at most 1,000,000");
}

/// The parser's own tables would be as deep, and nobody could walk or free them.
TEST(Settings, refuse_a_key_of_many_parts) {
  std::string key = "a";
  for (int i = 0; i < 40000; ++i) key += ".a";
  const std::string refusal = "a key of more than 16 parts, which no configuration has";
  EXPECT_EQ(complaint("\n" + key + " = 1"), "my.toml:2: " + refusal);
  EXPECT_EQ(complaint("[" + key + "]"), "my.toml:1: " + refusal);
  EXPECT_EQ(complaint("wall = { \"it's\" . " + key + " = 1 }"), "my.toml:1: " + refusal);
  EXPECT_EQ(complaint("mode = [\"\"\"\na\"\"\"\"\", {" + key + " = 1}]"), "my.toml:2: " + refusal);
  EXPECT_FALSE(holds(complaint("mode = '" + key + "'"), refusal));
  EXPECT_FALSE(holds(complaint("mode = \"\\\"" + key + "\""), refusal));
  EXPECT_FALSE(holds(complaint("mode = '''" + key + "''' # it's " + key), refusal));
  EXPECT_TRUE(complaint("mode = " + std::string(40000, '[')).starts_with("my.toml:1: not TOML, at column "));
}

}  // namespace
}  // namespace thinwall
