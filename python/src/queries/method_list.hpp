#pragma once
/// Methods by name, with options by name.

#include "queries.hpp"

namespace thinwall::python {

/// A method with what `options` sets of what it has.
template <class Method> Method with_options(const Options& options) {
  Method method{};
  const auto set = [](auto& option, const auto& value) {
    if (value) option = static_cast<std::remove_reference_t<decltype(option)>>(*value);
  };
  set(method.min_separation, options.min_separation);
  if constexpr (requires { method.tolerance; }) set(method.tolerance, options.tolerance);
  if constexpr (requires { method.margin; }) set(method.margin, options.margin);
  if constexpr (requires { method.n; }) set(method.n, options.n);
  if constexpr (requires { method.max_evaluations; }) set(method.max_evaluations, options.max_evaluations);
  return method;
}

/// The names of a list of methods, and of the options of each.
template <class List> MethodOptions names_of(List list) {
  MethodOptions names;
  for_each_type(list, [&]<class Tag>(Tag) {
    using Method = typename Tag::type;
    std::vector<std::string> options;
    if constexpr (requires(Method m) { m.tolerance; }) options.emplace_back("tolerance");
    if constexpr (requires(Method m) { m.margin; }) options.emplace_back("margin");
    if constexpr (requires(Method m) { m.n; }) options.emplace_back("n");
    if constexpr (requires(Method m) { m.max_evaluations; }) options.emplace_back("max_evaluations");
    options.emplace_back("min_separation");
    names.emplace_back(Method::name, options);
  });
  return names;
}

/// Calls ask.template operator()<Method>() for the method of that name.
template <class List, class Ask> void for_the_method(const std::string& name, List list, const Ask& ask) {
  for_each_type(list, [&]<class Tag>(Tag) {
    using Method = typename Tag::type;
    if (Method::name == name) ask.template operator()<Method>();
  });
}

}  // namespace thinwall::python
