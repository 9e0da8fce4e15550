#pragma once
/// What is counted over the balls of one cell and bound. Every field adds up: the order of the balls never matters.

#include <cstdint>
#include <string>

namespace thinwall {

struct SweepTally {
  std::int64_t shots = 0;       ///< balls around the bound
  std::int64_t touching = 0;    ///< of those, truly touched
  std::int64_t reported = 0;    ///< by the bound
  std::int64_t false_hits = 0;  ///< reported, and not touched
  std::int64_t grazing = 0;     ///< balls put where they just touch
  std::int64_t missed = 0;      ///< touched, of either kind, and not reported

  bool operator==(const SweepTally&) const = default;
};

std::string to_line(const SweepTally& tally);
SweepTally sweep_tally_from_line(const std::string& line);  ///< throws std::runtime_error if it is not one

}  // namespace thinwall
