#pragma once
/// The pairs whose accuracy is measured, the ways to ask, and what a block of queries adds up to.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include <thinwall/experiments/lab/record.hpp>

namespace thinwall {

/// Errors by size: 64 bins a factor of two, from 2^-16 to 2^16 units.
class ErrorHistogram {
 public:
  void add(double error);
  double largest() const { return largest_; }
  /// The upper end of the bin that holds the given share of all errors; at most a hundredth part above it.
  double quantile(double share) const;

  static constexpr auto fields() {
    return record(sum("bins", &ErrorHistogram::bins_, "1", "Errors in each bin."),
                  most("largest", &ErrorHistogram::largest_, "1", "The largest error."));
  }

 private:
  std::vector<std::int64_t> bins_{};  // up to the last that is not empty
  double largest_ = 0;
};

/// The goal: [u kappa t] or [u] of a time, a normal and a point; [u] of a wrong verdict.
inline constexpr double accuracy_goal = 4, accuracy_goal_wrong = 1;

struct AccuracyTally {
  std::int64_t queries = 0, hits = 0, overlapping = 0, wrong_verdicts = 0, gave_up = 0;
  double largest_wrong = 0, worst_normal = 0, worst_point = 0;
  ErrorHistogram forward{};   ///< [u kappa t] of the hits
  ErrorHistogram backward{};  ///< [u] of the hits

  static constexpr auto fields() {
    using T = AccuracyTally;
    return record(
        sum("queries", &T::queries, "1", "How many."),
        sum("hits", &T::hits, "1", "How many touch during the step, by the oracle."),
        sum("overlapping", &T::overlapping, "1", "How many touch at the start, by the oracle."),
        sum("wrong_verdicts", &T::wrong_verdicts, "1", "Verdicts that differ from the oracle's."),
        most("worst_wrong", &T::largest_wrong, "u", "The largest change of the input that a wrong verdict would need."),
        most("worst_normal", &T::worst_normal, "u",
             "By how much a hit's shapes overlap along its normal, over all sizes."),
        most("worst_point", &T::worst_point, "u",
             "How far a hit's point lies off either surface, over all sizes and what time is worth."),
        sum("gave_up", &T::gave_up, "1", "Queries that ran out of rounds."), part(&T::forward), part(&T::backward));
  }
};

bool is_within_goal(const AccuracyTally& tally);

enum class Inquiry { in_double, in_float, float_kernel, verdicts, along_edges, upright };
inline constexpr std::array all_inquiries{Inquiry::in_double, Inquiry::in_float,    Inquiry::float_kernel,
                                          Inquiry::verdicts,  Inquiry::along_edges, Inquiry::upright};

constexpr std::string_view name(Inquiry inquiry) {
  constexpr std::array<std::string_view, 6> names{"double",   "float",       "float kernel",
                                                  "verdicts", "along edges", "upright"};
  return names[static_cast<std::size_t>(inquiry)];
}

struct AccuracyPair {
  std::string_view name;
  /// Asks queries `first` to `first + count`, which depend on the seed and their number alone.
  AccuracyTally (*ask)(Inquiry inquiry, std::uint64_t seed, std::int64_t first, std::int64_t count);
};

extern const std::vector<AccuracyPair> accuracy_pairs;

}  // namespace thinwall
