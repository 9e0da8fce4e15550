#include <thinwall/experiments/text/ranges.hpp>

#include <cmath>

#include <fmt/format.h>

#include <thinwall/experiments/text/numbers.hpp>

namespace thinwall {

bool contains(const Range& range, double value) {
  const bool above = range.lower_open ? value > range.lower : value >= range.lower;
  const bool below = range.upper_open ? value < range.upper : value <= range.upper;
  return std::isfinite(value) && above && below;
}

std::string range_text(std::string_view kind, const Range& range) {
  std::string text(kind);
  const char* link = " ";
  if (std::isfinite(range.lower)) {
    text += fmt::format(" {} {}", range.lower_open ? ">" : ">=", exact_text(range.lower));
    link = " and ";
  }
  if (std::isfinite(range.upper)) {
    text += fmt::format("{}{} {}", link, range.upper_open ? "<" : "<=", exact_text(range.upper));
  }
  if (!range.unit.empty() && range.unit != "1") text += fmt::format(" [{}]", range.unit);
  return text;
}

}  // namespace thinwall
