#pragma once
/// Lists of types that tests, benchmarks and experiments loop over.

#include <string_view>
#include <vector>

namespace thinwall {

template <class... Types> struct TypeList {};

/// Stands for a type where a value is wanted.
template <class T> struct TypeTag {
  using type = T;
};

/// Calls f(TypeTag<T>{}) for each T of the list, in order.
template <class... Types, class F> constexpr void for_each_type(TypeList<Types...>, F&& f) {
  (f(TypeTag<Types>{}), ...);
}

/// The names of the list's types, in order: of those that `is(TypeTag<T>{})` holds for.
template <class List, class Is> std::vector<std::string_view> type_names(List list, const Is& is) {
  std::vector<std::string_view> names;
  for_each_type(list, [&]<class T>(TypeTag<T> tag) {
    if (is(tag)) names.push_back(T::name);
  });
  return names;
}
template <class List> std::vector<std::string_view> type_names(List list) {
  return type_names(list, [](auto) { return true; });
}

}  // namespace thinwall
