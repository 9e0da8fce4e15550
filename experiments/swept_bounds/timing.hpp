#pragma once
/// What the bounds cost. The runner's clock takes the time of units that do nothing but one kind of work; each is repeated,
/// in turn with all others, and the median counts.

#include <optional>
#include <span>
#include <vector>

#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/swept_bounds/line.hpp>
#include <thinwall/experiments/table.hpp>

namespace thinwall {

/// One kind of work at one cell and bound, and the balls it is done to.
struct TimedSubject {
  SweepPair pair;
  TimedWork work;
  std::vector<Sphere<double>> balls;  ///< not empty
  int passes;                         ///< through all of them
  double reported;                    ///< [1] share of the pairs in question that the bound reports
  double false_hits;                  ///< [1] share of them that it reports and the shape does not touch

  std::int64_t tests() const { return static_cast<std::int64_t>(balls.size()) * passes; }
};

/// The pairs in question are those that a broad phase of boxes hands over: balls whose bounding box overlaps the shape's
/// swept one, the centers uniform. False hits alone are put to the closed form; a bound without any has no such subject.
std::vector<TimedSubject> timed_subjects(const std::vector<Sweep>& sweeps, const std::vector<SweptBound>& bounds,
                                         std::uint64_t seed);

/// Units for `repeats` rounds over all subjects, which must outlive them.
std::vector<Unit> timing_units(const std::vector<TimedSubject>& subjects, std::int64_t repeats);

/// What a bound costs at a cell. Times are medians.
struct SweepCost {
  Sweep sweep;
  std::string bound;
  double reported, false_hits;  ///< [1] shares of the pairs in question
  double build_ns = 0, test_ns = 0;
  std::optional<double> false_ns;               ///< the closed form on one of its false hits, if it makes any
  double pair_ns = 0;                           ///< the bound on a pair, then the closed form if reported
  double pair_lower_ns = 0, pair_upper_ns = 0;  ///< quartiles of the rounds

  /// Time spent on false hits, a pair in question.
  double wasted_ns() const { return false_hits * false_ns.value_or(0); }
};

/// `seconds` of the timing units, in their order; none if there were no repeats.
std::vector<SweepCost> sweep_costs(const std::vector<TimedSubject>& subjects, std::span<const double> seconds);

Table sweep_timings_table(const std::vector<SweepCost>& costs);  ///< the one that differs from run to run

}  // namespace thinwall
