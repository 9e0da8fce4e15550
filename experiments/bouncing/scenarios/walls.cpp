/// A ball between walls: several at one instant, and a gap that holds a million bounces.
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>

#include <fmt/format.h>

#include <thinwall/experiments/bouncing/impacts.hpp>
#include <thinwall/experiments/bouncing/scenarios.hpp>

namespace thinwall {

namespace {

/// A wall of 2 m at rest whose face, towards the origin, lies `at` > 0 m along the axis; 16 m wide.
FlyingWall wall_across(int axis, double at) {
  FlyingWall wall = {{Vec3<double>::Zero(), Vec3<double>::Constant(8)}, Vec3<double>::Zero()};
  wall.shape.half_extents[axis] = 1;
  wall.shape.center[axis] = at + 1;
  return wall;
}

/// Flies a ball of radius 1/2 at (3, 1, 2) m/s (only its first `count` speeds) into faces it reaches after half a second.
BounceScenario corner(int count) {
  const Vec3<double> speeds = {3, 1, 2};
  std::vector<int> order;
  for (int axis = 0; axis < count; ++axis) order.push_back(axis);
  std::set<std::array<double, 7>> ends;  // impacts, position, speed: of every order
  do {
    FlyingBall ball = {{Vec3<double>::Zero(), 0.5}, Vec3<double>::Zero()};
    std::vector<FlyingWall> walls;
    for (const int axis : order) {
      ball.velocity[axis] = speeds[axis];
      walls.push_back(wall_across(axis, 0.5 + speeds[axis] / 2));
    }
    const auto impacts = static_cast<double>(fly_between(ball, walls, 1));
    const Vec3<double>&p = ball.shape.center, &v = ball.velocity;
    ends.insert({impacts, p.x(), p.y(), p.z(), v.x(), v.y(), v.z()});
  } while (std::next_permutation(order.begin(), order.end()));
  std::array<double, 7> expected = {static_cast<double>(count), 0, 0, 0, 0, 0, 0};
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(count); ++axis) {
    expected[4 + axis] = -speeds[static_cast<int>(axis)];
  }
  const std::array<double, 7>& end = *ends.begin();
  return {fmt::format("{} walls hit at one instant", count),
          fmt::format("{} speeds turn, and it is back at the start; the same in every order of the walls", count),
          fmt::format("speed ({:g}, {:g}, {:g}), place ({:g}, {:g}, {:g}); {}", end[4], end[5], end[6], end[1], end[2],
                      end[3], ends.size() == 1 ? "the same in every order" : "orders DIFFER"),
          ends.size() == 1 && end == expected};
}

BounceScenario fixed_gap() {
  constexpr double play = 0x1p-20, start = 0x1p-22, radius = 0.5;
  FlyingBall ball = {{{start, 0, 0}, radius}, {1, 0, 0}};
  std::array<FlyingWall, 2> walls = {wall_across(0, play + radius), wall_across(0, radius)};
  walls[1].shape.center.x() *= -1;
  const std::int64_t impacts = fly_between(ball, walls, 1);
  return {"ping-pong in a gap with 2^-20 m of play, 1 s at 1 m/s",
          "2^20 = 1048576 bounces, and at 2^-22 m again, exactly: the path unfolded",
          fmt::format("{} bounces, at 2^{:g} m, speed {:g} m/s", impacts, std::log2(ball.shape.center.x()),
                      ball.velocity.x()),
          impacts == 1 << 20 && ball.shape.center.x() == start && ball.velocity.x() == 1};
}

/// A point starts at a plate at 0, and another plate comes in. Each round trip adds 2 u to its speed v, and the gap that it
/// finds back at the plate is gap * v / (v + 2 u): their product stays. Derived in docs/bouncing.md.
BounceScenario closing_gap() {
  constexpr double gap = 0x1p-20, closing = 0x1p-4;
  constexpr int trips = 1 << 13;
  const auto plate = [](double x, double speed) { return FlyingWall{{{x, 0, 0}, {0, 8, 8}}, {-speed, 0, 0}}; };
  FlyingBall point = {{Vec3<double>::Zero(), 0}, {1, 0, 0}};
  FlyingWall still = plate(0, 0), coming = plate(gap, closing);
  int impacts = 0;
  for (; impacts < 2 * trips; ++impacts) {
    FlyingWall& next = impacts % 2 == 0 ? coming : still;
    const auto toi = next_impact(point, next);
    if (!toi) break;
    point.fly(toi->time);
    coming.fly(toi->time);
    point.shape.center.x() = next.shape.center.x();  // it touches: a rounding does not add up
    point.velocity -= toi->normal * (2 * (point.velocity - next.velocity).dot(toi->normal));
  }
  const double speed = 1 + 2 * closing * trips, left = gap / speed;
  const double error = std::abs(coming.shape.center.x() / left - 1);
  // A trip rounds the gap six times, by half a unit each; the product of gap and speed keeps what it has lost.
  const double allowed = trips * 6 * 0x1p-53;
  return {fmt::format("a gap of 2^-20 m closes at 1/16 m/s, for {} round trips", trips),
          fmt::format("speed {:g} m/s, gap {:.6g} m: their product at the plate stays, within {:.1e}", speed, left,
                      allowed),
          fmt::format("{} bounces, speed {:g} m/s, gap {:.6g} m, off by {:.1e} of it", impacts, point.velocity.x(),
                      coming.shape.center.x(), error),
          impacts == 2 * trips && point.velocity.x() == speed && error <= allowed};
}

}  // namespace

std::vector<BounceScenario> corner_scenarios() { return {corner(2), corner(3)}; }
std::vector<BounceScenario> gap_scenarios() { return {fixed_gap(), closing_gap()}; }

}  // namespace thinwall
