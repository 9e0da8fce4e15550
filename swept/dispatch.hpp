#pragma once
/// The time of impact of bodies whose shape is known at run time only. Moving<std::variant<...>> is the shape of any
/// type, or none, and its motion; discrete/dispatch.hpp has the rules.

#include <variant>

#include <thinwall/discrete/dispatch.hpp>
#include <thinwall/swept/time_of_impact.hpp>

namespace thinwall {

/// One of several shapes at time 0, or none, and how far it travels by time 1.
template <class... Types> struct Moving<std::variant<Types...>> {
  std::variant<Types...> shape;
  Vec3<scalar_of<Types...>> displacement;  ///< [length] velocity * dt
};
template <class... Types> Moving(std::variant<Types...>, Vec3<scalar_of<Types...>>) -> Moving<std::variant<Types...>>;

/// Asks about one moving pair of the two lists; the base names it where it is not served.
template <class A, class B> struct AskedOf<Moving<A>, Moving<B>> : AskedOf<A, B> {
  template <class Answer, class Query>
  static Answer answer(const Query& query, const Moving<A>& a, const Moving<B>& b, const Answer& none) {
    if constexpr (ServedPair<A, B>) {
      return query(a, b);
    } else {
      return none;
    }
  }
};

/// A moving body in a list of pairs: its shape decides the group.
template <class... Types> struct BodyTypes<Moving<std::variant<Types...>>> {
  using Held = BodyTypes<std::variant<Types...>>;
  using Body = Moving<std::variant<Types...>>;
  static constexpr std::size_t count = sizeof...(Types);
  template <std::size_t i> using Type = typename Held::template Type<i>;

  static std::size_t index(const Body& body) { return body.shape.index(); }
  template <std::size_t i> static Moving<Type<i>> get(const Body& body) {
    return {Held::template get<i>(body.shape), body.displacement};
  }
};

/// When the two first touch during the step, by `method`. No volume: `apart`.
template <class Method, class... As, class... Bs>
Toi<scalar_of<As...>> time_of_impact(const Method& method, const Moving<std::variant<As...>>& a,
                                     const Moving<std::variant<Bs...>>& b) {
  return visit_shapes(a.shape, b.shape, Toi<scalar_of<As...>>{}, [&]<class A, class B>(const A& x, const B& y) {
    return time_of_impact(method, Moving<A>{x, a.displacement}, Moving<B>{y, b.displacement});
  });
}

/// When the two first touch during the step, exact to rounding. No volume: `apart`.
template <class... As, class... Bs>
Toi<scalar_of<As...>> time_of_impact(const Moving<std::variant<As...>>& a, const Moving<std::variant<Bs...>>& b) {
  return time_of_impact(ClosedForm<scalar_of<As...>>{}, a, b);
}

}  // namespace thinwall
