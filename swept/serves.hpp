#pragma once
/// Which pairs a method serves. A method is an options struct with a `name`, a `min_separation`, and an overload
///
///   Toi<T> impact(const Method<S>& method, const Moving<A>& a, const Moving<B>& b)
///
/// that computes in the shapes' scalar T and is constrained to the pairs it can do, with the shape of later rank first.
/// It may take its input as valid and small enough not to overflow: time_of_impact(method, a, b) sees to that.

#include <concepts>

#include <thinwall/discrete/queries.hpp>
#include <thinwall/swept/moving.hpp>
#include <thinwall/swept/toi.hpp>

namespace thinwall {

template <class Method, class A, class B>
concept ServesInOrder = requires(const Method& method, const Moving<A>& a, const Moving<B>& b) {
  { impact(method, a, b) } -> std::same_as<Toi<typename A::Scalar>>;
};

/// True if `method` can be asked for the time of impact of A and B, in either order.
template <class Method, class A, class B>
inline constexpr bool serves = A::rank < B::rank ? ServesInOrder<Method, B, A> : ServesInOrder<Method, A, B>;

/// The motion of A seen from B.
template <class A, class B> Vec3<typename A::Scalar> relative_displacement(const Moving<A>& a, const Moving<B>& b) {
  return a.displacement - b.displacement;
}

/// The answer for shapes that touch or overlap at the start, which may turn as well: of their separation there, or asking for it.
template <Scalar S> Toi<S> overlapping_at_start(const Separation<S>& start, int evaluations) {
  return {ToiStatus::overlapping, evaluations, S(0), start.normal, middle(start)};
}
template <template <class> class Motion, class A, class B>
THINWALL_COLD Toi<typename A::Scalar> overlapping_at_start(const Motion<A>& a, const Motion<B>& b, int evaluations) {
  return overlapping_at_start(separation_unchecked(a.shape, b.shape), evaluations);
}

}  // namespace thinwall
