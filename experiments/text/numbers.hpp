#pragma once
/// Numbers as text: exactly for files, rounded for readers.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace thinwall {

/// The shortest text that reads back as the same bits. Whole numbers below 2^53 have no exponent: 1000000, not 1e+06.
/// Zero has no sign. NaN is `nan`, infinities `inf` and `-inf`.
std::string exact_text(double value);

/// `digits` significant digits, for a reader: 0.0123, 1.2e-05, 1500000.
std::string rounded_text(double value, int digits);

/// Thousands apart: 12,000,000.
std::string grouped_text(std::int64_t value);

/// `1 trial`, `12,000 trials`.
std::string plural_text(std::int64_t count, std::string_view noun);

/// As a person says it: `0.4 s`, `12 s`, `3 min 20 s`, `2 h 5 min`.
std::string duration_text(double seconds);

/// A whole number, also as 1e6; nothing if `text` is anything else or does not fit.
std::optional<std::int64_t> parse_count(std::string_view text);

}  // namespace thinwall
