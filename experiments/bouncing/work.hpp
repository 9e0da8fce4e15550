#pragma once
/// What a bounce costs. The runner's clock times units that do nothing but whole bounces, without loss and at evenly spaced
/// phases; each is repeated, in turn with all others, and the median counts.

#include <span>
#include <string>
#include <vector>

#include <thinwall/experiments/bouncing/trials.hpp>
#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/statistics.hpp>

namespace thinwall {

struct BounceSubject {
  BouncePolicy policy;
  BounceCell cell;
  int passes;  ///< through the evenly spaced phases

  std::int64_t bounces() const;
};

/// Every policy at every step of the cells, at restitution 1.
std::vector<BounceSubject> bounce_subjects(const std::vector<BounceCell>& cells,
                                           const std::vector<BouncePolicy>& policies);

/// Units for `rounds` rounds over all subjects, which must outlive them.
std::vector<Unit> bounce_timing_units(const std::vector<BounceSubject>& subjects, std::int64_t rounds);

struct BounceWork {
  std::string policy;
  BounceCell cell;
  BounceTally errors;  ///< [g h / V] over the evenly spaced phases: no chance
  double nanoseconds;  ///< a bounce, from apex to apex: median over the rounds
  Interval interval;   ///< its 95 % bootstrap interval

  double mean_error() const;  ///< [1] of the energy, a bounce
  double rms_error() const;   ///< [1] the same, root of the mean square
};

/// `results` and `seconds` of the timing units, in their order.
std::vector<BounceWork> bounce_work(const std::vector<BounceSubject>& subjects, std::span<const std::string> results,
                                    std::span<const double> seconds);

}  // namespace thinwall
