/// The questions at one instant. Both orders of a pair are asked of the front door, whose answers to shapes that lie on each
/// other are not those of the other order turned round.
#include <thinwall/capsule/capsule_manifold.hpp>
#include <thinwall/discrete/boxes/box_manifold.hpp>
#include <thinwall/swept/compiled.hpp>

#include "queries.hpp"

namespace thinwall::python {

namespace {

template <class A, class B> struct Asked {
  static constexpr bool value = ServedPair<A, B>;
};
template <class A, class B> struct AskedForManifold {
  static constexpr bool value = ServedPair<A, B> && serves_manifold<A, B>;
};

/// `ask(a, b)` of every row, in the scalar of the arrays.
template <template <class, class> class Serves, class Ask> bool ask_rows(const Question& q, const Ask& ask) {
  const auto ask_all = [&]<class S>(TypeTag<S>) {
    return for_the_shapes<S, Serves>(q, [&]<class A, class B>() {
      answer_rows(q, [&](std::size_t i) { return ask(row_of<A, S>(q.a, i), row_of<B, S>(q.b, i)); });
    });
  };
  return q.is_float ? ask_all(TypeTag<float>{}) : ask_all(TypeTag<double>{});
}

/// Of two that are not in contact.
template <class A, class B> ToiStatus apart_or_invalid(const A& a, const B& b) {
  return valid(a) && valid(b) ? ToiStatus::apart : ToiStatus::invalid;
}

template <class S> bool valid_rows(const Question& q) {
  for_each_type(Shapes<S>{}, [&]<class Tag>(Tag) {
    using A = typename Tag::type;
    if (A::rank != q.a.kind) return;
    answer_rows(q, [&](std::size_t i) {
      RowReader<S> from(q.a, i);
      Moving<A> item{from.template item<A>(), Vec3<S>::Zero()};
      if (q.a.motion != Motion::none) item.displacement = from.vector();
      const bool turns_well = q.a.motion != Motion::turning || is_finite(from.vector());
      return valid(item) && turns_well;
    });
  });
  if (q.a.kind < Capsule<S>::rank + 1) return true;
  answer_rows(q, [&](std::size_t i) { return valid(row_of<Ray<S>, S>(q.a, i)); });
  return true;
}

}  // namespace

bool ask_overlaps(const Question& q) {
  return ask_rows<Asked>(q, [](const auto& a, const auto& b) { return overlaps(a, b); });
}

bool ask_contact(const Question& q) {
  return ask_rows<Asked>(q, []<class A, class B>(const A& a, const B& b) -> ContactRow<typename A::Scalar> {
    if (const auto answer = contact(a, b)) return {ToiStatus::overlapping, *answer};
    return {apart_or_invalid(a, b), {}};
  });
}

bool ask_separation(const Question& q) {
  return ask_rows<Asked>(
      q, []<class A, class B, class S = typename A::Scalar>(const A& a, const B& b)->SeparationRow<S> {
        const Separation<S> answer = separation(a, b);
        if (answer.distance != answer.distance) return {ToiStatus::invalid, answer};
        return {answer.distance > S(0) ? ToiStatus::apart : ToiStatus::overlapping, answer};
      });
}

bool ask_manifold(const Question& q) {
  return ask_rows<AskedForManifold>(
      q, []<class A, class B, class S = typename A::Scalar>(const A& a, const B& b)->ManifoldRow<S> {
        const Manifold<S> answer = manifold(a, b);
        return {answer.empty() ? apart_or_invalid(a, b) : ToiStatus::overlapping, answer};
      });
}

bool ask_valid(const Question& q) { return q.is_float ? valid_rows<float>(q) : valid_rows<double>(q); }

}  // namespace thinwall::python
