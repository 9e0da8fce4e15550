#include <thinwall/experiments/text/numbers.hpp>

#include <array>
#include <charconv>
#include <cmath>

namespace thinwall {
namespace {

constexpr double two_to_53 = 9007199254740992.0;  // every whole number up to here is a double

template <class... Format> std::string to_text(double value, Format... format) {
  std::array<char, 64> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, format...).ptr;
  return {buffer.data(), end};
}

}  // namespace

std::string exact_text(double value) {
  if (value == 0) return "0";
  const bool whole = std::abs(value) < two_to_53 && value == std::trunc(value);
  return whole ? std::to_string(static_cast<std::int64_t>(value)) : to_text(value);
}

std::string rounded_text(double value, int digits) {
  if (!std::isfinite(value) || value == 0) return exact_text(value);
  std::string text = to_text(value, std::chars_format::scientific, digits - 1);
  std::from_chars(text.data(), text.data() + text.size(), value);  // the rounded value itself
  return exact_text(value);
}

std::string grouped_text(std::int64_t value) {
  std::string text = std::to_string(value);
  const std::size_t first = value < 0 ? 1 : 0;
  for (std::size_t at = text.size(); at > first + 3;) text.insert(at -= 3, ",");
  return text;
}

std::string plural_text(std::int64_t count, std::string_view noun) {
  return grouped_text(count).append(" ").append(noun).append(count == 1 ? "" : "s");
}

std::string duration_text(double seconds) {
  if (seconds < 9.95) return rounded_text(seconds, seconds < 1 ? 1 : 2) + " s";
  const auto whole = static_cast<std::int64_t>(std::llround(seconds));
  if (whole < 60) return std::to_string(whole) + " s";
  if (whole < 3600) return std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
  return std::to_string(whole / 3600) + " h " + std::to_string(whole % 3600 / 60) + " min";
}

std::optional<std::int64_t> parse_count(std::string_view text) {
  const char* const end = text.data() + text.size();
  std::int64_t count = 0;
  if (const auto [stop, error] = std::from_chars(text.data(), end, count); error == std::errc{} && stop == end) {
    return count;
  }
  double value = 0;
  if (const auto [stop, error] = std::from_chars(text.data(), end, value); error != std::errc{} || stop != end) {
    return std::nullopt;
  }
  if (!(std::abs(value) < two_to_53) || value != std::trunc(value)) return std::nullopt;
  return static_cast<std::int64_t>(value);
}

}  // namespace thinwall
