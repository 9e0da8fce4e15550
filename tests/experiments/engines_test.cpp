/// The shots that engines get and the oracle's time of contact; the chance of going through, averaged over angles; what a flight is
/// taken for, on flights made up by hand; and the stages that engines play.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/experiments/engines/model.hpp>
#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/lab/random.hpp>
#include <thinwall/experiments/models/tunneling_theory.hpp>

#include "support/experiment_run.hpp"
#include "support/program.hpp"
#include "support/reply.hpp"

namespace thinwall {

namespace {

constexpr EngineCell meter_cell = {
    .path = 1, .step = 1.0 / 60, .radius = 0.05, .thickness = 0.01, .wall_size = 250, .angle_deg = 60, .steps = 10};

TEST(EngineShots, touch_when_the_oracle_says_so) {
  const RandomStream stream = random_stream(ball_at_wall, meter_cell, 7);
  const EngineStage stage = ball_at_wall.stage(meter_cell);
  for (std::uint64_t i = 0; i < 200; ++i) {
    const EngineShot shot = ball_at_wall.shot(meter_cell, random_words(stream, i, 0));
    EXPECT_GT(shot.contact, 0);
    EXPECT_LE(shot.contact, 2);
    const Vec3<double> at = shot.start[0].position + shot.contact * stage.step * shot.start[0].velocity;
    EXPECT_NEAR(at[0], -stage.wall_half_extents()[0] - stage.ball_radius(), 1e-12) << i;
    EXPECT_LT(at.tail<2>().norm() + stage.ball_radius(), stage.wall_half_extents()[1]);
  }
}

TEST(EngineShots, are_spread_over_the_angles_and_the_step) {
  const RandomStream stream = random_stream(ball_at_wall, meter_cell, 7);
  double angle = 0, phase = 0, steepest = 0;
  constexpr int count = 2000;
  for (std::uint64_t i = 0; i < count; ++i) {
    const EngineShot shot = ball_at_wall.shot(meter_cell, random_words(stream, i, 0));
    const double a = std::acos(shot.start[0].velocity[0] / shot.start[0].velocity.norm()) * 180 / std::numbers::pi;
    angle += a / count;
    steepest = std::max(steepest, a);
    phase += (shot.contact - std::floor(shot.contact)) / count;
    EXPECT_NEAR(shot.start[0].velocity.norm(), 60, 1e-4);
  }
  EXPECT_NEAR(angle, 30, 5 * 60 / std::sqrt(12.0 * count));  // of a uniform mean
  EXPECT_NEAR(phase, 0.5, 5 / std::sqrt(12.0 * count));
  EXPECT_GT(steepest, 59);
  EXPECT_LE(steepest, 60 + 1e-4);
}

TEST(EngineShots, are_the_same_at_a_wall_of_another_width_and_others_in_another_cell) {
  EngineCell wide = meter_cell, far = meter_cell;
  wide.wall_size = 2000;
  far.path = 2;
  const EngineShot one = ball_at_wall.shot(meter_cell, random_words(random_stream(ball_at_wall, meter_cell, 7), 3, 0));
  const EngineShot other = ball_at_wall.shot(wide, random_words(random_stream(ball_at_wall, wide, 7), 3, 0));
  EXPECT_EQ(one.start[0].position, other.start[0].position);
  EXPECT_EQ(one.start[0].velocity, other.start[0].velocity);
  EXPECT_EQ(one.contact, other.contact);
  EXPECT_EQ(ball_at_wall.stage(wide).wall_half_extents()[1], 1000);
  EXPECT_NE(random_stream(ball_at_wall, meter_cell, 7).stream, random_stream(ball_at_wall, far, 7).stream);
}

/// The same by the midpoint rule, from the formula for one angle.
double average(double depth, double spacing, double angle_deg) {
  constexpr int parts = 20000;
  double sum = 0;
  for (int i = 0; i < parts; ++i) {
    const double a = (i + 0.5) / parts * angle_deg * std::numbers::pi / 180;
    sum += miss_probability(slab_chord(depth, 0, std::cos(a)), spacing) / parts;
  }
  return sum;
}

TEST(EngineTheory, is_the_average_over_the_angles) {
  for (const double spacing : {0.05, 0.056, 0.1, 0.11, 1.0, 10.0}) {
    for (const double angle : {1.0, 30.0, 60.0, 89.0}) {
      EXPECT_NEAR(mean_miss_probability(0.055, spacing, angle), average(0.055, spacing, angle), 1e-6)
          << spacing << " " << angle;
    }
  }
  EXPECT_EQ(mean_miss_probability(0.055, 0.11, 0), 0.5);
  EXPECT_NEAR(mean_miss_probability(0.055, 0.11, 1e-3), 0.5, 1e-9);
  EXPECT_EQ(mean_miss_probability(0.055, 0.055, 60), 0);
}

TEST(EngineTheory, counts_both_surfaces_of_what_is_never_seen_and_half_of_what_is_seen_in_time) {
  EXPECT_EQ(unseen_theory(meter_cell, 1), mean_miss_probability(0.11, 1, 60));
  EXPECT_EQ(through_theory(meter_cell, 1), mean_miss_probability(0.055, 1, 60));
  EXPECT_EQ(through_theory(meter_cell, 4), mean_miss_probability(0.055, 0.25, 60));
  EXPECT_NEAR(through_theory(meter_cell, 1, 0.01), mean_miss_probability(0.065, 1, 60), 1e-15);
  EXPECT_NEAR(unseen_theory(meter_cell, 1, 0.01), mean_miss_probability(0.13, 1, 60), 1e-15);
}

/// Head-on: contact at x = -1, half a step after the start; 2 m a step, steps of 1 s.
const EngineStage one_wall = {
    .step = 1, .fixed = {Aabb<double>{{0, 0, 0}, {0.5, 100, 100}}}, .moving = {Sphere<double>{{0, 0, 0}, 0.5}}};
const EngineShot head_on_shot = {
    .start = {{.position = {-2, 0, 0}, .velocity = {2, 0, 0}}}, .ahead = {1, 0, 0}, .beyond = 0.5, .contact = 0.5};

/// At the end of 4 steps.
EngineTally judged(const Vec3<double>& position, const Vec3<double>& velocity) {
  EngineTally tally;
  judge(one_wall, head_on_shot, EngineFlights::Flight(4, {{position, velocity}}), tally);
  EXPECT_EQ(tally.shots, 1);
  return tally;
}

double lateness(const EngineTally& tally) { return tally.lateness.mean().value(); }

TEST(EngineJudge, tells_in_front_from_within_and_beyond) {
  EXPECT_EQ(judged({6, 0, 0}, {2, 0, 0}).tunneled, 1);
  EXPECT_EQ(judged({6, 0, 0}, {2, 0, 0}).unseen, 1);
  const EngineTally pushed = judged({6.2, 0, 0}, {2, 0, 0});
  EXPECT_EQ(pushed.tunneled, 1);
  EXPECT_EQ(pushed.unseen, 0);
  EXPECT_EQ(judged({0.51, 0, 0}, {-2, 0, 0}).tunneled, 1);
  for (const double x : {-0.5, 0.0, 0.5}) EXPECT_EQ(judged({x, 0, 0}, {-2, 0, 0}).stuck, 1) << x;
  const EngineTally held = judged({-0.51, 0, 0}, {0, 1, 0});
  EXPECT_EQ(held.wrong(), 0);
  EXPECT_EQ(held.turned, 0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(judged({nan, 0, 0}, {-2, 0, 0}).lost, 1);
  EXPECT_EQ(judged({-2, 0, 0}, {-std::numeric_limits<double>::infinity(), 0, 0}).lost, 1);
}

TEST(EngineJudge, finds_no_lateness_in_an_exact_bounce) {
  const EngineTally tally = judged({-1 - 2 * 3.5, 0, 0}, {-2, 0, 0});
  EXPECT_EQ(tally.turned, 1);
  EXPECT_EQ(lateness(tally), 0);
  EXPECT_EQ(tally.energy.mean(), 1);
}

TEST(EngineJudge, finds_when_a_ball_turned_and_half_of_what_it_waited) {
  // Turned where it was at the end of the first step, half a step past contact.
  EXPECT_EQ(lateness(judged({0 - 2 * 3.0, 0, 0}, {-2, 0, 0})), 0.5);
  // Stopped at contact for the rest of the step.
  EXPECT_EQ(lateness(judged({-1 - 2 * 3.0, 0, 0}, {-2, 0, 0})), 0.25);
  // Turned a quarter of a step before contact, with half of its speed left.
  const EngineTally early = judged({-1.5 - 3.75, 3, 0}, {-1, 0, 0});
  EXPECT_EQ(lateness(early), -0.25);
  EXPECT_EQ(early.earliest, -0.25);
  EXPECT_EQ(early.latest, -0.25);
  EXPECT_EQ(early.least_energy, 0.25);
  EXPECT_EQ(early.most_energy, 0.25);
}

TEST(EngineJudge, measures_depth_at_the_ends_of_steps) {
  EngineTally tally;
  const BodyState in = {{-0.75, 0, 0}, {2, 0, 0}}, out = {{-3, 0, 0}, {-2, 0, 0}};
  judge(one_wall, head_on_shot, {{in}, {out}}, tally);
  EXPECT_EQ(tally.deepest, 0.25);
}

// ---- The experiment engines: what ours does, what the engines of others that are built in do, what is said of the rest, and its settings.

constexpr std::string_view few_engine_shots = R"(
  path = [0.1, 0.5, 2]
  wall_size = [250]
  swept_radius = [0.2]
  shots = 400
  stage_shots = 20
)";

EnginePlan engine_plan(std::string_view text, std::optional<std::int64_t> trials = {}) {
  return make_engine_plan(Settings(text, "test.toml", engines_experiment().default_toml),
                          {.seed = 1, .trials = trials});
}

std::vector<EngineRow> fired(const EnginePlan& plan) {
  std::vector<EngineRow> rows = plan.rows;
  const std::vector<EngineVolley> volleys = volleys_in_turn(rows, plan.shots);
  std::vector<EngineTally> tallies;
  for (const EngineVolley& v : volleys) tallies.push_back(fire(rows[v.row], v.first, v.shots, plan.seed));
  add_results(volleys, tallies, rows);
  return rows;
}

/// The rows of one engine in one mode, from the shortest path to the longest; none if it is not in the program.
struct EngineRows {
  EngineRows(const std::string& engine, const std::string& label)
      : plan(engine_plan("engine = ['" + engine + "']" + std::string(few_engine_shots))),
        rows(rows_of(fired(plan), label, 250)) {}
  EnginePlan plan;
  std::vector<EngineRow> rows;
};

#define SKIP_WITHOUT(name)                                                                   \
  if (!called(engine_list(), name).is_there()) {                                             \
    GTEST_SKIP() << name << " is not in this build: " << called(engine_list(), name).package \
                 << " and -DTHINWALL_PEERS=ON bring it";                                     \
  }

TEST(Engines, ours_lets_no_ball_through_where_it_sweeps_and_wastes_no_energy) {
  for (const char* mode : {"clamp", "event_driven"}) {
    const EngineRows ours("thinwall", std::string("thinwall ") + mode);
    ASSERT_EQ(ours.rows.size(), 3U);
    for (const EngineRow& row : ours.rows) {
      EXPECT_EQ(row.tally.turned, 400) << mode;
      EXPECT_NEAR(*row.tally.energy.mean(), 1, 1e-9);
      EXPECT_NEAR(*row.tally.lateness.mean(), mode == std::string("clamp") ? 0.25 : 0,
                  mode == std::string("clamp") ? 0.05 : 1e-9);
    }
  }
}

TEST(Engines, ours_follows_theory_where_it_looks_at_poses) {
  const EnginePlan plan = engine_plan("engine = ['thinwall']" + std::string(few_engine_shots));
  std::vector<EngineRow> rows = fired(plan);
  std::vector<CellCount> counts = own_counts(rows, {});
  EXPECT_EQ(counts.size(), 4U * 3);
  EXPECT_TRUE(all_passed(self_test(counts)));
  std::vector<EngineRow> at_two_walls = rows;  // the same shots, which theory is held against once
  for (EngineRow row : rows) {
    row.cell.wall_size = 500;
    at_two_walls.push_back(row);
  }
  EXPECT_EQ(own_counts(at_two_walls, {}).size(), 6U * 3);
  const EngineRow discrete = rows_of(rows, "thinwall discrete", 250).front();
  EXPECT_GT(discrete.tally.tunneled, 80) << "the foil tunnels";
  for (CellCount& count : counts) {
    if (count.name == "thinwall event_driven") count.counted = 1;
  }
  EXPECT_FALSE(all_passed(self_test(counts))) << "one ball is too many";
  for (EngineRow& row : rows) {
    if (row.theory) row.theory = *row.theory * 0.8;
  }
  EXPECT_FALSE(all_passed(self_test(own_counts(rows, {}))));
}

TEST(Engines, bullet_tunnels_without_its_sweep_and_not_with_it) {
  SKIP_WITHOUT("bullet");
  const EngineRows discrete("bullet", "Bullet discrete"), swept("bullet", "Bullet ccd_0.2");
  ASSERT_EQ(discrete.rows.size(), 3U);
  for (const EngineRow& row : discrete.rows)
    EXPECT_NEAR(static_cast<double>(row.tally.tunneled) / static_cast<double>(row.tally.shots), *row.theory, 0.1);
  for (const EngineRow& row : swept.rows) EXPECT_EQ(row.tally.tunneled, 0);
}

TEST(Engines, ode_follows_theory) {
  SKIP_WITHOUT("ode");
  const EngineRows ode("ode", "ODE discrete");
  ASSERT_EQ(ode.rows.size(), 3U);
  std::vector<CellCount> counts;
  for (const EngineRow& row : ode.rows) {
    counts.push_back({"ODE", "double", row.tally.shots, row.tally.wrong(), *row.theory});
    EXPECT_NEAR(*row.tally.energy.mean(), 1, 1e-6);
  }
  EXPECT_TRUE(all_passed(self_test(counts)));
}

TEST(Engines, box2d_stops_balls_at_its_skin_and_no_ball_further_than_it_moves_any) {
  SKIP_WITHOUT("box2d");
  const EngineRows discrete("box2d", "Box2D discrete"), swept("box2d", "Box2D bullet");
  std::vector<CellCount> counts;
  for (const EngineRow& row : discrete.rows) {
    counts.push_back({"Box2D", "float", row.tally.shots, row.tally.wrong(), *row.theory});
  }
  EXPECT_TRUE(all_passed(self_test(counts)));
  ASSERT_EQ(swept.rows.size(), 3U);
  for (const EngineRow& row : swept.rows) EXPECT_EQ(row.tally.wrong(), 0);
  const EnginePlan far = engine_plan("path = [1, 3]\nwall_size = [250]\nshots = 10");
  for (const EngineRow& row : fired(far)) EXPECT_FALSE(row.cell.path == 3 && row.setup->engine.name == "box2d");
}

TEST(Engines, of_npm_are_there_in_the_version_that_is_asked_for) {
  const TemporaryFolder scripts;
  const auto write = [&](const char* file, const std::string& text) { write_text(scripts / file, text); };
  const auto jolt_is_there = [&] { return called(npm_engines(scripts.path()), "jolt").is_there(); };
  EXPECT_FALSE(jolt_is_there());
  write("package.json", R"({"dependencies": {"jolt-physics": "2.0.0"}})");
  EXPECT_FALSE(jolt_is_there());
  write("node_modules/jolt-physics/package.json", R"({"version": "1.0.0"})");
  EXPECT_FALSE(jolt_is_there());
  write("node_modules/jolt-physics/package.json", "{");
  EXPECT_FALSE(jolt_is_there());
  write("node_modules/jolt-physics/package.json", R"({"version": "2.0.0"})");
  EXPECT_TRUE(jolt_is_there());
  EXPECT_EQ(called(npm_engines(scripts.path()), "jolt").integrity, "");
  write("node_modules/.package-lock.json", R"({"packages": {"node_modules/jolt-physics": {"integrity": "sha512-x"}}})");
  const std::vector<Engine> engines = npm_engines(scripts.path());
  const Engine& jolt = called(engines, "jolt");
  EXPECT_EQ(jolt.version, "2.0.0");
  EXPECT_EQ(jolt.integrity, "sha512-x");
  const EngineSetup setup = {jolt, jolt.modes.front()};
  const EngineTally tally = fire(EngineRow{meter_cell, &setup, &ball_at_wall}, 0, 5, 1);  // there is no script
  EXPECT_EQ(tally.unanswered, 5);
  EXPECT_EQ(tally.shots, 0);
}

TEST(Engines, that_die_are_named_and_left_out) {
  const EnginePlan plan = engine_plan("engine = ['thinwall']" + std::string(few_engine_shots));
  std::vector<EngineRow> rows = fired(plan);
  std::vector<StageRow> stages = plan.stages;
  const std::size_t all = rows.size();
  EXPECT_EQ(drop_failed(rows, stages), std::vector<std::string>{});
  EXPECT_EQ(rows.size(), all);
  EXPECT_FALSE(stages.empty());
  stages.back().tally.unanswered = 1;
  EXPECT_EQ(drop_failed(rows, stages), std::vector<std::string>{"thinwall"});
  EXPECT_TRUE(rows.empty() && stages.empty());
}

TEST(Engines, that_die_are_told_in_the_answer_and_in_the_report) {
  SKIP_WITHOUT("ode");
  const auto run = run_of(engines_experiment(), "engine = ['ode', 'thinwall']" + std::string(few_engine_shots),
                          {.seed = 1, .trials = 3});
  EngineTally dead;
  dead.unanswered = 3;
  std::vector<std::string> results;
  for (const Unit& unit : run->units()) {
    const bool is_dead = unit.key.find(" ode ") != std::string::npos;
    results.push_back(is_dead ? to_text(dead) : unit.compute());
  }
  const Outcome outcome = run->finish(results, std::vector<double>(results.size(), 1));
  EXPECT_TRUE(outcome.answer.ends_with("Clopper-Pearson). ODE is left out, having died or hung.")) << outcome.answer;
  EXPECT_TRUE(outcome.sections[0].text.starts_with("ODE is left out, having died or hung.\n\n"));
}

/// In every engine of the build: no shot knows of another, on whatever thread.
TEST(Engines, give_the_same_bits_on_four_threads_and_in_any_order) {
  const auto run = run_of(engines_experiment(), few_engine_shots, {.seed = 5, .trials = 30});
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
  const EngineCell cell = engine_plan("path = [1]").rows.front().cell;
  for (const Engine& engine : engine_list()) {
    if (!engine.is_there()) continue;
    const EngineSetup setup = {engine, engine.modes.front()};
    const auto counts = [&](std::int64_t shots) {
      EngineTally tally = fire(EngineRow{cell, &setup, &ball_at_wall}, 0, shots, 3);
      tally.seconds = 0;
      return to_text(tally);
    };
    constexpr std::int64_t shots = 500;
    const std::string alone = counts(shots);
    std::vector<std::string> lines(4);
    std::vector<std::thread> threads;
    for (std::string& line : lines) threads.emplace_back([&] { line = counts(shots); });
    for (std::thread& thread : threads) thread.join();
    for (const std::string& line : lines) EXPECT_EQ(line, alone) << engine.called;
  }
}

TEST(Engines, says_what_is_missing_and_does_the_rest) {
  const auto missing = std::ranges::count_if(engine_list(), [](const Engine& engine) { return !engine.is_there(); });
  const auto run = run_of(engines_experiment(), few_engine_shots, {.seed = 1, .trials = 5});
  EXPECT_EQ(std::ssize(run->notes()), missing);
  const Outcome outcome = outcome_of(*run);
  for (const std::string& note : run->notes()) {
    EXPECT_FALSE(holds(outcome.summary, note));  // said before the run
    EXPECT_TRUE(holds(outcome.sections[0].text, note));
  }
  EXPECT_EQ(called(engine_list(), "bullet").remedy,
            "install libbullet-dev, if it is missing, and configure with -DTHINWALL_PEERS=ON");
}

TEST(Engines, tell_whoever_starts_them_what_is_missing_before_they_run) {
  const TemporaryFolder folder;
  write_text(folder / "few.toml", "experiment = 'engines'" + std::string(few_engine_shots));
  const Reply reply =
      call_program({"run", folder / "few.toml", "--trials", "2", "--out", folder / "out"}, {engines_experiment()});
  EXPECT_NE(reply.status, 2) << reply.err;
  std::string expected;
  for (const std::string& note : run_of(engines_experiment(), few_engine_shots)->notes()) expected += note + "\n";
  EXPECT_TRUE(reply.err.starts_with(expected + "engines: ")) << reply.err;
}

TEST(Engines, hold_every_shot_once_in_volleys) {
  const EnginePlan plan = engine_plan("shots = 2345");
  std::vector<std::int64_t> next(plan.rows.size(), 0);
  for (const EngineVolley& volley : volleys_in_turn(plan.rows, plan.shots)) {
    EXPECT_EQ(volley.first, next[volley.row]);
    EXPECT_LE(volley.shots, most_shots_an_engine_volley);
    next[volley.row] += volley.shots;
  }
  for (const std::int64_t shots : next) EXPECT_EQ(shots, 2345);
}

TEST(Engines, answer_with_theory_and_hand_over_pictures_of_which_one_is_of_times) {
  const Outcome outcome = outcome_of(engines_experiment(), "shots = 3\nstage_shots = 3");
  EXPECT_TRUE(table_of(outcome, "timings").is_timing);
  for (const Figure& figure : outcome.figures) EXPECT_EQ(figure.is_timing, figure.name == "times");
  EXPECT_TRUE(holds(outcome.answer, "theory says 93.1 %"));
}

TEST(EnginesConfig, paths_are_sorted_and_engines_keep_their_order) {
  const EnginePlan plan = engine_plan("path = [2, 0.5, 1]\nwall_size = [300, 250]\nengine = ['all']");
  EXPECT_EQ(distinct(plan.rows, [](const EngineRow& row) { return row.cell.path; }), (std::vector{0.5, 1.0, 2.0}));
  EXPECT_EQ(distinct(plan.rows, [](const EngineRow& row) { return row.cell.wall_size; }), (std::vector{300.0, 250.0}));
  EXPECT_EQ(plan.setups.back().label(), "thinwall event_driven");
}

TEST(EnginesConfig, names_the_setting_that_is_out_of_range) {
  expect_refusals(engines_experiment(),
                  {{"path = [0]", "key 'path'"},
                   {"path = [0.01]", "at least 0.0275 m"},
                   {"path = [1e6]\nwall_size = [1e6]", "key 'path'"},
                   {"step = 0", "key 'step'"},
                   {"radius = 0", "key 'radius'"},
                   {"wall_size = [100]", "at least 201 m"},
                   {"angle_deg = 90", "key 'angle_deg'"},
                   {"steps = 3", "key 'steps'"},
                   {"steps = 1001", "key 'steps'"},
                   {"shots = 0", "key 'shots'"},
                   {"swept_radius = [0]", "key 'swept_radius'"},
                   {"swept_radius = [1.5]", "key 'swept_radius'"},
                   {"motion_threshold = 0", "key 'motion_threshold'"},
                   {"substeps = [1]", "key 'substeps'"},
                   {"stage_path = 0.66", "at least 0.67 m, so that what is not stopped has passed"}});
  EXPECT_EQ(refusal_of(engines_experiment(), "stage_path = 0.67"), "");
}

TEST(EnginesConfig, an_engine_asked_for_by_name_is_there_or_refused_with_what_brings_it) {
  for (const Engine& engine : engine_list()) {
    const std::string said = refusal_of(engines_experiment(), "engine = ['" + engine.name + "']");
    if (engine.is_there()) {
      EXPECT_EQ(said, "");
    } else {
      EXPECT_TRUE(holds(said, engine.remedy));
    }
  }
}

TEST(EnginesConfig, an_engine_with_no_path_that_it_can_do_is_refused) {
  SKIP_WITHOUT("box2d");
  expect_refusals(engines_experiment(), {{"engine = ['box2d']\npath = [3, 5]", "one of at most 2 m"}});
}

// ---- The stages: what is right on each, on flights made up by hand and in our world, and what passes where only poses are looked at.

constexpr const char* one_cell = "\npath = [1]\nwall_size = [250]";

std::vector<StageRow> played(const EnginePlan& plan) {
  std::vector<StageRow> rows = plan.stages;
  for (StageRow& row : rows) row.tally = fire(row, 0, plan.stage_shots, plan.seed);
  return rows;
}

/// Where bodies that meet nothing are at the end of each step.
EngineFlights::Flight straight(const EngineShot& shot, const EngineCell& cell, std::int64_t steps) {
  EngineFlights::Flight flight;
  std::vector<BodyState> at = shot.start;
  for (std::int64_t i = 0; i < steps; ++i) {
    for (BodyState& body : at) body.position += cell.step * body.velocity;
    flight.push_back(at);
  }
  return flight;
}

TEST(EngineStages, tell_who_passes_from_who_flies_away) {
  for (const StageKind& kind : stage_kinds) {
    for (std::uint64_t i = 0; i < 200; ++i) {
      const EngineShot shot = kind.shot(meter_cell, random_words({3, 4}, i, 0));
      EXPECT_EQ(shot.start.size(), kind.stage(meter_cell).moving.size()) << kind.name;
      StageTally tally;
      EngineFlights::Flight flight = straight(shot, meter_cell, kind.steps);
      judge(kind.stage(meter_cell), shot, flight, tally);
      EXPECT_EQ(tally.passed, kind.name == "near_miss" ? 0 : 1) << kind.name << " " << i;
      EXPECT_EQ(tally.disturbed, 0) << kind.name << " " << i;

      StageTally turned;  // where it was, with the velocity that is right
      flight = {shot.start};
      if (shot.velocity) flight.back().front().velocity = *shot.velocity;
      judge(kind.stage(meter_cell), shot, flight, turned);
      EXPECT_EQ(turned.passed + turned.disturbed + turned.lost, 0) << kind.name << " " << i;
      EXPECT_EQ(turned.most_error, shot.velocity ? 0 : no_most) << kind.name << " " << i;
    }
  }
}

TEST(EngineStages, count_what_is_off_by_more_than_a_hundredth) {
  const StageKind& kind = called(stage_kinds, "near_miss");
  const EngineShot shot = kind.shot(meter_cell, random_words({3, 4}, 0, 0));
  const auto off_by = [&](double share) {
    StageTally tally;
    EngineFlights::Flight flight = {shot.start};
    flight.back().front().velocity[1] += share * shot.velocity->norm();
    judge(kind.stage(meter_cell), shot, flight, tally);
    return tally;
  };
  EXPECT_EQ(off_by(0.009).disturbed, 0);
  EXPECT_EQ(off_by(0.011).disturbed, 1);
  EXPECT_NEAR(off_by(0.5).most_error, 0.5, 1e-12);
  const StageTally lost = off_by(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(lost.lost, 1);
  EXPECT_EQ(lost.disturbed, 0);
}

TEST(EngineStages, along_a_wall_count_what_is_lost_along_it) {
  const StageKind& kind = called(stage_kinds, "tiles");
  const EngineShot shot = kind.shot(meter_cell, random_words({3, 4}, 0, 0));
  StageTally tally;
  EngineFlights::Flight flight = {shot.start};
  flight.back().front().velocity = {0, shot.velocity->y(), 0};  // stopped by the wall, not along it
  judge(kind.stage(meter_cell), shot, flight, tally);
  EXPECT_EQ(tally.disturbed, 0);
  flight.back().front().velocity[1] += 0.02 * shot.velocity->norm();
  judge(kind.stage(meter_cell), shot, flight, tally);
  EXPECT_EQ(tally.disturbed, 1);
}

TEST(EngineStages, are_played_without_fault_by_ours_where_it_sweeps_and_to_theory_where_it_looks_at_poses) {
  const EnginePlan plan = engine_plan(std::string("engine = ['thinwall']") + one_cell, 500);
  std::vector<StageRow> rows = played(plan);
  EXPECT_EQ(rows.size(), 4U * 7) << "four modes; no mesh";
  EXPECT_TRUE(all_passed(self_test(own_counts({}, rows))));
  std::int64_t passed = 0;
  for (const StageRow& row : rows) {
    EXPECT_EQ(row.tally.shots, 500);
    EXPECT_EQ(row.tally.lost, 0);
    if (row.setup->mode.name == "discrete") passed += row.tally.passed;
  }
  EXPECT_GT(passed, 1000) << "the foil lets bodies pass";
  for (StageRow& row : rows) {
    if (row.setup->mode.exact && row.kind->name == "near_miss") row.tally.disturbed = 1;
  }
  EXPECT_FALSE(all_passed(self_test(own_counts({}, rows)))) << "one that is disturbed is too many";
}

/// Of two volleys, in the first of which a step took 2 us and in the second 4.
TEST(EngineStages, take_as_long_a_step_as_the_volleys_say) {
  const EnginePlan plan = engine_plan(std::string("engine = ['thinwall']\nstage = ['head_on']") + one_cell);
  std::vector<StageRow> rows = plan.stages;
  StageTally fast, slow;
  fast.shots = slow.shots = 1000;
  fast.seconds = 2e-6 * static_cast<double>(1000 * rows[0].steps());
  slow.seconds = 2 * fast.seconds;
  add_results({{0, 0, 1000}, {0, 1000, 1000}}, std::vector{fast, slow}, rows);
  EXPECT_EQ(rows[0].tally.shots, 2000);
  EXPECT_NEAR(median(rows[0].nanoseconds), 3000, 1e-6);
}

/// At walls and on stages; but mujoco's contacts are springs, which give way.
TEST(EngineStages, and_walls_follow_theory_in_npm_engines_that_look_at_poses) {
  std::string missing;
  std::vector<CellCount> walls, stages;
  for (const Engine& engine : npm_engines()) {
    if (!engine.is_there()) missing += " " + engine.called;
    if (!engine.is_there() || engine.name == "mujoco") continue;
    const std::string alone = "engine = ['" + engine.name + "']";
    const EnginePlan plan = engine_plan(alone + std::string(few_engine_shots));
    for (const EngineRow& row : fired(plan)) {
      EXPECT_EQ(row.tally.unanswered, 0) << row.setup->label();
      if (row.theory) {
        walls.push_back({row.setup->label(), "float", row.tally.shots, row.tally.wrong(), *row.theory});
      } else {
        EXPECT_EQ(row.tally.wrong(), 0) << row.setup->label();
      }
    }
    const EnginePlan staged = engine_plan(alone + "\nstage = ['head_on', 'crossing']" + one_cell, 200);
    for (const StageRow& row : played(staged)) {
      EXPECT_EQ(row.tally.unanswered, 0) << row.setup->label();
      if (row.theory) stages.push_back({row.setup->label(), "float", row.tally.shots, row.tally.passed, *row.theory});
    }
  }
  EXPECT_TRUE(all_passed(self_test(walls)));
  EXPECT_TRUE(all_passed(self_test(stages)));
  if (!missing.empty()) GTEST_SKIP() << "not in this build:" << missing << "; " << npm_engines().front().remedy;
}

}  // namespace

}  // namespace thinwall
