/// Times of impact by every other method, by those for what turns, and certified ones.
#include <thinwall/swept/certified.hpp>
#include <thinwall/swept/certified/turning_certified.hpp>
#include <thinwall/swept/compiled.hpp>
#include <thinwall/swept/methods.hpp>
#include <thinwall/swept/time_of_impact.hpp>
#include <thinwall/swept/turning/turning_impact.hpp>

#include "queries.hpp"

namespace thinwall::python {

namespace {

/// use(name, option, value) of every option that the method has, with what `options` says of it.
template <class Method, class Use> void for_each_option(Method& method, const Options& options, const Use& use) {
  if constexpr (requires { method.tolerance; }) use("tolerance", method.tolerance, options.tolerance);
  if constexpr (requires { method.margin; }) use("margin", method.margin, options.margin);
  if constexpr (requires { method.n; }) use("n", method.n, options.n);
  if constexpr (requires { method.max_evaluations; })
    use("max_evaluations", method.max_evaluations, options.max_evaluations);
  use("min_separation", method.min_separation, options.min_separation);
}

/// A method with what `options` sets of what it has.
template <class Method> Method with_options(const Options& options) {
  Method method{};
  for_each_option(method, options, []<class Option>(const char*, Option& option, const auto& value) {
    if (value) option = static_cast<Option>(*value);
  });
  return method;
}

/// The names of a list of methods, and of the options of each.
template <class List> MethodOptions names_of(List list) {
  MethodOptions names;
  for_each_type(list, [&]<class Method>(TypeTag<Method>) {
    Method method{};
    std::vector<std::string>& options = names.emplace_back(Method::name, std::vector<std::string>()).second;
    for_each_option(method, {}, [&](const char* name, const auto&, const auto&) { options.emplace_back(name); });
  });
  return names;
}

// ---- Which pairs are served.

/// Boxes along the axes do not turn: `serves()` is not asked of them.
template <class A, class B> constexpr bool may_turn(const auto& serves) {
  if constexpr (stays_along_the_axes<A> || stays_along_the_axes<B>) {
    return false;
  } else {
    return A::rank >= B::rank && serves.template operator()<A, B>();
  }
}

template <class Method> struct By {
  template <class A, class B> struct Pair {
    static constexpr bool value = A::rank >= B::rank && serves<Method, A, B>;
  };
  template <class A, class B> struct TurningPair {
    static constexpr bool value = may_turn<A, B>([]<class C, class D>() { return serves_turning<Method, C, D>; });
  };
};

template <class A, class B> struct Certified {
  static constexpr bool value = A::rank >= B::rank && certifies<A, B>;
};
template <class A, class B> struct CertifiedTurning {
  static constexpr bool value = may_turn<A, B>([]<class C, class D>() { return ServedPair<C, D>; });
};

// ---- `answer(a, b)` of every row.

template <class S, template <class, class> class Serves, class Answer>
bool ask_moving(const Question& q, const Answer& answer) {
  return for_the_shapes<S, Serves>(q, [&]<class A, class B>() {
    answer_rows(q, [&](std::size_t i) { return answer(row_of<Moving<A>, S>(q.a, i), row_of<Moving<B>, S>(q.b, i)); });
  });
}

template <class S, template <class, class> class Serves, class Answer>
bool ask_that_turn(const Question& q, const Answer& answer) {
  return for_the_shapes<S, Serves>(q, [&]<class A, class B>() {
    answer_rows(q, [&](std::size_t i) { return answer(turning_row<A, S>(q.a, i), turning_row<B, S>(q.b, i)); });
  });
}

template <class S, bool turns, class List>
bool ask_named(const std::string& name, List list, const Question& q, const Options& options) {
  bool asked = false;
  for_each_type(list, [&]<class Method>(TypeTag<Method>) {
    if (Method::name != name) return;
    const auto answer = [&q, method = with_options<Method>(options)](const auto& a, const auto& b) {
      const Toi<S> toi = time_of_impact(method, a, b);
      return q.swapped ? flipped(toi) : toi;
    };
    if constexpr (turns) {
      asked = ask_that_turn<S, By<Method>::template TurningPair>(q, answer);
    } else if constexpr (!std::is_same_v<Method, ClosedForm<S>>) {
      asked = ask_moving<S, By<Method>::template Pair>(q, answer);
    }
  });
  return asked;
}

}  // namespace

MethodOptions methods() { return names_of(Methods<double>{}); }
MethodOptions turning_methods() { return names_of(TurningMethods<double>{}); }

bool ask_method(const std::string& method, const Question& q, const Options& options) {
  return q.is_float ? ask_named<float, false>(method, Methods<float>{}, q, options)
                    : ask_named<double, false>(method, Methods<double>{}, q, options);
}

bool ask_turning(const std::string& method, const Question& q, const Options& options) {
  return q.is_float ? ask_named<float, true>(method, TurningMethods<float>{}, q, options)
                    : ask_named<double, true>(method, TurningMethods<double>{}, q, options);
}

/// Of double alone: they are proven for the numbers as given.
bool ask_certified(const Question& q) {
  const auto answer = [](const auto& a, const auto& b) { return certified_time_of_impact(a, b); };
  if (q.a.motion == Motion::turning || q.b.motion == Motion::turning)
    return ask_that_turn<double, CertifiedTurning>(q, answer);
  return ask_moving<double, Certified>(q, answer);
}

}  // namespace thinwall::python
