#include <thinwall/experiments/figures/plot_axis.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <thinwall/experiments/text/numbers.hpp>

namespace thinwall {
namespace {

/// The least of 1, 2 and 5 times a power of ten that is not below `step`.
double round_step(double step) {
  const double power = std::pow(10, std::floor(std::log10(step)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= step) return factor * power;
  }
  return 10 * power;
}

/// 1, 2 and 5 in each decade, as a list.
std::string one_two_five(const DrawnAxis& axis) {
  std::string list;
  for (int power = static_cast<int>(std::floor(std::log10(axis.lower))); std::pow(10, power) <= axis.upper; ++power) {
    for (const int factor : {1, 2, 5}) {
      const double at = factor * std::pow(10, power);
      if (at >= axis.lower && at <= axis.upper) list += (list.empty() ? "" : ", ") + rounded_text(at, 2);
    }
  }
  return "(" + list + ")";
}

}  // namespace

DrawnAxis axis_around(std::span<const double> values, bool log) {
  constexpr double air = 0.04;            // [1] of the length of the axis
  constexpr double least_drawn = 1e-300;  // gnuplot divides an axis, and must not come upon subnormal numbers
  std::vector<double> shown;
  for (const double value : values) {
    const bool drawable = value == 0 || std::abs(value) >= least_drawn;
    if (std::isfinite(value) && drawable && (!log || value > 0)) shown.push_back(log ? std::log10(value) : value);
  }
  double lower = 0, upper = 1;
  if (!shown.empty()) {
    const auto [least, most] = std::ranges::minmax(shown);
    const double length = most - least;
    const bool flat = rounded_text(least, axis_digits) == rounded_text(most, axis_digits);  // but for rounding
    const double pad = !flat ? air * length : (log || least == 0 ? 0.5 : std::abs(least) / 2);
    lower = least - pad;
    upper = most + pad;
  }
  if (log) return {true, std::pow(10, lower), std::pow(10, upper)};
  return {false, lower, upper};
}

std::string tics(const DrawnAxis& axis, double pixels, double spacing) {
  const double most = std::max(2.0, pixels / spacing);
  if (!axis.log) return rounded_text(round_step((axis.upper - axis.lower) / most), 3);
  const double decades = std::log10(axis.upper / axis.lower);
  if (decades < 2) return one_two_five(axis);
  // Powers of ten. Without a start gnuplot counts from the end of the axis, and labels 4, 40 and 400.
  const int first = static_cast<int>(std::floor(std::log10(axis.lower)));
  return fmt::format("1e{}, 1e{}", first, std::max(1, static_cast<int>(std::ceil(decades / most))));
}

}  // namespace thinwall
