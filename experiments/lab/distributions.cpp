/// The intervals that need quantiles of the binomial, beta and chi-squared distributions. Apart from statistics.cpp, which the page
/// in the browser has too, and which these would make larger.

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/chi_squared.hpp>

#include <thinwall/experiments/lab/statistics.hpp>

namespace thinwall {

namespace bm = boost::math;

Interval clopper_pearson(std::int64_t successes, std::int64_t trials) {
  using Binomial = bm::binomial_distribution<double>;
  const double n = static_cast<double>(trials), k = static_cast<double>(successes), side = (1 - confidence) / 2;
  return {successes == 0 ? 0 : Binomial::find_lower_bound_on_p(n, k, side),
          successes == trials ? 1 : Binomial::find_upper_bound_on_p(n, k, side)};
}

Interval binomial_range(std::int64_t trials, double probability, double coverage) {
  const bm::binomial_distribution<double> counts(static_cast<double>(trials), probability);
  const double side = (1 - coverage) / 2;
  return {bm::quantile(counts, side), bm::quantile(bm::complement(counts, side))};  // both rounded outward
}

Interval chi_square_range(std::int64_t count, double coverage) {
  const bm::chi_squared sum(static_cast<double>(count));
  const double side = (1 - coverage) / 2;
  return {bm::quantile(sum, side), bm::quantile(bm::complement(sum, side))};
}

}  // namespace thinwall
