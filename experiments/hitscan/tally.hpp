#pragma once
/// What is counted over the shots of one cell and rule. Every field adds up, or is an extreme, so that the order of the
/// shots never matters.

#include <cstdint>
#include <limits>
#include <string>

namespace thinwall {

/// A sum and the extremes of a quantity. The sum is kept in 2^-30 of a unit that the cell sets.
struct HitscanSpread {
  std::int64_t count = 0;
  std::int64_t sum = 0;                                    ///< [2^-30 units]
  double least = std::numeric_limits<double>::infinity();  ///< in its own unit
  double most = -std::numeric_limits<double>::infinity();
  bool operator==(const HitscanSpread&) const = default;
};
/// |x| <= 2 `unit`, so that 2^30 of them add up without overflow.
void add(HitscanSpread& spread, double x, double unit);
double mean(const HitscanSpread& spread, double unit);  ///< requires count > 0

struct HitscanTally {
  std::int64_t shots = 0;
  std::int64_t touching = 0;    ///< the bullet truly hits
  std::int64_t missed = 0;      ///< it does, and the rule says no
  std::int64_t false_hits = 0;  ///< it does not, and the rule says so
  HitscanSpread lateness;       ///< [s] from first contact to the report, of the true hits that are reported
  HitscanSpread point_error;    ///< [m] from the reported point on the target to the true one, of the same
  HitscanSpread path_error;  ///< [m] from the rule's path to the arc, where they cross the target's plane; of all shots

  std::int64_t reported() const { return touching - missed + false_hits; }
  bool operator==(const HitscanTally&) const = default;
};

std::string to_line(const HitscanTally& tally);                 ///< no digit is lost
HitscanTally hitscan_tally_from_line(const std::string& line);  ///< throws std::runtime_error if it is not one

}  // namespace thinwall
