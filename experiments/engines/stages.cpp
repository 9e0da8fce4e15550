/// What engines play: a ball at a wall, and the stages besides.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <thinwall/experiments/engines/model.hpp>
#include <thinwall/experiments/models/shots.hpp>
#include <thinwall/experiments/models/tunneling_theory.hpp>

namespace thinwall {

double unseen_theory(const EngineCell& cell, int poses_per_step, double skin) {
  return mean_miss_probability(cell.thickness + 2 * cell.radius + 2 * skin, cell.path / poses_per_step, cell.angle_deg);
}

double through_theory(const EngineCell& cell, int poses_per_step, double skin) {
  return mean_miss_probability(cell.thickness / 2 + cell.radius + skin, cell.path / poses_per_step, cell.angle_deg);
}

namespace {

using V = Vec3<double>;
constexpr double seam_angle_deg = 60;    ///< largest angle of incidence at a wall of pieces
constexpr double grazing_share = 0.025;  ///< of the path that leads into the wall where a ball grazes it

double speed(const EngineCell& s) { return s.path / s.step; }
double front(const EngineCell& s) { return -s.thickness / 2; }
double rod_radius(const EngineCell& s) { return 0.4 * s.radius; }
double rod_half(const EngineCell& s) { return 9 * s.radius; }

V in_plane(double angle) { return {std::cos(angle), std::sin(angle), 0}; }

Sphere<double> ball(const EngineCell& s) { return {V::Zero(), s.radius}; }

/// Around a place on the y axis.
Aabb<double> wall(const EngineCell& s, double y, double half_width, double half_height) {
  return {{0, y, 0}, {s.thickness / 2, half_width, half_height}};
}

/// Bounces off the wall where it touches it, which is within two steps.
EngineShot at_wall(const EngineCell& s, const RandomWords& words, const V& touch, const V& velocity) {
  return {.start = {{touch - 2 * s.step * uniform(words[0]) * velocity, velocity}},
          .ahead = V::UnitX(),
          .beyond = -front(s),
          .velocity = V(-velocity[0], velocity[1], velocity[2])};
}

// A wall and a ball, as thin_wall has them.

/// At one angle, of those that a cell has.
Target target_of(const EngineCell& cell, double angle_deg) {
  return target({.speed = speed(cell),
                 .step = cell.step,
                 .radius = cell.radius,
                 .thickness = cell.thickness,
                 .angle_deg = angle_deg});
}

EngineStage wide_wall(const EngineCell& cell) {
  const Target fired = target_of(cell, 0);  // as wide at every angle
  const V half_extents = {fired.half_extents[0], cell.wall_size / 2, cell.wall_size / 2};
  return {.step = cell.step,
          .fixed = {Aabb<double>{V::Zero(), half_extents}},
          .moving = {Sphere<double>{V::Zero(), fired.radius}}};
}

EngineShot at_an_angle(const EngineCell& cell, const RandomWords& words) {
  const Target fired = target_of(cell, cell.angle_deg * uniform(words[1]));
  const V start = start_at_phase(fired, uniform(words[0]));
  return {.start = {{start, fired.displacement / cell.step}},
          .ahead = V::UnitX(),
          .beyond = fired.half_extents[0],
          .contact = path_to_contact(fired, start) / fired.step_length};
}

// Two balls whose relative motion leads through each other's center. What they lose of it an exact bounce gives back.

EngineStage two_balls(const EngineCell& s) { return {.step = s.step, .moving = {ball(s), ball(s)}}; }

/// `drift`: of both across their relative motion, a share of it.
EngineShot meeting(const EngineCell& s, const RandomWords& words, double drift) {
  const double turned = 2 * std::numbers::pi * uniform(words[1]);
  const V ahead = in_plane(turned), across = in_plane(turned + std::numbers::pi / 2);
  const V u = speed(s) * (0.5 * ahead + drift * across), v = speed(s) * (-0.5 * ahead + drift * across);
  const double wait = 2 * s.step * uniform(words[0]);  // until they touch
  return {.start = {{-s.radius * ahead - wait * u, u}, {s.radius * ahead - wait * v, v}},
          .ahead = ahead,
          .beyond = 0,
          .velocity = u - speed(s) * ahead};
}

EngineShot head_on(const EngineCell& s, const RandomWords& words) { return meeting(s, words, 0); }
EngineShot crossing(const EngineCell& s, const RandomWords& words) { return meeting(s, words, 0.5); }

double two_balls_theory(const EngineCell& s, int poses, double skin) {
  return miss_probability(2 * s.radius + skin, s.path / poses);
}

// A wall of six pieces side by side, a meter each or more; the ball touches within its radius of where two of them meet.

constexpr int pieces = 6;

/// [m] Of a piece: no ball or pose of it comes to where the wall ends, and the shortest way out is not along it.
double side(const EngineCell& s) { return std::max(1.0, 2 * (s.radius + s.thickness)); }

EngineStage tiles(const EngineCell& s) {
  EngineStage stage = {.step = s.step, .moving = {ball(s)}};
  for (int i = 0; i < pieces; ++i)
    stage.fixed.emplace_back(wall(s, side(s) * (i - (pieces - 1) / 2.0), side(s) / 2, 2 * side(s)));
  return stage;
}

EngineStage mesh(const EngineCell& s) {
  EngineMesh mesh;
  for (int i = 0; i <= pieces; ++i) {
    for (const double z : {-1.75, 2.25}) mesh.points.emplace_back(front(s), side(s) * (i - pieces / 2.0), side(s) * z);
  }
  for (int i = 0; i < pieces; ++i) {
    mesh.triangles.push_back({2 * i, 2 * i + 1, 2 * i + 2});
    mesh.triangles.push_back({2 * i + 1, 2 * i + 3, 2 * i + 2});
  }
  return {.step = s.step, .fixed = {mesh}, .moving = {ball(s)}};
}

EngineShot at_seam(const EngineCell& s, const RandomWords& words, double angle) {
  const V touch = {front(s) - s.radius, s.radius * (2 * uniform(words[1]) - 1), 0};
  EngineShot shot = at_wall(s, words, touch, speed(s) * in_plane(angle));
  shot.along_wall = true;
  return shot;
}

EngineShot into_seam(const EngineCell& s, const RandomWords& words) {
  return at_seam(s, words, seam_angle_deg * (std::numbers::pi / 180) * (2 * uniform(words[2]) - 1));
}

EngineShot along_seam(const EngineCell& s, const RandomWords& words) {
  return at_seam(s, words, (words[2] & 1U) != 0 ? std::acos(grazing_share) : -std::acos(grazing_share));
}

double tiles_theory(const EngineCell& s, int poses, double skin) {
  return mean_miss_probability(s.thickness / 2 + s.radius + skin, s.path / poses, seam_angle_deg);
}

// A rod parallel to a thin wall, and one that turns by anything up to half a turn in a step, so that every pose has any angle.

EngineStage rod_at_wall(const EngineCell& s) {
  const V half = {0, rod_half(s), 0};
  return {.step = s.step,
          .fixed = {wall(s, 0, 100 * side(s), 100 * side(s))},
          .moving = {Capsule<double>{-half, half, rod_radius(s)}}};
}

EngineShot flat_rod(const EngineCell& s, const RandomWords& words) {
  return at_wall(s, words, {front(s) - rod_radius(s), 0, 0}, speed(s) * V::UnitX());
}

EngineShot spinning_rod(const EngineCell& s, const RandomWords& words) {
  EngineShot shot = flat_rod(s, words);
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
  return {.step = s.step, .fixed = {wall(s, 0, side(s) / 2, 2 * side(s))}, .moving = {ball(s)}};
}

EngineShot past_edge(const EngineCell& s, const RandomWords& words) {
  const V velocity = speed(s) * V::UnitX();
  const double gap = s.radius * (0.1 + 0.9 * uniform(words[1]));
  const V nearest = {0, side(s) / 2 + s.radius + gap, 0};
  return {.start = {{nearest - (1 + 2 * uniform(words[0])) * s.step * velocity, velocity}},
          .ahead = V::UnitX(),
          .beyond = std::numeric_limits<double>::infinity(),
          .velocity = velocity};
}

}  // namespace

const StageKind ball_at_wall = {"wall", "a ball flies at a wall", 0, wide_wall, at_an_angle, through_theory};

const std::vector<StageKind> stage_kinds = {
    {"head_on", "two equal balls fly at each other", 12, two_balls, head_on, two_balls_theory},
    {"crossing", "two equal balls cross at a right angle and meet", 12, two_balls, crossing, two_balls_theory},
    {"tiles", "a ball flies at where two boxes of a wall meet, at up to 60 degrees", 10, tiles, into_seam,
     tiles_theory},
    {"tiles_grazing", "the same with a fortieth of the path leading into the wall", 10, tiles, along_seam},
    {"mesh", "a ball flies at where triangles of a wall without thickness meet, at up to 60 degrees", 10, mesh,
     into_seam},
    {"mesh_grazing", "the same with a fortieth of the path leading into the wall", 10, mesh, along_seam},
    {"rod", "a rod flies at a thin wall that it is parallel to", 10, rod_at_wall, flat_rod, rod_theory},
    {"rod_spinning", "the same rod turns as well, by up to half a turn in a step", 10, rod_at_wall, spinning_rod,
     spinning_rod_theory, true},
    {"near_miss", "a ball passes the edge of a plate by a tenth of its radius to a radius", 10, plate, past_edge}};

RandomStream random_stream(const StageKind& kind, const EngineCell& cell, std::uint64_t seed) {
  const bool at_wall = &kind == &ball_at_wall;
  const double last = at_wall ? cell.angle_deg : static_cast<double>(&kind - stage_kinds.data());
  return {seed, stream_of(std::array{cell.path, cell.step, cell.radius, cell.thickness, last})};
}

}  // namespace thinwall
