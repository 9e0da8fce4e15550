#pragma once
/// Are computed vectors unit, and computed points on the surfaces they should be on?

#include "support/errors.hpp"
#include "support/pair.hpp"

namespace thinwall::testing {

template <class Vector> bool is_unit(const Vector& v) {
  const oracle::Real error = oracle::length(oracle::lift_vector(v)) - 1;  // NaN compares false
  return abs(error) <= 4 * oracle::unit_roundoff<typename Vector::Scalar>();
}

/// The size of all numbers involved, in any direction: bounds the rounding of a point in space.
inline oracle::Real size_at(const oracle::Pair& pair, const oracle::Real& time) {
  return oracle::scale(pair, time, {1, 1, 1});
}

/// How far a point is from the surface of a body.
inline oracle::Real off_surface(const oracle::Vector& point, const oracle::Body& body) {
  oracle::Body dot;
  dot.center = point;
  return abs(oracle::gap({body, dot, 0}, 0).separation);
}

}  // namespace thinwall::testing
