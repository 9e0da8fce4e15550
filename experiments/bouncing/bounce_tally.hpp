#pragma once
/// The change of energy over the trials of one cell and policy, in the order of the trials.

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

namespace thinwall {

struct BounceTally {
  std::int64_t trials = 0;
  double mean = 0;     ///< [g h / V]
  double squares = 0;  ///< [(g h / V)^2] sum of squared distances from the mean
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();

  void add(double error);  ///< Source: Welford's update
  double sigma() const { return trials > 1 ? std::sqrt(squares / static_cast<double>(trials - 1)) : 0; }
  double rms() const { return std::sqrt(mean * mean + squares / static_cast<double>(trials)); }
  bool operator==(const BounceTally&) const = default;
};

std::string to_line(const BounceTally& tally);             ///< no digit is lost
BounceTally bounce_tally_from_line(const std::string& s);  ///< throws std::runtime_error if it is not one

}  // namespace thinwall
