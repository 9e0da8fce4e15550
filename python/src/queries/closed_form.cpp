/// Times of impact by the closed form, by the batch kernels where the pair has one; and rays.
#include <thinwall/swept/compiled.hpp>
#include <thinwall/swept/time_of_impact.hpp>

#include "batch_rows.hpp"
#include "queries.hpp"

namespace thinwall::python {

namespace {

template <class A, class B> struct Asked {
  using S = typename A::Scalar;
  static constexpr bool value =
      A::rank >= B::rank && std::is_same_v<S, typename B::Scalar> && serves<ClosedForm<S>, A, B>;
};

/// The pairs of swept/batch.hpp, the shape of later rank first.
template <class A, class B> inline constexpr bool has_kernel = false;
template <Scalar S> inline constexpr bool has_kernel<Sphere<S>, Sphere<S>> = true;
template <Scalar S> inline constexpr bool has_kernel<Aabb<S>, Sphere<S>> = true;
template <Scalar S> inline constexpr bool has_kernel<Obb<S>, Sphere<S>> = true;
template <Scalar S> inline constexpr bool has_kernel<Capsule<S>, Sphere<S>> = true;
template <Scalar S> inline constexpr bool has_kernel<Aabb<S>, Aabb<S>> = true;

template <Scalar S> Toi<S> turned_round(const Toi<S>& toi, bool swapped) { return swapped ? flipped(toi) : toi; }

template <class Row, Scalar S> Row row_with(const Toi<S>& toi) {
  if constexpr (std::is_same_v<Row, Toi<S>>) {
    return toi;
  } else {
    return {toi.status, toi.evaluations, toi.time};
  }
}

/// The scalar code's answer. Compiled once a pair: all of the query is inlined here.
template <class A, class B, class S>
[[gnu::noinline]] Toi<S> ask_items(const ClosedForm<S>& method, bool swapped, const Moving<A>& a, const Moving<B>& b) {
  return turned_round(time_of_impact(method, a, b), swapped);
}

template <class A, class B, class Row> void ask_pair(const Question& q, typename A::Scalar min_separation) {
  using S = typename A::Scalar;
  const ClosedForm<S> method{min_separation};
  const auto set = [&](Row& row, const Moving<A>& a, const Moving<B>& b) {
    row = row_with<Row>(ask_items(method, q.swapped, a, b));
  };
  if constexpr (has_kernel<A, B>) {
    if (min_separation == S(0)) {
      answer_by_kernel<Moving<A>, Moving<B>, S>(q, std::is_same_v<Row, Toi<S>>, static_cast<Row*>(q.out), set,
                                                [](ToiStatus status, S time) {
                                                  return Row{status, 1, time};
                                                });
      return;
    }
  }
  answer_rows<Row>(q, [&](std::size_t i) {
    return row_with<Row>(ask_items(method, q.swapped, row_of<Moving<A>, S>(q.a, i), row_of<Moving<B>, S>(q.b, i)));
  });
}

template <class S> bool ask_all(const Question& q, S min_separation, bool vectors) {
  return for_the_shapes<S, Asked>(q, [&]<class A, class B>() {
    if (vectors) {
      ask_pair<A, B, Toi<S>>(q, min_separation);
    } else {
      ask_pair<A, B, TimeRow<S>>(q, min_separation);
    }
  });
}

// ---- Rays.

template <class S, class A> [[gnu::noinline]] RayRow<S> cast_row(const Ray<S>& ray, const A& shape) {
  if (const auto hit = raycast(ray, shape))
    return {hit->normal == Vec3<S>::Zero() ? ToiStatus::overlapping : ToiStatus::hit, *hit};
  if (!valid(ray) || !valid(shape)) return {ToiStatus::invalid, {std::numeric_limits<S>::quiet_NaN()}};
  return {ToiStatus::apart, {ray.max_t}};
}

template <class S> bool cast_rays(const Question& q) {
  bool asked = false;
  for_each_type(Shapes<S>{}, [&]<class Tag>(Tag) {
    using A = typename Tag::type;
    if (A::rank != q.b.kind) return;
    asked = true;
    if constexpr (std::is_same_v<A, Aabb<S>>) {
      const Question boxes_first{q.b, q.a, q.rows, q.out, q.threads, q.is_float};
      answer_by_kernel<Aabb<S>, Ray<S>, S>(
          boxes_first, true, static_cast<RayRow<S>*>(q.out),
          [](RayRow<S>& row, const Aabb<S>& box, const Ray<S>& ray) { row = cast_row(ray, box); },
          [](ToiStatus status, S t) {
            return RayRow<S>{status, {t}};
          });
    } else {
      answer_rows<RayRow<S>>(q,
                             [&](std::size_t i) { return cast_row(row_of<Ray<S>, S>(q.a, i), row_of<A, S>(q.b, i)); });
    }
  });
  return asked;
}

}  // namespace

bool ask_closed_form(const Question& q, const Options& options, bool vectors) {
  const double gap = options.min_separation.value_or(0);
  return q.is_float ? ask_all<float>(q, static_cast<float>(gap), vectors) : ask_all<double>(q, gap, vectors);
}

bool ask_raycast(const Question& q) { return q.is_float ? cast_rays<float>(q) : cast_rays<double>(q); }

}  // namespace thinwall::python
