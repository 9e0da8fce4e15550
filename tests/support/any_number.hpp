#pragma once
/// Shapes with any number in any of their fields: what every query must survive, and answer as it promises.

#include <concepts>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/swept/shapes.hpp>

#include "support/numbers_of.hpp"
#include "support/shaker.hpp"

namespace thinwall::testing {

template <class S> std::vector<S> special_numbers() {
  using Limits = std::numeric_limits<S>;
  const S huge = Limits::max() / 64, tiny = Limits::min() * 64;
  return {Limits::quiet_NaN(),
          Limits::infinity(),
          -Limits::infinity(),
          S(-1),
          S(0),
          Limits::denorm_min(),
          Limits::max(),
          -Limits::max(),
          huge,
          -huge,
          tiny};
}

template <class S> Sphere<S> usual(TypeTag<Sphere<S>>) { return {{0, 0.25, 0}, 1}; }
template <class S> Aabb<S> usual(TypeTag<Aabb<S>>) { return {{0, 0.5, 0}, {1, 0.5, 1}}; }
template <class S> Obb<S> usual(TypeTag<Obb<S>>) {
  return {{0, 0.5, 0}, {1, 0.5, 1}, turn_in_plane<S>(0, 1, S(3) / S(5), S(4) / S(5))};
}
template <class S> Triangle<S> usual(TypeTag<Triangle<S>>) { return {{-1, 0, 0}, {1, 0, 0.5}, {0, 1, -0.5}}; }
template <class S> Capsule<S> usual(TypeTag<Capsule<S>>) { return {{-1, 0, 0}, {1, 0.25, 0}, 0.5}; }

/// visit(), or visit(name, number), with each special number in turn in each field of `thing`, which is then put back.
template <class S, class Thing, class Visit> void with_every_number(Thing& thing, const Visit& visit) {
  for_each_named_number(thing, [&](const std::string& name, S& number) {
    const S usual_number = number;
    for (const S& special : special_numbers<S>()) {
      SCOPED_TRACE(name + " is " + std::to_string(static_cast<double>(special)));
      number = special;
      if constexpr (std::invocable<const Visit&, const std::string&, const S&>) {
        visit(name, special);
      } else {
        visit();
      }
    }
    number = usual_number;
  });
}

/// visit(TypeTag<A>, TypeTag<B>) for every pair that is served, in the order of its overload.
template <class S, class Visit> void for_each_served_pair(const Visit& visit) {
  for_each_type(Shapes<S>{}, [&]<class A>(TypeTag<A> first) {
    for_each_type(Shapes<S>{}, [&]<class B>(TypeTag<B> second) {
      if constexpr (ServedPair<A, B> && A::rank >= B::rank) {
        SCOPED_TRACE(std::string(shape_name<A>) + " and " + std::string(shape_name<B>));
        visit(first, second);
      }
    });
  });
}

/// A box's axes longer than 1, by nearly as much as they may be.
template <class A> A lengthened(A shape) {
  if constexpr (requires { shape.axes; }) shape.axes *= 1 + 0x1p-33;
  return shape;
}

}  // namespace thinwall::testing
