#pragma once
/// A time of impact that is proven: which of hit, miss and overlap it is, and two doubles that enclose the first contact.
/// Needs Boost.Multiprecision's headers; link thinwall::certified.

#include <thinwall/swept/certified/certificate_stage.hpp>
#include <thinwall/swept/certified/exact_stage.hpp>
#include <thinwall/swept/certified/filters.hpp>
#include <thinwall/swept/time_of_impact.hpp>

namespace thinwall {

/// Which pairs can be certified; the error names the two that cannot.
template <class A, class B> struct CertifiedAskedOf {
  static_assert(certifies<A, B>, "this pair of shapes cannot be certified: see docs/certified.md");
};

/// What needs more than double.
template <Shape A, Shape B> THINWALL_COLD CertifiedToi decided_exactly(const Moving<A>& a, const Moving<B>& b) {
  if (!valid(a) || !valid(b)) return {};
  return exact_answer(exact_core(a, b), time_of_impact(a, b).time);  // a guess at any scale, unlike the certificate's
}

/// What bounded rounding decides; `gave_up` for the rest, and for whatever is not finite.
template <Shape A, Shape B> THINWALL_HOT CertifiedToi decided_in_double(const Moving<A>& a, const Moving<B>& b) {
  const Vec3<double> v = relative_displacement(a, b);
  if constexpr (std::same_as<A, Sphere<double>> && std::same_as<B, Sphere<double>>) {
    return ball_filter(a.shape.center - b.shape.center, v, a.shape.radius + b.shape.radius);
  } else if constexpr (std::same_as<A, Aabb<double>> && std::same_as<B, Aabb<double>>) {
    return slab_filter(a.shape.center - b.shape.center, v, a.shape.half_extents + b.shape.half_extents);
  } else {
    constexpr double most = 0x1p200;  // NaN compares false
    return magnitude(a) + magnitude(b) <= most ? certificate(a, b) : undecided;
  }
}

/// The stages, one after the other.
template <Shape A, Shape B> THINWALL_HOT CertifiedToi certified_in_order(const Moving<A>& a, const Moving<B>& b) {
  if (!has_valid_sizes(a) || !has_valid_sizes(b) || !has_valid_axes(a) || !has_valid_axes(b)) return {};
  const CertifiedToi fast = decided_in_double(a, b);
  return fast.verdict != ToiStatus::gave_up ? fast : decided_exactly(a, b);
}

/// True if x is greater in the first number in which it and y differ.
template <class Matrix> bool is_later(const Matrix& x, const Matrix& y) {
  return std::lexicographical_compare(y.data(), y.data() + y.size(), x.data(), x.data() + x.size());
}

/// Two of a kind are asked about in one order, whichever way they are passed: by the first number in which they differ.
inline bool comes_later(const Moving<Obb<double>>& a, const Moving<Obb<double>>& b) {
  if (a.shape.center != b.shape.center) return is_later(a.shape.center, b.shape.center);
  if (a.shape.half_extents != b.shape.half_extents) return is_later(a.shape.half_extents, b.shape.half_extents);
  if (a.shape.axes != b.shape.axes) return is_later(a.shape.axes, b.shape.axes);
  return is_later(a.displacement, b.displacement);
}
inline bool comes_later(const Moving<Capsule<double>>& a, const Moving<Capsule<double>>& b) {
  if (a.shape.a != b.shape.a) return is_later(a.shape.a, b.shape.a);
  if (a.shape.b != b.shape.b) return is_later(a.shape.b, b.shape.b);
  if (a.shape.radius != b.shape.radius) return a.shape.radius > b.shape.radius;
  return is_later(a.displacement, b.displacement);
}

/// When A and B first touch during the step: a proven verdict, and `lower` <= first contact <= `upper`.
///   hit: no contact before `lower`, contact by `upper`.   overlapping: in contact at the start, both 0.
///   apart: no contact in the step, both 1.                invalid: a shape that is not valid(), both NaN.
/// Contact is closed: touching counts. All valid input is answered; `gave_up` never is.
/// The shapes are the numbers as given, without rounding: a capsule is all points within its radius of its core segment, and
/// an oriented box all center + sum of x_i h_i axes.col(i) with |x_i| <= 1, though its axes be orthonormal to rounding only.
/// Error: none; the bracket is a few units in the last place wide, times the conditioning of the contact (docs/certified.md).
/// Degenerate: points, segments, plates, no motion and exact touches are all decided.
/// Passing A and B the other way round gives the same bits.
/// Source: derived in docs/certified.md.
template <Shape A, Shape B> CertifiedToi certified_time_of_impact(const Moving<A>& a, const Moving<B>& b) {
  (void)CertifiedAskedOf<A, B>{};
  if constexpr (A::rank < B::rank) {
    return certified_time_of_impact(b, a);
  } else {
    if constexpr (std::same_as<A, B> && !has_symmetric_filter<A>) {
      if (comes_later(a, b)) return certified_in_order(b, a);
    }
    return certified_in_order(a, b);
  }
}

}  // namespace thinwall
