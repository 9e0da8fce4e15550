#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/lab/text.hpp>

namespace thinwall {

namespace {

TEST(ExactText, is_the_shortest_that_reads_back) {
  EXPECT_EQ(exact_text(0.1), "0.1");
  EXPECT_EQ(exact_text(1.0 / 3), "0.3333333333333333");
  EXPECT_EQ(exact_text(1e6), "1000000");
  EXPECT_EQ(exact_text(1e22), "1e+22");
  EXPECT_EQ(exact_text(-0.0), "0");
  EXPECT_EQ(exact_text(5e-324), "5e-324");
  EXPECT_EQ(exact_text(std::nan("")), "nan");
  EXPECT_EQ(exact_text(-std::numeric_limits<double>::infinity()), "-inf");
}

RC_GTEST_PROP(ExactText, reads_back_as_the_same_number, (double value)) {
  RC_ASSERT(std::stod(exact_text(value)) == value);
}

TEST(RoundedText, keeps_the_digits_asked_for) {
  EXPECT_EQ(rounded_text(0.123456, 4), "0.1235");
  EXPECT_EQ(rounded_text(1234567, 4), "1235000");
  EXPECT_EQ(rounded_text(1.2345e-7, 2), "1.2e-07");
  EXPECT_EQ(rounded_text(0, 4), "0");
}

TEST(PercentText, is_a_share_to_a_tenth_and_a_dash_where_there_is_none) {
  EXPECT_EQ(percent_text(0.8576), "85.8 %");
  EXPECT_EQ(percent_text(std::nullopt), "-");
  EXPECT_EQ(spaced("long_double"), "long double");
}

TEST(GroupedText, sets_thousands_apart) {
  EXPECT_EQ(grouped_text(0), "0");
  EXPECT_EQ(grouped_text(999), "999");
  EXPECT_EQ(grouped_text(-1000), "-1,000");
  EXPECT_EQ(grouped_text(12000000), "12,000,000");
}

TEST(DurationText, is_what_a_person_says) {
  EXPECT_EQ(duration_text(0.412), "0.4 s");
  EXPECT_EQ(duration_text(3.44), "3.4 s");
  EXPECT_EQ(duration_text(59.4), "59 s");
  EXPECT_EQ(duration_text(200), "3 min 20 s");
  EXPECT_EQ(duration_text(7500), "2 h 5 min");
}

TEST(ParseCount, takes_whole_numbers_however_written) {
  EXPECT_EQ(parse_count("12"), 12);
  EXPECT_EQ(parse_count("1e6"), 1000000);
  EXPECT_EQ(parse_count("-3"), -3);
  for (const char* bad : {"", "1.5", "12x", "nan", "inf", "1e300", " 1"}) EXPECT_FALSE(parse_count(bad)) << bad;
}

TEST(EditDistance, counts_inserted_deleted_replaced_and_swapped_letters) {
  EXPECT_EQ(edit_distance("radius", "radius"), 0u);
  EXPECT_EQ(edit_distance("Radius", "radius"), 0u);
  EXPECT_EQ(edit_distance("raduis", "radius"), 1u);
  EXPECT_EQ(edit_distance("adius", "radius"), 1u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
}

TEST(SpellingHint, names_the_nearest_and_all) {
  const std::vector<std::string_view> names = {"angle", "radius"};
  EXPECT_EQ(spelling_hint("raduis", names), "did you mean 'radius'? (allowed: angle, radius)");
  EXPECT_EQ(spelling_hint("frequency", names), "allowed: angle, radius");
  EXPECT_EQ(spelling_hint("", names), "allowed: angle, radius");
}

TEST(RangeText, says_what_is_allowed) {
  EXPECT_EQ(range_text("numbers", {}), "numbers");
  EXPECT_EQ(range_text("numbers", {.lower = 0, .lower_open = true, .unit = "s"}), "numbers > 0 [s]");
  EXPECT_EQ(range_text("a number", {.lower = 0, .upper = 90, .upper_open = true}), "a number >= 0 and < 90");
}

TEST(RangeContains, refuses_what_is_no_number) {
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
}

TEST(ShellLine, splits_into_the_same_words) {
  EXPECT_EQ(shell_line({"run", "a b", "it's", "", "x=1"}), "run 'a b' 'it'\\''s' '' x=1");
}

RC_GTEST_PROP(GnuplotQuoted, gives_the_text_back, (const std::string& text)) {
  RC_ASSERT(gnuplot_unquoted("title " + gnuplot_quoted(text) + " with 'b'") == one_line(text));
}

TEST(GnuplotQuoted, leaves_no_quote_within) {
  EXPECT_EQ(gnuplot_quoted("a \"b\" \\ `c`"), "'a \"b\" \\ `c`'");
  EXPECT_EQ(gnuplot_quoted("it's \"b\" \\ `c`"), "\"it\\047s \\042b\\042 \\134 \\140c\\140\"");
  EXPECT_EQ(gnuplot_unquoted("'it''s' 'b'"), "it's") << "as older scripts have it";
}

RC_GTEST_PROP(TsvEscape, gives_the_text_back_and_hides_what_separates, (const std::string& text)) {
  const std::string escaped = tsv_escaped(text);
  RC_ASSERT(escaped.find_first_of("\t\n\r") == std::string::npos);
  RC_ASSERT(tsv_unescaped(escaped) == text);
}

std::string shown(double value, double lower, double upper) {
  const IntervalText text = interval_text(value, lower, upper);
  return text.value + " [" + text.lower + ", " + text.upper + "]";
}

TEST(IntervalText, shows_the_digits_that_the_interval_supports) {
  EXPECT_EQ(shown(0.28723, 0.28591, 0.28851), "0.2872 [0.2859, 0.2885]");  // +- 0.0013: two digits of it
  EXPECT_EQ(shown(0.28723, 0.2812, 0.2932), "0.287 [0.281, 0.293]");       // +- 0.006: one
  EXPECT_EQ(shown(0.70263, 0.6925, 0.7125), "0.703 [0.693, 0.713]");
  EXPECT_EQ(shown(12345, 11543, 13147), "12300 [11500, 13100]");
  EXPECT_EQ(shown(-1.25, -1.4, -1.1), "-1.25 [-1.40, -1.10]") << "a supported zero is shown";
}

TEST(IntervalText, leaves_whole_numbers_whole) {
  EXPECT_EQ(shown(0, 0, 0.00048), "0 [0, 0.00048]");
  EXPECT_EQ(shown(1, 0.99952, 1), "1 [0.99952, 1]");
}

TEST(IntervalText, has_exponents_for_the_very_small_and_the_very_large) {
  EXPECT_EQ(shown(0, 0, 1.84e-5), "0 [0, 1.8e-05]");
  EXPECT_EQ(shown(1.2345e-6, 1.1e-6, 1.4e-6), "1.23e-06 [1.10e-06, 1.40e-06]");
  EXPECT_EQ(shown(1.2345e9, 1.1e9, 1.4e9), "1.23e+09 [1.10e+09, 1.40e+09]");
}

TEST(IntervalText, shows_four_digits_where_the_interval_has_no_width) {
  EXPECT_EQ(shown(0.123456, 0.123456, 0.123456), "0.1235 [0.1235, 0.1235]");
}

}  // namespace

}  // namespace thinwall
