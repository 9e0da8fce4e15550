#pragma once
/// What a block of queries adds up to: counts, largest errors, and a histogram of errors for their 99th percentile. Adding
/// tallies does not depend on their order.

#include <array>
#include <cstdint>
#include <string>

namespace thinwall {

/// Errors by size: 64 bins a factor of two, from 2^-16 to 2^16 units.
class ErrorHistogram {
 public:
  void add(double error);
  void add(const ErrorHistogram& other);
  double largest() const { return largest_; }
  /// The upper end of the bin that holds the given share of all errors; at most a hundredth part above it.
  double quantile(double share) const;

  std::string to_text() const;
  static ErrorHistogram from_text(const std::string& text);

 private:
  static constexpr int bins_an_octave = 64, octaves = 32;
  static constexpr double half_range = 16;
  std::array<std::int64_t, bins_an_octave * octaves + 1> bins_{};
  double largest_ = 0;
};

struct AccuracyTally {
  std::int64_t queries = 0;
  std::int64_t hits = 0;            ///< by the oracle
  std::int64_t overlapping = 0;     ///< by the oracle
  std::int64_t wrong_verdicts = 0;  ///< of any size
  std::int64_t gave_up = 0;
  double largest_wrong = 0;   ///< [u] backward error of the worst wrong verdict
  ErrorHistogram forward{};   ///< [u kappa t] of the hits
  ErrorHistogram backward{};  ///< [u] of the hits

  void add(const AccuracyTally& other);
  std::string to_line() const;
  static AccuracyTally from_line(const std::string& line);
};

}  // namespace thinwall
