#include <thinwall/capsule/capsule_manifold.hpp>
#include <thinwall/discrete/boxes/box_manifold.hpp>

#include "row_by_row.hpp"

namespace thinwall::row_by_row {

namespace {

template <Scalar S> void put_contact(const Contact<S>& c) {
  put(c.local_a);
  put(c.local_b);
  put(c.normal);
  put(c.penetration);
}

template <class A, class B> void ask(const std::string& query, const A& a, const B& b) {
  using S = typename A::Scalar;
  if (query == "overlaps") put(overlaps(a, b));
  if (query == "contact") {
    const auto answer = contact(a, b);
    put(answer.has_value());
    put_contact(answer.value_or(Contact<S>{}));
  }
  if (query == "separation") {
    const Separation<S> answer = separation(a, b);
    put(answer.distance);
    put(answer.normal);
    put(answer.point_a);
    put(answer.point_b);
  }
  if (query == "manifold") {
    const Manifold<S> answer = manifold(a, b);
    put(answer.count);
    for (const Contact<S>& c : answer.contacts) put_contact(c);
  }
}

}  // namespace

template <class S> bool at_rest(const Task& task) {
  bool asked = false;
  for_each_type(Shapes<S>{}, [&]<class TagA>(TagA) {
    using A = typename TagA::type;
    if (task.query == "raycast") {
      asked = asked || each_row<Ray<S>, A, S>(task, [](const auto& ray, const auto& body) {
                const auto hit = raycast(ray.shape, body.shape);
                put(hit.has_value());
                put(hit.value_or(RayHit<S>{}).t);
                put(hit.value_or(RayHit<S>{}).normal);
                put(hit.value_or(RayHit<S>{}).point);
              });
      return;
    }
    for_each_type(Shapes<S>{}, [&]<class TagB>(TagB) {
      using B = typename TagB::type;
      if constexpr (ServedPair<A, B>) {
        asked =
            asked || each_row<A, B, S>(task, [&](const auto& a, const auto& b) { ask(task.query, a.shape, b.shape); });
      }
    });
  });
  return asked;
}
template bool at_rest<float>(const Task&);
template bool at_rest<double>(const Task&);

}  // namespace thinwall::row_by_row
