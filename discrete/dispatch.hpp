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
/// Costs: two indirect jumps a query, which mixed types mispredict. To ask about many pairs, group them: below.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

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

// ---- Many pairs at once. Bodies of mixed types make every call through a variant an indirect jump that the processor
// guesses wrong; sorted by type pair, the jumps are gone and each type pair runs through one loop with its query
// inlined.
//
// N bodies among themselves make up to N (N - 1) / 2 pairs, and T types of shape T^2 ordered type pairs, most of them
// empty. Grouping is a counting sort: two passes over the pairs and one over the T^2 groups, no comparison. It is
// stable: within a group the pairs keep their order, and every answer is stored at its pair's place. So the answers
// are those of one-by-one calls, bit for bit and in the same order, whatever the mix.
//
// Grouping costs a pass of its own. It pays where a query is about as cheap as a wrong guess, and more where the same
// pairs are asked again: keep the PairGroups while no body changes its type.

/// Two bodies, by their places in two lists.
struct IndexPair {
  std::uint32_t a = 0;  ///< [1] place in the first list
  std::uint32_t b = 0;  ///< [1] place in the second list
};

/// Places in a list of pairs, sorted by the types of the two bodies; types (i, j) are group number i * types_b + j.
struct PairGroups {
  std::vector<std::uint32_t> order;  ///< the places, group by group
  std::vector<std::uint32_t> start;  ///< where in `order` each group starts, and where the last one ends
};

/// How to read a body of a list: the number of types it may have, which one it has, and the shape as that type.
template <class Body> struct BodyTypes;
template <class... Types> struct BodyTypes<std::variant<Types...>> {
  using Body = std::variant<Types...>;
  static constexpr std::size_t count = sizeof...(Types);
  template <std::size_t i> using Type = std::variant_alternative_t<i, Body>;

  static std::size_t index(const Body& body) { return body.index(); }
  template <std::size_t i> static const Type<i>& get(const Body& body) { return *std::get_if<i>(&body); }
};

/// Groups pairs of bodies of two lists, such as vectors: the same list twice for bodies among themselves.
/// Requires fewer than 2^32 pairs, and places inside the lists.
template <class ListA, class ListB, class Pairs>
PairGroups group_pairs(const ListA& list_a, const ListB& list_b, const Pairs& pairs) {
  using A = BodyTypes<typename ListA::value_type>;
  using B = BodyTypes<typename ListB::value_type>;
  const auto group = [&](const IndexPair& pair) {
    return A::index(list_a[pair.a]) * B::count + B::index(list_b[pair.b]);
  };
  PairGroups groups{std::vector<std::uint32_t>(pairs.size()), std::vector<std::uint32_t>(A::count * B::count + 1)};
  for (const IndexPair& pair : pairs) ++groups.start[group(pair) + 1];
  for (std::size_t i = 1; i < groups.start.size(); ++i) groups.start[i] += groups.start[i - 1];
  std::vector<std::uint32_t> next = groups.start;
  std::uint32_t place = 0;
  for (const IndexPair& pair : pairs) groups.order[next[group(pair)]++] = place++;
  return groups;
}

/// Calls visit(place, a, b) for each pair whose bodies have the types (i, j), with their shapes as these types, in the
/// order of the pairs. None if one type has no volume.
template <std::size_t i, std::size_t j, class ListA, class ListB, class Pairs, class Visit>
void visit_group(const PairGroups& groups, const ListA& list_a, const ListB& list_b, const Pairs& pairs,
                 const Visit& visit) {
  using A = BodyTypes<typename ListA::value_type>;
  using B = BodyTypes<typename ListB::value_type>;
  constexpr bool is_empty = std::is_same_v<typename A::template Type<i>, std::monostate> ||
                            std::is_same_v<typename B::template Type<j>, std::monostate>;
  if constexpr (!is_empty) {
    const auto ask = [&](std::uint32_t place) {
      const IndexPair& pair = pairs[place];
      visit(place, A::template get<i>(list_a[pair.a]), B::template get<j>(list_b[pair.b]));
    };
    constexpr std::size_t group = i * B::count + j;
    for (std::uint32_t k = groups.start[group]; k < groups.start[group + 1]; ++k) ask(groups.order[k]);
  }
}

/// query(a, b) for every pair, in the order of the pairs; `none` where one of the two has no volume.
template <class Answer, class ListA, class ListB, class Pairs, class Query>
std::vector<Answer> answers(const PairGroups& groups, const ListA& list_a, const ListB& list_b, const Pairs& pairs,
                            const Answer& none, const Query& query) {
  constexpr std::size_t types_a = BodyTypes<typename ListA::value_type>::count;
  constexpr std::size_t types_b = BodyTypes<typename ListB::value_type>::count;
  std::vector<Answer> all(pairs.size(), none);
  const auto visit = [&]<class A, class B>(std::uint32_t place, const A& a, const B& b) {
    all[place] = AskedOf<A, B>::answer(query, a, b, none);
  };
  [&]<std::size_t... n>(std::index_sequence<n...>) {
    (visit_group<n / types_b, n % types_b>(groups, list_a, list_b, pairs, visit), ...);
  }(std::make_index_sequence<types_a * types_b>());
  return all;
}

}  // namespace thinwall
