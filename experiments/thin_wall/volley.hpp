#pragma once
/// The shots of a cell at one detector, in pieces that are short enough to lose. What they count adds up to what one
/// piece would count, to the bit: a shot's random numbers depend on its number alone.

#include <cstdint>
#include <vector>

#include <thinwall/experiments/thin_wall/detectors.hpp>

namespace thinwall {

/// Shots `first`, `first + 1`, ... of a cell.
struct Volley {
  std::int64_t first = 0;
  std::int64_t shots = 0;
};

/// A minute's work at most, at the speed of a slow method; a cell of fewer shots is one volley. Volleys are longer where
/// a cell would have more than so many: each is a unit, kept in memory.
inline constexpr std::int64_t most_shots_a_volley = std::int64_t(1) << 22, most_volleys = 32;

/// Lateness is summed in 64 bits, of which a shot takes up to 32.
inline constexpr std::int64_t most_shots_a_cell = std::int64_t(1) << 30;

std::vector<Volley> volleys_of(std::int64_t shots, std::int64_t most = most_shots_a_volley);

Tally fire(const Cell& cell, const Detector& detector, const Volley& volley, std::uint64_t seed);

}  // namespace thinwall
