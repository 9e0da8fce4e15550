#pragma once
/// Lists of types that tests, benchmarks and experiments loop over.

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

}  // namespace thinwall
