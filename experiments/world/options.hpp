#pragma once
/// How a world steps, and what is asked of it.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/discrete/scalar.hpp>

namespace thinwall {

/// What is looked at of the motion in a step.
enum class TimePolicy {
  discrete,      ///< the poses at its end, and nothing between
  substeps,      ///< the poses at the end of each of n equal parts
  clamp,         ///< all of it; a body stops where it first hits, and loses the rest of the step: what engines do
  event_driven,  ///< all of it; after a hit a body goes on at its new velocity, up to `max_events` times
};
std::string_view name_of(TimePolicy policy);  ///< as it is spelled in a scene: `event_driven`

struct WorldOptions {
  Vec3<double> gravity = Vec3<double>::Zero();  ///< [m/s^2]
  TimePolicy policy = TimePolicy::event_driven;
  int substeps = 1;                  ///< >= 1; of TimePolicy::substeps alone
  int max_events = 16;               ///< >= 1: hits of a body in a step; after the last one it waits for the next step
  int contact_rounds = 8;            ///< >= 0: passes over the contacts at the start of a step, before anything moves
  double correction = 1;             ///< [1] in [0, 1]: part of a penetration that is undone at the end of a step
  std::string broad_phase = "auto";  ///< a name of BroadPhases; auto: as the plan decides
  bool response = true;              ///< false: bodies pass through each other, and the contacts are only told
  bool events = true;                ///< false: nobody reads them
  int end_after = 1;                 ///< >= 1: a contact ends on this many consecutive steps apart
  double gate = 0;                   ///< [1] >= 0: a pair of which neither moves more than this part of its least half
                                     ///< width is not swept but tested at the start of the step. 0: off
  bool full_plan = false;            ///< true: omit nothing, to show that what is omitted changes no outcome
  std::vector<std::string> keep = {};  ///< omissions not to make, by `PlanLine::what`: what one alone saves
  int threads = 1;                     ///< >= 1; of no effect on any result
  std::size_t max_pairs =
      std::size_t{1} << 24;  ///< >= 1: more candidate pairs than this stop the step with TooManyPairs
};

}  // namespace thinwall
