/// The experiment engines: what ours does, what the engines of others that are built in do, and what is said of the rest.
#include <algorithm>
#include <sstream>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include <thinwall/experiments/engines/engine_list.hpp>
#include <thinwall/experiments/engines/fly.hpp>
#include <thinwall/experiments/engines/report.hpp>
#include <thinwall/experiments/program/program.hpp>

#include "experiments/engines/engines_run.hpp"
#include "support/described_tables.hpp"
#include "support/temporary_folder.hpp"

namespace thinwall {
namespace {

std::vector<EngineLine> fired(const EnginePlan& plan) { return engine_lines(plan, results_of(engine_units(plan))); }

const Engine& engine_called(const std::vector<Engine>& engines, const std::string& name) {
  return *std::find_if(engines.begin(), engines.end(), [&](const Engine& e) { return e.name == name; });
}

/// The lines of one engine in one mode, from the shortest path to the longest; none if it is not in the program.
struct EngineLines {
  EngineLines(const std::string& engine, const std::string& label)
      : plan(engine_plan("engine = ['" + engine + "']" + std::string(few_engine_shots))),
        lines(lines_of(fired(plan), label, 250)) {}
  EnginePlan plan;
  std::vector<EngineLine> lines;
};

#define SKIP_WITHOUT(name)                                                                          \
  if (!engine_called(engine_list(), name).is_there) {                                               \
    GTEST_SKIP() << name << " is not in this build: " << engine_called(engine_list(), name).package \
                 << " and -DTHINWALL_PEERS=ON bring it";                                            \
  }

TEST(Engines, ours_lets_no_ball_through_where_it_sweeps_and_wastes_no_energy) {
  for (const char* mode : {"clamp", "event_driven"}) {
    const EngineLines ours("thinwall", std::string("thinwall ") + mode);
    ASSERT_EQ(ours.lines.size(), 3U);
    for (const EngineLine& line : ours.lines) {
      EXPECT_EQ(line.tally.turned, 400) << mode;
      EXPECT_NEAR(*mean_energy(line), 1, 1e-9);
      EXPECT_NEAR(*mean_late(line), mode == std::string("clamp") ? 0.25 : 0,
                  mode == std::string("clamp") ? 0.05 : 1e-9);
    }
  }
}

TEST(Engines, ours_follows_theory_where_it_looks_at_poses) {
  const EnginePlan plan = engine_plan("engine = ['thinwall']" + std::string(few_engine_shots));
  std::vector<EngineLine> lines = fired(plan);
  std::vector<CellCount> counts = own_counts(lines);
  EXPECT_EQ(counts.size(), 4U * 3);
  EXPECT_TRUE(all_passed(self_test(counts)));
  const EngineLine discrete = lines_of(lines, "thinwall discrete", 250).front();
  EXPECT_GT(discrete.tally.tunneled, 80) << "the foil tunnels";
  for (CellCount& count : counts) {
    if (count.method == "thinwall event_driven") count.tunneled = 1;
  }
  EXPECT_FALSE(all_passed(self_test(counts))) << "one ball is too many";
  for (EngineLine& line : lines) {
    if (line.theory) line.theory = *line.theory * 0.8;
  }
  EXPECT_FALSE(all_passed(self_test(own_counts(lines))));
}

TEST(Engines, bullet_tunnels_without_its_sweep_and_not_with_it) {
  SKIP_WITHOUT("bullet");
  const EngineLines discrete("bullet", "Bullet discrete"), swept("bullet", "Bullet ccd_0.2");
  ASSERT_EQ(discrete.lines.size(), 3U);
  for (const EngineLine& line : discrete.lines) EXPECT_NEAR(tunneled_share(line), *line.theory, 0.1);
  for (const EngineLine& line : swept.lines) EXPECT_EQ(line.tally.tunneled, 0);
}

TEST(Engines, ode_follows_theory) {
  SKIP_WITHOUT("ode");
  const EngineLines ode("ode", "ODE discrete");
  ASSERT_EQ(ode.lines.size(), 3U);
  std::vector<CellCount> counts;
  for (const EngineLine& line : ode.lines) {
    counts.push_back({"ODE", "double", line.tally.shots, wrong_shots(line), *line.theory});
    EXPECT_NEAR(*mean_energy(line), 1, 1e-6);
  }
  EXPECT_TRUE(all_passed(self_test(counts)));
}

TEST(Engines, box2d_stops_balls_at_its_skin_and_no_ball_further_than_it_moves_any) {
  SKIP_WITHOUT("box2d");
  const EngineLines discrete("box2d", "Box2D discrete"), swept("box2d", "Box2D bullet");
  std::vector<CellCount> counts;
  for (const EngineLine& line : discrete.lines) {
    counts.push_back({"Box2D", "float", line.tally.shots, wrong_shots(line), *line.theory});
  }
  EXPECT_TRUE(all_passed(self_test(counts)));
  ASSERT_EQ(swept.lines.size(), 3U);
  for (const EngineLine& line : swept.lines) EXPECT_EQ(wrong_shots(line), 0);
  const EnginePlan far = engine_plan("path = [1, 3]\nwall_size = [250]\nshots = 10");
  for (const EngineLine& line : fired(far)) EXPECT_FALSE(line.cell->path == 3 && line.setup->engine.name == "box2d");
}

/// In every engine of the build: no shot knows of another, on whatever thread.
TEST(Engines, give_the_same_bits_on_four_threads_and_in_any_order) {
  const auto run = engines_run(few_engine_shots, {.seed = 5, .trials = 200});
  const std::vector<Unit> units = run->units();
  const std::vector<std::string> once = results_of(units);
  std::vector<std::string> again(units.size());
  const auto some_of_each = [&](std::size_t from) {
    for (std::size_t i = 0; i < units.size(); ++i) {
      if (i % 4 == from) again[units.size() - 1 - i] = units[units.size() - 1 - i].compute();
    }
  };
  std::vector<std::thread> threads;
  for (std::size_t from = 0; from < 4; ++from) threads.emplace_back(some_of_each, from);
  for (std::thread& thread : threads) thread.join();
  const std::vector<double> seconds(units.size(), 1);
  const Outcome first = run->finish(once, seconds), second = run->finish(again, seconds);
  for (std::size_t i = 0; i < first.tables.size(); ++i) {
    if (!first.tables[i].is_timing) {
      EXPECT_EQ(first.tables[i].rows, second.tables[i].rows) << first.tables[i].name;
    }
  }
  EXPECT_EQ(first.answer, second.answer);
  EXPECT_EQ(first.summary, second.summary);
}

/// As many worlds at once of one engine as there are threads.
TEST(Engines, bear_worlds_of_their_own_kind_on_other_threads) {
  for (const Engine& engine : engine_list()) {
    if (!engine.is_there) continue;
    const EngineMode mode = engine.modes({{0.5}, 0.5, {2}}).front();
    const auto counts = [&](std::int64_t shots) {
      const std::string line = to_line(fire(meter_cell, mode, {0, shots}, 3));
      return line.substr(0, line.rfind(' '));  // the last word is a time
    };
    constexpr std::int64_t shots = 2000;
    const std::string alone = counts(shots);
    std::vector<std::string> lines(4);
    std::vector<std::thread> threads;
    for (std::string& line : lines) threads.emplace_back([&] { line = counts(shots); });
    for (std::thread& thread : threads) thread.join();
    for (const std::string& line : lines) EXPECT_EQ(line, alone) << engine.called;
  }
}

TEST(Engines, says_what_is_missing_and_does_the_rest) {
  std::size_t missing = 0;
  for (const Engine& engine : engine_list()) missing += engine.is_there ? 0 : 1;
  const auto run = engines_run(few_engine_shots, {.seed = 1, .trials = 5});
  EXPECT_EQ(run->notes().size(), missing);
  const Outcome outcome = outcome_of(*run);
  for (const std::string& note : run->notes()) {
    EXPECT_NE(outcome.summary.find(note), std::string::npos);
    EXPECT_NE(outcome.sections[1].text.find(note), std::string::npos);
  }
  EnginePlan plan = engine_plan(few_engine_shots);
  plan.missing = {engine_called(engine_list(), "bullet")};
  ASSERT_EQ(missing_engines(plan).size(), 1U);
  EXPECT_EQ(missing_engines(plan)[0],
            "Bullet is left out: install libbullet-dev and configure with -DTHINWALL_PEERS=ON");
}

TEST(Engines, tell_whoever_starts_them_what_is_missing_before_they_run) {
  const TemporaryFolder folder;
  write_text(folder / "few.toml", "experiment = 'engines'" + std::string(few_engine_shots));
  std::ostringstream reply, notes;
  const int status = run_program({"thinwall", "run", folder / "few.toml", "--trials", "2", "--out", folder / "out"},
                                 std::vector{engines_experiment()}, reply, notes);
  EXPECT_NE(status, 2) << notes.str();
  std::string expected;
  for (const std::string& note : engines_run(few_engine_shots)->notes()) expected += note + "\n";
  EXPECT_TRUE(notes.str().starts_with(expected + "engines: ")) << notes.str();
}

TEST(Engines, hands_over_tables_that_are_described_and_a_summary_that_fits) {
  const Outcome outcome = outcome_of(*engines_run("shots = 3"));
  expect_described_tables(outcome);
  std::istringstream text(outcome.summary);
  for (std::string line; std::getline(text, line);) EXPECT_LE(line.size(), 100U) << line;
  EXPECT_TRUE(table_of(outcome, "timings").is_timing);
  for (const Figure& figure : outcome.figures) {
    EXPECT_EQ(figure.is_timing, figure.name == "times");
    for (const Panel& panel : figure.panels) {
      for (const Series& series : panel.series) EXPECT_EQ(series.x.size(), series.y.size()) << series.label;
    }
  }
  EXPECT_NE(outcome.answer.find("theory says 93.1 %"), std::string::npos) << outcome.answer;
}

}  // namespace
}  // namespace thinwall
