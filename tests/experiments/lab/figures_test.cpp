#include <cmath>
#include <cstdlib>
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include <thinwall/experiments/check/check.hpp>
#include <thinwall/experiments/check/readers.hpp>
#include <thinwall/experiments/lab/draw.hpp>
#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/gnuplot.hpp>

#include "support/program.hpp"
#include "support/said.hpp"

namespace thinwall {

namespace {

Figure two_panels() {
  const double gap = std::numeric_limits<double>::quiet_NaN();
  const Series theory{
      .label = "theory", .mark = Mark::line, .x = {1, 10, 100}, .y = {0, gap, 1}, .lower = {}, .upper = {}};
  const Series points{
      .label = "it's_@{a}", .mark = Mark::points, .x = {1, 10}, .y = {0, 0.5}, .lower = {0, 0.4}, .upper = {0.1, 0.6}};
  Series residuals = points;
  residuals.lower.clear();
  residuals.upper.clear();
  return {.name = "probability",
          .title = "Seen",
          .caption = "Meant.",
          .panels = {{"x [1]", "p [1]", true, false, 1, {theory, points}},
                     {"x [1]", "r [1]", true, false, 0.4, {residuals}}}};
}

struct DrawnPlot : ::testing::Test {
  TemporaryFolder folder;

  void SetUp() override {
    if (!gnuplot_is_there()) GTEST_SKIP() << "gnuplot is not installed";
  }
  void expect_drawn(const Figure& figure, const std::string& format = "svg") const {
    write_text(folder / (figure.name + ".gp"), plot_script(figure));
    write_text(folder / (figure.name + ".dat"), plot_data(figure));
    ASSERT_EQ(draw(folder.path(), figure.name, format), "") << format;
  }
};

TEST_F(DrawnPlot, is_drawn_the_same_every_time_and_again_by_a_reader) {
  expect_drawn(two_panels());
  const std::string first = read_text(folder / "probability.svg");
  ASSERT_EQ(std::system(("cd " + folder.path().string() + " && gnuplot probability.gp").c_str()), 0);
  EXPECT_EQ(read_text(folder / "probability.svg"), first);
  for (const char* text : {"Seen", "x [1]", "p [1]", "r [1]", "it&#39;s_@{a}", "it's_@{a}"}) {
    if (first.find(text) != std::string::npos) continue;
    EXPECT_STREQ(text, "it&#39;s_@{a}") << "not in the figure";  // either spelling of the quote is right
  }
}

/// A name is the user's, and stands in the script, the legend, at the tics and as the title.
TEST_F(DrawnPlot, no_name_breaks_a_figure) {
  for (const std::string name :
       {"'",    "''",     "'a",       "a''b",         "it's",         "\"",   "a\"b",  "'\"'\"", "a\\",
        "\\'",  "\\047'", "'`date`'", "'@small'",     "a{b}_c^d",     "#",    "%g",    "$1",     "a, b; c",
        "a\nb", "]]>",    "']]>]]>'", "<b>&amp;</b>", "\xef\xbf\xbe", "\xff", "\u00b5"}) {
    Figure figure = two_panels();
    figure.title = figure.panels[0].series[0].label = name;
    figure.panels[0].y_tics = {{0, name}, {1, "one"}};
    SCOPED_TRACE(name);
    expect_drawn(figure);
    const std::string svg = read_text(folder / "probability.svg");
    EXPECT_EQ(xml_fault(svg), "") << name;
    std::string shown = one_line(name);
    for (auto at = shown.find("]]>"); at != std::string::npos; at = shown.find("]]>")) shown.insert(at + 2, " ");
    EXPECT_TRUE(holds(html_unescaped(svg), ">" + shown + "<")) << name;
    EXPECT_EQ(title_of_script(plot_script(figure)), shown) << "what a check looks for";
  }
}

TEST_F(DrawnPlot, says_what_gnuplot_minds) {
  write_text(folder / "broken.gp", "set nonsense\n");
  const std::string trouble = draw(folder.path(), "broken");
  EXPECT_TRUE(trouble.starts_with("gnuplot ended with 1: ")) << trouble;
  EXPECT_EQ(trouble.find('\n'), std::string::npos);
}

TEST(Plot, data_are_a_block_a_series) {
  EXPECT_EQ(plot_data(two_panels()),
            "# panel 1, theory: x y\n1 0\n10 NaN\n100 1\n\n\n"
            "# panel 1, it's_@{a}: x y lower upper\n1 0 0 0.1\n10 0.5 0.4 0.6\n\n\n"
            "# panel 2, it's_@{a}: x y\n1 0\n10 0.5\n\n\n");
}

TEST(Plot, bars_may_lie_along_both_axes) {
  Figure figure = two_panels();
  Series& points = figure.panels[0].series[1];
  points.x_lower = {0.5, 9};
  points.x_upper = {1, 200};
  EXPECT_TRUE(holds(plot_data(figure), "x y lower upper x_lower x_upper\n1 0 0 0.1 0.5 1\n10 0.5 0.4 0.6 9 200\n"));
  EXPECT_TRUE(holds(plot_script(figure), "using 5:2:($6-$5):(0) with vectors"));
  points.x_upper.pop_back();
  EXPECT_THROW(plot_script(figure), std::logic_error);
}

TEST_F(DrawnPlot, cells_stand_between_names) {
  Figure figure;
  figure.name = "heat";
  Series cells{.label = "much", .mark = Mark::cells, .x = {1, 2}, .y = {1, 1}, .lower = {}, .upper = {}};
  cells.color = "#123456";
  Panel panel{"x", "y", false, false, 0.5, {cells}};
  panel.x_tics = {{1, "ten_thousand"}, {2, "more"}};
  panel.y_tics = {{1, "a rather long name of a row"}};
  panel.x_groups = {{1.5, "group"}};
  figure.panels = {panel};
  const std::string script = plot_script(figure);
  EXPECT_TRUE(holds(script, "linecolor rgb '#123456'"));
  EXPECT_TRUE(holds(script, "with boxxyerror"));
  EXPECT_TRUE(holds(script, "set xrange [0.4:2.6]"));
  expect_drawn(figure);
  const std::string svg = read_text(folder / "heat.svg");
  for (const char* text : {"ten_thousand", "a rather long name of a row", "group", "much"}) {
    EXPECT_TRUE(holds(svg, text));
  }
}

TEST_F(DrawnPlot, is_drawn_in_every_format_from_one_script) {
  for (const char* format : {"svg", "pdf", "tex"}) {
    expect_drawn(two_panels(), format);
    for (const std::string& file : drawn_files("probability", format))
      EXPECT_FALSE(read_text(folder / file).empty()) << file;
  }
  EXPECT_TRUE(holds(read_text(folder / "probability-latex.tex"), "it's\\_@\\{a\\}")) << "as LaTeX wants it";
  EXPECT_TRUE(holds(read_text(folder / "probability.svg"), "_@{a}")) << "as it is";
}

TEST(Plot, refuses_what_cannot_be_drawn) {
  Figure figure = two_panels();
  figure.name = "../up";
  EXPECT_THROW(plot_script(figure), std::logic_error);
  figure = two_panels();
  figure.panels[0].series[0].y.pop_back();
  EXPECT_THROW(plot_script(figure), std::logic_error);
  figure.panels.clear();
  EXPECT_THROW(plot_script(figure), std::logic_error);
}

TEST(PlotStyle, is_one_look_a_label) {
  Figure figure = two_panels();
  for (const char* label : {"a", "b", "c", "d"}) {
    figure.panels[0].series.push_back(
        {.label = label, .mark = Mark::points, .x = {}, .y = {}, .lower = {}, .upper = {}});
  }
  const auto styles = series_styles(figure);
  ASSERT_EQ(styles.size(), 6u);
  EXPECT_EQ(styles[0].color, "#000000") << "theory is black";
  std::set<std::string> colors;
  std::set<int> points;
  for (const SeriesStyle& style : styles) {
    colors.insert(style.color);
    if (style.has_points) points.insert(style.point_type);
  }
  EXPECT_EQ(colors.size(), 6u);
  EXPECT_EQ(points.size(), 5u) << "told apart without color too";
}

TEST(PlotAxis, shows_every_value_and_skips_what_it_cannot_show) {
  const std::vector<double> values = {0, 1, std::nan(""), 100};
  const DrawnAxis linear = axis_around(values, false);
  EXPECT_LT(linear.lower, 0);
  EXPECT_GT(linear.upper, 100);
  const DrawnAxis log = axis_around(values, true);
  EXPECT_LT(log.lower, 1);
  EXPECT_GT(log.lower, 0.5);
  EXPECT_GT(log.upper, 100);
  EXPECT_LT(axis_around(std::vector<double>{5}, false).lower, 5);
  const std::vector<double> subnormal = {0, 5e-324};
  EXPECT_EQ(axis_around(subnormal, false).upper, 0.5);
  EXPECT_EQ(axis_around(subnormal, true).lower, axis_around(std::vector<double>{}, true).lower);
  EXPECT_LT(axis_around(std::vector<double>{}, true).lower, axis_around(std::vector<double>{}, true).upper);
}

TEST(PlotAxis, has_round_tics) {
  EXPECT_EQ(tics({false, -0.04, 1.04}, 360, 44), "0.2");
  EXPECT_EQ(tics({true, 0.04, 1000}, 640, 80), "1e-2, 1e1") << "from a power of ten on";
  EXPECT_EQ(tics({true, 1e-12, 1}, 640, 80), "1e-12, 1e2");
  EXPECT_EQ(tics({true, 9, 60}, 360, 44), "(10, 20, 50)");
}

TEST(InlineSvg, has_ids_of_its_own) {
  const std::string svg =
      "<?xml version=\"1.0\"?>\n<svg viewBox=\"0 0 1 1\"><title>x</title><path id='p1'/>"
      "<use xlink:href='#p1'/><g id=\"q\" filter=\"url(#q)\"/></svg>";
  EXPECT_EQ(inline_svg(svg, "fig", "A & B"),
            "<svg role=\"img\" aria-label=\"A &amp; B\" viewBox=\"0 0 1 1\"><title>A &amp; B</title><path id='fig_p1'/>"
            "<use xlink:href='#fig_p1'/><g id=\"fig_q\" filter=\"url(#fig_q)\"/></svg>");
}

TEST(Xml, takes_what_every_reader_takes) {
  for (
      const char* good : {
          "<a/>",
          "<?xml version=\"1.0\"?>\n<!DOCTYPE svg>\n<!-- c -->\n<svg a='1' b = \"&lt;&#39;&#x1F600;'\"><x:g-1 /></svg >\n",
          "<a>it's > \"b\" &amp; ]] ]&gt; \u00b5<![CDATA[<&]]></a>",
      }) {
    EXPECT_EQ(xml_fault(good), "") << good;
  }
}

TEST(Xml, names_the_line_and_what_is_wrong) {
  const std::pair<const char*, const char*> cases[] = {
      {"", "no element found"},
      {"<a>\n<b>\n</a>", "line 3, column 3: mismatched tag"},
      {"<a>", "no element found"},
      {"<a/><b/>", "junk after document element"},
      {"<a/>text", "junk after document element"},
      {"<a>\n]]></a>", "line 2, column 3: not well-formed"},
      {"<a>b & c</a>", "not well-formed"},
      {"<a>&nbsp;</a>", "undefined entity"},
      {"<!DOCTYPE a SYSTEM 'there.dtd'><a>&nbsp;</a>", "undefined entity"},
      {"<!DOCTYPE a SYSTEM 'there.dtd'><a b='&nbsp;'/>", "undefined entity"},
      {"<a>&#x;</a>", "not well-formed"},
      {"<a>&#x1F;</a>", "reference to invalid character number"},
      {"<a>&lt</a>", "not well-formed"},
      {"<a b='1' b='2'/>", "duplicate attribute"},
      {"<a b='1'c='2'/>", "not well-formed"},
      {"<a b=1/>", "not well-formed"},
      {"<a b='<'/>", "not well-formed"},
      {"<a b/>", "not well-formed"},
      {"<a><1/></a>", "not well-formed"},
      {"<a><!-- -- --></a>", "not well-formed"},
      {"<a><![CDATA[</a>", "unclosed CDATA section"},
      {"<a>\xef\xbf\xbe</a>", "not well-formed"},
      {"<a>\x1b</a>", "not well-formed"},
      {"<a>\xff</a>", "not well-formed"},
  };
  for (const auto& [text, fault] : cases) {
    EXPECT_TRUE(holds(xml_fault(text), fault)) << text << "\n" << xml_fault(text);
  }
}

}  // namespace

}  // namespace thinwall
