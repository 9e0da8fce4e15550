#pragma once
/// What is counted over the shots of one cell, method and scalar. Every field adds up, or is an extreme, so that the
/// order of the shots never matters.

#include <cstdint>
#include <limits>
#include <string>

namespace thinwall {

struct Tally {
  std::int64_t shots = 0;
  std::int64_t tunneled = 0;     ///< went past the wall unseen
  std::int64_t undecided = 0;    ///< a query gave up or found its input invalid; the shot ended there
  std::int64_t queries = 0;      ///< steps asked about
  std::int64_t evaluations = 0;  ///< what the queries say they cost
  std::int64_t lateness = 0;     ///< sum over the detected, in whole units of Target::lateness_unit
  std::int64_t wrong_side = 0;   ///< of a bounce: seen first where the way out leads ahead or sideways, not back
  std::int64_t behind = 0;       ///< of a bounce: ended flying away behind the wall, tunneled ones included
  double latest = -std::numeric_limits<double>::infinity();   ///< [m] past first contact, of the detected
  double earliest = std::numeric_limits<double>::infinity();  ///< [m] the least of them
  double widest = -std::numeric_limits<double>::infinity();   ///< [m] gap at detection; > 0: a hit where there is none

  std::int64_t detected() const { return shots - tunneled - undecided; }
  Tally& operator+=(const Tally& more);  ///< as if one tally had counted both; exact, in any order
  bool operator==(const Tally&) const = default;
};

std::string to_line(const Tally& tally);         ///< no digit is lost
Tally tally_from_line(const std::string& line);  ///< throws std::runtime_error if it is not one

}  // namespace thinwall
