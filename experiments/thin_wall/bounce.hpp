#pragma once
/// What becomes of a ball that was seen: the response of an ordinary engine, with restitution 1 and a wall that stays.
///
/// The ball is put where the query saw it, pushed out of the wall along the normal by what it is in, and reflected if it
/// approaches. The normal of a pose in the wall is the one of least penetration. A ball that was seen too deep is past
/// the middle, and the short way out leads ahead: it leaves with the velocity it came with, as if there were no wall.

#include <array>
#include <cstdint>
#include <string_view>

#include <thinwall/discrete/aabb.hpp>
#include <thinwall/discrete/sphere.hpp>
#include <thinwall/experiments/thin_wall/shots.hpp>
#include <thinwall/experiments/thin_wall/tally.hpp>
#include <thinwall/swept/time_of_impact.hpp>

namespace thinwall {

enum class Response { none, bounce };
inline constexpr std::array<std::string_view, 2> response_names = {"none", "bounce"};

/// A ball in flight: where its center is, and how far it goes in a step. Both in meters.
struct Flight {
  Vec3<double> position;
  Vec3<double> displacement;
};

/// It moves into what lies along `normal`.
inline bool approaches(const Flight& flight, const Vec3<double>& normal) { return flight.displacement.dot(normal) > 0; }

/// Pushes the ball out along `normal`, which points into the wall, and reflects it there if it approaches.
inline void respond(const Target& target, const Vec3<double>& normal, Flight& flight) {
  const Sphere<double> ball{flight.position, target.radius};
  const double distance = separation(ball, Aabb<double>{Vec3<double>::Zero(), target.half_extents}).distance;
  if (distance < 0) flight.position += distance * normal;
  if (approaches(flight, normal)) flight.displacement -= 2 * flight.displacement.dot(normal) * normal;
}

/// Beyond the wall on some axis and moving away, as is_past() says of a shot.
inline bool has_left(const Target& target, const Flight& flight) {
  for (int i = 0; i < 3; ++i) {
    const double ahead = flight.displacement[i] < 0 ? -flight.position[i] : flight.position[i];
    if (flight.displacement[i] != 0 && ahead > target.half_extents[i] + target.radius) return true;
  }
  return false;
}

/// Flies on from `flight`, where a query saw the ball with `normal`, asking `query(flight)` for each step, until the
/// ball has left. A wall is convex: the ball meets it once, rounding aside, and after `most_responses` is given up on.
template <class Query>
void fly_on(const Target& target, Flight flight, Vec3<double> normal, const Query& query, Tally& tally) {
  constexpr int most_responses = 16;
  if (!approaches(flight, normal)) ++tally.wrong_side;
  respond(target, normal, flight);
  for (int responses = 1; responses <= most_responses && !has_left(target, flight);) {
    const auto toi = query(flight);
    ++tally.queries;
    tally.evaluations += toi.evaluations;
    normal = toi.normal.template cast<double>();
    const bool seen = toi.status == ToiStatus::hit || toi.status == ToiStatus::overlapping;
    if (!seen || !approaches(flight, normal)) {
      flight.position += flight.displacement;
      continue;
    }
    flight.position += static_cast<double>(toi.time) * flight.displacement;
    respond(target, normal, flight);
    ++responses;
  }
  if (flight.displacement[0] > 0) ++tally.behind;
}

}  // namespace thinwall
