/// Bodies that hit each other head-on: masses far apart, a cradle, and the billiard that counts the digits of pi.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <thinwall/experiments/bouncing/impacts.hpp>
#include <thinwall/experiments/bouncing/scenarios.hpp>
#include <thinwall/experiments/text/numbers.hpp>

namespace thinwall {

namespace {

constexpr double u = std::numeric_limits<double>::epsilon() / 2;

/// Units of round-off between an answer and what it should be.
double rounds_off(double answer, long double expected) {
  return static_cast<double>(
      std::abs((static_cast<long double>(answer) - expected) / (expected * static_cast<long double>(u))));
}

/// A ball of mass `a` at 1 m/s hits one of mass `b` at rest; the library says when.
BounceScenario head_on(double a, double b) {
  FlyingBall first = {{{-1, 0, 0}, 0.5}, {1, 0, 0}}, second = {{{0.5, 0, 0}, 0.5}, {0, 0, 0}};
  const auto toi = next_impact(first, second);
  const LineSpeeds<double> after = after_impact({first.velocity.x(), second.velocity.x()}, a, b, 1.0);
  const long double la = a, lb = b;
  const long double back = (la - lb) / (la + lb), on = 2 * la / (la + lb);
  // v' = 1 - 2 b / (a + b): three roundings of a number up to 2 beside an answer that may be small; V' has three of its own.
  const double off =
      std::max(a == b ? std::abs(after.a) : rounds_off(after.a, back) * std::abs(static_cast<double>(back)) / 2,
               rounds_off(after.b, on));
  return {fmt::format("masses {} : {}, elastic", exact_text(a), exact_text(b)),
          fmt::format("v' = {}, V' = {}, within 4 u", rounded_text(static_cast<double>(back), 10),
                      rounded_text(static_cast<double>(on), 10)),
          fmt::format("v' = {}, V' = {}, off by {:.2g} u", rounded_text(after.a, 10), rounded_text(after.b, 10), off),
          toi && toi->time == 0.5 && off <= 4};
}

/// Of five balls of 1 m that touch in a row, the first `count` come in at 1 m/s.
BounceScenario cradle(int count) {
  bool passed = true;
  std::string speeds;
  std::int64_t impacts = 0;
  for (const bool reversed : {false, true}) {
    std::vector<FlyingBall> balls;
    for (int i = 0; i < 5; ++i) {
      const double gap = i < count ? 0.5 : 0;  // half a second before they meet the others
      balls.push_back({{{i - gap, 0, 0}, 0.5}, {i < count ? 1.0 : 0.0, 0, 0}});
    }
    if (reversed) std::reverse(balls.begin(), balls.end());
    impacts = fly_together(balls, 1);
    if (reversed) std::reverse(balls.begin(), balls.end());
    speeds.clear();
    for (int i = 0; i < 5; ++i) {
      const FlyingBall& ball = balls[static_cast<std::size_t>(i)];
      const bool leaves = i >= 5 - count;
      const double place = leaves ? i + 0.5 : i;
      passed &= ball.velocity == Vec3<double>(leaves ? 1 : 0, 0, 0) && ball.shape.center == Vec3<double>(place, 0, 0);
      speeds += (i > 0 ? " " : "") + rounded_text(ball.velocity.x(), 6);
    }
    passed &= impacts == std::int64_t{count} * (5 - count);
  }
  return {fmt::format("a cradle of five balls, {} come{} in", count, count == 1 ? "s" : ""),
          fmt::format("only the last {} leave{}, exactly; {} impacts at one instant, in either order of the list",
                      count == 1 ? "one" : std::to_string(count), count == 1 ? "s" : "", count * (5 - count)),
          fmt::format("speeds {}, {} impacts", speeds, impacts), passed};
}

constexpr std::array<std::int64_t, 8> pi_digits = {3, 31, 314, 3141, 31415, 314159, 3141592, 31415926};

template <class S> BounceScenario digits_of_pi(int digits, const char* scalar) {
  const BlockCount count = count_block_impacts<S>(digits);
  const std::int64_t expected = pi_digits[static_cast<std::size_t>(digits)];
  BounceScenario row = {fmt::format("blocks of masses 1 : 100^{} and a wall, {}", digits, scalar),
                        fmt::format("{} impacts: the digits of pi", expected), fmt::format("{} impacts", count.impacts),
                        count.impacts == expected};
  if (std::is_same_v<S, double>) {
    // Each impact rounds places of up to 4 m beside speeds of up to 10^digits.
    const double error = std::abs(count.moment - 1),
                 allowed = 8 * u * static_cast<double>(expected) * std::pow(10.0, digits);
    row.must += fmt::format("; the moment of the path, 1, stays within {:.1e}", allowed);
    row.happened += fmt::format(", moment off by {:.1e}", error);
    row.passed &= error <= allowed;
  }
  return row;
}

}  // namespace

std::vector<BounceScenario> mass_scenarios(const std::vector<double>& ratios) {
  std::vector<BounceScenario> scenarios;
  for (const double ratio : ratios) {
    scenarios.push_back(head_on(1, ratio));
    if (ratio != 1) scenarios.push_back(head_on(ratio, 1));
  }
  return scenarios;
}

std::vector<BounceScenario> cradle_scenarios() { return {cradle(1), cradle(2), cradle(3)}; }

/// The blocks never both approach: after an impact of the two, only the light one can approach the wall, and after that one,
/// only the two each other. So the speeds alone decide whether there is a next impact, and the library when.
template <class S> BlockCount count_block_impacts(int digits) {
  using Block = Moving<Aabb<S>>;
  const S mass = static_cast<S>(std::pow(100.0, digits)), half = S(1) / S(2);
  const auto block = [&](S left) { return Block{{{left + half, 0, 0}, {half, half, half}}, Vec3<S>::Zero()}; };
  const Block wall = block(S(-1));
  Block light = block(S(1)), heavy = block(S(3));
  LineSpeeds<S> speeds = {S(0), S(-1)};
  S horizon = 1;  // [s] a power of two: scales the motion without rounding
  std::int64_t impacts = 0;
  while (speeds.a < S(0) || speeds.b < speeds.a) {
    const bool at_wall = speeds.a < S(0);
    Toi<S> toi;
    for (;; horizon *= 2) {
      light.displacement.x() = speeds.a * horizon;
      heavy.displacement.x() = speeds.b * horizon;
      toi = at_wall ? time_of_impact(light, wall) : time_of_impact(light, heavy);
      if (toi.status != ToiStatus::apart) break;
    }
    light.shape.center.x() += light.displacement.x() * toi.time;
    heavy.shape.center.x() += heavy.displacement.x() * toi.time;
    if (at_wall) {
      speeds.a = -speeds.a;
    } else {
      speeds = after_impact(speeds, S(1), mass, S(1));
    }
    ++impacts;
    if (toi.time < S(1) / S(8)) horizon = std::max(S(horizon / 4), std::numeric_limits<S>::epsilon());
  }
  const auto place_light = double{light.shape.center.x()} - 0.5, place_heavy = double{heavy.shape.center.x()} - 1.5;
  return {impacts, std::abs(place_heavy * double{speeds.a} - place_light * double{speeds.b})};
}
template BlockCount count_block_impacts<float>(int);
template BlockCount count_block_impacts<double>(int);

std::vector<BounceScenario> digit_scenarios(int most) {
  std::vector<BounceScenario> scenarios;
  for (int digits = 0; digits <= std::min(most, 5); ++digits) scenarios.push_back(digits_of_pi<float>(digits, "float"));
  for (int digits = 0; digits <= most; ++digits) scenarios.push_back(digits_of_pi<double>(digits, "double"));
  return scenarios;
}

}  // namespace thinwall
