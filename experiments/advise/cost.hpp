#pragma once
/// What a step costs on this machine, method by method.

#include <span>
#include <vector>

#include <thinwall/experiments/advise/candidates.hpp>
#include <thinwall/experiments/statistics.hpp>

namespace thinwall {

struct QueryTime {
  double median;    ///< [ns]
  Interval spread;  ///< [ns] 95 %, of the median
};

/// Of one query. Which of the two kinds of steps is dearer differs from method to method.
struct StepCost {
  QueryTime clear;    ///< a step that ends before the wall
  QueryTime contact;  ///< the next one, in which the ball touches it

  const QueryTime& dearer() const { return clear.median > contact.median ? clear : contact; }
};

struct TimingEffort {
  std::int64_t queries = 2048;  ///< of each kind
  std::int64_t rounds = 61;
  double round_ns = 1e6;  ///< a method's turn in a round takes at most about this long
};

/// `result[i]` is of `candidates[i]`. Takes about a second at most.
std::vector<StepCost> measure_costs(const Cell& cell, std::span<const Candidate> candidates,
                                    const TimingEffort& effort = {});

}  // namespace thinwall
