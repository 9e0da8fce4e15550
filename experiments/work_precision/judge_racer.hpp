#pragma once
/// One method at one setting, on the same queries as every other: what it gets wrong, and by how much.

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include <thinwall/experiments/statistics.hpp>
#include <thinwall/experiments/work_precision/racer.hpp>
#include <thinwall/experiments/work_precision/timed_query.hpp>

namespace thinwall {

inline ErrorSpread spread_of(std::span<const double> errors) {
  if (errors.empty()) return {};
  return {quantile(errors, 0.5), quantile(errors, 0.99), quantile(errors, 1)};
}

/// Fills in all of `racer` but its name and times.
template <class Method, class A, class B>
void judge_racer(const Method& method, std::span<const TimedQuery<A, B>> queries, Racer& racer) {
  using S = typename A::Scalar;
  constexpr double unit = static_cast<double>(std::numeric_limits<S>::epsilon()) / 2;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<double> times, lengths;
  std::int64_t evaluations = 0;
  racer.latest = -infinity;
  racer.earliest = infinity;
  for (const TimedQuery<A, B>& q : queries) {
    const Toi<S> toi = time_of_impact(method, q.a, q.b);
    ++racer.queries;
    evaluations += toi.evaluations;
    racer.most_evaluations = std::max(racer.most_evaluations, std::int64_t{toi.evaluations});
    const bool says_hit = toi.status == ToiStatus::hit || toi.status == ToiStatus::overlapping;
    const bool says_apart = toi.status == ToiStatus::apart;
    racer.touching += q.touches ? 1 : 0;
    racer.gave_up += says_hit || says_apart ? 0 : 1;
    racer.false_hits += says_hit && !q.touches ? 1 : 0;
    racer.missed += says_apart && q.touches ? 1 : 0;
    if (!q.touches) continue;
    const double late = says_hit ? static_cast<double>(static_cast<long double>(toi.time) - q.time) : infinity;
    times.push_back(std::abs(late));
    lengths.push_back(std::abs(late) * q.path);
    if (!says_hit) continue;
    racer.latest = std::max(racer.latest, late);
    racer.earliest = std::min(racer.earliest, late);
    racer.forward = std::max(racer.forward, std::abs(late) / (unit * q.conditioning));
  }
  racer.time = spread_of(times);
  racer.length = spread_of(lengths);
  racer.evaluations = static_cast<double>(evaluations) / static_cast<double>(std::max<std::int64_t>(1, racer.queries));
}

}  // namespace thinwall
