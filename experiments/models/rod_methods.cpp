#include <thinwall/experiments/models/rod_methods.hpp>

#include <algorithm>

#include <fmt/format.h>

#include <thinwall/swept/turning/turning_impact.hpp>

namespace thinwall {

namespace {

using Chance = std::optional<double>;

double pose_theory(const RodFlight& c, int poses) {
  return rod_miss_probability(clearance(c), reach(c), step_length(c) / poses, radians(c.spin_deg) / poses);
}
double pose_theory(const BladePass& c, int poses) {
  return blade_miss_probability(2 * half_window(c), radians(c.post_spin_deg) / poses);
}

// Which theory is whose, at the wall and at the post. A method that is not named here has none, and its cells say so.

template <class Method> Chance rod_theory(const Method&, const auto&) { return {}; }
Chance rod_theory(const EndOfStep<double>&, const auto& cell) { return pose_theory(cell, 1); }
Chance rod_theory(const Substeps<double>& method, const auto& cell) { return pose_theory(cell, method.n); }
Chance rod_theory(const LinearSweep<double>&, const RodFlight&) {
  return 0;
}  // the sweeps join, across the wall's middle
Chance rod_theory(const LinearSweep<double>&, const BladePass& cell) {
  return pose_theory(cell, 1);
}  // no path: a pose
Chance rod_theory(const Speculative<double>&, const auto&) { return 0; }
Chance rod_theory(const ConservativeAdvancement<double>&, const auto&) { return 0; }

template <class Method> RodClaims claims_of(const Method&) { return {}; }
RodClaims claims_of(const EndOfStep<double>&) { return {.never_late = false, .most_gap = 0}; }
RodClaims claims_of(const Substeps<double>&) { return {.never_late = false, .most_gap = 0}; }
RodClaims claims_of(const Speculative<double>&) { return {.never_late = true, .most_gap = {}}; }
RodClaims claims_of(const ConservativeAdvancement<double>& method) {
  return {.never_late = true, .most_gap = method.tolerance};
}

template <class Method> std::vector<Method> variants_of(const Method& method, std::span<const std::int64_t>) {
  return {method};
}
std::vector<Substeps<double>> variants_of(const Substeps<double>&, std::span<const std::int64_t> poses) {
  std::vector<Substeps<double>> all;
  for (const std::int64_t n : poses) all.push_back({.n = static_cast<int>(n)});
  return all;
}

template <class Method> std::string variant_name(const Method&) { return std::string(Method::name); }
std::string variant_name(const Substeps<double>& method) {
  return fmt::format("{}_{}", Substeps<double>::name, method.n);
}

template <class Cell, class Ask>
void try_once(const Cell& cell, const RodMotion& motion, const Ask& ask, RodTally& tally) {
  constexpr double noticed = 0x1p-20;  // [steps]
  ++tally.trials;
  for (std::int64_t k = 0; k < motion.steps; ++k) {
    const Toi<double> toi = ask(step_of(motion, k));
    ++tally.steps;
    tally.evaluations += toi.evaluations;
    if (toi.status == ToiStatus::apart) continue;
    if (toi.status != ToiStatus::hit && toi.status != ToiStatus::overlapping) {
      ++tally.undecided;
      return;
    }
    const long double time = static_cast<long double>(k) + static_cast<long double>(toi.time);
    const auto late = static_cast<double>(time - motion.contact);
    const double gap = gap_at(cell, motion, time);
    if (motion.contact > static_cast<long double>(k + 1) + noticed) ++tally.false_hits;
    if (late > noticed) ++tally.late;
    tally.lateness.add(late);
    tally.latest = std::max(tally.latest, late);
    tally.earliest = std::min(tally.earliest, late);
    tally.widest = std::max(tally.widest, gap);
    tally.deepest = std::min(tally.deepest, gap);
    return;
  }
  ++tally.tunneled;
}

template <class Cell, class Ask>
RodTally try_all(const Cell& cell, std::uint64_t seed, std::int64_t first, std::int64_t trials, const Ask& ask) {
  RodTally tally;
  const RandomStream stream = random_stream(cell, seed);
  for (std::int64_t i = first; i < first + trials; ++i)
    try_once(cell, random_motion(cell, stream, static_cast<std::uint64_t>(i)), ask, tally);
  return tally;
}

}  // namespace

std::vector<std::string_view> rod_method_names() {
  std::vector<std::string_view> names;
  for_each_type(TurningMethods<double>{}, [&]<class Method>(TypeTag<Method>) { names.push_back(Method::name); });
  return names;
}

std::vector<RodMethod> rod_methods(std::span<const std::string> names, std::span<const std::int64_t> substeps) {
  std::vector<RodMethod> all;
  for_each_type(TurningMethods<double>{}, [&]<class Method>(TypeTag<Method>) {
    if (std::ranges::find(names, Method::name) == names.end()) return;
    for (const Method& method : variants_of(Method{}, substeps)) {
      const auto ask = [method](const auto& rod, const auto& obstacle) {
        return time_of_impact(method, rod, obstacle);
      };
      const auto theory = [method](const auto& cell) { return rod_theory(method, cell); };
      all.push_back({variant_name(method), claims_of(method), ask, ask, theory, theory});
    }
  });
  return all;
}

RodTally fly(const RodFlight& c, const RodMethod& method, std::int64_t flights, std::uint64_t seed,
             std::int64_t first) {
  const auto ask = [&, obstacle = wall(c)](const auto& rod) { return method.at_wall(rod, obstacle); };
  return try_all(c, seed, first, flights, ask);
}

RodTally pass(const BladePass& c, const RodMethod& method, std::int64_t passes, std::uint64_t seed) {
  const auto ask = [&, obstacle = post(c)](const auto& blade) { return method.at_post(blade, obstacle); };
  return try_all(c, seed, 0, passes, ask);
}

}  // namespace thinwall
