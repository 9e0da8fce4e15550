#pragma once
/// The polytope K(t) of exact_core.hpp in integers: every coordinate over one power of two, the largest that divides all.
///
/// Numbers: a coordinate of a corner of K is the sum of at most 32 terms below 2^high in multiples of 2^low, so an integer
/// of at most L = high - low + 5 bits. integer_bits() gives the bits of the largest number that gjk.hpp makes of them.

#include <algorithm>
#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>

#include <thinwall/swept/certified/exact_core.hpp>
#include <thinwall/swept/certified/simplex.hpp>

namespace thinwall {

/// Integers of any size, and of a fixed one that needs no memory from the heap.
using UnboundedInteger =
    boost::multiprecision::number<boost::multiprecision::cpp_int_backend<>, boost::multiprecision::et_off>;
template <unsigned bits>
using FixedInteger = boost::multiprecision::number<
    boost::multiprecision::cpp_int_backend<bits, bits, boost::multiprecision::signed_magnitude,
                                           boost::multiprecision::unchecked, void>,
    boost::multiprecision::et_off>;

/// A double as mantissa * 2^exponent with an odd mantissa; x != 0.
struct OddMantissa {
  std::int64_t mantissa = 0;
  int exponent = 0;

  explicit OddMantissa(double x) {
    mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
    const int zeros = std::countr_zero(static_cast<std::uint64_t>(mantissa));
    mantissa /= std::int64_t{1} << zeros;
    exponent += zeros - 53;
  }
};

/// The power of two that divides all terms, and one that exceeds each.
struct ExponentSpan {
  int low = 1 << 20, high = -(1 << 20);

  void include(const ExactTerm& term) {
    const OddMantissa x(term.x), y(term.y);
    low = std::min(low, x.exponent + y.exponent + term.shift);
    high = std::max(high, std::ilogb(term.x) + std::ilogb(term.y) + 2 + term.shift);
  }
  void include(const ExactSum& sum) {
    for (std::size_t i = 0; i < sum.count; ++i) include(sum.terms[i]);
  }
  void include(const ExactPoint& point) {
    for (const ExactSum& sum : point) include(sum);
  }
  /// Bits of a coordinate of a corner of K; 0 if all are zero.
  int bits() const { return high < low ? 0 : high - low + 5; }
};

/// K(time) as sums of exact terms: the sweep is one edge more.
struct SweptCore {
  const ExactCore& query;
  ExactPoint sweep{};
  ExponentSpan span{};

  SweptCore(const ExactCore& asked, double time) : query(asked), sweep(asked.velocity) {
    for (ExactSum& sum : sweep) {
      for (std::size_t i = 0; i < sum.count; ++i) sum.terms[i].y = time;
      if (time == 0) sum.count = 0;
    }
    for (std::size_t i = 0; i < query.start_count; ++i) span.include(query.starts[i]);
    for (std::size_t i = 0; i < query.edge_count; ++i) span.include(query.edges[i]);
    span.include(sweep);
    span.include(query.reach);
  }

  /// Bits of the largest integer in touches_origin(); derived in docs/certified.md.
  int integer_bits() const { return bits_for(span.bits()); }
  static constexpr int bits_for(int coordinate_bits) { return 8 * coordinate_bits + 13; }

  /// The power of two below which `low` must not lie for coordinates of so many bits.
  int low_for(int coordinate_bits) const { return span.high + 5 - coordinate_bits; }
};

/// The sum in units of 2^low. Of a term with bits below them, those are dropped: each such is off by less than one unit.
template <class Integer> Integer integer_from(const ExactSum& sum, int low) {
  Integer total = 0;
  for (std::size_t i = 0; i < sum.count; ++i) {
    const ExactTerm& term = sum.terms[i];
    const OddMantissa x(term.x), y(term.y);
    const Integer product = Integer(x.mantissa) * Integer(y.mantissa);
    const int shift = x.exponent + y.exponent + term.shift - low;
    if (shift >= 0) {
      total += product << static_cast<unsigned>(shift);
    } else if (shift > -2 * std::numeric_limits<double>::digits) {
      total += product / (Integer(1) << static_cast<unsigned>(-shift));
    }
  }
  return total;
}
template <class Integer> Triple<Integer> integer_from(const ExactPoint& point, int low) {
  return {integer_from<Integer>(point[0], low), integer_from<Integer>(point[1], low),
          integer_from<Integer>(point[2], low)};
}

template <class Integer> struct IntegerPolytope {
  std::array<Triple<Integer>, 3> starts;
  std::array<Triple<Integer>, 7> edges;
  std::size_t start_count = 0, edge_count = 0;
  Integer reach;

  explicit IntegerPolytope(const SweptCore& core) : IntegerPolytope(core, core.span.low) {}
  IntegerPolytope(const SweptCore& core, int low) : start_count(core.query.start_count) {
    for (std::size_t i = 0; i < start_count; ++i) starts[i] = integer_from<Integer>(core.query.starts[i], low);
    for (std::size_t i = 0; i < core.query.edge_count; ++i) add_edge(integer_from<Integer>(core.query.edges[i], low));
    add_edge(integer_from<Integer>(core.sweep, low));
    reach = integer_from<Integer>(core.query.reach, low);
  }

  /// The corner that lies least far along n.
  Triple<Integer> lowest_along(const Triple<Integer>& n) const {
    Triple<Integer> corner = starts[0];
    for (std::size_t i = 1; i < start_count; ++i) {
      if (dot(n, difference(starts[i], corner)) < 0) corner = starts[i];
    }
    for (std::size_t i = 0; i < edge_count; ++i) {
      if (dot(n, edges[i]) >= 0) continue;
      for (std::size_t k = 0; k < 3; ++k) corner[k] += edges[i][k];
    }
    return corner;
  }

 private:
  void add_edge(const Triple<Integer>& edge) {
    if (edge[0] != 0 || edge[1] != 0 || edge[2] != 0) edges[edge_count++] = edge;
  }
};

}  // namespace thinwall
