#pragma once
/// Text: numbers and intervals as people read them, lists of values, names that are nearly right.

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace thinwall {

// ---- Numbers as text: exactly for files, rounded for readers.

/// The shortest text that reads back as the same bits. Whole numbers below 2^53 have no exponent: 1000000, not 1e+06; all from
/// there on have one. Zero has no sign. NaN is `nan`, infinities `inf` and `-inf`.
std::string exact_text(double value);

/// `digits` significant digits, for a reader: 0.0123, 1.2e-05, 1500000.
std::string rounded_text(double value, int digits);

/// Of a column's texts, makes the numbers of one notation if they are of both: plain from 1e-5 to 1e7, or with powers of ten.
void in_one_notation(const std::vector<std::string*>& texts);

/// Thousands apart: 12,000,000.
std::string grouped_text(std::int64_t value);

/// Of a share: `85.8 %`; `-` where there is none.
std::string percent_text(const std::optional<double>& share);

/// `1 trial`, `12,000 trials`.
std::string plural_text(std::int64_t count, std::string_view noun);

/// A name as a person writes it: `long double` for `long_double`.
std::string spaced(std::string name);

/// The `name` of each thing; the things must outlive what is returned.
template <class Things> std::vector<std::string_view> names_of(const Things& things) {
  std::vector<std::string_view> names;
  for (const auto& thing : things) names.push_back(thing.name);
  return names;
}

/// `a`, `a and b`, `a, b and c`.
std::string listed(std::span<const std::string> parts, std::string_view last = " and ");

/// As a person says it: `0.4 s`, `12 s`, `3 min 20 s`, `2 h 5 min`.
std::string duration_text(double seconds);

/// The number that all of `text` is.
template <class Number> std::optional<Number> parsed(std::string_view text) {
  Number number{};
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && stop == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

/// A number with its interval, rounded to what the interval supports.
struct IntervalText {
  std::string value, lower, upper;
};

/// The last digit shown is the first of half the interval's width, or the second where the first is 1 or 2: 0.28723 in
/// [0.28591, 0.28851] is 0.2872 [0.2859, 0.2885]. Whole numbers, such as a probability of 0, stay as they are. What would be
/// rounded to 0, in an interval without it, keeps two digits of its own. Where the interval has no width there are four digits.
/// All three must be finite, and `lower` <= `upper`.
IntervalText interval_text(double value, double lower, double upper);

/// The allowed values of a number; NaN and infinity never are.
struct Range {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_open = false;  ///< `lower` itself is not allowed
  bool upper_open = false;  ///< `upper` itself is not allowed
  std::string_view unit = "1";
};

/// False for NaN and infinity, whatever the range.
bool contains(const Range& range, double value);

/// As a complaint names them: `numbers > 0 and <= 10 [s]`, where `kind` is `numbers`.
std::string range_text(std::string_view kind, const Range& range);

/// The fewest letters to insert, delete, replace or swap with their neighbor that turn `a` into `b`; case is ignored.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The end of a complaint: `did you mean 'radius'? (allowed: angle, radius)`; if nothing is near, `allowed: angle, radius`.
std::string spelling_hint(std::string_view word, std::span<const std::string_view> candidates);

/// What stands between the separators: of `a,,b` three parts, of an empty text one.
std::vector<std::string_view> split(std::string_view text, char separator);

/// Every `from` in `text`, which is not empty, becomes `to`.
void replace_all(std::string& text, std::string_view from, std::string_view to);

/// Of a TOML text that no parser has seen yet, the line, from 1, of the first key of more than `most` parts, as `a.b.c` has
/// three; 0 if there is none. Nested arrays and inline tables are bounded by the parser itself.
int line_of_deep_key(std::string_view text, int most);

}  // namespace thinwall
