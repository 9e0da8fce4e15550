#include <thinwall/experiments/thin_wall/detectors.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <thinwall/discrete/aabb.hpp>
#include <thinwall/discrete/sphere.hpp>
#include <thinwall/experiments/thin_wall/method_theory.hpp>
#include <thinwall/experiments/timing/interleaved.hpp>
#include <thinwall/swept/methods.hpp>
#include <thinwall/swept/time_of_impact.hpp>

namespace thinwall {

namespace {

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
void append(std::string_view scalar, std::span<const std::string> methods, std::span<const std::int64_t> poses,
            Response response, std::vector<Detector>& all) {
  for_each_type(Methods<S>{}, [&]<class Method>(TypeTag<Method>) {
    if constexpr (serves<Method, Sphere<S>, Aabb<S>>) {
      if (std::find(methods.begin(), methods.end(), Method::name) == methods.end()) return;
      for (const Method& method : variants(Method{}, poses)) {
        all.push_back({name_of(method), std::string(scalar), poses_of(method),
                       static_cast<double>(std::numeric_limits<S>::epsilon()),
                       [method, response](const Target& target, const Vec3<double>& start, Tally& tally) {
                         fire_at<S>(method, target, start, response, tally);
                       },
                       [method](const Cell& cell) { return theory_of(method, cell); },
                       [method](std::span<const ShotStep> steps) { ask_all<S>(method, steps); }});
      }
    }
  });
}

}  // namespace

std::vector<std::string_view> method_names() {
  std::vector<std::string_view> names;
  for_each_type(Methods<double>{}, [&]<class Method>(TypeTag<Method>) {
    if constexpr (serves<Method, Sphere<double>, Aabb<double>>) names.push_back(Method::name);
  });
  return names;
}

std::vector<Detector> detectors(std::span<const std::string> methods, std::span<const std::int64_t> substeps,
                                std::span<const std::string> scalars, Response response) {
  std::vector<Detector> all;
  for (const std::string& scalar : scalars) {
    if (scalar == "float") append<float>(scalar, methods, substeps, response, all);
    if (scalar == "double") append<double>(scalar, methods, substeps, response, all);
  }
  return all;
}

}  // namespace thinwall
