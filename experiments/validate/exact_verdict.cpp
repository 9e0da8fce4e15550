#include <thinwall/experiments/validate/exact_verdict.hpp>

#include <algorithm>
#include <vector>

namespace thinwall {
namespace {

/// The unknowns are t, alpha and beta, in this order: the time is found last.
constexpr std::size_t unknowns = 3;

/// factors . unknowns + constant: either zero or not negative.
struct Linear {
  std::array<Rational, unknowns> factors;
  Rational constant;
};

/// a * x + b * y.
Linear combined(const Rational& a, const Linear& x, const Rational& b, const Linear& y) {
  Linear sum;
  for (std::size_t k = 0; k < unknowns; ++k) sum.factors[k] = a * x.factors[k] + b * y.factors[k];
  sum.constant = a * x.constant + b * y.constant;
  return sum;
}

struct LinearSystem {
  std::vector<Linear> zero;          ///< each is 0
  std::vector<Linear> not_negative;  ///< each is >= 0
};

/// start + t * displacement - alpha * e1 - beta * e2 is zero on each axis; the rest bounds t, alpha and beta.
LinearSystem system_of(const ExactQuery& query) {
  LinearSystem system;
  for (std::size_t i = 0; i < 3; ++i) {
    system.zero.push_back({{query.displacement[i], -query.e1[i], -query.e2[i]}, query.start[i]});
  }
  system.not_negative = {{{1, 0, 0}, 0}, {{-1, 0, 0}, 1}, {{0, 1, 0}, 0}, {{0, 0, 1}, 0}};
  if (query.set == FlatSet::triangle) {
    system.not_negative.push_back({{0, -1, -1}, 1});
  } else {
    system.not_negative.push_back({{0, -1, 0}, 1});
    system.not_negative.push_back({{0, 0, -1}, 1});
  }
  return system;
}

/// Solves one equation for unknown k and puts the answer into all others; false if no equation has it.
bool substitute(LinearSystem& system, std::size_t k) {
  const auto has_k = [&](const Linear& equation) { return equation.factors[k] != 0; };
  const auto found = std::ranges::find_if(system.zero, has_k);
  if (found == system.zero.end()) return false;
  const Linear pivot = *found;
  system.zero.erase(found);
  for (auto* const rows : {&system.zero, &system.not_negative}) {
    for (Linear& row : *rows) row = combined(1, row, -row.factors[k] / pivot.factors[k], pivot);
  }
  return true;
}

/// Fourier-Motzkin: unknown k exists if and only if each of its lower bounds is at most each of its upper bounds.
void eliminate(LinearSystem& system, std::size_t k) {
  std::vector<Linear> lower, upper, rest;
  for (const Linear& row : system.not_negative) {
    (row.factors[k] > 0 ? lower : row.factors[k] < 0 ? upper : rest).push_back(row);
  }
  for (const Linear& low : lower) {
    for (const Linear& high : upper) rest.push_back(combined(-high.factors[k], low, low.factors[k], high));
  }
  system.not_negative = std::move(rest);
}

/// The least t that satisfies what is left once t is the only unknown.
std::optional<Rational> least_time(const LinearSystem& system) {
  Rational first = 0, last = 1;
  const auto bound = [&](const Rational& factor, const Rational& constant) {  // factor * t + constant >= 0
    if (factor == 0) return constant >= 0;
    const Rational root = -constant / factor;
    if (factor > 0) first = std::max(first, root);
    if (factor < 0) last = std::min(last, root);
    return true;
  };
  for (const Linear& row : system.not_negative) {
    if (!bound(row.factors[0], row.constant)) return std::nullopt;
  }
  for (const Linear& row : system.zero) {
    if (!bound(row.factors[0], row.constant) || !bound(-row.factors[0], -row.constant)) return std::nullopt;
  }
  return first <= last ? std::optional(first) : std::nullopt;
}

}  // namespace

RationalPoint difference(const RationalPoint& a, const RationalPoint& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

std::optional<Rational> first_contact(const ExactQuery& query) {
  LinearSystem system = system_of(query);
  for (const std::size_t k : {std::size_t{1}, std::size_t{2}}) {
    if (!substitute(system, k)) eliminate(system, k);
  }
  return least_time(system);
}

}  // namespace thinwall
