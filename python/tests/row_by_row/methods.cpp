#include <thinwall/swept/methods.hpp>
#include <thinwall/swept/time_of_impact.hpp>
#include <thinwall/swept/turning/turning_impact.hpp>

#include "row_by_row.hpp"

namespace thinwall::row_by_row {

namespace {

/// Every method, of a few pairs: the pair changes what a row is, the method what is asked of it.
template <class A, class B> bool ask(const Task& task) {
  using S = typename A::Scalar;
  bool asked = false;
  if (task.query == "turning") {
    return each_row<A, B, S>(task, [&](const auto& a, const auto& b) {
      if constexpr (stays_along_the_axes<B>) {
        put(time_of_impact(Turning<A>{a.shape, a.displacement, a.rotation}, Moving<B>{b.shape, b.displacement}));
      } else {
        put(time_of_impact(Turning<A>{a.shape, a.displacement, a.rotation},
                           Turning<B>{b.shape, b.displacement, b.rotation}));
      }
    });
  }
  for_each_type(Methods<S>{}, [&]<class Tag>(Tag) {
    using Method = typename Tag::type;
    if constexpr (serves<Method, A, B>) {
      if (Method::name != task.method) return;
      asked = each_row<A, B, S>(task, [](const auto& a, const auto& b) {
        put(time_of_impact(Method{}, Moving<A>{a.shape, a.displacement}, Moving<B>{b.shape, b.displacement}));
      });
    }
  });
  return asked;
}

}  // namespace

template <class S> bool by_method(const Task& task) {
  return ask<Sphere<S>, Aabb<S>>(task) || ask<Obb<S>, Sphere<S>>(task) || ask<Sphere<S>, Capsule<S>>(task) ||
         ask<Capsule<S>, Capsule<S>>(task);
}
template bool by_method<float>(const Task&);
template bool by_method<double>(const Task&);

}  // namespace thinwall::row_by_row
