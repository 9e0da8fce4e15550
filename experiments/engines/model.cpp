#include <thinwall/experiments/engines/model.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include <thinwall/experiments/lab/text.hpp>
#include <thinwall/experiments/models/shots.hpp>
#include <thinwall/experiments/models/tunneling_theory.hpp>

namespace thinwall {

namespace {

/// The lines of flight before and after the bounce meet at some time: of a ball that turns in an instant, when it turned. Its
/// distance from first contact, in steps; < 0 where the ball turns before it touches.
double lateness_of(const EngineStage& stage, const EngineShot& shot, const BodyState& end, double steps) {
  const double contact_at = -stage.wall_half_extents()[0] - stage.ball_radius();
  const double in = shot.start[0].velocity[0] * stage.step, out = end.velocity[0] * stage.step;
  return (end.position[0] - contact_at - out * (steps - shot.contact)) / (in - out);
}

/// Where the ball would be had there been no wall, to a hundredth of its radius.
bool flew_straight(const EngineStage& stage, const EngineShot& shot, const BodyState& end, double steps) {
  const Vec3<double> straight = shot.start[0].position + steps * stage.step * shot.start[0].velocity;
  return (end.position - straight).norm() <= stage.ball_radius() / 100;
}

/// At one angle, of those that a cell has.
Target target_of(const EngineCell& cell, double angle_deg) {
  return target({.speed = cell.path / cell.step,
                 .step = cell.step,
                 .radius = cell.radius,
                 .thickness = cell.thickness,
                 .angle_deg = angle_deg,
                 .wall = Wall::infinite,
                 .wall_size = 0});
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

EngineStage wall_stage(const EngineCell& cell) {
  const Target fired = target_of(cell, 0);  // as wide at every angle
  const Vec3<double> half_extents = {fired.half_extents[0], cell.wall_size / 2, cell.wall_size / 2};
  return {.step = cell.step,
          .fixed = {Aabb<double>{Vec3<double>::Zero(), half_extents}},
          .moving = {Sphere<double>{Vec3<double>::Zero(), fired.radius}}};
}

EngineShot engine_shot(const EngineCell& cell, const RandomStream& stream, std::uint64_t trial) {
  const RandomWords words = random_words(stream, trial, 0);
  const Target fired = target_of(cell, cell.angle_deg * uniform(words[1]));
  const Vec3<double> start = start_at_phase(fired, uniform(words[0]));
  return {.start = {{start, fired.displacement / cell.step}},
          .contact = path_to_contact(fired, start) / fired.step_length};
}

RandomStream random_stream(const EngineCell& cell, std::uint64_t seed) {
  return {seed, stream_of(std::array{cell.path, cell.step, cell.radius, cell.thickness, cell.angle_deg})};
}

void judge(const EngineStage& stage, const EngineShot& shot, const EngineFlights::Flight& flight, EngineTally& tally) {
  ++tally.shots;
  const BodyState& end = flight.back()[0];
  const auto steps = static_cast<double>(flight.size());
  const double half = stage.wall_half_extents()[0];
  if (!end.position.allFinite() || !end.velocity.allFinite()) {
    ++tally.lost;
  } else if (end.position[0] > half) {
    ++tally.tunneled;
    if (flew_straight(stage, shot, end, steps)) ++tally.unseen;
  } else if (end.position[0] >= -half) {
    ++tally.stuck;
  } else if (end.velocity[0] < 0) {
    ++tally.turned;
    const double lateness = lateness_of(stage, shot, end, steps);
    const double energy = std::min(1024.0, end.velocity.squaredNorm() / shot.start[0].velocity.squaredNorm());
    tally.lateness.add(lateness);
    tally.energy.add(energy);
    tally.latest = std::max(tally.latest, lateness);
    tally.earliest = std::min(tally.earliest, lateness);
    tally.most_energy = std::max(tally.most_energy, energy);
    tally.least_energy = std::min(tally.least_energy, energy);
    for (const EngineStart& at : flight)
      tally.deepest = std::max(tally.deepest, at[0].position[0] + stage.ball_radius() + half);
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

// The stages.

namespace {

using V = Vec3<double>;
constexpr double seam_angle_deg = 60;    ///< largest angle of incidence at a wall of pieces
constexpr double grazing_share = 0.025;  ///< of the path that leads into the wall where a ball grazes it

double speed(const EngineCell& s) { return s.path / s.step; }
double front(const EngineCell& s) { return -s.thickness / 2; }
double rod_radius(const EngineCell& s) { return 0.4 * s.radius; }
double rod_half(const EngineCell& s) { return 9 * s.radius; }

V in_plane(double angle) { return {std::cos(angle), std::sin(angle), 0}; }

// Two balls whose relative motion leads through each other's center. What they lose of it an exact bounce gives back.

EngineStage two_balls(const EngineCell& s) {
  const Sphere<double> ball = {V::Zero(), s.radius};
  return {.step = s.step, .fixed = {}, .moving = {ball, ball}};
}

/// `first` and `second` are shares of the relative speed, along `ahead` and across it.
StageShot meeting(const EngineCell& s, const RandomWords& words, const std::array<double, 2>& first,
                  const std::array<double, 2>& second) {
  const double turned = 2 * std::numbers::pi * uniform(words[1]);
  const V ahead = in_plane(turned), across = in_plane(turned + std::numbers::pi / 2);
  const V u = speed(s) * (first[0] * ahead + first[1] * across),
          v = speed(s) * (second[0] * ahead + second[1] * across);
  const double wait = 2 * s.step * uniform(words[0]);  // until they touch
  return {.start = {{-s.radius * ahead - wait * u, u}, {s.radius * ahead - wait * v, v}},
          .ahead = ahead,
          .beyond = 0,
          .velocity = u - speed(s) * ahead};
}

StageShot head_on(const EngineCell& s, const RandomWords& words) { return meeting(s, words, {0.5, 0}, {-0.5, 0}); }
StageShot crossing(const EngineCell& s, const RandomWords& words) { return meeting(s, words, {0.5, 0.5}, {-0.5, 0.5}); }

double two_balls_theory(const EngineCell& s, int poses, double skin) {
  return miss_probability(2 * s.radius + skin, s.path / poses);
}

// A wall of six pieces side by side, a meter each or more; the ball touches within its radius of where two of them meet.

constexpr int pieces = 6;

/// [m] Of a piece: no ball or pose of it comes to where the wall ends, and the shortest way out is not along it.
double side(const EngineCell& s) { return std::max(1.0, 2 * (s.radius + s.thickness)); }

EngineStage tiles(const EngineCell& s) {
  EngineStage stage = {.step = s.step, .fixed = {}, .moving = {Sphere<double>{V::Zero(), s.radius}}};
  for (int i = 0; i < pieces; ++i) {
    stage.fixed.emplace_back(
        Aabb<double>{{0, side(s) * (i - (pieces - 1) / 2.0), 0}, {s.thickness / 2, side(s) / 2, 2 * side(s)}});
  }
  return stage;
}

EngineStage mesh(const EngineCell& s) {
  EngineStage stage = {.step = s.step, .fixed = {}, .moving = {Sphere<double>{V::Zero(), s.radius}}};
  EngineMesh mesh;
  for (int i = 0; i <= pieces; ++i) {
    for (const double z : {-1.75, 2.25}) mesh.points.emplace_back(front(s), side(s) * (i - pieces / 2.0), side(s) * z);
  }
  for (int i = 0; i < pieces; ++i) {
    mesh.triangles.push_back({2 * i, 2 * i + 1, 2 * i + 2});
    mesh.triangles.push_back({2 * i + 1, 2 * i + 3, 2 * i + 2});
  }
  stage.fixed.emplace_back(std::move(mesh));
  return stage;
}

StageShot at_seam(const EngineCell& s, const RandomWords& words, const V& velocity) {
  const V touch = {front(s) - s.radius, s.radius * (2 * uniform(words[1]) - 1), 0};
  return {.start = {{touch - 2 * s.step * uniform(words[0]) * velocity, velocity}},
          .ahead = V::UnitX(),
          .beyond = -front(s),
          .velocity = V(-velocity[0], velocity[1], velocity[2])};
}

StageShot into_seam(const EngineCell& s, const RandomWords& words) {
  const double angle = seam_angle_deg * (std::numbers::pi / 180) * (2 * uniform(words[2]) - 1);
  return at_seam(s, words, speed(s) * in_plane(angle));
}

StageShot along_seam(const EngineCell& s, const RandomWords& words) {
  return at_seam(s, words,
                 speed(s) * in_plane((words[2] & 1U) != 0 ? std::acos(grazing_share) : -std::acos(grazing_share)));
}

double tiles_theory(const EngineCell& s, int poses, double skin) {
  return mean_miss_probability(s.thickness / 2 + s.radius + skin, s.path / poses, seam_angle_deg);
}

// A rod parallel to a thin wall, and one that turns by anything up to half a turn in a step, so that every pose has any angle.

EngineStage rod_at_wall(const EngineCell& s) {
  const V half = {0, rod_half(s), 0};
  return {.step = s.step,
          .fixed = {Aabb<double>{V::Zero(), {s.thickness / 2, 100 * side(s), 100 * side(s)}}},
          .moving = {Capsule<double>{-half, half, rod_radius(s)}}};
}

StageShot flat_rod(const EngineCell& s, const RandomWords& words) {
  const V velocity = speed(s) * V::UnitX();
  const V touch = {front(s) - rod_radius(s), 0, 0};
  return {.start = {{touch - 2 * s.step * uniform(words[0]) * velocity, velocity}},
          .ahead = V::UnitX(),
          .beyond = -front(s),
          .velocity = -velocity};
}

StageShot spinning_rod(const EngineCell& s, const RandomWords& words) {
  StageShot shot = flat_rod(s, words);
  BodyState& rod = shot.start.front();
  rod.position[0] -= rod_half(s);  // however it is turned
  rod.spin = std::numbers::pi * (2 * uniform(words[2]) - 1) / s.step * V::UnitZ();
  shot.velocity.reset();
  return shot;
}

double rod_theory(const EngineCell& s, int poses, double skin) {
  return miss_probability(s.thickness / 2 + rod_radius(s) + skin, s.path / poses);
}

/// A pose at the angle a sees the wall from w/2 + r + L |cos a| on, 2 L / pi of it in the mean.
double spinning_rod_theory(const EngineCell& s, int poses, double skin) {
  return miss_probability(s.thickness / 2 + rod_radius(s) + skin + 2 * rod_half(s) / std::numbers::pi, s.path / poses);
}

// Past the edge of a plate, a tenth of the radius to a radius away from it.

EngineStage plate(const EngineCell& s) {
  return {.step = s.step,
          .fixed = {Aabb<double>{V::Zero(), {s.thickness / 2, side(s) / 2, 2 * side(s)}}},
          .moving = {Sphere<double>{V::Zero(), s.radius}}};
}

StageShot past_edge(const EngineCell& s, const RandomWords& words) {
  const V velocity = speed(s) * V::UnitX();
  const double gap = s.radius * (0.1 + 0.9 * uniform(words[1]));
  const V nearest = {0, side(s) / 2 + s.radius + gap, 0};
  return {.start = {{nearest - (1 + 2 * uniform(words[0])) * s.step * velocity, velocity}},
          .ahead = V::UnitX(),
          .beyond = std::numeric_limits<double>::infinity(),
          .velocity = velocity};
}

constexpr double most_error = 0.01;  ///< [1] of the speed, that disturbs nobody

}  // namespace

const std::vector<StageKind>& stage_kinds() {
  static const std::vector<StageKind> all = {
      {"head_on", "two equal balls fly at each other", 12, false, false, false, two_balls, head_on, two_balls_theory},
      {"crossing", "two equal balls cross at a right angle and meet", 12, false, false, false, two_balls, crossing,
       two_balls_theory},
      {"tiles", "a ball flies at where two boxes of a wall meet, at up to 60 degrees", 10, false, false, true, tiles,
       into_seam, tiles_theory},
      {"tiles_grazing", "the same with a fortieth of the path leading into the wall", 10, false, false, true, tiles,
       along_seam},
      {"mesh", "a ball flies at where triangles of a wall without thickness meet, at up to 60 degrees", 10, true, false,
       true, mesh, into_seam},
      {"mesh_grazing", "the same with a fortieth of the path leading into the wall", 10, true, false, true, mesh,
       along_seam},
      {"rod", "a rod flies at a thin wall that it is parallel to", 10, false, false, false, rod_at_wall, flat_rod,
       rod_theory},
      {"rod_spinning", "the same rod turns as well, by up to half a turn in a step", 10, false, true, false,
       rod_at_wall, spinning_rod, spinning_rod_theory},
      {"near_miss", "a ball passes the edge of a plate by a tenth of its radius to a radius", 10, false, false, false,
       plate, past_edge}};
  return all;
}

void judge(const StageKind& kind, const StageShot& shot, const EngineFlights::Flight& flight, StageTally& tally) {
  ++tally.shots;
  const std::vector<BodyState>& end = flight.back();
  const bool finite =
      std::ranges::all_of(end, [](const BodyState& b) { return b.position.allFinite() && b.velocity.allFinite(); });
  if (!finite) {
    ++tally.lost;
    return;
  }
  const V from = end.size() > 1 ? end[1].position : V::Zero();
  if ((end[0].position - from).dot(shot.ahead) > shot.beyond) {
    ++tally.passed;
    return;
  }
  if (!shot.velocity) return;
  V change = end[0].velocity - *shot.velocity;
  if (kind.along_wall) change[0] = 0;
  const double error = std::min(1024.0, change.norm() / shot.start[0].velocity.norm());
  tally.error.add(error);
  tally.most_error = std::max(tally.most_error, error);
  if (error > most_error) ++tally.disturbed;
}

// What a run fires.

EnginePlan make_engine_plan(const Settings& settings, const RunOptions& options) {
  EnginePlan plan;
  choose_engines(settings, plan);
  plan.shots = settings.trials("shots", 1, most_engine_shots, options.trials);
  const std::int64_t volleys = (plan.shots + most_shots_an_engine_volley - 1) / most_shots_an_engine_volley;
  settings.limit_cells({"path", "wall_size"}, plan.setups.size() * static_cast<std::size_t>(volleys));
  choose_cells(settings, plan);
  std::vector<std::string_view> stages;
  for (const StageKind& kind : stage_kinds()) stages.push_back(kind.name);
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
      rows.push_back({cell, &setup});
      if (poses > 0) rows.back().theory = through_theory(cell, poses, setup.mode.skin);
    }
  }
  return rows;
}

std::vector<StageRow> stage_rows(const EnginePlan& plan) {
  EngineCell cell = plan.cells.front();
  cell.path = plan.stage_path;
  std::vector<StageRow> rows;
  for (const StageKind& kind : stage_kinds()) {
    if (plan.stage_shots == 0 || std::ranges::find(plan.stages, kind.name) == plan.stages.end()) continue;
    for (const EngineSetup& setup : plan.setups) {
      const EngineMode& mode = setup.mode;
      if (!mode.plays_stages || (kind.has_mesh && !mode.has_meshes) || (kind.spins && !mode.turns)) continue;
      rows.push_back({&kind, cell, &setup});
      if (mode.poses_per_step > 0 && kind.theory != nullptr)
        rows.back().theory = kind.theory(cell, mode.poses_per_step, mode.skin);
    }
  }
  return rows;
}

namespace {

/// In a row's mode. `judge(shot, flight, tally)` adds a shot to the tally.
template <class Row, class Shot, class Judge>
auto fired(const Row& row, const EngineStage& stage, const std::vector<Shot>& shots, const Judge& judge) {
  std::vector<EngineStart> starts;
  for (const Shot& shot : shots) starts.push_back(shot.start);
  const EngineFlights flights = row.setup->mode.play(stage, starts, row.steps());
  auto tally = decltype(row.tally){};
  for (std::size_t i = 0; i < flights.shots.size(); ++i) judge(shots[i], flights.shots[i], tally);
  tally.seconds = flights.seconds;
  tally.unanswered = std::ssize(shots) - std::ssize(flights.shots);
  return tally;
}

}  // namespace

EngineTally fire(const EngineRow& row, std::int64_t first, std::int64_t shots, std::uint64_t seed) {
  const RandomStream stream = random_stream(row.cell, seed);
  std::vector<EngineShot> all;
  for (std::int64_t i = first; i < first + shots; ++i)
    all.push_back(engine_shot(row.cell, stream, static_cast<std::uint64_t>(i)));
  const EngineStage stage = wall_stage(row.cell);
  return fired(row, stage, all,
               [&](const auto& shot, const auto& flight, EngineTally& tally) { judge(stage, shot, flight, tally); });
}

StageTally fire(const StageRow& row, std::int64_t first, std::int64_t shots, std::uint64_t seed) {
  const EngineCell& c = row.cell;
  const auto number = static_cast<double>(row.kind - stage_kinds().data());
  const RandomStream stream = {seed, stream_of(std::array{c.path, c.step, c.radius, c.thickness, number})};
  std::vector<StageShot> all;
  for (std::int64_t i = first; i < first + shots; ++i)
    all.push_back(row.kind->shot(c, random_words(stream, static_cast<std::uint64_t>(i), 0)));
  return fired(row, row.kind->stage(c), all,
               [&](const auto& shot, const auto& flight, StageTally& tally) { judge(*row.kind, shot, flight, tally); });
}

std::vector<std::string> drop_failed(std::vector<EngineRow>& rows, std::vector<StageRow>& stages) {
  std::vector<std::string> failed;
  const auto is_failed = [&](const auto& row) {
    return std::ranges::find(failed, row.setup->engine.called) != failed.end();
  };
  const auto look = [&](const auto& all) {
    for (const auto& row : all) {
      if (row.tally.unanswered > 0 && !is_failed(row)) failed.push_back(row.setup->engine.called);
    }
  };
  look(rows);
  look(stages);
  std::erase_if(rows, is_failed);
  std::erase_if(stages, is_failed);
  return failed;
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

std::vector<CellCount> own_counts(const std::vector<StageRow>& rows) {
  std::vector<CellCount> counts;
  for (const StageRow& row : rows) {
    if (!row.setup->is_ours()) continue;
    const StageTally& t = row.tally;
    const std::string label = row.setup->label() + " on stages";
    if (row.theory && !row.kind->spins)  // of what spins it is the least
      counts.push_back({label, "double", t.shots, t.passed + t.lost, *row.theory});
    if (row.setup->mode.exact) counts.push_back({label, "double", t.shots, t.passed + t.lost + t.disturbed, 0});
  }
  return counts;
}

}  // namespace thinwall
