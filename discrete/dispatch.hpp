#pragma once
/// The queries for bodies whose shape is known at run time only: a `std::variant` of the shapes that a scene has. A
/// body without a volume holds `std::monostate` and collides with nothing.
///
///   using Shape = std::variant<std::monostate, Sphere<double>, Obb<double>>;
///   overlaps(a, b);                                 // both Shape
///
/// Only the pairs of the two lists are compiled. A pair that is not served is a compile error that names it, even if no
/// body ever makes it: a pair skipped in silence is tunneling by omission. The two arguments may have different lists:
/// walls that never meet each other, triangles for one, belong in a list of their own.
///
/// Costs: two indirect jumps a query, which mixed types mispredict. To ask about many pairs, see grouped_pairs.hpp.

#include <optional>
#include <type_traits>
#include <variant>

#include <thinwall/discrete/manifold.hpp>
#include <thinwall/discrete/queries.hpp>

namespace thinwall {

/// Anything that holds one of several shapes, or none.
template <class... Types>
concept ShapesOrNone = ((std::is_same_v<Types, std::monostate> || Shape<Types>)&&...);

/// The scalar of the first shape in a list.
template <class First, class... Rest> struct ScalarOf : ScalarOf<Rest...> {};
template <Shape First, class... Rest> struct ScalarOf<First, Rest...> {
  using type = typename First::Scalar;
};
template <class... Types> using scalar_of = typename ScalarOf<Types...>::type;

/// Asks about one pair of the two lists. Its parameters name that pair in the error where no query serves it.
template <class A, class B> struct AskedOf {
  static_assert(ServedPair<A, B>,
                "this pair of shapes is not served yet; see docs/pairs.md, or keep the two in lists apart");

  template <class Answer, class Query>
  static Answer answer(const Query& query, const A& a, const B& b, const Answer& none) {
    if constexpr (ServedPair<A, B>) {
      return query(a, b);
    } else {
      return none;  // one error is enough
    }
  }
};

/// query(a, b) for the shapes that two variants hold; `none` where one of them holds no volume.
template <class Answer, class... As, class... Bs, class Query>
  requires ShapesOrNone<As...> && ShapesOrNone<Bs...>
Answer visit_shapes(const std::variant<As...>& a, const std::variant<Bs...>& b, const Answer& none,
                    const Query& query) {
  return std::visit(
      [&]<class A, class B>(const A& shape_a, const B& shape_b) -> Answer {
        if constexpr (std::is_same_v<A, std::monostate> || std::is_same_v<B, std::monostate>) {
          return none;
        } else {
          return AskedOf<A, B>::answer(query, shape_a, shape_b, none);
        }
      },
      a, b);
}

/// True if the two share a point; touching counts. No volume: false.
template <class... As, class... Bs> bool overlaps(const std::variant<As...>& a, const std::variant<Bs...>& b) {
  return visit_shapes(a, b, false, [](const auto& x, const auto& y) { return overlaps(x, y); });
}

/// One point of contact data, where overlaps() is true.
template <class... As, class... Bs>
std::optional<Contact<scalar_of<As...>>> contact(const std::variant<As...>& a, const std::variant<Bs...>& b) {
  using Answer = std::optional<Contact<scalar_of<As...>>>;
  return visit_shapes(a, b, Answer{}, [](const auto& x, const auto& y) { return contact(x, y); });
}

/// Every point of contact, where overlaps() is true.
template <class... As, class... Bs>
Manifold<scalar_of<As...>> manifold(const std::variant<As...>& a, const std::variant<Bs...>& b) {
  using Answer = Manifold<scalar_of<As...>>;
  return visit_shapes(a, b, Answer{}, [](const auto& x, const auto& y) { return manifold(x, y); });
}

/// Signed distance, normal and closest points. No volume: nothing, for it is at no distance.
template <class... As, class... Bs>
std::optional<Separation<scalar_of<As...>>> separation(const std::variant<As...>& a, const std::variant<Bs...>& b) {
  using Answer = std::optional<Separation<scalar_of<As...>>>;
  return visit_shapes(a, b, Answer{}, [](const auto& x, const auto& y) -> Answer { return separation(x, y); });
}

/// Where the ray first meets what the variant holds.
template <Scalar S, class... Types>
  requires ShapesOrNone<Types...>
std::optional<RayHit<S>> raycast(const Ray<S>& ray, const std::variant<Types...>& shape) {
  return std::visit(
      [&]<class A>(const A& held) -> std::optional<RayHit<S>> {
        if constexpr (std::is_same_v<A, std::monostate>) {
          return std::nullopt;
        } else {
          return raycast(ray, held);
        }
      },
      shape);
}

}  // namespace thinwall
