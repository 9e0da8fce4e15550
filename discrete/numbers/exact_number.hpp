#pragma once
/// Sums and products without rounding, for the few decisions that plain arithmetic leaves open.
/// A number is an unevaluated sum of scalars that do not overlap; short where the input has few digits, as from a grid.
/// Needs round to nearest, no contraction, and products away from underflow and overflow.
/// Source: Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates", Discrete &
/// Computational Geometry 18, 1997, theorems 10 and 12.

#include <array>
#include <cstddef>
#include <vector>

#include <thinwall/discrete/numbers/double_word.hpp>

namespace thinwall {

template <Scalar S> struct ExactNumber {
  std::vector<S> terms;  ///< by magnitude, smallest first, none zero; their sum is the number

  ExactNumber() = default;
  ExactNumber(const S& x) {
    if (x != S(0)) terms.push_back(x);
  }

  /// -1, 0 or +1: the last term outweighs the rest.
  int sign() const { return terms.empty() ? 0 : terms.back() > S(0) ? 1 : -1; }

  /// To within one rounding or two.
  S rounded() const {
    S sum = 0;
    for (const S& term : terms) sum += term;
    return sum;
  }

  ExactNumber& operator+=(const S& x) {
    std::vector<S> grown;
    grown.reserve(terms.size() + 1);
    S carried = x;
    for (const S& term : terms) {
      const DoubleWord<S> sum = exact_sum(carried, term);
      if (sum.low != S(0)) grown.push_back(sum.low);
      carried = sum.high;
    }
    if (carried != S(0)) grown.push_back(carried);
    terms = std::move(grown);
    return *this;
  }
};

template <Scalar S> ExactNumber<S> operator-(ExactNumber<S> a) {
  for (S& term : a.terms) term = -term;
  return a;
}
template <Scalar S> ExactNumber<S> operator+(ExactNumber<S> a, const ExactNumber<S>& b) {
  for (const S& term : b.terms) a += term;
  return a;
}
template <Scalar S> ExactNumber<S> operator-(const ExactNumber<S>& a, const ExactNumber<S>& b) { return a + (-b); }

template <Scalar S> ExactNumber<S> operator*(const ExactNumber<S>& a, const ExactNumber<S>& b) {
  ExactNumber<S> product;
  for (const S& x : a.terms) {
    for (const S& y : b.terms) {
      const DoubleWord<S> part = exact_product(x, y);
      product += part.low;
      product += part.high;
    }
  }
  return product;
}

template <Scalar S> using ExactVec = std::array<ExactNumber<S>, 3>;

template <Scalar S> ExactVec<S> exact_vector(const Vec3<S>& v) { return {v[0], v[1], v[2]}; }

template <Scalar S> ExactNumber<S> dot(const ExactVec<S>& a, const ExactVec<S>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <Scalar S> ExactVec<S> cross(const ExactVec<S>& a, const ExactVec<S>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace thinwall
