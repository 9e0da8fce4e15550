#pragma once
/// The range of an axis, and where its tics stand.

#include <span>
#include <string>
#include <vector>

namespace thinwall {

/// Significant digits of the ends of an axis in a script.
inline constexpr int axis_digits = 6;

struct DrawnAxis {
  bool log = false;
  double lower = 0, upper = 1;
};

/// An axis that shows every finite value (on a logarithmic one: every positive value) with a little air around them.
DrawnAxis axis_around(std::span<const double> values, bool log);

/// What follows `set xtics` in gnuplot, for an axis of so many pixels that `spacing` of them are enough between two tics.
std::string tics(const DrawnAxis& axis, double pixels, double spacing);

}  // namespace thinwall
