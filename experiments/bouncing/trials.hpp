#pragma once
/// One bounce after another, each a flight of its own from apex to apex, at a phase of its own.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/bouncing/bounce_tally.hpp>
#include <thinwall/experiments/bouncing/cell.hpp>
#include <thinwall/experiments/bouncing/theory.hpp>

namespace thinwall {

/// A way to take a step, as the loops over whole bounces see it.
struct BouncePolicy {
  std::string name;
  bool staggered;  ///< its speeds are half a step early
  int drift;       ///< [g h / V] mean change a bounce, to first order
  /// [g h / V] Change of the flight's energy when a ball of `cell` meets the floor `phase` in (0, 1) of a step after it began.
  double (*error_at)(const BounceCell& cell, double phase);
  /// One ball that bounces on and on: energy of the flight after each bounce over that of the first flight, until `bounces` or
  /// until a flight has become shorter than two steps. The run begins `elapsed` in [0, 1) of a step after the drop.
  std::vector<double> (*energies)(const BounceCell& cell, double elapsed, std::int64_t bounces);
  /// [m] The gap at the start of such a run, and after each step.
  std::vector<double> (*heights)(const BounceCell& cell, double elapsed, std::int64_t steps);
};

std::vector<BouncePolicy> bounce_policies(const std::vector<std::string>& names);  ///< in the order of the list of all
std::vector<std::string_view> bounce_policy_names();

/// `trials` bounces at random phases: independent, the same for every policy.
BounceTally random_bounces(const BouncePolicy& policy, const BounceCell& cell, std::uint64_t seed, std::int64_t trials);

/// `count` bounces at phases in the middle of `count` equal parts: no chance, and the means of a parabola but for 1 / count^2.
BounceTally even_bounces(const BouncePolicy& policy, const BounceCell& cell, std::int64_t count);

}  // namespace thinwall
