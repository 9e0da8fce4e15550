#include <thinwall/experiments/engines/stages.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <thinwall/experiments/models/tunneling_theory.hpp>

namespace thinwall {

namespace {

using V = Vec3<double>;
constexpr double seam_angle_deg = 60;    ///< largest angle of incidence at a wall of pieces
constexpr double grazing_share = 0.025;  ///< of the path that leads into the wall where a ball grazes it

double speed(const StageSize& s) { return s.path / s.step; }
double front(const StageSize& s) { return -s.thickness / 2; }
double rod_radius(const StageSize& s) { return 0.4 * s.radius; }
double rod_half(const StageSize& s) { return 9 * s.radius; }

V in_plane(double angle) { return {std::cos(angle), std::sin(angle), 0}; }

// Two balls whose relative motion leads through each other's center. What they lose of it an exact bounce gives back.

EngineStage two_balls(const StageSize& s) {
  const Sphere<double> ball = {V::Zero(), s.radius};
  return {.step = s.step, .fixed = {}, .moving = {ball, ball}};
}

/// `first` and `second` are shares of the relative speed, along `ahead` and across it.
StageShot meeting(const StageSize& s, const RandomWords& words, const std::array<double, 2>& first,
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

StageShot head_on(const StageSize& s, const RandomWords& words) { return meeting(s, words, {0.5, 0}, {-0.5, 0}); }
StageShot crossing(const StageSize& s, const RandomWords& words) { return meeting(s, words, {0.5, 0.5}, {-0.5, 0.5}); }

double two_balls_theory(const StageSize& s, int poses, double skin) {
  return miss_probability(2 * s.radius + skin, s.path / poses);
}

// A wall of six pieces side by side, a meter each or more; the ball touches within its radius of where two of them meet.

constexpr int pieces = 6;

/// [m] Of a piece: no ball or pose of it comes to where the wall ends, and the shortest way out is not along it.
double side(const StageSize& s) { return std::max(1.0, 2 * (s.radius + s.thickness)); }

EngineStage tiles(const StageSize& s) {
  EngineStage stage = {.step = s.step, .fixed = {}, .moving = {Sphere<double>{V::Zero(), s.radius}}};
  for (int i = 0; i < pieces; ++i) {
    stage.fixed.emplace_back(
        Aabb<double>{{0, side(s) * (i - (pieces - 1) / 2.0), 0}, {s.thickness / 2, side(s) / 2, 2 * side(s)}});
  }
  return stage;
}

EngineStage mesh(const StageSize& s) {
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

StageShot at_seam(const StageSize& s, const RandomWords& words, const V& velocity) {
  const V touch = {front(s) - s.radius, s.radius * (2 * uniform(words[1]) - 1), 0};
  return {.start = {{touch - 2 * s.step * uniform(words[0]) * velocity, velocity}},
          .ahead = V::UnitX(),
          .beyond = -front(s),
          .velocity = V(-velocity[0], velocity[1], velocity[2])};
}

StageShot into_seam(const StageSize& s, const RandomWords& words) {
  const double angle = seam_angle_deg * (std::numbers::pi / 180) * (2 * uniform(words[2]) - 1);
  return at_seam(s, words, speed(s) * in_plane(angle));
}

StageShot along_seam(const StageSize& s, const RandomWords& words) {
  return at_seam(s, words,
                 speed(s) * in_plane((words[2] & 1U) != 0 ? std::acos(grazing_share) : -std::acos(grazing_share)));
}

double tiles_theory(const StageSize& s, int poses, double skin) {
  return mean_miss_probability(s.thickness / 2 + s.radius + skin, s.path / poses, seam_angle_deg);
}

// A rod parallel to a thin wall, and one that turns by anything up to half a turn in a step, so that every pose has any angle.

EngineStage rod_at_wall(const StageSize& s) {
  const V half = {0, rod_half(s), 0};
  return {.step = s.step,
          .fixed = {Aabb<double>{V::Zero(), {s.thickness / 2, 100 * side(s), 100 * side(s)}}},
          .moving = {Capsule<double>{-half, half, rod_radius(s)}}};
}

StageShot flat_rod(const StageSize& s, const RandomWords& words) {
  const V velocity = speed(s) * V::UnitX();
  const V touch = {front(s) - rod_radius(s), 0, 0};
  return {.start = {{touch - 2 * s.step * uniform(words[0]) * velocity, velocity}},
          .ahead = V::UnitX(),
          .beyond = -front(s),
          .velocity = -velocity};
}

StageShot spinning_rod(const StageSize& s, const RandomWords& words) {
  StageShot shot = flat_rod(s, words);
  BodyState& rod = shot.start.front();
  rod.position[0] -= rod_half(s);  // however it is turned
  rod.spin = std::numbers::pi * (2 * uniform(words[2]) - 1) / s.step * V::UnitZ();
  shot.velocity.reset();
  return shot;
}

double rod_theory(const StageSize& s, int poses, double skin) {
  return miss_probability(s.thickness / 2 + rod_radius(s) + skin, s.path / poses);
}

/// A pose at the angle a sees the wall from w/2 + r + L |cos a| on, 2 L / pi of it in the mean.
double spinning_rod_theory(const StageSize& s, int poses, double skin) {
  return miss_probability(s.thickness / 2 + rod_radius(s) + skin + 2 * rod_half(s) / std::numbers::pi, s.path / poses);
}

// Past the edge of a plate, a tenth of the radius to a radius away from it.

EngineStage plate(const StageSize& s) {
  return {.step = s.step,
          .fixed = {Aabb<double>{V::Zero(), {s.thickness / 2, side(s) / 2, 2 * side(s)}}},
          .moving = {Sphere<double>{V::Zero(), s.radius}}};
}

StageShot past_edge(const StageSize& s, const RandomWords& words) {
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

std::vector<std::string_view> stage_names() {
  std::vector<std::string_view> names;
  for (const StageKind& kind : stage_kinds()) names.push_back(kind.name);
  return names;
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

std::vector<StageRow> stage_rows(const EnginePlan& plan) {
  const EngineCell& cell = plan.cells.front();
  const StageSize size = {
      .path = plan.stage_path, .step = cell.step, .radius = cell.radius, .thickness = cell.thickness};
  std::vector<StageRow> rows;
  for (const StageKind& kind : stage_kinds()) {
    if (plan.stage_shots == 0 || std::ranges::find(plan.stages, kind.name) == plan.stages.end()) continue;
    for (const EngineSetup& setup : plan.setups) {
      const EngineMode& mode = setup.mode;
      if (!mode.play || (kind.has_mesh && !mode.has_meshes) || (kind.spins && !mode.turns)) continue;
      rows.push_back({.kind = &kind, .setup = &setup, .size = size});
      if (mode.poses_per_step > 0 && kind.theory != nullptr)
        rows.back().theory = kind.theory(size, mode.poses_per_step, mode.skin);
    }
  }
  return rows;
}

StageTally play(const StageRow& row, std::int64_t first, std::int64_t shots, std::uint64_t seed) {
  const StageSize& s = row.size;
  const std::size_t number = static_cast<std::size_t>(row.kind - stage_kinds().data());
  const RandomStream stream = {
      seed, stream_of(std::array{s.path, s.step, s.radius, s.thickness, static_cast<double>(number)})};
  std::vector<StageShot> all;
  std::vector<std::vector<BodyState>> starts;
  for (std::int64_t i = first; i < first + shots; ++i) {
    all.push_back(row.kind->shot(s, random_words(stream, static_cast<std::uint64_t>(i), 0)));
    starts.push_back(all.back().start);
  }
  StageTally tally;
  const EngineFlights flights = row.setup->mode.play(row.kind->stage(s), starts, row.kind->steps);
  for (std::size_t i = 0; i < flights.shots.size(); ++i) judge(*row.kind, all[i], flights.shots[i], tally);
  tally.seconds = flights.seconds;
  tally.unanswered = shots - std::ssize(flights.shots);
  return tally;
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
