#pragma once
/// One ball that bounces on and on without loss. Its phases are not random: each follows from the one before.

#include <string>
#include <vector>

#include <thinwall/experiments/bouncing/trials.hpp>

namespace thinwall {

/// Energy of the flight after a number of bounces over that of the first flight, over all runs that got so far.
struct LongRunPoint {
  std::int64_t bounces = 0;
  std::int64_t runs = 0;
  double mean = 0, sigma = 0;  ///< [1]
  bool operator==(const LongRunPoint&) const = default;
};

struct LongRun {
  std::string policy;
  BounceCell cell;
  int drift;                ///< [g h / V] a bounce at random phase
  double sigma;             ///< [g h / V] standard deviation of that, to first order
  double dropped_at_rest;   ///< [1] energy at the end of a run that begins with the drop itself
  std::int64_t rest_count;  ///< bounces that run lasted
  std::vector<LongRunPoint> points;
};

/// After 1, 2, 4, ... bounces, as long as every run lasts. Each run begins at a time of its own within the first step.
std::vector<LongRunPoint> long_run(const BouncePolicy& policy, const BounceCell& cell, std::uint64_t seed,
                                   std::int64_t runs, std::int64_t bounces);

LongRun make_long_run(const BouncePolicy& policy, const BounceCell& cell, std::int64_t bounces,
                      std::vector<LongRunPoint> points);

/// [1] What the mean and the standard deviation would be if every phase were random, to first order: V changes by drift g h / 2
/// a bounce.
double random_phase_mean(const LongRun& run, double bounces);
double random_phase_sigma(const LongRun& run, double bounces);

std::string to_line(const std::vector<LongRunPoint>& points);
std::vector<LongRunPoint> long_run_from_line(const std::string& line);  ///< throws std::runtime_error if it is not one

}  // namespace thinwall
