#include <thinwall/experiments/lab/statistics.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include <boost/math/distributions/normal.hpp>

namespace thinwall {

namespace bm = boost::math;

Interval wilson(std::int64_t successes, std::int64_t trials) {
  const double n = static_cast<double>(trials);
  const double p = static_cast<double>(successes) / n;
  const double z = bm::quantile(bm::complement(bm::normal(), (1 - confidence) / 2));
  const double center = (p + z * z / (2 * n)) / (1 + z * z / n);
  const double half = z / (1 + z * z / n) * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n));
  // At the ends the two terms cancel exactly; rounding must not leave 1e-19 where the answer is 0.
  return {successes == 0 ? 0 : center - half, successes == trials ? 1 : center + half};
}

double standard_residual(std::int64_t successes, std::int64_t trials, double probability) {
  const double n = static_cast<double>(trials);
  return (static_cast<double>(successes) - n * probability) / std::sqrt(n * probability * (1 - probability));
}

double median(std::span<const double> values) {
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  const std::size_t middle = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
}

double quantile(std::span<const double> values, double share) {
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  const double rank = std::ceil(share * static_cast<double>(sorted.size()));
  return sorted[static_cast<std::size_t>(std::max(1.0, rank)) - 1];
}

Interval bootstrap_median(std::span<const double> values, const RandomStream& stream) {
  constexpr std::uint64_t resamples = 1000;
  std::vector<double> medians, drawn(values.size());
  for (std::uint64_t k = 0; k < resamples; ++k) {
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      const double place = uniform(random_words(stream, k, i)[0]) * static_cast<double>(values.size());
      drawn[i] = values[static_cast<std::size_t>(place)];
    }
    medians.push_back(median(drawn));
  }
  const double side = (1 - confidence) / 2;
  return {quantile(medians, side), quantile(medians, 1 - side)};
}

}  // namespace thinwall
