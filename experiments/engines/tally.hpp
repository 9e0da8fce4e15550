#pragma once
/// What is counted over the shots of one cell in one mode. Every field adds up, or is an extreme, so that the order of the
/// shots never matters; but for the seconds.

#include <cstdint>
#include <limits>
#include <string>

namespace thinwall {

struct EngineTally {
  std::int64_t shots = 0;
  std::int64_t tunneled = 0;  ///< the center ended beyond the wall's back
  std::int64_t unseen = 0;    ///< of these: where they would be without a wall
  std::int64_t stuck = 0;     ///< the center ended between the wall's two faces
  std::int64_t lost = 0;      ///< no finite place any more
  std::int64_t turned = 0;    ///< flying away in front of the wall; the rest is in front and does not
  std::int64_t lateness = 0;  ///< [2^-32 steps] sum over the turned
  std::int64_t energy =
      0;  ///< [2^-32] sum over the turned of the energy after over the energy before, at most 1024 each
  double latest = -std::numeric_limits<double>::infinity();       ///< [steps] of the turned
  double earliest = std::numeric_limits<double>::infinity();      ///< [steps] of the turned
  double most_energy = -std::numeric_limits<double>::infinity();  ///< [1] of the turned
  double least_energy = std::numeric_limits<double>::infinity();  ///< [1] of the turned
  double deepest = -std::numeric_limits<double>::infinity();  ///< [m] in the wall at the end of a step, of the turned
  double seconds = 0;                                         ///< [s] of stepping all of them

  std::int64_t kept() const { return shots - tunneled - stuck - lost; }  ///< ended in front
  EngineTally& operator+=(const EngineTally& more);  ///< as if one tally had counted both; but for the seconds exact
};

/// A shot's share of the sums, which have 63 bits.
inline constexpr std::int64_t most_engine_shots = std::int64_t(1) << 20;  ///< of a cell
inline constexpr int most_engine_steps = 1000;                            ///< of a shot

std::string to_line(const EngineTally& tally);                ///< no digit is lost
EngineTally engine_tally_from_line(const std::string& line);  ///< throws std::runtime_error if it is not one

}  // namespace thinwall
