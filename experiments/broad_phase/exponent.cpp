#include <thinwall/experiments/broad_phase/exponent.hpp>

#include <cmath>

#include <boost/math/distributions/students_t.hpp>

namespace thinwall {

std::optional<Growth> fit_growth(std::span<const GrowthPoint> points) {
  const auto n = static_cast<double>(points.size());
  if (points.size() < 3) return std::nullopt;
  double mean_x = 0, mean_y = 0;
  for (const GrowthPoint& p : points) {
    mean_x += std::log(p.count) / n;
    mean_y += std::log(p.cost) / n;
  }
  double xx = 0, xy = 0;
  for (const GrowthPoint& p : points) {
    const double x = std::log(p.count) - mean_x;
    xx += x * x;
    xy += x * (std::log(p.cost) - mean_y);
  }
  if (!(xx > 0)) return std::nullopt;
  const double slope = xy / xx;
  double residual = 0;
  for (const GrowthPoint& p : points) {
    const double off = std::log(p.cost) - mean_y - slope * (std::log(p.count) - mean_x);
    residual += off * off;
  }
  const double error = std::sqrt(residual / (n - 2) / xx);
  const double reach = error * boost::math::quantile(boost::math::students_t(n - 2), 0.975);
  return Growth{slope, {slope - reach, slope + reach}};
}

}  // namespace thinwall
