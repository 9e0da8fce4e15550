#include <thinwall/experiments/engines/model.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <thinwall/experiments/lab/race.hpp>
#include <thinwall/experiments/lab/text.hpp>
#include <thinwall/experiments/models/shots.hpp>
#include <thinwall/experiments/models/tunneling_theory.hpp>

namespace thinwall {

namespace {

/// The lines of flight before and after the bounce meet at some time: of a ball that turns in an instant, when it turned. Its
/// distance from first contact, in steps; < 0 where the ball turns before it touches.
double lateness_of(const EngineShot& shot, const BodyState& end, double steps) {
  const double contact_at = -shot.scene.thickness / 2 - shot.scene.radius;
  const double in = shot.start.velocity[0] * shot.scene.step, out = end.velocity[0] * shot.scene.step;
  return (end.position[0] - contact_at - out * (steps - shot.contact)) / (in - out);
}

/// Where the ball would be had there been no wall, to a hundredth of its radius.
bool flew_straight(const EngineShot& shot, const BodyState& end, double steps) {
  const Vec3<double> straight = shot.start.position + steps * shot.scene.step * shot.start.velocity;
  return (end.position - straight).norm() <= shot.scene.radius / 100;
}

/// Poses lie on a grid that float holds, as thin_wall's do: a path must not be longer than this many times what it crosses.
constexpr double most_walls_a_path = 1e6;

/// What brings an engine that is not in this program.
std::string remedy(const Engine& engine) {
  return engine.remedy.empty() ? fmt::format("install {} and configure with -DTHINWALL_PEERS=ON", engine.package)
                               : engine.remedy;
}

void choose_engines(const Settings& settings, EnginePlan& plan) {
  const EngineChoices choices = {
      .swept_radius = settings.numbers("swept_radius", {.lower = 0, .upper = 1, .lower_open = true}),
      .motion_threshold = settings.number("motion_threshold", {.lower = 0, .upper = 1000, .lower_open = true}),
      .substeps = settings.integers("substeps", 2, 1000)};
  const std::vector<Engine> engines = engine_list();
  std::vector<std::string_view> allowed;
  for (const Engine& engine : engines) allowed.push_back(engine.name);
  allowed.emplace_back("all");
  const std::vector<std::string> chosen = settings.choices("engine", allowed);
  const auto asked = [&](const std::string& name) { return std::ranges::find(chosen, name) != chosen.end(); };
  for (const Engine& engine : engines) {
    if (!asked("all") && !asked(engine.name)) continue;
    if (engine.is_there()) {
      for (EngineMode& mode : engine.modes(choices)) plan.setups.push_back({engine, std::move(mode)});
    } else if (asked(engine.name)) {
      settings.complain("engine", fmt::format("only what this program was built with, and {} is not in it: {}",
                                              engine.called, remedy(engine)));
    } else {
      plan.missing.push_back(engine);
    }
  }
}

/// A ball that is not stopped is behind the wall in time.
void check_path(const Settings& settings, const EngineCell& cell) {
  const double thick = cell.thickness + 2 * cell.radius;
  const double ahead =
      cell.path * std::cos(cell.angle_deg * (std::numbers::pi / 180)) * static_cast<double>(cell.steps - 2);
  if (ahead < thick) {
    settings.complain("path", fmt::format("long enough that {} steps cross the wall at {} deg: at least {} m",
                                          cell.steps, cell.angle_deg, rounded_text(thick / ahead * cell.path, 3)));
  }
  if (cell.path > most_walls_a_path * thick) {
    settings.complain(
        "path", fmt::format("at most {} times thickness + 2 * radius: not so at {} m", most_walls_a_path, cell.path));
  }
}

void check_wall(const Settings& settings, const EngineCell& cell) {
  const double least = 2 * (static_cast<double>(cell.steps) * cell.path + 2 * (cell.radius + cell.thickness));
  if (cell.wall_size < least) {
    settings.complain("wall_size",
                      fmt::format("at least {} m, so that no ball gets round it: path is {} m, steps is {}",
                                  rounded_text(std::ceil(least), 6), cell.path, cell.steps));
  }
}

void choose_cells(const Settings& settings, EnginePlan& plan) {
  plan.cells = engine_factors().cells(settings);
  for (auto first = plan.cells.begin(); first != plan.cells.end();) {
    const auto last = std::find_if(first, plan.cells.end(),
                                   [&](const EngineCell& cell) { return cell.wall_size != first->wall_size; });
    std::sort(first, last, [](const EngineCell& a, const EngineCell& b) { return a.path < b.path; });
    first = last;
  }
  for (const EngineCell& cell : plan.cells) {
    check_path(settings, cell);
    if (cell.path == plan.cells.back().path) check_wall(settings, cell);  // the longest needs the widest
  }
  const EngineCell& shortest = plan.cells.front();
  if (std::ranges::any_of(plan.setups, [&](const EngineSetup& setup) { return setup.can_do(shortest); })) return;
  const Engine& engine = plan.setups.front().engine;
  settings.complain("path", fmt::format("one of at most {} m: {} moves nothing further in a step ({})",
                                        engine.most_path, engine.called, engine.why_most_path));
}

}  // namespace

std::vector<Engine> engine_list() {
#define THINWALL_MAKE_ENGINE(make) make(),
  std::vector<Engine> engines = {THINWALL_ENGINES(THINWALL_MAKE_ENGINE)};
#undef THINWALL_MAKE_ENGINE
  const std::vector<Engine> others = npm_engines();
  engines.insert(engines.end() - 1, others.begin(), others.end());  // ours is last
  return engines;
}

EngineStage stage_of(const EngineScene& scene) {
  const Vec3<double> half_extents = {scene.thickness / 2, scene.half_side, scene.half_side};
  return {.step = scene.step,
          .fixed = {Aabb<double>{Vec3<double>::Zero(), half_extents}},
          .moving = {Sphere<double>{Vec3<double>::Zero(), scene.radius}}};
}

const Factors<EngineCell>& engine_factors() {
  constexpr Range length = {.lower = 1e-9, .upper = 1e6, .unit = "m"};
  using C = EngineCell;
  static const Factors<C> all = factors<C>(
      numbers("wall_size", &C::wall_size, length, "Side of the wall, a square."),
      numbers("path", &C::path, length, "Path of the ball in a step."),
      number("step", &C::step, {.lower = 1e-9, .upper = 1e3, .unit = "s"}, "Time step."),
      number("radius", &C::radius, length, "Of the ball."), number("thickness", &C::thickness, length, "Of the wall."),
      number("angle_deg", &C::angle_deg, {.lower = 0, .upper = 89.9, .unit = "deg"}, "Largest angle of incidence."),
      count("steps", &C::steps, 4, 1000, "Steps that a shot is followed for."));
  return all;
}

EngineShot engine_shot(const EngineCell& cell, const RandomStream& stream, std::uint64_t trial) {
  const RandomWords words = random_words(stream, trial, 0);
  const Target fired = target({.speed = cell.path / cell.step,
                               .step = cell.step,
                               .radius = cell.radius,
                               .thickness = cell.thickness,
                               .angle_deg = cell.angle_deg * uniform(words[1]),
                               .wall = Wall::infinite,
                               .wall_size = 0});
  const Vec3<double> start = start_at_phase(fired, uniform(words[0]));
  return {.scene = {.radius = fired.radius,
                    .thickness = 2 * fired.half_extents[0],
                    .half_side = cell.wall_size / 2,
                    .step = cell.step},
          .start = {start, fired.displacement / cell.step},
          .contact = path_to_contact(fired, start) / fired.step_length};
}

RandomStream random_stream(const EngineCell& cell, std::uint64_t seed) {
  return {seed, stream_of(std::array{cell.path, cell.step, cell.radius, cell.thickness, cell.angle_deg})};
}

void judge(const EngineShot& shot, const std::vector<BodyState>& flight, EngineTally& tally) {
  ++tally.shots;
  const BodyState& end = flight.back();
  const auto steps = static_cast<double>(flight.size());
  const double half = shot.scene.thickness / 2;
  if (!end.position.allFinite() || !end.velocity.allFinite()) {
    ++tally.lost;
  } else if (end.position[0] > half) {
    ++tally.tunneled;
    if (flew_straight(shot, end, steps)) ++tally.unseen;
  } else if (end.position[0] >= -half) {
    ++tally.stuck;
  } else if (end.velocity[0] < 0) {
    ++tally.turned;
    const double lateness = lateness_of(shot, end, steps);
    const double energy = std::min(1024.0, end.velocity.squaredNorm() / shot.start.velocity.squaredNorm());
    tally.lateness.add(lateness);
    tally.energy.add(energy);
    tally.latest = std::max(tally.latest, lateness);
    tally.earliest = std::min(tally.earliest, lateness);
    tally.most_energy = std::max(tally.most_energy, energy);
    tally.least_energy = std::min(tally.least_energy, energy);
    for (const BodyState& at : flight) {
      tally.deepest = std::max(tally.deepest, at.position[0] + shot.scene.radius + half);
    }
  }
}

/// The integral of 1 / cos from 0 is ln tan(pi/4 + a/2), and beyond the angle whose cosine is depth / spacing nothing is missed.
double mean_miss_probability(double depth, double spacing, double angle_deg) {
  const double share = depth / spacing;
  if (share >= 1) return 0;
  const double most = angle_deg * (std::numbers::pi / 180);
  if (most < 1e-6) return miss_probability(depth, spacing);
  const double a = std::min(most, std::acos(share));
  return (a - share * std::log(std::tan(std::numbers::pi / 4 + a / 2))) / most;
}

double unseen_theory(const EngineCell& cell, int poses_per_step, double skin) {
  return mean_miss_probability(cell.thickness + 2 * cell.radius + 2 * skin, cell.path / poses_per_step, cell.angle_deg);
}

double through_theory(const EngineCell& cell, int poses_per_step, double skin) {
  return mean_miss_probability(cell.thickness / 2 + cell.radius + skin, cell.path / poses_per_step, cell.angle_deg);
}

EnginePlan make_engine_plan(const Settings& settings, const RunOptions& options) {
  EnginePlan plan;
  choose_engines(settings, plan);
  plan.shots = settings.trials("shots", 1, most_engine_shots, options.trials);
  const std::int64_t volleys = (plan.shots + most_shots_an_engine_volley - 1) / most_shots_an_engine_volley;
  settings.limit_cells({"path", "wall_size"}, plan.setups.size() * static_cast<std::size_t>(volleys));
  choose_cells(settings, plan);
  const std::vector<std::string_view> stages = stage_names();
  plan.stages = settings.choices_or_all("stage", stages);
  plan.stage_shots = settings.trials("stage_shots", 0, most_engine_shots, options.trials);
  plan.stage_path = settings.number("stage_path", {.lower = 1e-9, .upper = 1000, .unit = "m"});
  const double least_path = 13 * plan.cells.front().radius + 2 * plan.cells.front().thickness;
  if (plan.stage_shots > 0 && plan.stage_path < least_path) {
    settings.complain("stage_path",
                      fmt::format("at least {} m, so that what is not stopped has passed at the end of a shot; "
                                  "without stages, stage_shots is 0",
                                  rounded_text(least_path, 3)));
  }
  plan.seed = options.seed;
  return plan;
}

std::vector<std::string> missing_engines(const EnginePlan& plan) {
  std::vector<std::string> lines;
  for (const Engine& engine : plan.missing)
    lines.push_back(fmt::format("{} is left out: {}", engine.called, remedy(engine)));
  return lines;
}

std::vector<EngineRow> engine_rows(const EnginePlan& plan) {
  std::vector<EngineRow> rows;
  for (const EngineCell& cell : plan.cells) {
    for (const EngineSetup& setup : plan.setups) {
      if (!setup.can_do(cell)) continue;
      const int poses = setup.mode.poses_per_step;
      rows.push_back({cell, &setup, {}});
      if (poses > 0) rows.back().theory = through_theory(cell, poses, setup.mode.skin);
    }
  }
  return rows;
}

EngineTally fire(const EngineCell& cell, const EngineMode& mode, std::int64_t first, std::int64_t shots,
                 std::uint64_t seed) {
  const RandomStream stream = random_stream(cell, seed);
  EngineTally tally;
  if (!mode.make) {
    std::vector<EngineShot> all;
    std::vector<std::vector<BodyState>> starts;
    for (std::int64_t i = first; i < first + shots; ++i) {
      all.push_back(engine_shot(cell, stream, static_cast<std::uint64_t>(i)));
      starts.push_back({all.back().start});
    }
    const EngineFlights flights = mode.play(stage_of(all.front().scene), starts, cell.steps);
    for (std::size_t i = 0; i < flights.shots.size(); ++i) {
      std::vector<BodyState> flight;
      for (const std::vector<BodyState>& bodies : flights.shots[i]) flight.push_back(bodies.front());
      judge(all[i], flight, tally);
    }
    tally.seconds = flights.seconds;
    tally.unanswered = shots - std::ssize(flights.shots);
    return tally;
  }
  std::vector<BodyState> flight(static_cast<std::size_t>(cell.steps));
  for (std::int64_t i = first; i < first + shots; ++i) {
    const EngineShot shot = engine_shot(cell, stream, static_cast<std::uint64_t>(i));
    const auto world = mode.make(shot.scene, shot.start);
    const double start = thread_seconds();
    for (BodyState& at : flight) {
      world->step();
      at = world->ball();
    }
    tally.seconds += thread_seconds() - start;
    judge(shot, flight, tally);
  }
  return tally;
}

void add_results(const std::vector<EngineVolley>& volleys, const std::vector<EngineTally>& tallies,
                 std::vector<EngineRow>& rows) {
  for (std::size_t i = 0; i < volleys.size(); ++i) {
    EngineRow& row = rows[volleys[i].row];
    row.tally += tallies[i];
    if (tallies[i].shots > 0)
      row.nanoseconds.push_back(1e9 * tallies[i].seconds / static_cast<double>(tallies[i].shots * row.cell.steps));
  }
}

std::vector<EngineRow> rows_of(const std::vector<EngineRow>& rows, const std::string& label, double wall_size) {
  return only(rows,
              [&](const EngineRow& row) { return row.setup->label() == label && row.cell.wall_size == wall_size; });
}

std::vector<CellCount> own_counts(const std::vector<EngineRow>& rows) {
  std::vector<CellCount> counts;
  for (const EngineRow& row : rows) {
    const auto count = [&](double theory) {
      counts.push_back({row.setup->label(), "double", row.tally.shots, row.tally.wrong(), theory});
    };
    if (!row.setup->is_ours()) continue;
    if (row.theory && row.cell.wall_size == rows.front().cell.wall_size) count(*row.theory);
    if (row.setup->mode.exact) count(0);
  }
  return counts;
}

}  // namespace thinwall
