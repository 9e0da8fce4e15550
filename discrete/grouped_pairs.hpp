#pragma once
/// Many pairs at once. Bodies of mixed types make every call through a variant an indirect jump that the processor
/// guesses wrong; sorted by type pair, the jumps are gone and each type pair runs through one loop with its query
/// inlined.
///
/// N bodies among themselves make up to N (N - 1) / 2 pairs, and T types of shape T^2 ordered type pairs, most of them
/// empty. Grouping is a counting sort: two passes over the pairs and one over the T^2 groups, no comparison. It is
/// stable: within a group the pairs keep their order, and every answer is stored at its pair's place. So the answers
/// are those of one-by-one calls, bit for bit and in the same order, whatever the mix.
///
/// Grouping costs a pass of its own. It pays where a query is about as cheap as a wrong guess, and more where the same
/// pairs are asked again: keep the PairGroups while no body changes its type.

#include <cstddef>
#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

#include <thinwall/discrete/dispatch.hpp>

namespace thinwall {

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
