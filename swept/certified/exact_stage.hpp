#pragma once
/// The last stage: integers. Shapes as polytopes of whole numbers, and GJK among them.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <boost/multiprecision/cpp_int.hpp>

#include <thinwall/swept/certified/certified_toi.hpp>
#include <thinwall/swept/certified/simplex.hpp>
#include <thinwall/swept/moving.hpp>

namespace thinwall {

// ---- A question about two moving shapes without a rounding: their relative core as sums of products of the input's doubles.
//
// Seen from B, A's core moves by v; the shapes touch by time t where the polytope
//   K(t) = { start + sum of [0, 1] edge + [0, t] v },  start and edges from core(A) - core(B),
// comes within the sum of the radii of the origin. K grows with t: "touched by t" is monotone.

/// x * y * 2^shift, exactly.
struct ExactTerm {
  double x = 0, y = 1;
  int shift = 0;
};

/// A coordinate: at most the center and three half axes of each of two boxes.
struct ExactSum {
  static constexpr std::size_t most = 8;
  std::array<ExactTerm, most> terms{};
  std::size_t count = 0;

  void add(double x, double y = 1, int shift = 0) {
    if (x != 0 && y != 0) terms[count++] = {x, y, shift};
  }
};

using ExactPoint = std::array<ExactSum, 3>;

struct ExactCore {
  std::array<ExactPoint, 3> starts{};  ///< one, or the corners of a triangle
  std::array<ExactPoint, 6> edges{};
  std::size_t start_count = 1, edge_count = 0;
  ExactPoint velocity{};  ///< of A seen from B, over the step
  ExactSum reach{};       ///< the sum of both radii
};

inline void add_point(ExactPoint& point, const Vec3<double>& x, double sign) {
  for (int i = 0; i < 3; ++i) point[static_cast<std::size_t>(i)].add(sign * x[i]);
}

/// The half axes -g ... g as the start -g and the edge 2 g, where g = half * axis.
inline void add_half_axis(ExactCore& query, double half, const Vec3<double>& axis) {
  ExactPoint& edge = query.edges[query.edge_count++];
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    query.starts[0][k].add(-half, axis[i]);
    edge[k].add(half, axis[i], 1);
  }
}

// The core of A (sign 1) or of B mirrored (sign -1), and its radius.
inline void add_core(ExactCore& query, const Sphere<double>& sphere, double sign) {
  for (std::size_t i = 0; i < query.start_count; ++i) add_point(query.starts[i], sphere.center, sign);
  query.reach.add(sphere.radius);
}
inline void add_core(ExactCore& query, const Aabb<double>& box, double sign) {
  add_point(query.starts[0], box.center, sign);
  for (int i = 0; i < 3; ++i) add_half_axis(query, box.half_extents[i], axis_vector<double>(i));
}
inline void add_core(ExactCore& query, const Obb<double>& box, double sign) {
  add_point(query.starts[0], box.center, sign);
  for (int i = 0; i < 3; ++i) add_half_axis(query, box.half_extents[i], box.axes.col(i));
}
inline void add_core(ExactCore& query, const Capsule<double>& capsule, double sign) {
  add_point(query.starts[0], capsule.a, sign);
  ExactPoint& edge = query.edges[query.edge_count++];
  add_point(edge, capsule.b, sign);
  add_point(edge, capsule.a, -sign);
  query.reach.add(capsule.radius);
}
inline void add_core(ExactCore& query, const Triangle<double>& t, double sign) {
  query.start_count = 3;
  add_point(query.starts[0], t.a, sign);
  add_point(query.starts[1], t.b, sign);
  add_point(query.starts[2], t.c, sign);
}

/// Requires the shape of later rank first: a triangle before the sphere.
template <Shape A, Shape B> ExactCore exact_core(const Moving<A>& a, const Moving<B>& b) {
  static_assert(A::rank >= B::rank);
  ExactCore query;
  add_core(query, a.shape, 1);
  add_core(query, b.shape, -1);
  add_point(query.velocity, a.displacement, 1);
  add_point(query.velocity, b.displacement, -1);
  return query;
}

// ---- The polytope K(t) of above in integers: every coordinate over one power of two, the largest that divides all.
//
// Numbers: a coordinate of a corner of K is the sum of at most 32 terms below 2^high in multiples of 2^low, so an integer
// of at most L = high - low + 5 bits. integer_bits() gives the bits of the largest number that the walk below makes of them.

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

