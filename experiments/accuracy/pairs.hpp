#pragma once
/// The pairs whose accuracy is measured, and the ways to ask.

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include <thinwall/experiments/accuracy/tally.hpp>

namespace thinwall {

enum class Inquiry { in_double, in_float, float_kernel, verdicts };
inline constexpr std::array all_inquiries{Inquiry::in_double, Inquiry::in_float, Inquiry::float_kernel,
                                          Inquiry::verdicts};

constexpr std::string_view name(Inquiry inquiry) {
  constexpr std::array<std::string_view, 4> names{"double", "float", "float kernel", "verdicts"};
  return names[static_cast<std::size_t>(inquiry)];
}

struct AccuracyPair {
  std::string_view name;
  /// Asks queries `first` to `first + count`, which depend on the seed and their number alone.
  AccuracyTally (*ask)(Inquiry inquiry, std::uint64_t seed, std::int64_t first, std::int64_t count);
};

std::span<const AccuracyPair> accuracy_pairs();

}  // namespace thinwall
