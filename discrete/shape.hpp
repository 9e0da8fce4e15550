#pragma once
/// What makes a type a shape, and the one view that serves every pair: a shape is a core (a point, a segment, a box)
/// rounded by a radius. Two shapes are as far apart as their cores, less both radii.
///
/// A shape declares `Scalar` and `rank`, and in its header these free functions:
///   center(shape)      the point its contact data is relative to
///   skin_radius(shape)    the radius around its core; 0 for a box
///   magnitude(shape)   the sum of the absolute values of its fields, not finite if one is not
///   scaled(shape, e)   the shape with every length multiplied by 2^e
///   cast<T>(shape)     the same shape in scalar T
///   moved(shape, by)   the shape translated by a vector
///   half_widths(shape) half of its extent along each axis, around its center
///   has_valid_sizes(shape)  true if no size is negative
///   has_valid_axes(shape)   true if its axes are orthonormal; a shape without axes leaves it out
///   valid(shape)            both, and its fields are finite
///   contact_point(shape, core_point, outward)   where a contact acts, relative to center(shape)
///   ray_entry(ray, shape)                       the raycast, coordinates small enough not to overflow
/// and one overload per unordered pair, written for (later rank, earlier rank), of
///   cores_within(a, b, reach)   true if the cores are at most `reach` apart
///   core_gap(a, b)              how far apart, and where

#include <concepts>
#include <cstring>

#include <thinwall/discrete/numbers/range.hpp>
#include <thinwall/discrete/scalar.hpp>

namespace thinwall {

template <class T>
concept Shape = Scalar<typename T::Scalar> && std::same_as<decltype(T::rank), const int>;

template <class T> bool has_valid_axes(const T&) { return true; }

/// [length] how far from the origin a shape is and reaches, about: its magnitude without what is no length.
template <Shape A> typename A::Scalar extent(const A& shape) {
  return center(shape).cwiseAbs().sum() + half_widths(shape).sum();
}

/// The same shape in a wider scalar; of a box, also as true to its axes as that scalar can be.
template <Scalar W, Shape A> auto widened(const A& shape) { return cast<W>(shape); }

/// True if every length of a shape of doubles or floats, divided by 2^e, is one: nothing is lost below the range.
template <class T> bool divides_exactly(const T& shape, int e) {
  const T back = scaled(scaled(shape, -e), e);
  return std::memcmp(&back, &shape, sizeof(T)) == 0;  // NOLINT(bugprone-suspicious-memory-comparison): bit for bit
}

/// Two cores seen from A. Points are relative to the shapes' centers, so that nothing far from the origin is lost.
template <Scalar S> struct CoreGap {
  S distance = 0;                     ///< [length] < 0: the least translation that parts the cores
  Vec3<S> normal = Vec3<S>::Zero();   ///< unit, from A to B; zero where any direction perpendicular to `along` will do
  Vec3<S> local_a = Vec3<S>::Zero();  ///< [length] closest point of A's core, relative to center(A)
  Vec3<S> local_b = Vec3<S>::Zero();  ///< [length] closest point of B's core, relative to center(B)
  Vec3<S> along = Vec3<S>::Zero();    ///< a direction the cores share where they touch, or zero
};

template <Scalar S> CoreGap<S> flipped(const CoreGap<S>& g) {
  return {g.distance, -g.normal, g.local_b, g.local_a, g.along};
}

/// The unit vector perpendicular to `along` that is nearest to +x; +x itself where `along` is zero, +y where it is
/// parallel to x. This is the normal of shapes whose cores coincide, whichever way round they are passed.
template <Scalar S> Vec3<S> arbitrary_normal(const Vec3<S>& along) {
  const Vec3<S> axis = safe_unit(along);
  const Vec3<S> across(axis[1] * axis[1] + axis[2] * axis[2], -axis[0] * axis[1], -axis[0] * axis[2]);  // x - (x.a) a
  if (axis == Vec3<S>::Zero()) return axis_vector<S>(0);
  return axis[1] == S(0) && axis[2] == S(0) ? axis_vector<S>(1) : safe_unit(across);
}

template <class A, class B>
concept PairInOrder = requires(const A& a, const B& b, const typename A::Scalar& reach) {
  cores_within(a, b, reach);
  core_gap(a, b);
};

/// A pair the library can decide: one of the two orders has the overloads.
template <class A, class B>
concept ServedPair = Shape<A> && Shape<B> && std::same_as<typename A::Scalar, typename B::Scalar> &&
                     (PairInOrder<A, B> || PairInOrder<B, A>);

/// Small enough that differences and sums of a few such numbers do not overflow. False for NaN and infinity.
template <Scalar S> bool is_ordinary(const S& magnitude) { return magnitude <= std::numeric_limits<S>::max() / 64; }

}  // namespace thinwall