// ---- Is the origin within reach of a convex polytope? The algorithm of Gilbert, Johnson and Keerthi (GJK) in integers.
//
// It keeps a simplex of corners and the direction n of its point nearest to the origin, a multiple of it, so that nothing
// is divided. Each round asks for the corner lowest along n:
//   - the simplex is within reach: touching;
//   - the corner's plane is beyond reach: apart, and that plane proves it;
//   - else the corner joins, and only the face nearest to the origin stays.
// Every sign is exact, so the distance falls in each round, no simplex comes twice, no four corners lie in one plane, and it
// ends. No tolerance, no limit of rounds.
// Source: Gilbert, Johnson, Keerthi 1988; the budget of bits is derived in docs/certified.md.

/// True if the polytope and the ball of its reach about the origin share a point.
template <class Integer> bool touches_origin(const IntegerPolytope<Integer>& polytope) {
  Simplex<Integer> simplex(polytope.starts[0]);
  const Integer reach_square = polytope.reach * polytope.reach;
  while (true) {
    if (simplex.level == 0) return true;
    const Integer limit = reach_square == 0 ? Integer(0) : Integer(reach_square * dot(simplex.normal, simplex.normal));
    const auto is_beyond = [&](const Integer& level) { return level > 0 && (limit == 0 || level * level > limit); };
    if (!is_beyond(simplex.level)) return true;
    const Triple<Integer> corner = polytope.lowest_along(simplex.normal);
    if (is_beyond(dot(simplex.normal, corner))) return false;
    if (!simplex.add(corner)) return true;
  }
}

// ---- The last stage: the same question in integers, whose answer is right for every finite input.
//
// Whether the shapes have touched by a time t is one exact predicate; two of them give the verdict, and a search among the
// doubles around a guess gives two neighbors that enclose the first contact.

/// True if the shapes share a point at some time in [0, time]. Where the exponents of the input are too far apart for the
/// fixed width, coordinates are cut off there first: no corner moves by as much as 64 units, so a reach that much longer or
/// shorter decides all but a near-touch.
inline bool touched_by(const ExactCore& query, double time) {
  constexpr int fixed = 1024, coordinate_bits = 126, moved = 64;
  static_assert(SweptCore::bits_for(coordinate_bits) <= fixed);
  const SweptCore core(query, time);
  if (core.integer_bits() <= fixed) return touches_origin(IntegerPolytope<FixedInteger<fixed>>(core));

  IntegerPolytope<FixedInteger<fixed>> cut(core, core.low_for(coordinate_bits));
  cut.reach += moved;
  if (!touches_origin(cut)) return false;
  cut.reach -= 2 * moved;
  if (cut.reach >= 0 && touches_origin(cut)) return true;
  return touches_origin(IntegerPolytope<UnboundedInteger>(core));
}

/// The neighboring doubles that enclose the first contact of shapes that do not touch at 0 and have touched by 1.
/// Errors: none; `lower` < first contact <= `upper`. A good guess saves rounds and changes nothing else.
inline CertifiedToi exact_bracket(const ExactCore& query, double guess) {
  const auto number = [](double time) { return std::bit_cast<std::uint64_t>(time); };  // doubles >= 0 in their order
  std::uint64_t lower = number(0.0), upper = number(1.0);
  const auto probe = [&](std::uint64_t at) {
    if (at > lower && at < upper) (touched_by(query, std::bit_cast<double>(at)) ? upper : lower) = at;
  };
  const std::uint64_t center = guess > 0 && guess <= 1 ? number(guess) : number(1.0);
  for (std::uint64_t step = 1; lower + 1 < upper && step <= center / 16; step *= 16) {  // out from the guess
    probe(center - step);
    probe(center + step);
    if (lower + step >= center && upper <= center + step) break;
  }
  while (lower + 1 < upper) probe(lower + (upper - lower) / 2);
  return {ToiStatus::hit, std::bit_cast<double>(lower), std::bit_cast<double>(upper), DecidedBy::exact};
}

inline CertifiedToi exact_answer(const ExactCore& query, double guess) {
  if (touched_by(query, 0)) return {ToiStatus::overlapping, 0, 0, DecidedBy::exact};
  if (!touched_by(query, 1)) return {ToiStatus::apart, 1, 1, DecidedBy::exact};
  return exact_bracket(query, guess);
}

}  // namespace thinwall
