#include <thinwall/experiments/models/shot_methods.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <thinwall/experiments/lab/race.hpp>
#include <thinwall/swept/methods.hpp>
#include <thinwall/swept/time_of_impact.hpp>

namespace thinwall {

namespace {

// Which theory is whose. A method that is not named here has none, and its cells say so.

/// Contact so short against the step is lost in the rounding of a pose, and it is chance whether a pose is found in it.
bool rounding_decides(const Cell& cell, double contact) { return contact <= 0x1p-45 * step_length(cell); }

template <class Method> Theory theory_of(const Method&, const Cell&) { return {}; }
template <Scalar S> Theory theory_of(const EndOfStep<S>&, const Cell& cell) { return pose_theory(cell, 1); }
template <Scalar S> Theory theory_of(const Substeps<S>& method, const Cell& cell) {
  return pose_theory(cell, method.n);
}

template <Scalar S> Theory theory_of(const SweptVolumeRay<S>&, const Cell& cell) {
  if (cell.wall == Wall::finite) return {.probability = 0};
  return {.probability = 0,
          .lateness = center_ray_lateness(cell.radius / cosine(cell), step_length(cell)),
          .through = 0,
          .why = "0: the swept volume is seen",
          .why_late = "min(v h, r / cos a)"};
}

template <Scalar S> Theory theory_of(const CentreRay<S>&, const Cell& cell) {
  if (cell.wall == Wall::infinite) {  // no line misses the wall itself
    Theory theory = theory_of(SweptVolumeRay<S>{}, cell);
    theory.why = "0: a ray meets any infinite wall";
    return theory;
  }
  if (cell.angle_deg != 0) return {};
  return {.probability = center_ray_miss_probability(rounded_box(cell), step_length(cell))};
}

/// The track of a wall at rest is the wall: a ray from the center, and at its hit the ball is in contact. A point is
/// there on the wall's face itself.
template <Scalar S> Theory theory_of(const SweepThenConfirm<S>&, const Cell& cell) {
  if (rounding_decides(cell, cell.radius)) return {};
  Theory theory = theory_of(CentreRay<S>{}, cell);
  if (cell.wall == Wall::infinite) theory.why = "0: a wall at rest is its own track";
  return theory;
}

/// The plane before an infinite wall is the wall. Beside one that ends, the plane reaches on, and so do its hits.
template <Scalar S> Theory theory_of(const Speculative<S>&, const Cell& cell) {
  Theory theory = early_theory(cell, cell.wall == Wall::finite ? 1 : 0);
  theory.why = "0: it looks a whole step ahead";
  return theory;
}

template <Scalar S> Theory theory_of(const ConservativeAdvancement<S>& method, const Cell& cell) {
  return early_theory(cell, static_cast<double>(method.tolerance));
}
template <Scalar S> Theory theory_of(const Inclusion<S>& method, const Cell& cell) {
  return early_theory(cell, static_cast<double>(method.tolerance));
}

/// Seen before the middle of the wall, it turns back. At a rim there is no depth that is safe.
template <Scalar S> Theory theory_of(const Bisection<S>& method, const Cell& cell) {
  if (rounding_decides(cell, slab_chord(cell))) return {};
  const double latest = static_cast<double>(method.tolerance) * step_length(cell);
  Theory theory = {
      .probability = 0, .latest = latest, .why = "0: finds the least of a convex gap", .why_late = "tolerance v h"};
  if (cell.wall == Wall::infinite && latest < slab_chord(cell) / 2) theory.through = 0;
  return theory;
}

template <Scalar S> Theory theory_of(const ClosedForm<S>&, const Cell&) {
  return {
      .probability = 0, .lateness = Lateness{0, 0, 0}, .through = 0, .why = "0: exact to rounding", .why_late = "0"};
}

/// It moves into what lies along `normal`.
bool approaches(const Flight& flight, const Vec3<double>& normal) { return flight.displacement.dot(normal) > 0; }

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

/// One shot: step by step, pose k at start + k s, until the method sees a contact or the ball is past the wall.
template <Scalar S, class Method>
void fire_at(const Method& method, const Target& target, const Vec3<double>& start, Response response, Tally& tally) {
  const Moving<Aabb<S>> wall = at_rest(Aabb<S>{Vec3<S>::Zero(), target.half_extents.cast<S>()});
  const auto query = [&](const Flight& at) {
    const Sphere<S> ball{at.position.cast<S>(), static_cast<S>(target.radius)};
    return time_of_impact(method, Moving<Sphere<S>>{ball, at.displacement.cast<S>()}, wall);
  };
  ++tally.shots;
  for (std::int64_t k = 0;; ++k) {
    const Flight pose = {start + static_cast<double>(k) * target.displacement, target.displacement};
    if (has_left(target, pose)) {
      ++tally.tunneled;
      if (response == Response::bounce) ++tally.behind;
      return;
    }
    const Toi<S> toi = query(pose);
    ++tally.queries;
    tally.evaluations += toi.evaluations;
    if (toi.status == ToiStatus::apart) continue;
    if (toi.status == ToiStatus::gave_up || toi.status == ToiStatus::invalid) {
      ++tally.undecided;
      return;
    }
    const double steps = static_cast<double>(k) + static_cast<double>(toi.time);
    const double late = steps * target.step_length - path_to_contact(target, start);
    tally.lateness += std::llround(late / target.lateness_unit);
    tally.latest = std::max(tally.latest, late);
    tally.earliest = std::min(tally.earliest, late);
    const Flight seen = {start + steps * target.displacement, target.displacement};
    tally.widest = std::max(tally.widest, gap(target, seen.position));
    if (response == Response::bounce) fly_on(target, seen, toi.normal.template cast<double>(), query, tally);
    return;
  }
}

template <Scalar S, class Method> void ask_all(const Method& method, std::span<const ShotStep> steps) {
  for (const ShotStep& step : steps) {
    if constexpr (std::is_same_v<S, double>) {
      keep(time_of_impact(method, step.ball, step.wall));
    } else {
      keep(time_of_impact(method, cast<S>(step.ball), cast<S>(step.wall)));
    }
  }
}

template <Scalar S, class Method>
ThinWallMethod shot_at(const Method& method, std::string name, int poses_per_step, Response response) {
  return {std::move(name),
          std::same_as<S, float> ? "float" : "double",
          poses_per_step,
          static_cast<double>(std::numeric_limits<S>::epsilon()),
          [method, response](const Target& target, const Vec3<double>& start, Tally& tally) {
            fire_at<S>(method, target, start, response, tally);
          },
          [method](const Cell& cell) { return theory_of(method, cell); },
          [method](const ShotStep& step) -> StepAnswer {
            const Toi<S> toi = time_of_impact(method, cast<S>(step.ball), cast<S>(step.wall));
            return {toi.status, static_cast<double>(toi.time)};
          },
          [method](std::span<const ShotStep> steps) { ask_all<S>(method, steps); }};
}

template <Scalar S>
void append(std::span<const std::string> names, std::span<const std::int64_t> poses, Response response,
            std::vector<ThinWallMethod>& all) {
  for_each_type(Methods<S>{}, [&]<class Method>(TypeTag<Method>) {
    if constexpr (serves<Method, Sphere<S>, Aabb<S>>) {
      if (std::ranges::find(names, Method::name) == names.end()) return;
      if constexpr (std::same_as<Method, Substeps<S>>) {
        for (const std::int64_t n : poses) {
          const Method method = {.n = static_cast<int>(n)};
          all.push_back(shot_at<S>(method, fmt::format("{}_{}", Method::name, n), method.n, response));
        }
      } else {
        all.push_back(
            shot_at<S>(Method{}, std::string(Method::name), std::same_as<Method, EndOfStep<S>> ? 1 : 0, response));
      }
    }
  });
}

}  // namespace

Theory pose_theory(const Cell& cell, int poses_per_step) {
  const double spacing = step_length(cell) / poses_per_step;
  if (cell.wall == Wall::finite) {
    const RoundedBox box = rounded_box(cell);
    return {.probability = miss_probability(box, direction(cell), spacing),
            .through = unturned_probability(box, direction(cell), spacing)};
  }
  const double chord = slab_chord(cell);
  const bool once = poses_per_step == 1;
  return {.probability = miss_probability(chord, spacing),
          .lateness = pose_lateness(chord, spacing),
          .through = miss_probability(chord / 2, spacing),
          .why = once ? "max(0, 1 - (w + 2r) / (v h cos a))" : "max(0, 1 - n (w + 2r) / (v h cos a))",
          .why_late = once ? "min(v h, (w + 2r) / cos a)" : "min(v h / n, (w + 2r) / cos a)"};
}

Theory early_theory(const Cell& cell, double tolerance) {
  Theory theory = {.probability = 0,
                   .latest = 0,
                   .widest = tolerance * step_length(cell),
                   .why = "0: free up to its answer, proven",
                   .why_late = "0"};
  if (cell.wall == Wall::infinite) theory.through = 0;  // at a rim it may be pushed neither back nor ahead
  return theory;
}

void respond(const Target& target, const Vec3<double>& normal, Flight& flight) {
  const Sphere<double> ball{flight.position, target.radius};
  const double distance = separation(ball, Aabb<double>{Vec3<double>::Zero(), target.half_extents}).distance;
  if (distance < 0) flight.position += distance * normal;
  if (approaches(flight, normal)) flight.displacement -= 2 * flight.displacement.dot(normal) * normal;
}

bool has_left(const Target& target, const Flight& flight) {
  for (int i = 0; i < 3; ++i) {
    const double ahead = flight.displacement[i] < 0 ? -flight.position[i] : flight.position[i];
    if (flight.displacement[i] != 0 && ahead > target.half_extents[i] + target.radius) return true;
  }
  return false;
}

ShotStep random_step(const Target& target, const RandomStream& stream, std::uint64_t shot, double back) {
  const Vec3<double> start = random_start(target, stream, shot) - back * target.displacement;
  return {{Sphere<double>{start, target.radius}, target.displacement},
          at_rest(Aabb<double>{Vec3<double>::Zero(), target.half_extents})};
}

std::vector<std::string_view> method_names() {
  return type_names(Methods<double>{}, []<class M>(TypeTag<M>) { return serves<M, Sphere<double>, Aabb<double>>; });
}

std::vector<ThinWallMethod> thin_wall_methods(std::span<const std::string> names,
                                              std::span<const std::int64_t> substeps,
                                              std::span<const std::string> scalars, Response response) {
  std::vector<ThinWallMethod> all;
  for (const std::string& scalar : scalars) {
#ifndef THINWALL_DOUBLE_ALONE  // as the page is compiled, in half the time
    if (scalar == "float") append<float>(names, substeps, response, all);
#endif
    if (scalar == "double") append<double>(names, substeps, response, all);
  }
  return all;
}

std::vector<ThinWallMethod> thin_wall_methods(std::span<const std::int64_t> substeps) {
  const std::vector<std::string_view> names = method_names();
  return thin_wall_methods(std::vector<std::string>(names.begin(), names.end()), substeps,
                           std::array<std::string, 1>{"double"});
}

std::vector<Volley> volleys_of(std::int64_t shots, std::int64_t most) {
  most = std::max(most, (shots + most_volleys - 1) / most_volleys);
  std::vector<Volley> volleys;
  for (std::int64_t first = 0; first < shots; first += most) volleys.push_back({first, std::min(most, shots - first)});
  return volleys;
}

Tally fire(const Cell& cell, const ThinWallMethod& method, const Volley& volley, std::uint64_t seed) {
  const Target aimed = target(cell);
  const RandomStream stream = random_stream(cell, seed);
  Tally tally;
  for (std::int64_t i = volley.first; i < volley.first + volley.shots; ++i) {
    method.fire(aimed, random_start(aimed, stream, static_cast<std::uint64_t>(i)), tally);
  }
  return tally;
}

std::int64_t tunneled_evenly(const Cell& cell, const ThinWallMethod& method, std::uint64_t seed) {
  const Target fired = target(cell);
  // The offset's counter is one that no independent shot has.
  constexpr std::uint64_t no_trial = std::numeric_limits<std::uint64_t>::max();
  const double offset = uniform(random_words(random_stream(cell, seed), no_trial, 0)[0]);
  Tally tally;
  for (std::int64_t i = 0; i < stratified_shots; ++i) {
    const double phase = (static_cast<double>(i) + offset) / static_cast<double>(stratified_shots);
    method.fire(fired, start_at_phase(fired, phase), tally);
  }
  return tally.tunneled;
}

}  // namespace thinwall
