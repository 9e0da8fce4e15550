#include <thinwall/experiments/hitscan/shadow.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace thinwall {

namespace {

std::optional<Interval> shadow_of(const PathPiece& piece, double range, double radius) {
  const double from = std::max(piece.x0 - range, -radius), to = std::min(piece.x1 - range, radius);
  if (from > to) return std::nullopt;
  const double slope = (piece.s1 - piece.s0) / (piece.x1 - piece.x0);
  const auto path = [&](double x) { return piece.s0 + slope * (x + range - piece.x0); };
  const auto rise = [&](double x) { return std::sqrt(std::max(0.0, radius * radius - x * x)); };
  // Where a line of this slope touches the ball, or at the end nearest to that: rise is concave.
  const double touch = slope * radius / std::hypot(1.0, slope);
  const double low = std::clamp(-touch, from, to), high = std::clamp(touch, from, to);
  return Interval{path(low) - rise(low), path(high) + rise(high)};
}

}  // namespace

Places shadow(const std::vector<PathPiece>& pieces, double range, double radius) {
  Places all;
  for (const PathPiece& piece : pieces) {
    if (const auto one = shadow_of(piece, range, radius)) all.push_back(*one);
  }
  std::sort(all.begin(), all.end(), [](const Interval& a, const Interval& b) { return a.lower < b.lower; });
  Places merged;
  for (const Interval& i : all) {
    if (!merged.empty() && i.lower <= merged.back().upper) {
      merged.back().upper = std::max(merged.back().upper, i.upper);
    } else {
      merged.push_back(i);
    }
  }
  return merged;
}

double length(const Places& places) {
  double sum = 0;
  for (const Interval& i : places) sum += i.upper - i.lower;
  return sum;
}

Places common(const Places& a, const Places& b) {
  Places both;
  for (const Interval& i : a) {
    for (const Interval& j : b) {
      const Interval k = {std::max(i.lower, j.lower), std::min(i.upper, j.upper)};
      if (k.lower < k.upper) both.push_back(k);
    }
  }
  return both;
}

double lens_area(double radius_a, double radius_b, double apart) {
  const double least = std::min(radius_a, radius_b), most = std::max(radius_a, radius_b);
  if (apart >= least + most) return 0;
  if (apart <= most - least) return std::numbers::pi * least * least;
  // The common chord is `x` from the one center and `apart - x` from the other: two segments.
  const auto segment = [](double radius, double x) {
    return radius * radius * std::acos(std::clamp(x / radius, -1.0, 1.0)) -
           x * std::sqrt(std::max(0.0, radius * radius - x * x));
  };
  const double x = (apart * apart + (radius_a - radius_b) * (radius_a + radius_b)) / (2 * apart);
  return segment(radius_a, x) + segment(radius_b, apart - x);
}

}  // namespace thinwall
