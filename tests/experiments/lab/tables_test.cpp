/// What follows from a declaration: columns, cells of a design, a terminal's table, a panel, a run.
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/experiments/lab/columns.hpp>
#include <thinwall/experiments/lab/factors.hpp>
#include <thinwall/experiments/lab/plot.hpp>
#include <thinwall/experiments/lab/table_text.hpp>
#include <thinwall/experiments/lab/tasks.hpp>
#include <thinwall/experiments/lab/terminal.hpp>

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

const char* defaults = "speed = [10]\nstep = 0.5\nwall = ['infinite']";

std::vector<Cell> cells(const std::string& text, const std::function<bool(Cell&)>& adjust = {}) {
  return grid.cells(Settings(text, "test.toml", defaults), 1, {}, adjust);
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

TEST(Columns, leave_out_what_is_there_only) {
  const Table brief = table("brief", "", columns().without({"shots", "latest"}), rows);
  EXPECT_EQ(brief.columns.size(), 9U);
  EXPECT_THROW(columns().without({"shot"}), std::logic_error);
}

TEST(Columns, are_empty_where_their_condition_does_not_hold) {
  const auto some = columns_of<Row>(where([](const Row& r) { return r.method == "nothing"; }, fields(&Row::tally)));
  const Table table = thinwall::table("some", "", some, rows);
  EXPECT_EQ(table.rows[0][0], Value());
  EXPECT_EQ(table.rows[2][0], Value(std::int64_t{0}));
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

TEST(Factors, refuse_by_name_what_is_not_allowed) {
  const auto refusal = [](const std::string& text) -> std::string {
    try {
      cells(text);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(refusal("speed = [0]").find("key 'speed': 0"), std::string::npos) << refusal("speed = [0]");
  EXPECT_NE(refusal("step = 2").find("key 'step': 2"), std::string::npos);
  EXPECT_NE(refusal("wall = ['finit']").find("did you mean 'finite'?"), std::string::npos);
}

TEST(Terminal, is_as_wide_as_its_columns_need_and_says_once_what_is_always_so) {
  EXPECT_EQ(
      terminal(table("cells", "All.", columns(), {rows[0], rows[1]}), {"method", "shots", "tunneled", "probability"}),
      "All. In every row: shots 100.\n"
      "method       tunneled  probability\n"
      "closed_form         0            0\n"
      "end_of_step        25         0.25\n");
}

TEST(Terminal, breaks_lines_and_leaves_what_is_too_wide_to_the_file) {
  EXPECT_EQ(wrapped("one two\n\nthree"), "one two\n\nthree\n");
  EXPECT_EQ(wrapped(std::string(99, 'a') + " bc"), std::string(99, 'a') + "\nbc\n");
  Row wide = rows[0];
  wide.method = std::string(120, 'x');
  const std::string cut = terminal(table("cells", "All.", columns(), {wide, rows[1]}), {"method", "tunneled"});
  EXPECT_NE(cut.find("And 1 columns that data/cells.csv has."), std::string::npos) << cut;
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

}  // namespace
}  // namespace thinwall
