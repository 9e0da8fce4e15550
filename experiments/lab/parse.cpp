/// Numbers as people type them. Apart from text.cpp, which the page in the browser has too: its library reads no double.

#include <cmath>

#include <thinwall/experiments/lab/text.hpp>

namespace thinwall {

std::optional<std::int64_t> parse_count(std::string_view text) {
  if (const auto count = parsed<std::int64_t>(text)) return count;
  const auto value = parsed<double>(text);
  if (!value || !(std::abs(*value) < 0x1p53) || *value != std::trunc(*value)) return std::nullopt;
  return static_cast<std::int64_t>(*value);
}

}  // namespace thinwall
