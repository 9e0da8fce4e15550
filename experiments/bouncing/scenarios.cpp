/// Impacts that come in crowds: each scenario is a row of the results. But for the ball on the floor, bodies fly straight between
/// impacts, and each impact comes in turn, at the time that the library finds.

#include <numbers>
#include <type_traits>
#include <utility>

#include <thinwall/experiments/bouncing/model.hpp>

namespace thinwall {

namespace {

constexpr double u = std::numeric_limits<double>::epsilon() / 2;

/// A ball, or a wall that nothing moves out of its way.
template <class Shape> struct FlyingBody {
  Shape shape;
  Vec3<double> velocity;  ///< [m/s]
  double mass = 1;        ///< [kg] of a ball
  void fly(double seconds) { shape = moved(shape, Vec3<double>(velocity * seconds)); }
};
using FlyingBall = FlyingBody<Sphere<double>>;
using FlyingWall = FlyingBody<Aabb<double>>;

/// The next impact within a second of bodies that approach each other; a pair in touch that parts is none.
template <class A, class B> std::optional<Toi<double>> next_impact(const FlyingBody<A>& a, const FlyingBody<B>& b) {
  const Toi<double> toi = time_of_impact(Moving{a.shape, a.velocity}, Moving{b.shape, b.velocity});
  const bool meets = toi.status == ToiStatus::hit || toi.status == ToiStatus::overlapping;
  if (!meets || !((a.velocity - b.velocity).dot(toi.normal) > 0)) return std::nullopt;
  return toi;
}

/// Lets balls bounce off each other and off walls at rest for `seconds`, without loss. Impacts at one instant come one after the
/// other, at times of impact of 0, until all part. Returns how many impacts there were.
std::int64_t fly(std::vector<FlyingBall>& balls, const std::vector<FlyingWall>& walls, double seconds) {
  std::int64_t impacts = 0;
  for (double left = seconds;; ++impacts) {
    FlyingBall *a = nullptr, *b = nullptr;  // that meet first; no b: a wall
    Toi<double> first = {.time = left};
    const auto look = [&](FlyingBall& ball, const auto& other, FlyingBall* other_ball) {
      const auto toi = next_impact(ball, other);
      if (!toi || toi->time > left || (a != nullptr && toi->time >= first.time)) return;
      first = *toi;
      a = &ball;
      b = other_ball;
    };
    for (auto ball = balls.begin(); ball != balls.end(); ++ball) {
      for (auto other = ball + 1; other != balls.end(); ++other) look(*ball, *other, &*other);
      for (const FlyingWall& wall : walls) look(*ball, wall, nullptr);
    }
    for (FlyingBall& ball : balls) ball.fly(first.time);
    if (a == nullptr) return impacts;
    left -= first.time;
    const Vec3<double> closing = b != nullptr ? a->velocity - b->velocity : a->velocity;
    const Vec3<double> change = first.normal * (2 * closing.dot(first.normal));
    // The change of each is its own product, so that neither is lost beside the other at any ratio of the masses.
    a->velocity -= (b != nullptr ? b->mass / (a->mass + b->mass) : 1) * change;
    if (b != nullptr) b->velocity += a->mass / (a->mass + b->mass) * change;
  }
}

// One ball on the floor: bounces that pile up, and rest.

/// A ball dropped from 1 m at g = 2 m/s^2 with restitution 1/2 bounces at 1, 2, 2.5, 2.75, ... s, without end before 3 s.
/// Followed by steps of 1/4 s on the exact arc.
BounceScenario zeno() {
  const BouncingWorld world = {2, 0.5, 0.25, floor_of_depth(8)};
  BouncingBall ball = ball_at(1, 0, 0.5);
  std::vector<double> times;
  for (int step = 0; step < 40; ++step) follow_arc(world, ball, [&](double time) { times.push_back(time); });
  bool exact = times.size() == 54;
  for (std::size_t n = 0; n < times.size(); ++n) exact &= times[n] == 3 - std::ldexp(1.0, 1 - static_cast<int>(n));
  const bool rests = gap_of(ball) == 0 && ball.velocity == 0;
  return {"bounces that pile up (restitution 1/2)",
          "at 3 - 2^(2-n) s, exactly; the clock stalls at 3 s with the 54th, then rest",
          fmt::format("{} bounces, the last at {} s, {}; {} at 10 s", times.size(), times.empty() ? 0 : times.back(),
                      exact ? "all exact" : "NOT all exact", rests ? "at rest" : "NOT at rest"),
          exact && rests};
}

BounceScenario rest(const BouncePolicy& policy) {
  constexpr int steps = 100000;
  const bool sinks = policy.name == "flip_only";
  const BounceCell cell = {9.81, sinks ? 1024.0 : 1.0, 0.5, 1.0 / 60, 0.25, policy};
  const BouncingWorld world = world_of(cell);
  BouncingBall ball = ball_at(0, 0, cell.radius);
  double lowest = 0, highest = 0;
  for (int i = 0; i < steps; ++i) {
    policy.step(world, ball);
    lowest = std::min(lowest, gap_of(ball));
    highest = std::max(highest, gap_of(ball));
  }
  const std::string name = fmt::format("rest on the floor, {}", policy.name);
  if (sinks) {
    // Its speed after step k is v (1 - (-e)^k) with v = e g h / (1 + e), and it sinks by (g h - the speed before) h in each.
    const double e = cell.restitution, kick = cell.gravity * cell.step, speed = e * kick / (1 + e);
    const double depth = cell.step * (steps * kick - speed * (steps - (1 - std::pow(-e, steps)) / (1 + e)));
    return {name, fmt::format("sinks: nothing pushes it out; {:.3f} m in 100 000 steps", depth),
            fmt::format("{:.3f} m", -gap_of(ball)), std::abs(gap_of(ball) + depth) <= 1e-9 * depth};
  }
  const bool exact = policy.name == "linear_toi" || policy.name == "parabola_toi";
  const double allowed = exact ? 0 : 0x1p-52 * world.floor.half_extents.y();  // of a pose that is pushed out
  return {name, fmt::format("no drift over 100 000 steps{}", exact ? ", to the bit" : " but the rounding of the floor"),
          fmt::format("{:.3g} to {:.3g} m", lowest, highest), std::max(highest, -lowest) <= allowed};
}

// A ball between walls: several at one instant, and a gap that holds a million bounces.

/// A wall of 2 m at rest whose face, towards the origin, lies `at` > 0 m along the axis; 16 m wide.
FlyingWall wall_across(int axis, double at) {
  FlyingWall wall = {{Vec3<double>::Zero(), Vec3<double>::Constant(8)}, Vec3<double>::Zero()};
  wall.shape.half_extents[axis] = 1;
  wall.shape.center[axis] = at + 1;
  return wall;
}

/// Flies a ball of radius 1/2 at (3, 1, 2) m/s, of two walls at (3, 1, 0), into faces it reaches after half a second.
BounceScenario corner(int count) {
  const Vec3<double> speeds = {3, 1, count == 3 ? 2.0 : 0.0};
  std::vector<int> order = {0, 1, 2};
  order.resize(static_cast<std::size_t>(count));
  std::vector<FlyingBall> ball;
  bool passed = true;
  do {
    ball = {{{Vec3<double>::Zero(), 0.5}, speeds}};
    std::vector<FlyingWall> walls;
    for (const int axis : order) walls.push_back(wall_across(axis, 0.5 + speeds[axis] / 2));
    passed &= fly(ball, walls, 1) == count && ball[0].velocity == -speeds && ball[0].shape.center.isZero(0);
  } while (passed && std::next_permutation(order.begin(), order.end()));
  const Vec3<double>&p = ball[0].shape.center, &v = ball[0].velocity;
  return {fmt::format("{} walls hit at one instant", count),
          fmt::format("{} speeds turn, and it is back at the start; the same in every order of the walls", count),
          fmt::format("speed ({:g}, {:g}, {:g}), place ({:g}, {:g}, {:g}); {}", v.x(), v.y(), v.z(), p.x(), p.y(),
                      p.z(), passed ? "the same in every order" : "orders DIFFER"),
          passed};
}

BounceScenario fixed_gap() {
  constexpr double play = 0x1p-20, start = 0x1p-22, radius = 0.5;
  std::vector<FlyingBall> balls = {{{{start, 0, 0}, radius}, {1, 0, 0}}};
  std::vector<FlyingWall> walls = {wall_across(0, play + radius), wall_across(0, radius)};
  walls[1].shape.center.x() *= -1;
  const std::int64_t impacts = fly(balls, walls, 1);
  const double place = balls[0].shape.center.x(), speed = balls[0].velocity.x();
  return {"ping-pong in a gap with 2^-20 m of play, 1 s at 1 m/s",
          "2^20 = 1048576 bounces, and at 2^-22 m again, exactly: the path unfolded",
          fmt::format("{} bounces, at 2^{:g} m, speed {:g} m/s", impacts, std::log2(place), speed),
          impacts == 1 << 20 && place == start && speed == 1};
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
  const double allowed = trips * 6 * u;
  return {fmt::format("a gap of 2^-20 m closes at 1/16 m/s, for {} round trips", trips),
          fmt::format("speed {:g} m/s, gap {:.6g} m: their product at the plate stays, within {:.1e}", speed, left,
                      allowed),
          fmt::format("{} bounces, speed {:g} m/s, gap {:.6g} m, off by {:.1e} of it", impacts, point.velocity.x(),
                      coming.shape.center.x(), error),
          impacts == 2 * trips && point.velocity.x() == speed && error <= allowed};
}

// Bodies that hit each other head-on: masses far apart, a cradle, and the billiard that counts the digits of pi.

/// A ball of mass `a` at 1 m/s hits one of mass `b` at rest; the library says when.
BounceScenario head_on(double a, double b) {
  std::vector<FlyingBall> balls = {{{{-1, 0, 0}, 0.5}, {1, 0, 0}, a}, {{{0.5, 0, 0}, 0.5}, {0, 0, 0}, b}};
  const bool meet_in_time = fly(balls, {}, 0.5) == 1 && balls[0].shape.center.x() == -0.5;
  const double after_a = balls[0].velocity.x(), after_b = balls[1].velocity.x();
  const long double la = a, lb = b;
  const long double back = (la - lb) / (la + lb), on = 2 * la / (la + lb);
  const auto units_off = [](double is, long double truth) { return static_cast<double>(std::abs(is - truth)) / u; };
  // v' = 1 - 2 b / (a + b): three roundings of a number up to 2 beside an answer that may be small; V' has three of its own.
  const double off = std::max(units_off(after_a, back) / 2, units_off(after_b, on) / static_cast<double>(on));
  return {fmt::format("masses {} : {}, elastic", exact_text(a), exact_text(b)),
          fmt::format("v' = {}, V' = {}, within 4 u", rounded_text(static_cast<double>(back), 10),
                      rounded_text(static_cast<double>(on), 10)),
          fmt::format("v' = {}, V' = {}, off by {:.2g} u", rounded_text(after_a, 10), rounded_text(after_b, 10), off),
          meet_in_time && off <= 4};
}

/// Of five balls of 1 m that touch in a row, the first `count` come in at 1 m/s.
BounceScenario cradle(int count) {
  bool passed = true;
  std::vector<double> speeds(5);
  std::int64_t impacts = 0;
  for (std::vector<int> order : {std::vector{0, 1, 2, 3, 4}, std::vector{4, 3, 2, 1, 0}}) {
    std::vector<FlyingBall> balls;
    for (const int i : order) {
      const double gap = i < count ? 0.5 : 0;  // half a second before they meet the others
      balls.push_back({{{i - gap, 0, 0}, 0.5}, {i < count ? 1.0 : 0.0, 0, 0}});
    }
    impacts = fly(balls, {}, 1);
    passed &= impacts == std::int64_t{count} * (5 - count);
    for (std::size_t k = 0; k < balls.size(); ++k) {
      const int i = order[k];
      const bool leaves = i >= 5 - count;
      passed &= balls[k].velocity == Vec3<double>(leaves ? 1 : 0, 0, 0) &&
                balls[k].shape.center == Vec3<double>(leaves ? i + 0.5 : i, 0, 0);
      speeds[static_cast<std::size_t>(i)] = balls[k].velocity.x();
    }
  }
  return {fmt::format("a cradle of five balls, {} come{} in", count, count == 1 ? "s" : ""),
          fmt::format("only the last {} leave{}, exactly; {} impacts at one instant, in either order of the list",
                      count == 1 ? "one" : std::to_string(count), count == 1 ? "s" : "", count * (5 - count)),
          fmt::format("speeds {:g}, {} impacts", fmt::join(speeds, " "), impacts), passed};
}

/// Impacts of a block that stands 1 m from a wall while one 100^digits times as heavy comes in at 1 m/s, and then the moment [m^2/s] of
/// the path of (heavy, light) around the corner where all three touch, |x_heavy v_light - x_light v_heavy|, which stays 1. The blocks never
/// both approach: the speeds alone decide whether there is a next impact, and the library when. Derived in docs/bouncing.md.
template <class S> std::pair<std::int64_t, double> count_block_impacts(int digits) {
  using Block = Moving<Aabb<S>>;
  const S mass = static_cast<S>(std::pow(100.0, digits)), half = S(1) / S(2);
  const auto block = [&](S left) { return Block{{{left + half, 0, 0}, {half, half, half}}, Vec3<S>::Zero()}; };
  const Block wall = block(S(-1));
  Block light = block(S(1)), heavy = block(S(3));
  S light_speed = 0, heavy_speed = -1;
  S horizon = 1;  // [s] a power of two: scales the motion without rounding
  std::int64_t impacts = 0;
  while (light_speed < S(0) || heavy_speed < light_speed) {
    const bool at_wall = light_speed < S(0);
    Toi<S> toi;
    for (;; horizon *= 2) {
      light.displacement.x() = light_speed * horizon;
      heavy.displacement.x() = heavy_speed * horizon;
      toi = at_wall ? time_of_impact(light, wall) : time_of_impact(light, heavy);
      if (toi.status != ToiStatus::apart) break;
    }
    light.shape.center.x() += light.displacement.x() * toi.time;
    heavy.shape.center.x() += heavy.displacement.x() * toi.time;
    if (at_wall) {
      light_speed = -light_speed;
    } else {
      const S closing = S(2) * (light_speed - heavy_speed), both = S(1) + mass;
      light_speed -= closing * (mass / both);
      heavy_speed += closing * (S(1) / both);
    }
    ++impacts;
    if (toi.time < S(1) / S(8)) horizon = std::max(S(horizon / 4), std::numeric_limits<S>::epsilon());
  }
  const auto place_light = double{light.shape.center.x()} - 0.5, place_heavy = double{heavy.shape.center.x()} - 1.5;
  return {impacts, std::abs(place_heavy * double{light_speed} - place_light * double{heavy_speed})};
}

template <class S> BounceScenario digits_of_pi(int digits, const char* scalar) {
  const auto [impacts, moment] = count_block_impacts<S>(digits);
  const auto expected = static_cast<std::int64_t>(std::numbers::pi * std::pow(10.0, digits));
  BounceScenario row = {fmt::format("blocks of masses 1 : 100^{} and a wall, {}", digits, scalar),
                        fmt::format("{} impacts: the digits of pi", expected), fmt::format("{} impacts", impacts),
                        impacts == expected};
  if (std::is_same_v<S, double>) {
    // Each impact rounds places of up to 4 m beside speeds of up to 10^digits.
    const double allowed = 8 * u * static_cast<double>(expected) * std::pow(10.0, digits);
    const double error = std::abs(moment - 1);
    row.must += fmt::format("; the moment of the path, 1, stays within {:.1e}", allowed);
    row.happened += fmt::format(", moment off by {:.1e}", error);
    row.passed &= error <= allowed;
  }
  return row;
}

}  // namespace

std::vector<BounceScenario> bounce_scenarios(std::string_view group, const std::vector<double>& mass_ratios,
                                             int digits) {
  std::vector<BounceScenario> all;
  if (group == "zeno") all = {zeno()};
  if (group == "walls") all = {corner(2), corner(3)};
  if (group == "gap") all = {fixed_gap(), closing_gap()};
  if (group == "cradle") all = {cradle(1), cradle(2), cradle(3)};
  if (group == "rest") {
    for (const BouncePolicy& policy : all_bounce_policies) all.push_back(rest(policy));
  } else if (group == "masses") {
    for (const double ratio : mass_ratios) {
      all.push_back(head_on(1, ratio));
      if (ratio != 1) all.push_back(head_on(ratio, 1));
    }
  } else if (group == "digits") {
    for (int more = 0; more <= std::min(digits, 5); ++more) all.push_back(digits_of_pi<float>(more, "float"));
    for (int more = 0; more <= digits; ++more) all.push_back(digits_of_pi<double>(more, "double"));
  }
  for (BounceScenario& scenario : all) scenario.group = group;
  return all;
}

}  // namespace thinwall
