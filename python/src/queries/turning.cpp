/// Times of impact where a shape turns.
#include <thinwall/swept/compiled.hpp>
#include <thinwall/swept/turning/turning_impact.hpp>

#include "method_list.hpp"

namespace thinwall::python {

namespace {

template <class Method> struct AskedOf {
  template <class A, class B> struct Pair {
    static constexpr bool value = [] {
      if constexpr (stays_along_the_axes<A> || stays_along_the_axes<B>) {
        return false;
      } else {
        return A::rank >= B::rank && serves_turning<Method, A, B>;
      }
    }();
  };
};

template <class Method, class S> bool ask_all(const Method& method, const Question& q) {
  return for_the_shapes<S, AskedOf<Method>::template Pair>(q, [&]<class A, class B>() {
    answer_rows<Toi<S>>(q, [&](std::size_t i) {
      const Toi<S> toi = time_of_impact(method, turning_row<A, S>(q.a, i), turning_row<B, S>(q.b, i));
      return q.swapped ? flipped(toi) : toi;
    });
  });
}

template <class S> bool ask_named(const std::string& name, const Question& q, const Options& options) {
  bool asked = false;
  for_the_method(name, TurningMethods<S>{},
                 [&]<class Method>() { asked = ask_all<Method, S>(with_options<Method>(options), q); });
  return asked;
}

}  // namespace

MethodOptions turning_methods() { return names_of(TurningMethods<double>{}); }

bool ask_turning(const std::string& method, const Question& q, const Options& options) {
  return q.is_float ? ask_named<float>(method, q, options) : ask_named<double>(method, q, options);
}

}  // namespace thinwall::python
