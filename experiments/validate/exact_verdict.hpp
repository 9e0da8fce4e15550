#pragma once
/// When a moving point first touches a flat set, without rounding: the judge of `thinwall validate`.
/// It shares no code with what it judges: linear inequalities over the rationals, and no case for a degenerate input.

#include <array>
#include <optional>

#include <boost/multiprecision/cpp_int.hpp>

namespace thinwall {

using Integer = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<>, boost::multiprecision::et_off>;
using Rational =
    boost::multiprecision::number<boost::multiprecision::cpp_rational_backend, boost::multiprecision::et_off>;
using RationalPoint = std::array<Rational, 3>;

/// a - b.
RationalPoint difference(const RationalPoint& a, const RationalPoint& b);

/// The flat set { alpha * e1 + beta * e2 } with alpha, beta >= 0.
enum class FlatSet {
  triangle,       ///< alpha + beta <= 1
  parallelogram,  ///< alpha, beta <= 1
};

/// A point passes a flat set. A vertex and a face: the vertex seen from the face's first corner. Two edges, s in [0, 1]
/// on the first and u on the second: they touch where the start of the second, seen from that of the first, is at
/// s * (first edge) - u * (second edge), which is a parallelogram.
struct ExactQuery {
  FlatSet set = FlatSet::triangle;
  RationalPoint start;         ///< [length] of the point
  RationalPoint displacement;  ///< [length] over the step
  RationalPoint e1, e2;        ///< [length] what spans the set; of any length and direction
};

/// The first time in [0, 1] at which the point is in the set, touching included; nothing if there is none.
std::optional<Rational> first_contact(const ExactQuery& query);

}  // namespace thinwall
