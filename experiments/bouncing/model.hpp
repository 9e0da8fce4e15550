#pragma once
/// A ball is dropped from a height onto a floor: the conditions, and what each policy does to the energy of its flight, in one bounce
/// after another or on and on.

#include <cmath>
#include <cstdint>
#include <vector>

#include <thinwall/experiments/bouncing/policies.hpp>
#include <thinwall/experiments/lab/factors.hpp>
#include <thinwall/experiments/lab/record.hpp>

namespace thinwall {

struct BounceCell {
  double gravity;      ///< [m/s^2] > 0
  double height;       ///< [m] > 0, of the gap that it is dropped from
  double radius;       ///< [m] > 0
  double step;         ///< [s] > 0
  double restitution;  ///< [1] in [0, 1]
};

const Factors<BounceCell>& bounce_factors();

/// Every combination of step and restitution, steps from coarse to fine; `each` units come of one. Throws UsageError.
std::vector<BounceCell> make_bounce_cells(const Settings& settings, std::size_t each = 1);

double impact_speed(const BounceCell& c);  ///< [m/s] V, of the true flight
double fall_time(const BounceCell& c);     ///< [s] V / g
double delta(const BounceCell& c);         ///< [1] g h / V: speed that gravity adds in a step, over the impact's
/// The floor is deeper than what a ball falls in a step after `bounces` of which each adds a whole g h to its speed, so that
/// a test of the pose at the end of a step sees it.
BouncingWorld world_of(const BounceCell& c, std::int64_t bounces = 1);
/// [g h / V] More than what rounding does to the energy of a flight of this many steps.
double rounding_of(const BounceCell& c);

/// The change of energy over the trials of one cell and policy, in the order of the trials.
struct BounceTally {
  std::int64_t trials = 0;
  double mean = 0;     ///< [g h / V]
  double squares = 0;  ///< [(g h / V)^2] sum of squared distances from the mean
  double least = no_least, most = no_most;

  void add(double error);  ///< Source: Welford's update
  double sigma() const { return trials > 1 ? std::sqrt(squares / static_cast<double>(trials - 1)) : 0; }
  double rms() const { return std::sqrt(mean * mean + squares / static_cast<double>(trials)); }
  static constexpr auto fields() {
    using T = BounceTally;
    return record(kept("bounces", &T::trials, "1", "Bounces at random phase."), kept("mean", &T::mean),
                  kept("squares", &T::squares), kept("least", &T::least, "g h / V", "The bounce that loses most."),
                  kept("most", &T::most, "g h / V", "The bounce that gains most."));
  }
};

/// [g h / V] Change of the flight's energy when a ball of `cell` meets the floor `phase` in (0, 1) of a step after it began.
double error_at(const BouncePolicy& policy, const BounceCell& cell, double phase);

/// One ball that bounces on and on: energy of the flight after each bounce over that of the first flight, until `bounces` or
/// until a flight has become shorter than two steps. The run begins `elapsed` in [0, 1) of a step after the drop.
std::vector<double> energies(const BouncePolicy& policy, const BounceCell& cell, double elapsed, std::int64_t bounces);

/// [m] The gap at the start of such a run, and after each step.
std::vector<double> heights(const BouncePolicy& policy, const BounceCell& cell, double elapsed, std::int64_t steps);

/// `trials` bounces at random phases: independent, the same for every policy.
BounceTally random_bounces(const BouncePolicy& policy, const BounceCell& cell, std::uint64_t seed, std::int64_t trials);

/// One ball that bounces on and on, whose phases are not random: each follows from the one before.
struct LongRunPoint {
  std::int64_t bounces = 0;
  std::int64_t runs = 0;
  double mean = 0, sigma = 0;  ///< [1]

  static constexpr auto fields() {
    using P = LongRunPoint;
    return record(kept("bounces", &P::bounces, "1", "Bounces so far."), kept("runs", &P::runs, "1", "Balls."),
                  kept("mean", &P::mean, "1", "Mean energy over the first."),
                  kept("sigma", &P::sigma, "1", "Standard deviation over the runs."));
  }
};

/// After 1, 2, 4, ... bounces, as long as every run lasts. Each run begins at a time of its own within the first step.
std::vector<LongRunPoint> long_run(const BouncePolicy& policy, const BounceCell& cell, std::uint64_t seed,
                                   std::int64_t runs, std::int64_t bounces);

}  // namespace thinwall
