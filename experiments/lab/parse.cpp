/// Numbers as people type them.

#include <charconv>
#include <cmath>

#include <thinwall/experiments/lab/text.hpp>

namespace thinwall {

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
  if (!(std::abs(value) < 0x1p53) || value != std::trunc(value)) return std::nullopt;
  return static_cast<std::int64_t>(value);
}

}  // namespace thinwall
