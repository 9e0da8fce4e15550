#pragma once
/// Sums and products without rounding, for the few decisions that plain arithmetic leaves open.
/// A number is an unevaluated sum of scalars, each at most one unit in the last place of the next: short where the input has few
/// digits, as from a grid, and never longer than the scalar's range of exponents over its digits, which is why none is allocated.
/// Needs round to nearest, no contraction, and products away from underflow and overflow.
/// Source: Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates", Discrete &
/// Computational Geometry 18, 1997, theorem 10 and the downward half of theorem 23.

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <vector>

#include <thinwall/discrete/numbers/double_word.hpp>

namespace thinwall {

/// As many scalars as a number can need, from the largest to the smallest each smaller by its digits but one, and two to
/// spare.
template <class S> class ExactTerms {
 public:
  // What is not in use is not set.
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init,modernize-use-equals-default)
  ExactTerms() {}
  ExactTerms(const ExactTerms& other) { *this = other; }  // NOLINT(cppcoreguidelines-pro-type-member-init)
  ExactTerms& operator=(const ExactTerms& other) {
    std::copy(other.begin(), other.end(), begin());
    size_ = other.size_;
    return *this;
  }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  void push_back(const S& term) {
    assert(size_ < terms_.size());
    terms_[size_++] = term;
  }
  void erase(S* from, S* to) { size_ = static_cast<std::size_t>(std::copy(to, end(), from) - begin()); }
  S& operator[](std::size_t i) { return terms_[i]; }
  const S& back() const { return terms_[size_ - 1]; }
  S* begin() { return terms_.data(); }
  S* end() { return terms_.data() + size_; }
  const S* begin() const { return terms_.data(); }
  const S* end() const { return terms_.data() + size_; }

 private:
  using Limits = std::numeric_limits<S>;
  static constexpr int range = Limits::max_exponent - Limits::min_exponent + Limits::digits;  // [bits]
  std::array<S, range / (Limits::digits - 1) + 3> terms_;
  std::size_t size_ = 0;
};

template <Scalar S> struct ExactNumber {
  /// Multiprecision, whose range has no bound worth the name, allocates as it likes anyway.
  using Terms = std::conditional_t<std::is_floating_point_v<S>, ExactTerms<S>, std::vector<S>>;
  Terms terms;  ///< by magnitude, smallest first, none zero; their sum is the number

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

  /// Adds x from the smallest term up, then gathers from the largest down, so that no two terms could be one.
  ExactNumber& operator+=(const S& x) {
    S carried = x;
    for (S& term : terms) {
      const DoubleWord<S> sum = exact_sum(carried, term);
      term = sum.low;
      carried = sum.high;
    }
    std::size_t next = terms.size();
    terms.push_back(S(0));
    std::size_t gathered = terms.size();  // from here on
    while (next-- > 0) {
      const DoubleWord<S> sum = exact_sum(carried, terms[next]);
      carried = sum.high;
      if (sum.low == S(0)) continue;
      terms[--gathered] = sum.high;
      carried = sum.low;
    }
    if (carried != S(0)) terms[--gathered] = carried;
    terms.erase(terms.begin(), terms.begin() + static_cast<std::ptrdiff_t>(gathered));
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
