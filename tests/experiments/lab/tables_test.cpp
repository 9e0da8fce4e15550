/// What follows from a declaration: columns, cells of a design, a terminal's table, a panel, a run; and figures as they are drawn.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/experiments/check/check.hpp>
#include <thinwall/experiments/lab/columns.hpp>
#include <thinwall/experiments/lab/draw.hpp>
#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/factors.hpp>
#include <thinwall/experiments/lab/files.hpp>
#include <thinwall/experiments/lab/plot.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/lab/table_text.hpp>
#include <thinwall/experiments/lab/tasks.hpp>
#include <thinwall/experiments/lab/terminal.hpp>

#include "support/program.hpp"
#include "support/reply.hpp"

namespace thinwall {

namespace {

struct Cell {
  double speed = 0, step = 0;
  std::string wall = {};
  bool operator==(const Cell&) const = default;
};

struct Tally {
  std::int64_t shots = 0, tunneled = 0;
  double latest = no_most;
  static constexpr auto fields() {
    return record(sum("shots", &Tally::shots, "1", "Shots fired."), sum("tunneled", &Tally::tunneled, "1", "Unseen."),
                  most("latest", &Tally::latest, "m", "The latest."));
  }
  bool operator==(const Tally&) const = default;
};

struct Row {
  std::string method;
  Cell cell;
  Tally tally;
  std::optional<double> theory = {};
};

constexpr std::array<std::string_view, 2> walls = {"infinite", "finite"};

const Factors<Cell> grid = factors<Cell>(
    numbers("speed", &Cell::speed, {.lower = 0, .upper = 100, .lower_open = true, .unit = "m/s"}, "Of the ball."),
    number("step", &Cell::step, {.lower = 0, .upper = 1, .unit = "s"}, "Time step."),
    choices("wall", &Cell::wall, walls, "Infinite, or a square."));

const char* small_defaults = "speed = [10]\nstep = 0.5\nwall = ['infinite']";

std::vector<Cell> cells(const std::string& text, const std::function<bool(Cell&)>& adjust = {}) {
  return grid.cells(Settings(text, "test.toml", small_defaults), 1, {}, adjust);
}

Columns<Row> columns() {
  return columns_of<Row>(text("method", "Way of detecting.", &Row::method), grid.columns(&Row::cell),
                         fields(&Row::tally),
                         share(
                             "probability", "tunneled / shots.", [](const Row& r) { return r.tally.tunneled; },
                             [](const Row& r) { return r.tally.shots; }),
                         fields(&Row::tally, {"latest"}), value("theory", "1", "By theory.", &Row::theory));
}

const std::vector<Row> rows = {{"closed_form", {10, 0.5, "infinite"}, {100, 0, 0.25}, 0.0},
                               {"end_of_step", {10, 0.5, "infinite"}, {100, 25, no_most}},
                               {"nothing", {20, 0.5, "finite"}, {}}};

TEST(Columns, a_field_stands_where_it_is_named_and_the_others_where_all_are) {
  EXPECT_EQ(csv_text(table("cells", "All.", columns(), rows)),
            "method,speed,step,wall,shots,tunneled,probability,lower,upper,latest,theory\n"
            "closed_form,10,0.5,infinite,100,0,0,0,0.03699349820698568,0.25,0\n"
            "end_of_step,10,0.5,infinite,100,25,0.25,0.17545211362287674,0.34304463548061603,,\n"
            "nothing,20,0.5,finite,0,0,,,,,\n");
}

TEST(Columns, leave_out_what_is_there_only_and_are_empty_where_their_condition_does_not_hold) {
  EXPECT_EQ(columns().without({"shots", "latest"}).all().size(), 9U);
  EXPECT_THROW(columns().without({"shot"}), std::logic_error);
  const auto some = columns_of<Row>(where([](const Row& r) { return r.method == "nothing"; }, fields(&Row::tally)));
  const Table table = thinwall::table("some", "", some, rows);
  EXPECT_EQ(table.rows[0][0], Value());
  EXPECT_EQ(table.rows[2][0], Value(std::int64_t{0}));
}

enum class Paint { red, green };
std::string_view name(Paint paint) { return paint == Paint::red ? "red" : "green"; }

struct Painted {
  Paint paint;
  static constexpr auto fields() { return record(kept("paint", &Painted::paint, "", "Of the ball.")); }
};

TEST(Columns, spell_an_enumeration_by_its_name) {
  EXPECT_EQ(csv_text(table("painted", "", columns_of<Painted>(fields(std::identity())), {{Paint::green}})),
            "paint\ngreen\n");
}

TEST(Factors, make_every_combination_the_last_the_fastest) {
  const auto all = cells("speed = [1, 2]\nwall = ['finite', 'infinite']");
  ASSERT_EQ(all.size(), 4U);
  EXPECT_EQ(grid.key(all[1]), "speed 1 step 0.5 wall infinite");
  EXPECT_EQ(all[2].speed, 2);
}

TEST(Factors, what_is_adjusted_to_be_like_an_earlier_cell_is_left_out) {
  EXPECT_EQ(cells("speed = [1, 2, 3]",
                  [](Cell& c) {
                    if (c.speed == 2) c.speed = 1;
                    return c.speed < 3;
                  })
                .size(),
            1U);
}

TEST(Factors, draw_from_their_numbers_alone) {
  const Cell cell = {10, 0.5, "finite"}, other = {10, 0.5, "infinite"}, third = {11, 0.5, "finite"};
  EXPECT_EQ(grid.stream(cell, 7).stream, grid.stream(other, 7).stream);
  EXPECT_NE(grid.stream(cell, 7).stream, grid.stream(third, 7).stream);
  EXPECT_EQ(grid.stream(cell, 7).seed, 7U);
}

TEST(Terminal, is_as_wide_as_its_columns_need_and_says_once_what_is_always_so) {
  EXPECT_EQ(
      terminal(table("cells", "All.", columns(), {rows[0], rows[1]}), {"method", "shots", "tunneled", "probability"}),
      "All. In every row: shots 100.\n"
      "method       tunneled  probability\n"
      "closed_form         0            0\n"
      "end_of_step        25         0.25\n");
}

TEST(Terminal, has_one_notation_in_a_column) {
  const auto shown = [&](double x, double y) {
    Table two = table("cells", "", columns(), {rows[0], rows[1]});
    const std::size_t at = place_of(two, "theory");
    two.rows[0][at] = x;
    two.rows[1][at] = y;
    const std::string text = terminal(two, {"theory"});
    return text.substr(text.find('\n') + 1);
  };
  EXPECT_EQ(shown(0.25, 2.5e-6), "2.5e-01\n2.5e-06\n");
  EXPECT_EQ(shown(0.25, 1e-4), "  0.25\n0.0001\n");
  EXPECT_EQ(shown(0, 2.5e-6), "      0\n2.5e-06\n");
}

TEST(Terminal, breaks_lines_and_leaves_what_is_too_wide_to_the_file) {
  EXPECT_EQ(wrapped("one two\n\nthree"), "one two\n\nthree\n");
  EXPECT_EQ(wrapped(std::string(99, 'a') + " bc"), std::string(99, 'a') + "\nbc\n");
  EXPECT_EQ(wrapped(std::string(98, 'a') + " [b c] [d e"), std::string(98, 'a') + "\n[b c] [d e\n");
  Row wide = rows[0];
  wide.method = std::string(120, 'x');
  const std::string cut = terminal(table("cells", "All.", columns(), {wide, rows[1]}), {"method", "tunneled"});
  EXPECT_TRUE(holds(cut, "And tunneled in data/cells.csv."));
  EXPECT_THROW(terminal(table("cells", "All.", columns(), rows), {"nothing"}), std::logic_error);
}

TEST(Plot, draws_a_series_for_each_value_with_the_intervals_of_its_column) {
  const Panel panel = plot(table("cells", "", columns(), rows))
                          .where("wall", "infinite")
                          .x("speed", Axis::log)
                          .y("probability")
                          .by("method")
                          .curve(
                              "theory", [](double x) { return x / 100; }, 1, 100);
  ASSERT_EQ(panel.series.size(), 3U);
  EXPECT_EQ(panel.x_label, "speed [m/s]");
  EXPECT_TRUE(panel.log_x);
  EXPECT_EQ(panel.series[1].label, "end_of_step");
  EXPECT_EQ(panel.series[1].y, std::vector{0.25});
  EXPECT_EQ(panel.series[1].lower, std::vector{0.17545211362287674});
  EXPECT_EQ(panel.series[2].mark, Mark::line);
  EXPECT_DOUBLE_EQ(panel.series[2].x[200], 10);
}

TEST(Plot, leads_lines_through_another_column_and_leaves_out_panels_of_nothing) {
  const std::vector<Row> out_of_order = {{"end_of_step", {20, 0.5, "infinite"}, {100, 25}, 0.5},
                                         {"closed_form", {10, 0.5, "infinite"}, {100, 0}, 0.0},
                                         {"end_of_step", {10, 0.5, "infinite"}, {100, 5}, 0.25}};
  Plot all = plot(table("cells", "", columns(), out_of_order)).x("speed").y("probability").by("method");
  Plot none = plot(table("cells", "", columns(), {})).x("speed").y("probability").by("method");
  const auto figures = only_measured(
      {{.name = "some", .title = "", .caption = "", .panels = {none, all.through("theory", "by theory")}},
       {.name = "none", .title = "", .caption = "", .panels = {none.line("limit", {0, 1}, {0, 1}, Mark::dashes)}}});
  ASSERT_EQ(figures.size(), 1U);
  ASSERT_EQ(figures[0].panels.size(), 1U);
  const std::vector<Series>& series = figures[0].panels[0].series;
  ASSERT_EQ(series.size(), 4U);
  EXPECT_EQ(series[3].label, "by theory");
  EXPECT_EQ(series[3].mark, Mark::line);
  EXPECT_EQ(series[3].x, (std::vector<double>{10, 20}));
  EXPECT_EQ(series[3].y, (std::vector{0.25, 0.5}));
  const Panel single =
      plot(table("cells", "", columns(), {out_of_order[0]})).x("speed").y("probability").through("theory", "by theory");
  EXPECT_EQ(single.series[1].mark, Mark::points) << "a line of one point is not seen";
}

TEST(Plot, has_a_gap_between_curves_of_one_label_and_bars_along_either_axis) {
  const auto zero = [](double) { return 0.0; };
  const Panel panel = joined(plot(rows, columns())
                                 .x("probability")
                                 .y("shots")
                                 .label("all")
                                 .curve("limit", zero, 1, 2, Mark::dashes)
                                 .curve("limit", zero, 3, 4, Mark::dashes));
  ASSERT_EQ(panel.series.size(), 3U);
  EXPECT_EQ(panel.series[0].mark, Mark::line);
  const Series &points = panel.series[1], &curves = panel.series[2];
  EXPECT_EQ(points.x, (std::vector{0, 0.25}));
  EXPECT_EQ(points.x_upper, (std::vector{0.03699349820698568, 0.34304463548061603}));
  EXPECT_EQ(points.lower, points.y);
  EXPECT_EQ(curves.mark, Mark::dashes);
  EXPECT_EQ(std::ranges::count_if(curves.y, [](double y) { return std::isnan(y); }), 1);
  EXPECT_EQ(curves.x.back(), 4);
}

TEST(Plot, has_series_on_the_zero_line_take_turns_where_each_has_one) {
  const Series zero = {.label = "a", .x = {1, 2, 3}, .y = {0, 0, 0}};
  const Series other = {.label = "b", .x = {1, 2}, .y = {0, 1}};
  const Panel three = taking_turns({.x_label = "", .y_label = "", .series = {zero, other, zero}});
  EXPECT_EQ(three.series[0].x, (std::vector<double>{1, 3}));
  EXPECT_EQ(three.series[1].x, other.x);
  EXPECT_EQ(three.series[2].x, (std::vector<double>{2}));
  const Panel many = taking_turns({.x_label = "", .y_label = "", .series = {zero, zero, zero, zero}});
  for (const Series& series : many.series) EXPECT_EQ(series.x, zero.x) << "one would vanish";
}

TEST(Tasks, hand_each_list_its_own_results) {
  std::vector<Task<Tally>> tallies = {{"a", 3, [] { return Tally{3, 1}; }}, {"b", 4, [] { return Tally{4, 2}; }}};
  std::vector<Task<std::string>> names = {{"c", 5, [] { return std::string("d e\t"); }}};
  const auto run = make_run(
      [](const Done<Tally>& done, const Done<std::string>& said) {
        Outcome outcome;
        outcome.answer = said.results[0] + std::to_string(done.results[1].tunneled) + std::to_string(said.seconds[0]);
        return outcome;
      },
      std::move(tallies), std::move(names));
  const auto units = run->units();
  ASSERT_EQ(units.size(), 3U);
  EXPECT_EQ(units[2].trials, 5);
  std::vector<std::string> results;
  for (const Unit& unit : units) results.push_back(unit.compute());
  EXPECT_EQ(run->finish(results, {0, 0, 2}).answer, "d e\t2" + std::to_string(2.0));
}

TEST(Sha256, gives_the_examples_of_the_standard_and_of_a_file_its_contents) {
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  const TemporaryFolder folder;
  write_text(folder / "abc", "abc");
  EXPECT_EQ(sha256_of_file(folder / "abc"), sha256("abc"));
  EXPECT_EQ(sha256_of_file(folder / "none"), "");
}

Table small_table() {
  Table table{.name = "cells", .description = "A & B.", .columns = {}, .rows = {}};
  table.columns = {{"method", ColumnType::text, "", "How."},
                   {"angle_deg", ColumnType::number, "deg", "Where."},
                   {"shots", ColumnType::integer, "1", "Count."},
                   {"passed", ColumnType::boolean, "", "If so."}};
  table.rows = {{std::string("end_of_step"), 0.1, std::int64_t{12000}, true},
                {std::string("a,b\"c\"\nd"), -1.5e-7, std::int64_t{12000}, Value{}}};
  return table;
}

TEST(Csv, quotes_as_rfc_4180_says) {
  EXPECT_EQ(csv_text(small_table()),
            "method,angle_deg,shots,passed\nend_of_step,0.1,12000,true\n\"a,b\"\"c\"\"\nd\",-1.5e-07,12000,\n");
}

TEST(Csv, keeps_a_spreadsheet_from_computing_a_text) {
  Table table{.name = "words", .description = "", .columns = {}, .rows = {}};
  table.columns = {{"word", ColumnType::text, "", "Any."}, {"size", ColumnType::number, "1", "Any."}};
  for (const char* word : {"=1+1", "@a", "+1", "-1", "\ta", "\ra", "'a", "'", "-", "a=b", ""})
    table.rows.push_back({std::string(word), -1.5});
  EXPECT_EQ(
      csv_text(table),
      "word,size\n'=1+1,-1.5\n'@a,-1.5\n'+1,-1.5\n'-1,-1.5\n'\ta,-1.5\n\"'\ra\",-1.5\n''a,-1.5\n'',-1.5\n-,-1.5\na=b,-1.5\n,-1.5\n");
}

TEST(Csv, spells_what_is_no_finite_number_and_refuses_rows_that_do_not_fit_the_columns) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(exact_text(Value{std::nan("")}), "");
  EXPECT_EQ(exact_text(Value{infinity}), "INF");
  EXPECT_EQ(exact_text(Value{-infinity}), "-INF");
  EXPECT_EQ(exact_text(Value{}), "");
  Table table = small_table();
  table.rows[1].pop_back();
  EXPECT_THROW(csv_text(table), std::logic_error);
  table = small_table();
  table.rows[0][2] = 1.5;
  EXPECT_THROW(csv_text(table), std::logic_error);
}

TEST(ShownTable, tells_a_constant_column_in_words) {
  const std::string markdown = markdown_table(small_table());
  EXPECT_EQ(markdown,
            "A & B. In every row: shots 12,000.\n\n| method | angle [deg] | passed |\n| :--- | ---: | :--- |\n"
            "| end\\_of\\_step | 0.1 | yes |\n| a,b\"c\" d | -1.5e-07 | \u2013 |\n");
  Table table = small_table();
  table.rows[1][3] = true;
  EXPECT_TRUE(holds(markdown_table(table), "| method | angle [deg] | passed |")) << "a verdict is shown row by row";
  table.rows.pop_back();
  EXPECT_TRUE(holds(markdown_table(table), "| method | angle [deg] | shots | passed |")) << "one row is not every";
}

TEST(ShownTable, has_no_markup_of_its_words_in_markdown) {
  Table table = small_table();
  table.description = "<b>*a*</b> ![b](http://c) `d` [e, f]";
  EXPECT_TRUE(markdown_table(table).starts_with("&lt;b>\\*a\\*&lt;/b> ![b]\\(http://c) \\`d\\` [e, f] In every row"))
      << markdown_table(table);
}

TEST(ShownTable, is_what_latex_and_html_expect) {
  const std::string latex = latex_table(small_table());
  EXPECT_TRUE(holds(latex,
                    "\\begin{tabular}{lrl}\n  \\toprule\n  method & angle [deg] & passed \\\\\n  \\midrule\n"
                    "  end\\_of\\_step & $0.1$ & yes \\\\\n"));
  EXPECT_TRUE(holds(latex, "$-1.5\\times 10^{-7}$ & --"));
  const std::string html = html_table(small_table());
  EXPECT_TRUE(holds(html, "A &amp; B."));
  EXPECT_TRUE(holds(html, "<td class=\"n\">&minus;1.5&times;10<sup>&minus;7</sup></td>"));
}

Table table_with_intervals() {
  Table table{.name = "cells", .description = "Shares.", .columns = {}, .rows = {}};
  table.columns = {{"method", ColumnType::text, "", "How."},
                   {"share_percent", ColumnType::number, "percent", "Missed.", "lower", "upper"},
                   {"lower", ColumnType::number, "percent", "Lower end of its 95 % Wilson interval."},
                   {"upper", ColumnType::number, "percent", "Upper end of it."}};
  table.rows = {{std::string("a"), 28.723, 28.591, 28.851},
                {std::string("b"), Value{}, Value{}, Value{}},
                {std::string("c"), 1.5, Value{}, Value{}}};
  return table;
}

TEST(ShownTable, shows_a_value_and_its_interval_in_one_cell) {
  EXPECT_EQ(markdown_table(table_with_intervals()),
            "Shares. Brackets hold its 95 % Wilson interval.\n\n| method | share [percent] |\n| :--- | ---: |\n"
            "| a | 28.72 [28.59, 28.85] |\n| b | \u2013 |\n| c | 1.5 |\n");
  EXPECT_TRUE(holds(latex_table(table_with_intervals()), "  a & $28.72$ $[28.59, 28.85]$ \\\\\n"));
  EXPECT_TRUE(holds(html_table(table_with_intervals()), "28.72 <span class=\"i\">[28.59, 28.85]</span></td>"));
  EXPECT_TRUE(
      csv_text(table_with_intervals()).starts_with("method,share_percent,lower,upper\na,28.723,28.591,28.851\n"));
}

TEST(ShownTable, shows_what_is_expected_as_what_is_counted) {
  Table table = {
      "t", "T.", {{"tunneled", ColumnType::integer, "1", ""}, {"expected", ColumnType::number, "1", ""}}, {}};
  table.columns.push_back({"speed", ColumnType::number, "m/s", ""});
  table.rows = {{std::int64_t{4540730}, 4540317.87, 54321.5}, {std::int64_t{17}, 17.4449, 0.5}};
  EXPECT_TRUE(holds(markdown_table(table), "| 4,540,730 | 4,540,318 | 54320 |\n| 17 | 17.44 | 0.5 |\n"));
  EXPECT_TRUE(holds(latex_table(table), "4,540,730 & 4,540,318 & $54320$"));
  EXPECT_TRUE(holds(csv_text(table), "4540730,4540317.87,54321.5\n"));
}

TEST(ShownTable, refuses_an_interval_whose_end_is_no_column) {
  Table table = table_with_intervals();
  table.columns[1].upper = "most";
  EXPECT_THROW(markdown_table(table), std::logic_error);
}

// ---- Figures: their scripts and data, as gnuplot draws them; and whether what is drawn can be read.

Figure two_panels() {
  const double gap = std::numeric_limits<double>::quiet_NaN();
  const Series theory{.label = "theory", .mark = Mark::line, .x = {1, 10, 100}, .y = {0, gap, 1}};
  const Series points{
      .label = "it's_@{a}", .mark = Mark::points, .x = {1, 10}, .y = {0, 0.5}, .lower = {0, 0.4}, .upper = {0.1, 0.6}};
  const Series residuals{.label = points.label, .x = points.x, .y = points.y};
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
  for (const char* text : {"Seen", "x [1]", "p [1]", "r [1]", "it's_@{a}"})
    EXPECT_TRUE(holds(html_unescaped(first), text));
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

/// More series than there are looks repeat them; a name that is no method's does not look as one that is.
TEST(Plot, series_wear_what_no_method_does_while_there_is_any) {
  Figure figure = two_panels();
  figure.panels.resize(1);
  figure.panels[0].series = {{.label = "closed_form", .x = {1}, .y = {1}}, {.label = "my_method", .x = {1}, .y = {2}}};
  const auto look = [script = plot_script(figure)](const std::string& number) {
    const std::size_t line = script.find("set style line " + number + " ");
    return script.substr(script.find("linecolor", line), script.find('\n', line) - script.find("linecolor", line));
  };
  EXPECT_TRUE(holds(look("1"), "linecolor"));
  EXPECT_NE(look("1"), look("2"));
  for (int i = 0; i < 100; ++i) figure.panels[0].series.push_back({.label = fmt::format("s{}", i), .x = {1}, .y = {1}});
  EXPECT_TRUE(holds(plot_script(figure), "'s99'"));
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
  figure.panels = {{.x_label = "x",
                    .y_label = "y",
                    .height = 0.5,
                    .series = {{.label = "much", .mark = Mark::cells, .x = {1, 2}, .y = {1, 1}, .color = "#123456"}},
                    .x_tics = {{1, "ten_thousand"}, {2, "more"}},
                    .y_tics = {{1, "a rather long name of a row"}},
                    .x_groups = {{1.5, "group"}}}};
  const std::string script = plot_script(figure);
  EXPECT_TRUE(holds(script, "linecolor rgb '#123456'"));
  EXPECT_TRUE(holds(script, "with boxxyerror"));
  EXPECT_TRUE(holds(script, "set xrange [0.4:2.6]"));
  expect_drawn(figure);
  const std::string svg = read_text(folder / "heat.svg");
  for (const char* text : {"ten_thousand", "a rather long name of a row", "group", "much"})
    EXPECT_TRUE(holds(svg, text));
}

TEST_F(DrawnPlot, is_drawn_for_latex_with_words_as_it_wants_them) {
  expect_drawn(two_panels(), "tex");
  EXPECT_TRUE(holds(read_text(folder / "probability-latex.tex"), "it's\\_@\\{a\\}"));
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
    figure.panels[0].series.push_back({.label = label});
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

TEST(PlotStyle, of_a_roster_is_alike_whoever_is_drawn) {
  const std::vector<std::string> roster = {"ours", "theirs", "others"};
  const auto of_two = [&](const char* first, const char* second) {
    Figure figure = two_panels();
    figure.panels.resize(1);
    figure.panels[0].series = {{.label = first}, {.label = second}};
    figure.roster = roster;
    EXPECT_NE(figure_json(figure).find(R"("roster":["ours","theirs","others"])"), std::string::npos);
    return series_styles(figure);
  };
  const auto here = of_two("ours", "others"), there = of_two("others", "theirs");
  ASSERT_EQ(here.size(), 2U);
  ASSERT_EQ(there.size(), 2U);
  EXPECT_EQ(here[1].label, there[1].label);
  EXPECT_EQ(here[1].color, there[1].color);
  EXPECT_EQ(here[1].point_type, there[1].point_type);
  EXPECT_NE(here[0].color, here[1].color);
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
  EXPECT_EQ(tics({true, 657, 1858}, 360, 44), "(1000, 1500)") << "not 1000 alone";
  EXPECT_EQ(tics({true, 21, 22.5}, 360, 44), "(21, 21.5, 22, 22.5)");
}

TEST(InlineSvg, has_ids_of_its_own) {
  const std::string svg =
      "<?xml version=\"1.0\"?>\n<svg viewBox=\"0 0 1 1\"><title>x</title><path id='p1'/>"
      "<use xlink:href='#p1'/><g id=\"q\" filter=\"url(#q)\"/></svg>";
  EXPECT_EQ(inline_svg(svg, "fig", "A & B"),
            "<svg role=\"img\" aria-label=\"A &amp; B\" viewBox=\"0 0 1 1\"><title>A &amp; B</title><path id='fig_p1'/>"
            "<use xlink:href='#fig_p1'/><g id=\"fig_q\" filter=\"url(#fig_q)\"/></svg>");
}

TEST(Xml, takes_what_every_reader_takes_and_names_the_line_of_what_is_wrong) {
  for (
      const char* good : {
          "<a/>",
          "<?xml version=\"1.0\"?>\n<!DOCTYPE svg>\n<!-- c -->\n<svg a='1' b = \"&lt;&#39;&#x1F600;'\"><x:g-1 /></svg >\n",
          "<a>it's > \"b\" &amp; ]] ]&gt; \u00b5<![CDATA[<&]]></a>",
      }) {
    EXPECT_EQ(xml_fault(good), "") << good;
  }
  const std::pair<const char*, const char*> cases[] = {
      {"", "no element found"},
      {"<a>\n<b>\n</a>", "line 3, column 3: mismatched tag"},
      {"<a/><b/>", "junk after document element"},
      {"<a>\n]]></a>", "line 2, column 3: not well-formed"},
      {"<a>&nbsp;</a>", "undefined entity"},
      {"<!DOCTYPE a SYSTEM 'there.dtd'><a>&nbsp;</a>", "undefined entity"},
      {"<!DOCTYPE a SYSTEM 'there.dtd'><a b='&nbsp;'/>", "undefined entity"},
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
