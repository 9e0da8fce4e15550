#pragma once
/// The answer of certified_time_of_impact, and the pairs it serves.

#include <concepts>
#include <limits>
#include <type_traits>

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/discrete/triangle.hpp>
#include <thinwall/swept/toi.hpp>

namespace thinwall {

/// The stage that decided, cheapest first.
enum class DecidedBy {
  guard,        ///< the input is no question: a NaN, an infinity, a negative size
  filter,       ///< a formula in double whose rounding errors are bounded (spheres, boxes along the axes)
  certificate,  ///< a plane that parts the shapes, and a point they share, checked in double with bounded errors
  exact,        ///< integers made of the doubles' own bits
};

/// A proven answer for the shapes as given: every number is exactly the double it is.
struct CertifiedToi {
  ToiStatus verdict = ToiStatus::invalid;  ///< proven, or `gave_up`, which only shapes that turn can be
  double lower = std::numeric_limits<double>::quiet_NaN();  ///< [1] no contact before it; in [0, 1], NaN if invalid
  double upper = std::numeric_limits<double>::quiet_NaN();  ///< [1] contact by then; in [0, 1], NaN if invalid
  DecidedBy decided_by = DecidedBy::guard;

  bool operator==(const CertifiedToi&) const = default;
};

/// Core shapes whose Minkowski sums are zonotopes: points, segments and boxes, each rounded by a radius.
template <class A> inline constexpr bool has_zonotope_core = false;
template <> inline constexpr bool has_zonotope_core<Sphere<double>> = true;
template <> inline constexpr bool has_zonotope_core<Aabb<double>> = true;
template <> inline constexpr bool has_zonotope_core<Obb<double>> = true;
template <> inline constexpr bool has_zonotope_core<Capsule<double>> = true;

/// Two of these are decided by the same numbers, but for their signs, whichever is passed first.
template <class A>
inline constexpr bool has_symmetric_filter = std::same_as<A, Sphere<double>> || std::same_as<A, Aabb<double>>;

/// True if certified_time_of_impact answers for A and B, in either order.
template <class A, class B>
inline constexpr bool certifies = (has_zonotope_core<A> && has_zonotope_core<B>) ||
                                  (std::same_as<A, Triangle<double>> && std::same_as<B, Sphere<double>>) ||
                                  (std::same_as<A, Sphere<double>> && std::same_as<B, Triangle<double>>);

}  // namespace thinwall
