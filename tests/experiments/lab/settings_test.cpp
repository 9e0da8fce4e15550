/// What a configuration may say and what it is told; and the texts of numbers, ranges and names, which are escaped where they stand.

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <nlohmann/json.hpp>

#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/lab/text.hpp>

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

TEST(Settings, are_refused_by_name_in_one_line) {
  const std::pair<const char*, const char*> bad[] = {
      {"\nraduis = 1",
       "my.toml:2: key 'raduis': unknown key; did you mean 'radius'? "
       "(allowed: exact, experiment, methods, mode, radius, shots, speed, wall)"},
      {"[wall]\nthicknes = 1",
       "my.toml:2: key 'wall.thicknes': unknown key; did you mean 'thickness'? (allowed: thickness)"},
      {"wall = 3", "my.toml:1: key 'wall': 3 is not allowed; a table"},
      {"[radius]\nx = 1", "my.toml:1: key 'radius': a table is not allowed; a number >= 0 [m]"},
      {"radius = -1", "my.toml:1: key 'radius': -1 is not allowed; a number >= 0 [m]"},
      {"radius = nan", "my.toml:1: key 'radius': nan is not allowed; a number >= 0 [m]"},
      {"radius = \"big\"", "my.toml:1: key 'radius': 'big' is not allowed; a number >= 0 [m]"},
      {"radius = [inf, 0]", "my.toml:1: key 'radius': [inf,0] is not allowed; a number >= 0 [m]"},
      {"radius = [1]", "my.toml:1: key 'radius': [1] is a list; leave the brackets out"},
      {"radius = 1979-05-27", "my.toml:1: key 'radius': a date or time is not allowed; a number >= 0 [m]"},
      {"speed = [\n 1,\n 0]", "my.toml:3: key 'speed': 0 is not allowed; a list of numbers > 0 [m/s]"},
      {"speed = [inf]", "my.toml:1: key 'speed': inf is not allowed; a list of numbers > 0 [m/s]"},
      {"speed = [true]", "my.toml:1: key 'speed': true is not allowed; a list of numbers > 0 [m/s]"},
      {"speed = []", "my.toml:1: key 'speed': an empty list is not allowed; a list of numbers > 0 [m/s]"},
      {"speed = 1", "my.toml:1: key 'speed': 1 is not a list; put it in brackets"},
      {"speed = -1", "my.toml:1: key 'speed': -1 is not a list; a list of numbers > 0 [m/s]"},
      {"speed = [1, 1.0]", "my.toml:1: key 'speed': 1 stands twice; every value once"},
      {"shots = 0", "my.toml:1: key 'shots': 0 is not allowed; a whole number from 1 to 5000"},
      {"shots = 5001", "my.toml:1: key 'shots': 5001 is not allowed; a whole number from 1 to 5000"},
      {"shots = 1.5", "my.toml:1: key 'shots': 1.5 is not allowed; a whole number from 1 to 5000"},
      {"exact = 1", "my.toml:1: key 'exact': 1 is not allowed; true or false"},
      {"mode = \"fats\"", "my.toml:1: key 'mode': 'fats' is not allowed; did you mean 'fast'? (allowed: fast, slow)"},
      {"mode = 7", "my.toml:1: key 'mode': 7 is not allowed; allowed: fast, slow"},
      {"methods = [\"closed_from\"]",
       "my.toml:1: key 'methods': 'closed_from' is not allowed; "
       "did you mean 'closed_form'? (allowed: ray, sweep, closed_form)"},
      {"methods = [\"ray\", \"ray\"]", "my.toml:1: key 'methods': 'ray' stands twice; every value once"},
      {"mode = \"a\\u001b[31m\"", "my.toml:1: key 'mode': 'a\\x1b[31m' is not allowed; allowed: fast, slow"}};
  for (const auto& [text, said] : bad) {
    EXPECT_EQ(complaint(text), said);
    EXPECT_EQ(complaint(text).find('\n'), std::string::npos);
  }
}

TEST(Settings, name_the_place_of_broken_toml) {
  EXPECT_TRUE(complaint("radius = 1\nradius = 2").starts_with("my.toml:2: not TOML, at column "));
  EXPECT_TRUE(complaint("x = [1,\n2").starts_with("my.toml:2: not TOML, at column "));
  EXPECT_TRUE(complaint("\xff").starts_with("my.toml:1: not TOML, at column "));
}

