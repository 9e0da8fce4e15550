#pragma once
/// Where a method breaks: from the usual outward along an arm, the first value at which it does not answer as it should.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/extremes/line.hpp>

namespace thinwall {

/// Why a method is broken, the worst first.
enum class Flaw {
  verdict,  ///< a wrong verdict whose input would have to change by more than 4 u to make it right
  error,    ///< a time off by more than 100 u kappa t
  nan,      ///< no number, or a valid input called invalid
  gave_up,  ///< out of evaluations
};
std::string_view name(Flaw flaw);
inline constexpr double break_verdict = 4;  ///< [u]
inline constexpr double break_error = 100;  ///< [u kappa t] two decimals lost

std::optional<Flaw> flaw_of(const ExtremeTally& tally);

/// How far a method gets along an arm, on some pairs together.
struct Survival {
  std::optional<double>
      survived;                  ///< the last value at which nothing was wrong, before the first at which something was
  std::optional<double> broken;  ///< that first value
  Flaw flaw = Flaw::verdict;     ///< the worst there
  std::string_view pair{};       ///< whose
};
Survival survival(const std::vector<ExtremeLine>& lines, const Arm& arm, std::string_view method, std::size_t precision,
                  PairSet pairs = PairSet::four);

/// True if it breaks on most arms at their first value, where little or nothing is extreme.
bool breaks_at_once(const std::vector<ExtremeLine>& lines, std::string_view method, std::size_t precision,
                    PairSet pairs);

/// The power of ten, and what is wrong: "4v", "-10e"; "-" where it survives, "all" where it breaks at the first value, empty
/// where it was not asked.
std::string short_text(const Survival& s);

}  // namespace thinwall
