#pragma once
/// One race: a set of queries, a class and a scalar, and all who took part; and how they compare.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/statistics.hpp>
#include <thinwall/experiments/work_precision/query_sets.hpp>

namespace thinwall {

struct Heat {
  const QuerySet* set;
  QueryClass kind;
  std::string scalar;
  std::vector<Racer> racers;
};

/// A median over the rounds, with its 95 % bootstrap interval.
struct Estimate {
  double median;
  Interval interval;
};

Estimate nanoseconds(const Racer& racer);                   ///< [ns] a query
Estimate slowdown(const Racer& racer, const Racer& other);  ///< [1] times as long as the other, round by round

/// [1] of a step: a method whose 99th percentile error is no more finds the time about as well as the scalar can say it.
double fine_error(std::string_view scalar);

/// It misses no contact of the heat and decides every query, so that its errors are all there.
bool finishes(const Racer& racer);

/// Those who finish and whom nobody beats in both 99th percentile error and time, from the finest to the coarsest.
std::vector<const Racer*> pareto_front(const Heat& heat);

/// Of every method one racer, in the order of the list: the roughest setting that is fine, or else the finest there is.
std::vector<const Racer*> one_a_method(const Heat& heat);

/// [1] The share of the misses of a heat's set and scalar that a racer of the heat calls a hit; missing if none were asked.
std::optional<double> false_share(const std::vector<Heat>& heats, const Heat& heat, const Racer& racer);

/// The racer of `ClosedForm`, what all others are held against; null if it does not take part.
const Racer* closed_form_of(const Heat& heat);

/// Those, other than the closed form, that are fine and faster than it, by more than the intervals' width.
std::vector<const Racer*> fine_and_faster(const Heat& heat);

}  // namespace thinwall
