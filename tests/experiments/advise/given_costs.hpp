#pragma once
/// A wish, and advice on it with costs that nobody measured.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include <thinwall/experiments/advise/advice.hpp>
#include <thinwall/experiments/thin_wall/results.hpp>

namespace thinwall {

/// The bullet of the textbook: it tunnels 7 times in 10, and a step is 3 1/3 times as long as its contact.
inline const Wish bullet_wish = {.cell = bullet};

/// Both kinds of steps take `ns`, known to within 1 %.
inline StepCost costing(double ns) {
  const QueryTime time = {ns, {0.99 * ns, 1.01 * ns}};
  return {time, time};
}

/// The methods cost 10, 20, 30 ... ns in the order of the list.
inline Advice advice_on(const Wish& wish) {
  const std::vector<Candidate> methods = candidates(wish);
  std::vector<StepCost> costs;
  for (std::size_t i = 0; i < methods.size(); ++i) costs.push_back(costing(10 * static_cast<double>(i + 1)));
  return advise(wish, methods, costs);
}

inline const AdviceRow& row_of(const Advice& advice, const std::string& method) {
  const auto row = std::ranges::find_if(advice.rows, [&](const AdviceRow& r) { return r.method.name == method; });
  if (row == advice.rows.end()) throw std::runtime_error("no row of " + method);
  return *row;
}

inline bool has_row(const Advice& advice, const std::string& method) {
  return std::ranges::any_of(advice.rows, [&](const AdviceRow& row) { return row.method.name == method; });
}

}  // namespace thinwall
