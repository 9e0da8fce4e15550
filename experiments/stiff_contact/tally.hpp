#pragma once
/// What came of the bounces of one cell, over all phases.

#include <cstdint>
#include <istream>
#include <limits>
#include <string>

#include <thinwall/experiments/stiff_contact/bounce.hpp>

namespace thinwall {

struct ContactTally {
  std::int64_t returned = 0;       ///< left on the side they came from; all that follows but blow-up is of these
  std::int64_t escaped = 0;        ///< left on the other side
  std::int64_t unfinished = 0;     ///< did not leave
  std::int64_t contact_steps = 0;  ///< sum
  std::int64_t blown_up = 0;       ///< of all, however they ended
  std::int64_t blow_up_step = 0;   ///< the first step after which one of them was too fast; 0 if none
  double slowest = std::numeric_limits<double>::infinity();     ///< [incoming speeds] on leaving
  double fastest = 0;                                           ///< [incoming speeds]
  double speed_sum = 0;                                         ///< [incoming speeds]
  double square_error = 0;                                      ///< sum of (speed - restitution)^2
  double shallowest = std::numeric_limits<double>::infinity();  ///< [m] least of the greatest depths
  double deepest = 0;                                           ///< [m]

  std::int64_t bounces() const { return returned + escaped + unfinished; }
  double mean_speed() const { return speed_sum / static_cast<double>(returned); }
  double rms_error() const;
  bool operator==(const ContactTally&) const = default;
};

/// The phases: one in each of `count` equal parts of the step, at random. The same for every scheme and detection.
ContactTally bounce_all(const Approach& e, const PenaltyContact& c, std::uint64_t seed, std::int64_t count);

std::string to_line(const ContactTally& tally);    ///< no digit is lost
ContactTally bounce_tally_from(std::istream& in);  ///< throws std::runtime_error if it is not one

/// In a stream, a number that {:a} wrote; also infinity.
double read_number(std::istream& in);

}  // namespace thinwall
