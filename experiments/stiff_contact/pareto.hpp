#pragma once
/// Who is cheapest at which error: the race, compared.

#include <vector>

#include <thinwall/experiments/statistics.hpp>
#include <thinwall/experiments/stiff_contact/race.hpp>
#include <thinwall/experiments/table.hpp>

namespace thinwall {

/// [ns] A bounce: the median over the rounds, with its 95 % bootstrap interval.
struct BounceTime {
  double median;
  Interval interval;
};
BounceTime bounce_time(const StiffRacer& racer);

/// Of those of one damping ratio, all of whose bounces returned: whom nobody beats in both error and time, from the finest
/// to the coarsest.
std::vector<const StiffRacer*> stiff_front(const std::vector<StiffRacer>& racers, double ratio);

/// The cheapest of a scheme and detection with an error of at most `error`, or null.
const StiffRacer* cheapest(const std::vector<StiffRacer>& racers, double ratio, Scheme scheme, Detection detection,
                           double error);

}  // namespace thinwall
