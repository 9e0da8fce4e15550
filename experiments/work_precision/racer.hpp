#pragma once
/// What came of one method at one setting, over all queries of a set, class and scalar.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace thinwall {

/// Errors of the time of impact where the bodies touch and the method says so, or infinity where it does not say so.
struct ErrorSpread {
  double median = 0, p99 = 0, max = 0;
};

struct Racer {
  std::string method;
  std::string setting;           ///< "tolerance 1e-06"; empty for a method without an option
  std::optional<double> option;  ///< its value
  std::int64_t queries = 0;
  std::int64_t touching = 0;    ///< by the oracle
  std::int64_t missed = 0;      ///< touching, and the method says apart
  std::int64_t false_hits = 0;  ///< not touching, and the method says hit
  std::int64_t gave_up = 0;     ///< neither
  ErrorSpread time{};           ///< [1] of a step
  ErrorSpread length{};         ///< [m] the same along the relative path
  double latest = 0;            ///< [1] of a step, <= 0 if never late
  double earliest = 0;          ///< [1] of a step, >= 0 if never early
  double forward = 0;           ///< [u kappa t] largest error, in units of what the closed form may err by
  double evaluations = 0;       ///< [1] a query, on average
  std::int64_t most_evaluations = 0;
  std::vector<double> nanoseconds{};  ///< a query, one of each round; the rounds of all racers are interleaved

  /// Every verdict is right.
  bool is_sound() const { return missed == 0 && false_hits == 0 && gave_up == 0; }
};

/// A field of racers as the line that a run's journal keeps, and back. Throws std::runtime_error if it is not one.
std::string to_line(const std::vector<Racer>& racers);
std::vector<Racer> racers_from_line(const std::string& line);

}  // namespace thinwall