TEST(Settings, keep_whole_numbers_that_no_integer_holds) {
  for (double number = 0x1p53; number <= 1e22; number = 1.37 * number + 2) {
    const std::string text = exact_text(number);
    const Settings settings("x = " + text, "my.toml", "x = 0");
    EXPECT_EQ(settings.number("x", {}), number);
    EXPECT_EQ(settings.resolved_json(), "{\"x\":" + text + "}");
    EXPECT_TRUE(nlohmann::json::parse(text).is_number_float()) << text;
    EXPECT_EQ(nlohmann::json::parse(text).get<double>(), number);
  }
  EXPECT_EQ(Settings("x = 100000000000000001", "my.toml", "x = 0").number("x", {}), 1e17);
}

TEST(Settings, let_the_user_override_the_defaults_one_by_one) {
  const Settings settings("radius = 2\nshots = 1e3\nwall.thickness = 3", "my.toml", defaults);
  EXPECT_NO_THROW(read_all(settings));
  EXPECT_EQ(settings.number("radius", {}), 2);
  EXPECT_EQ(settings.integer("shots", 1000, 1000), 1000);
  EXPECT_EQ(settings.number("wall.thickness", {}), 3);
  EXPECT_EQ(settings.numbers("speed", {}), (std::vector<double>{1, 10.5}));
  EXPECT_EQ(settings.choices("methods", methods), (std::vector<std::string>{"ray", "sweep"}));
  EXPECT_FALSE(std::signbit(Settings("radius = -0.0", "my.toml", defaults).number("radius", {})));
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
  EXPECT_EQ(Settings("[wall]\nb = 3", "", "[wall]\na = 1\nb = 2").resolved_json(), R"({"wall":{"a":1,"b":3}})");
}

TEST(Settings, let_an_experiment_complain_of_its_own_and_blame_the_users_file_for_a_default) {
  const auto complaint_about = [](const char* text) {
    return error_of<UsageError>([&] { Settings(text, "my.toml", defaults).complain("radius", "at most so much"); });
  };
  EXPECT_EQ(complaint_about("\n\nradius = 2"), "my.toml:3: key 'radius': 2 is not allowed; at most so much");
  EXPECT_EQ(complaint_about("\nshots = 3"),
            "my.toml:1: key 'radius', left at its default: 0.5 is not allowed; at most so much");
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
  const auto complaint_of = [&](const std::vector<std::string_view>& lists, std::size_t each) {
    return error_of<UsageError>([&] { settings.limit_cells(lists, each); });
  };
  EXPECT_EQ(complaint_of({"speed", "methods"}, 250), "");
  EXPECT_EQ(complaint_of({"speed", "radius"}, 1), "");  // which is no list: that is for another complaint
  EXPECT_EQ(
      complaint_of({"methods", "speed"}, 251),
      "my.toml:2: key 'speed': methods (2) x speed (2,000) x 251 for each make 1,004,000 cells; at most 1,000,000");
  const std::vector<std::string_view> six(6, "speed");  // 2^64 is 1.8e19
  EXPECT_TRUE(holds(complaint_of(six, 1), "make 6.4e+19 cells"));
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

// ---- The texts of numbers, ranges and names.

TEST(Text, of_numbers_is_exact_for_files_and_rounded_for_readers) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(exact_text(0.1), "0.1");
  EXPECT_EQ(exact_text(1.0 / 3), "0.3333333333333333");
  EXPECT_EQ(exact_text(1e6), "1000000");
  EXPECT_EQ(exact_text(1e22), "1e+22");
  EXPECT_EQ(exact_text(-0.0), "0");
  EXPECT_EQ(exact_text(5e-324), "5e-324");
  EXPECT_EQ(exact_text(std::nan("")), "nan");
  EXPECT_EQ(exact_text(-infinity), "-inf");
  EXPECT_EQ(rounded_text(0.123456, 4), "0.1235");
  EXPECT_EQ(rounded_text(1234567, 4), "1235000");
  EXPECT_EQ(rounded_text(1.2345e-7, 2), "1.2e-07");
  EXPECT_EQ(rounded_text(0, 4), "0");
  EXPECT_EQ(grouped_text(0), "0");
  EXPECT_EQ(grouped_text(999), "999");
  EXPECT_EQ(grouped_text(-1000), "-1,000");
  EXPECT_EQ(grouped_text(-100), "-100");
  EXPECT_EQ(grouped_text(12000000), "12,000,000");
  EXPECT_EQ(percent_text(0.8576), "85.8 %");
  EXPECT_EQ(percent_text(std::nullopt), "-");
  EXPECT_EQ(spaced("long_double"), "long double");
  EXPECT_EQ(duration_text(0.412), "0.4 s");
  EXPECT_EQ(duration_text(3.44), "3.4 s");
  EXPECT_EQ(duration_text(59.4), "59 s");
  EXPECT_EQ(duration_text(200), "3 min 20 s");
  EXPECT_EQ(duration_text(7500), "2 h 5 min");
}

