#pragma once
/// Intervals for counts: what a number of hits in a number of trials says about a probability, and the other way round.

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

#include <thinwall/experiments/lab/random.hpp>

namespace thinwall {

struct Interval {
  double lower;
  double upper;
  bool contains(double x) const { return lower <= x && x <= upper; }
};

/// Of the interval of a measured number.
inline constexpr double confidence = 0.95;

/// A number and its interval.
struct Measured {
  double value;
  Interval interval;

  Measured times(double factor) const { return {factor * value, {factor * interval.lower, factor * interval.upper}}; }
};

/// Standard deviations from the middle of a normal distribution to either end of its central 95 %.
inline constexpr double normal_95 = 1.959963984540054;

/// The mean of so many, whose standard deviation is known; without an interval where that is NaN.
inline Measured normal_mean(double mean, double deviation, std::int64_t count, double deviations = 1.96) {
  const double bar = deviations * deviation / std::sqrt(static_cast<double>(count));
  return {mean, {mean - bar, mean + bar}};
}

/// For a curve: the Wilson score interval of a probability, after `successes` in `trials` >= 1 independent trials.
/// Covers the true probability `confidence` of the time on average; at the ends it is exactly 0 and exactly 1.
/// Source: derived in docs/tunneling_theory.md.
Interval wilson(std::int64_t successes, std::int64_t trials);

/// The share that a part, counted or expected, is of the whole; nothing where that is none.
std::optional<double> share_of(auto part, auto whole) {
  return whole > 0 ? std::optional(static_cast<double>(part) / static_cast<double>(whole)) : std::nullopt;
}

/// A share of counts with that interval; nothing where there is no trial.
inline std::optional<Measured> measured_share(std::int64_t successes, std::int64_t trials) {
  const std::optional<double> share = share_of(successes, trials);
  return share ? std::optional(Measured{*share, wilson(successes, trials)}) : std::nullopt;
}

/// For a claim, such as "none seen": the Clopper-Pearson interval, which covers the true probability at least
/// `confidence` of the time, whatever it is. Source: the beta quantiles of Boost.Math, (1 - confidence) / 2 a side.
Interval clopper_pearson(std::int64_t successes, std::int64_t trials);

/// (successes - n p) / sqrt(n p (1 - p)), for 0 < p < 1.
double standard_residual(std::int64_t successes, std::int64_t trials, double probability);

/// The least range of counts that leaves at most (1 - coverage) / 2 of Binomial(trials, probability) on either side.
Interval binomial_range(std::int64_t trials, double probability, double coverage);

/// The middle of a list, or halfway between the two in its middle. Not empty.
double median(std::span<const double> values);

/// The smallest value that at least `share` in (0, 1] of the list do not exceed. Not empty; may hold infinity, not NaN.
double quantile(std::span<const double> values, double share);

/// The percentile bootstrap interval of the median: of the medians of 1000 lists drawn from `values` with replacement.
/// Not empty. Source: Efron, "Bootstrap Methods: Another Look at the Jackknife", 1979.
Interval bootstrap_median(std::span<const double> values, const RandomStream& stream);

/// The central range of a sum of `count` >= 1 squared standard normal numbers.
Interval chi_square_range(std::int64_t count, double coverage);

}  // namespace thinwall
