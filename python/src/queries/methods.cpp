/// Times of impact by every other method.
#include <thinwall/swept/compiled.hpp>
#include <thinwall/swept/methods.hpp>
#include <thinwall/swept/time_of_impact.hpp>

#include "method_list.hpp"

namespace thinwall::python {

namespace {

template <class Method> struct AskedOf {
  template <class A, class B> struct Pair {
    static constexpr bool value = A::rank >= B::rank && serves<Method, A, B>;
  };
};

template <class Method, class S> bool ask_all(const Method& method, const Question& q) {
  return for_the_shapes<S, AskedOf<Method>::template Pair>(q, [&]<class A, class B>() {
    answer_rows<Toi<S>>(q, [&](std::size_t i) {
      const auto a = row_of<Moving<A>, S>(q.a, i);
      const auto b = row_of<Moving<B>, S>(q.b, i);
      const Toi<S> toi = time_of_impact(method, a, b);
      return q.swapped ? flipped(toi) : toi;
    });
  });
}

template <class S> bool ask_named(const std::string& name, const Question& q, const Options& options) {
  bool asked = false;
  for_the_method(name, Methods<S>{}, [&]<class Method>() {
    if constexpr (!std::is_same_v<Method, ClosedForm<S>>) asked = ask_all<Method, S>(with_options<Method>(options), q);
  });
  return asked;
}

}  // namespace

MethodOptions methods() { return names_of(Methods<double>{}); }

bool ask_method(const std::string& method, const Question& q, const Options& options) {
  return q.is_float ? ask_named<float>(method, q, options) : ask_named<double>(method, q, options);
}

}  // namespace thinwall::python