RC_GTEST_PROP(Text, reads_back_as_the_same_number, (double value)) { RC_ASSERT(std::stod(exact_text(value)) == value); }

TEST(Text, of_a_count_is_taken_however_written) {
  EXPECT_EQ(parse_count("12"), 12);
  EXPECT_EQ(parse_count("1e6"), 1000000);
  EXPECT_EQ(parse_count("-3"), -3);
  for (const char* bad : {"", "1.5", "12x", "nan", "inf", "1e300", " 1", "9007199254740993.0"})
    EXPECT_FALSE(parse_count(bad)) << bad;
}

TEST(Text, of_a_mistyped_word_names_the_nearest_and_all) {
  EXPECT_EQ(edit_distance("radius", "radius"), 0u);
  EXPECT_EQ(edit_distance("Radius", "radius"), 0u);
  EXPECT_EQ(edit_distance("raduis", "radius"), 1u);
  EXPECT_EQ(edit_distance("adius", "radius"), 1u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  const std::vector<std::string_view> names = {"angle", "radius"};
  EXPECT_EQ(spelling_hint("raduis", names), "did you mean 'radius'? (allowed: angle, radius)");
  EXPECT_EQ(spelling_hint("frequency", names), "allowed: angle, radius");
  EXPECT_EQ(spelling_hint("", names), "allowed: angle, radius");
  EXPECT_EQ(spelling_hint("--bogus", std::vector<std::string_view>{"--out"}), "allowed: --out")
      << "dashes are not letters";
  EXPECT_EQ(spelling_hint("x", std::vector<std::string_view>{"a"}), "allowed: a") << "no letter is right";
}

TEST(Text, of_a_range_says_what_is_allowed_and_contains_refuses_what_is_no_number) {
  EXPECT_EQ(range_text("numbers", {}), "numbers");
  EXPECT_EQ(range_text("numbers", {.lower = 0, .lower_open = true, .unit = "s"}), "numbers > 0 [s]");
  EXPECT_EQ(range_text("a number", {.lower = 0, .upper = 90, .upper_open = true}), "a number >= 0 and < 90");
  EXPECT_TRUE(contains({.lower = 0}, 0));
  EXPECT_FALSE(contains({.lower = 0, .lower_open = true}, 0));
  EXPECT_FALSE(contains({.upper = 1, .upper_open = true}, 1));
  EXPECT_FALSE(contains({}, std::nan("")));
  EXPECT_FALSE(contains({}, std::numeric_limits<double>::infinity()));
}

TEST(Escape, leaves_nothing_that_the_place_would_read) {
  EXPECT_EQ(one_line("a\nb\x1b[31m"), "a\\x0ab\\x1b[31m");
  EXPECT_EQ(one_line("\u00b5 \U0001f3b1 \uac00"), "\u00b5 \U0001f3b1 \uac00");
  EXPECT_EQ(one_line("\xc2\x9b|\xef\xbf\xbe|\xef\xbf\xbf|\xef\xbf\xbd"),
            "\\xc2\\x9b|\\xef\\xbf\\xbe|\\xef\\xbf\\xbf|\xef\xbf\xbd");
  EXPECT_EQ(one_line("\xff|\xc0\xaf|\xed\xa0\x80|\xf4\x90\x80\x80"),
            "\\xff|\\xc0\\xaf|\\xed\\xa0\\x80|\\xf4\\x90\\x80\\x80")
      << "no UTF-8, too long, a surrogate, beyond the last";
  EXPECT_EQ(one_line("\xe2\x82"), "\\xe2\\x82") << "half a letter";
  EXPECT_EQ(json_string("a\"b\\\n"), "\"a\\\"b\\\\\\u000a\"");
  EXPECT_EQ(html_escaped("<a href=\"x\">&'"), "&lt;a href=&quot;x&quot;&gt;&amp;&#39;");
  EXPECT_EQ(latex_escaped("50 % of a_b & {c}^2"), "50 \\% of a\\_b \\& \\{c\\}\\textasciicircum{}2");
  EXPECT_EQ(markdown_escaped("a|b*c\nd"), "a\\|b\\*c d");
  EXPECT_EQ(clipped("abc", 3), "abc");
  EXPECT_EQ(clipped("a\u00e9b", 2), "a...");
  EXPECT_EQ(shell_line({"run", "a b", "it's", "", "x=1"}), "run 'a b' 'it'\\''s' '' x=1");
}

RC_GTEST_PROP(Escape, of_gnuplot_gives_the_text_back, (const std::string& text)) {
  RC_ASSERT(gnuplot_unquoted("title " + gnuplot_quoted(text) + " with 'b'") == one_line(text));
}

TEST(Escape, of_gnuplot_leaves_no_quote_within) {
  EXPECT_EQ(gnuplot_quoted("a \"b\" \\ `c`"), "'a \"b\" \\ `c`'");
  EXPECT_EQ(gnuplot_quoted("it's \"b\" \\ `c`"), "\"it\\047s \\042b\\042 \\134 \\140c\\140\"");
  EXPECT_EQ(gnuplot_unquoted("'it''s' 'b'"), "it's") << "as older scripts have it";
}

RC_GTEST_PROP(Escape, of_tsv_gives_the_text_back_and_hides_what_separates, (const std::string& text)) {
  const std::string escaped = tsv_escaped(text);
  RC_ASSERT(escaped.find_first_of("\t\n\r") == std::string::npos);
  RC_ASSERT(tsv_unescaped(escaped) == text);
}

std::string shown(double value, double lower, double upper) {
  const IntervalText text = interval_text(value, lower, upper);
  return text.value + " [" + text.lower + ", " + text.upper + "]";
}

TEST(Text, of_an_interval_shows_the_digits_that_it_supports) {
  EXPECT_EQ(shown(0.28723, 0.28591, 0.28851), "0.2872 [0.2859, 0.2885]");  // +- 0.0013: two digits of it
  EXPECT_EQ(shown(0.28723, 0.2812, 0.2932), "0.287 [0.281, 0.293]");       // +- 0.006: one
  EXPECT_EQ(shown(0.70263, 0.6925, 0.7125), "0.703 [0.693, 0.713]");
  EXPECT_EQ(shown(12345, 11543, 13147), "12300 [11500, 13100]");
  EXPECT_EQ(shown(-1.25, -1.4, -1.1), "-1.25 [-1.40, -1.10]");  // a supported zero is shown
  EXPECT_EQ(shown(2.147, 1.995, 4523), "2.1 [2, 4500]");        // what is not 0 is not shown as 0
  EXPECT_EQ(shown(-3.2, -900, -0.04), "-3.2 [-900, -0.04]");
  EXPECT_EQ(shown(0.5, 1e-70, 1), "0.5 [1e-70, 1]");
  EXPECT_EQ(shown(0, 0, 0.00048), "0 [0, 0.00048]");  // whole numbers stay whole
  EXPECT_EQ(shown(1, 0.99952, 1), "1 [0.99952, 1]");
  EXPECT_EQ(shown(0, 0, 1.84e-5), "0 [0, 1.8e-05]");  // exponents for the very small and the very large
  EXPECT_EQ(shown(1.2345e-6, 1.1e-6, 1.4e-6), "1.23e-06 [1.10e-06, 1.40e-06]");
  EXPECT_EQ(shown(1.2345e9, 1.1e9, 1.4e9), "1.23e+09 [1.10e+09, 1.40e+09]");
  EXPECT_EQ(shown(0.123456, 0.123456, 0.123456), "0.1235 [0.1235, 0.1235]");  // no width: four digits
}

}  // namespace
}  // namespace thinwall
