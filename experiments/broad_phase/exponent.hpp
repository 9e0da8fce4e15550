#pragma once
/// How a cost grows: the exponent p of cost = c * count^p.

#include <optional>
#include <span>

#include <thinwall/experiments/statistics.hpp>

namespace thinwall {

struct GrowthPoint {
  double count;  ///< > 0
  double cost;   ///< > 0
};

struct Growth {
  double exponent = 0;
  Interval interval{0, 0};  ///< 95 %, from how far the points lie off the line; a bend widens it
};

/// The straight line of least squares through the logarithms; nothing for fewer than three different counts.
/// Source: ordinary least squares, the interval from Student's t with two degrees of freedom less than points.
std::optional<Growth> fit_growth(std::span<const GrowthPoint> points);

}  // namespace thinwall
