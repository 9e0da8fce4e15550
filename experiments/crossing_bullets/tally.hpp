#pragma once
/// What is counted over the encounters of one cell and rule. Every field adds up, or is an extreme, so that the order of
/// the encounters never matters.

#include <cstdint>
#include <limits>
#include <string>

namespace thinwall {

/// Why the tutorial's rule misses: what its ray found, and when.
struct MissCauses {
  std::int64_t inside = 0;     ///< the ray starts in the other's track: it looks at the start alone
  std::int64_t too_early = 0;  ///< it enters the track before the other arrives
  std::int64_t too_late = 0;   ///< ... after the other has gone
  std::int64_t beside = 0;     ///< it does not enter: only the ball's radius does
  bool operator==(const MissCauses&) const = default;
};

struct CrossingTally {
  std::int64_t shots = 0;
  std::int64_t touching = 0;                                  ///< the balls truly touch during the step
  std::int64_t missed = 0;                                    ///< they touch, and the rule says no
  std::int64_t false_hits = 0;                                ///< they do not, and it says so
  std::int64_t undecided = 0;                                 ///< it gave up or found its input invalid
  std::int64_t evaluations = 0;                               ///< what the queries say they cost
  std::int64_t timed = 0;                                     ///< true hits it gave a time for
  std::int64_t lateness = 0;                                  ///< sum over those, in 2^-32 of a step
  MissCauses causes = {};                                     ///< of the misses of sweep_then_confirm
  double latest = -std::numeric_limits<double>::infinity();   ///< [1] of a step past first contact, of the timed
  double earliest = std::numeric_limits<double>::infinity();  ///< [1] the least of them
  double widest = -std::numeric_limits<double>::infinity();   ///< [m] gap at the answered time, of all timed answers
  double deepest = std::numeric_limits<double>::infinity();   ///< [m] the least gap of them; < 0: overlap

  std::int64_t reported() const { return touching - missed + false_hits; }
  bool operator==(const CrossingTally&) const = default;
};

std::string to_line(const CrossingTally& tally);                  ///< no digit is lost
CrossingTally crossing_tally_from_line(const std::string& line);  ///< throws std::runtime_error if it is not one

}  // namespace thinwall
