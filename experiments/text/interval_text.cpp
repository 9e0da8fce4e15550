#include <thinwall/experiments/text/interval_text.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include <thinwall/experiments/text/numbers.hpp>

namespace thinwall {
namespace {

int power_of_ten(double value) { return static_cast<int>(std::floor(std::log10(std::abs(value)))); }

/// The power of ten of the last digit that an interval of that half-width supports.
int last_place(double half_width) {
  const int power = power_of_ten(half_width);
  return half_width / std::pow(10, power) < 3 ? power - 1 : power;
}

std::string to_place(double value, int place, bool scientific) {
  if (value == std::trunc(value) && std::abs(value) < 10) return exact_text(value);
  const double unit = std::pow(10, place);
  if (std::abs(value) < unit / 2) return "0";
  std::array<char, 64> buffer{};
  const auto text = [&](std::chars_format format, int digits) {
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, format, digits).ptr;
    return std::string(buffer.data(), end);
  };
  if (scientific) return text(std::chars_format::scientific, std::max(0, power_of_ten(value) - place));
  if (place < 0) return text(std::chars_format::fixed, -place);
  return exact_text(std::round(value / unit) * unit);
}

}  // namespace

IntervalText interval_text(double value, double lower, double upper) {
  constexpr int digits = 4;
  if (!(upper > lower)) return {rounded_text(value, digits), rounded_text(lower, digits), rounded_text(upper, digits)};
  const int place = last_place((upper - lower) / 2);
  const double largest = std::max({std::abs(value), std::abs(lower), std::abs(upper)});
  const bool scientific = largest < 1e-4 || largest >= 1e7;
  return {to_place(value, place, scientific), to_place(lower, place, scientific), to_place(upper, place, scientific)};
}

}  // namespace thinwall
