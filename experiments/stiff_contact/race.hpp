#pragma once
/// Error against run time: every scheme and detection at every step, on the same bounces, timed in interleaved rounds.

#include <string>
#include <vector>

#include <thinwall/experiments/stiff_contact/plan.hpp>
#include <thinwall/experiments/stiff_contact/tally.hpp>

namespace thinwall {

struct StiffRacer {
  PenaltyContact contact;
  ContactTally tally;
  std::vector<double> nanoseconds = {};  ///< a bounce, round by round
};

/// At one damping ratio and the greatest stiffness. Schemes and detections in their order, steps from rough to fine.
std::vector<StiffRacer> stiff_race(const StiffPlan& plan, double ratio);

std::string to_line(const std::vector<StiffRacer>& racers);
std::vector<StiffRacer> racers_from(const StiffPlan& plan, double ratio, const std::string& line);

}  // namespace thinwall
