#include <thinwall/experiments/thin_wall/methods.hpp>

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

template <class Method> Theory theory_of(const Method&, const Cell&) { return {}; }
template <Scalar S> Theory theory_of(const EndOfStep<S>&, const Cell& cell) { return pose_theory(cell, 1); }
template <Scalar S> Theory theory_of(const Substeps<S>& method, const Cell& cell) {
  return pose_theory(cell, method.n);
}
template <Scalar S> Theory theory_of(const CentreRay<S>&, const Cell& cell) { return center_ray_theory(cell); }
template <Scalar S> Theory theory_of(const SweptVolumeRay<S>&, const Cell& cell) {
  return swept_volume_ray_theory(cell);
}
template <Scalar S> Theory theory_of(const SweepThenConfirm<S>&, const Cell& cell) {
  return confirmed_ray_theory(cell);
}
template <Scalar S> Theory theory_of(const Speculative<S>&, const Cell& cell) { return speculative_theory(cell); }
template <Scalar S> Theory theory_of(const ConservativeAdvancement<S>& method, const Cell& cell) {
  return early_theory(cell, static_cast<double>(method.tolerance));
}
template <Scalar S> Theory theory_of(const Bisection<S>& method, const Cell& cell) {
  return late_theory(cell, static_cast<double>(method.tolerance));
}
template <Scalar S> Theory theory_of(const Inclusion<S>& method, const Cell& cell) {
  return early_theory(cell, static_cast<double>(method.tolerance));
}
template <Scalar S> Theory theory_of(const ClosedForm<S>&, const Cell&) { return exact_theory(); }

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
    const Vec3<double> pose = start + static_cast<double>(k) * target.displacement;
    if (is_past(target, pose)) {
      ++tally.tunneled;
      if (response == Response::bounce) ++tally.behind;
      return;
    }
    const Toi<S> toi = query({pose, target.displacement});
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

/// The settings a method is run with: itself, but for the one whose number of poses is a factor of the experiment.
template <class Method> std::vector<Method> variants(const Method& method, std::span<const std::int64_t>) {
  return {method};
}
template <Scalar S> std::vector<Substeps<S>> variants(const Substeps<S>&, std::span<const std::int64_t> poses) {
  std::vector<Substeps<S>> all;
  for (const std::int64_t n : poses) all.push_back({.n = static_cast<int>(n)});
  return all;
}

template <class Method> int poses_of(const Method&) { return 0; }
template <Scalar S> int poses_of(const EndOfStep<S>&) { return 1; }
template <Scalar S> int poses_of(const Substeps<S>& method) { return method.n; }

template <class Method> std::string name_of(const Method&) { return std::string(Method::name); }
template <Scalar S> std::string name_of(const Substeps<S>& m) { return fmt::format("{}_{}", Substeps<S>::name, m.n); }

template <Scalar S>
void append(std::string_view scalar, std::span<const std::string> names, std::span<const std::int64_t> poses,
            Response response, std::vector<ThinWallMethod>& all) {
  for_each_type(Methods<S>{}, [&]<class Method>(TypeTag<Method>) {
    if constexpr (serves<Method, Sphere<S>, Aabb<S>>) {
      if (std::ranges::find(names, Method::name) == names.end()) return;
      for (const Method& method : variants(Method{}, poses)) {
        all.push_back({name_of(method), std::string(scalar), poses_of(method),
                       static_cast<double>(std::numeric_limits<S>::epsilon()),
                       [method, response](const Target& target, const Vec3<double>& start, Tally& tally) {
                         fire_at<S>(method, target, start, response, tally);
                       },
                       [method](const Cell& cell) { return theory_of(method, cell); },
                       [method](const ShotStep& step) -> StepAnswer {
                         const Toi<S> toi = time_of_impact(method, cast<S>(step.ball), cast<S>(step.wall));
                         return {toi.status, static_cast<double>(toi.time)};
                       },
                       [method](std::span<const ShotStep> steps) { ask_all<S>(method, steps); }});
      }
    }
  });
}

}  // namespace

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

std::vector<std::string_view> method_names() {
  std::vector<std::string_view> names;
  for_each_type(Methods<double>{}, [&]<class Method>(TypeTag<Method>) {
    if constexpr (serves<Method, Sphere<double>, Aabb<double>>) names.push_back(Method::name);
  });
  return names;
}

std::vector<ThinWallMethod> thin_wall_methods(std::span<const std::string> names,
                                              std::span<const std::int64_t> substeps,
                                              std::span<const std::string> scalars, Response response) {
  std::vector<ThinWallMethod> all;
  for (const std::string& scalar : scalars) {
#ifndef THINWALL_DOUBLE_ALONE  // as the page is compiled, in half the time
    if (scalar == "float") append<float>(scalar, names, substeps, response, all);
#endif
    if (scalar == "double") append<double>(scalar, names, substeps, response, all);
  }
  return all;
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

std::vector<std::int64_t> stratified_counts(const Cell& cell, std::span<const ThinWallMethod> methods,
                                            std::uint64_t seed) {
  const Target fired = target(cell);
  // The offset's counter is one that no independent shot has.
  constexpr std::uint64_t no_trial = std::numeric_limits<std::uint64_t>::max();
  const double offset = uniform(random_words(random_stream(cell, seed), no_trial, 0)[0]);
  std::vector<std::int64_t> counts;
  for (const ThinWallMethod& method : methods) {
    Tally tally;
    for (std::int64_t i = 0; i < stratified_shots; ++i) {
      const double phase = (static_cast<double>(i) + offset) / static_cast<double>(stratified_shots);
      method.fire(fired, start_at_phase(fired, phase), tally);
    }
    counts.push_back(tally.tunneled);
  }
  return counts;
}

}  // namespace thinwall
