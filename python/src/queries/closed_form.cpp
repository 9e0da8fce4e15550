/// Times of impact by the closed form, by the batch kernels where the pair has one; and rays.
#include <array>
#include <cstdint>
#include <memory>
#include <type_traits>

#include <thinwall/swept/batch.hpp>
#include <thinwall/swept/compiled.hpp>
#include <thinwall/swept/time_of_impact.hpp>

#include "queries.hpp"

namespace thinwall::python {

namespace {

// ---- The kernels of swept/batch/ over NumPy's memory: what does not lie as they read it, a number after the other, is copied there
// by blocks that stay in the first cache.

/// As long as swept/batch.hpp's own: shorter ones begin each column's memory anew too often.
constexpr std::size_t rows_of_kernel = 2048;

/// Longer by a line of the cache than what they hold: at a power of two from each other they would share few lines of it, and take a
/// third longer.
template <class S> using Columns = std::array<std::array<S, rows_of_kernel + 64 / sizeof(S)>, batch::most_columns>;

/// Where the two sides of a block are copied to. A thread of Python's may have a stack that is too short for it, and keeps what the heap
/// gave: to find as much for every block takes time.
template <class S> std::array<Columns<S>, 2>& room_for_sides() {
  thread_local const auto room = std::make_unique_for_overwrite<std::array<Columns<S>, 2>>();
  return *room;
}

/// A block of one side, as its kernel reads it.
template <class Item, class S> class Block {
 public:
  Block(const Side& side, bool is_one, std::size_t begin, std::size_t n, Columns<S>& room)
      : rows_{{}, side.count, is_one}, copied_(room) {
    for (std::size_t k = 0; k < side.count; ++k) rows_.columns[k] = column(side, k, begin, is_one ? 1 : n);
  }
  Block(const Block&) = delete;
  Block& operator=(const Block&) = delete;

  const batch::Rows<S>& rows() const { return rows_; }
  Item item(std::size_t j) const {
    std::size_t k = 0;
    return item_of<Item>([&] { return rows_.columns[k++][rows_.is_one ? 0 : j]; });
  }

 private:
  const S* column(const Side& side, std::size_t k, std::size_t begin, std::size_t n) {
    const std::byte* const from = side.first[k] + side.step[k] * static_cast<std::ptrdiff_t>(begin);
    const bool aligned = reinterpret_cast<std::uintptr_t>(from) % alignof(S) == 0;
    const std::ptrdiff_t step = side.step[k];
    if (aligned && (n == 1 || step == std::ptrdiff_t{sizeof(S)})) return reinterpret_cast<const S*>(from);
    S* const to = copied_[k].data();
    for (std::size_t i = 0; i < n; ++i) std::memcpy(to + i, from + step * static_cast<std::ptrdiff_t>(i), sizeof(S));
    return to;
  }

  batch::Rows<S> rows_;
  Columns<S>& copied_;  // filled as far as it is read
};

/// Answers q's rows by the kernel of ItemA and ItemB. `ask(a, b)` is the scalar code's answer, where the kernel is not sure and, if
/// vectors are wanted, where there is contact; `quick(status, time)` is the row of the kernel's, of the type that is wanted: to choose it
/// row by row takes a third longer.
template <class ItemA, class ItemB, class S, class Ask, class Quick>
void answer_by_kernel(const Question& q, const Ask& ask, const Quick& quick) {
  batch::for_each_block(q.rows, rows_of_kernel, {q.threads}, [&](std::size_t begin, std::size_t end) {
    const std::size_t n = end - begin;
    auto* const row = static_cast<std::invoke_result_t<Quick, ToiStatus, S>*>(q.out) + begin;
    auto& [room_a, room_b] = room_for_sides<S>();
    const bool b_is_one = q.b.is_one && !q.a.is_one;  // a kernel takes one shape on one side
    const Block<ItemA, S> a(q.a, q.a.is_one, begin, n, room_a);
    const Block<ItemB, S> b(q.b, b_is_one, begin, n, room_b);
    std::array<ToiStatus, rows_of_kernel> status;
    std::array<S, rows_of_kernel> time;
    const std::size_t unclear =
        batch::run<ItemA, ItemB>(a.rows(), b.rows(), n, batch::Answers<S>{status.data(), time.data()});
    if (unclear == 0 && !q.vectors) {
      for (std::size_t j = 0; j < n; ++j) row[j] = quick(status[j], time[j]);
      return;
    }
    for (std::size_t j = 0; j < n; ++j) {
      const bool in_contact = status[j] == ToiStatus::hit || status[j] == ToiStatus::overlapping;
      if (status[j] == batch::not_clear || (q.vectors && in_contact)) {
        put(q, begin + j, ask(a.item(j), b.item(j)));
      } else {
        row[j] = quick(status[j], time[j]);
      }
    }
  });
}

// ---- Times of impact.

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

/// The scalar code's answer. Compiled once a pair: all of the query is inlined here.
template <class A, class B, class S>
[[gnu::noinline]] Toi<S> ask_items(const ClosedForm<S>& method, bool swapped, const Moving<A>& a, const Moving<B>& b) {
  return turned_round(time_of_impact(method, a, b), swapped);
}

template <class A, class B> void ask_pair(const Question& q, typename A::Scalar min_separation) {
  using S = typename A::Scalar;
  const auto ask = [&q, method = ClosedForm<S>{min_separation}](const Moving<A>& a, const Moving<B>& b) {
    return ask_items(method, q.swapped, a, b);
  };
  if constexpr (has_kernel<A, B>) {
    if (min_separation == S(0)) {
      const auto by_kernel = [&](const auto& quick) { answer_by_kernel<Moving<A>, Moving<B>, S>(q, ask, quick); };
      if (q.vectors) {
        by_kernel([](ToiStatus status, S time) { return Toi<S>{status, 1, time}; });
      } else {
        by_kernel([](ToiStatus status, S time) { return TimeRow<S>{status, 1, time}; });
      }
      return;
    }
  }
  answer_rows(q, [&](std::size_t i) { return ask(row_of<Moving<A>, S>(q.a, i), row_of<Moving<B>, S>(q.b, i)); });
}

template <class S> bool ask_all(const Question& q, S min_separation) {
  return for_the_shapes<S, Asked>(q, [&]<class A, class B>() { ask_pair<A, B>(q, min_separation); });
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
          boxes_first, [](const Aabb<S>& box, const Ray<S>& ray) { return cast_row(ray, box); },
          [](ToiStatus status, S t) {
            return RayRow<S>{status, {t}};
          });
    } else {
      answer_rows(q, [&](std::size_t i) { return cast_row(row_of<Ray<S>, S>(q.a, i), row_of<A, S>(q.b, i)); });
    }
  });
  return asked;
}

}  // namespace

bool ask_closed_form(const Question& q, const Options& options) {
  const double gap = options.min_separation.value_or(0);
  return q.is_float ? ask_all<float>(q, static_cast<float>(gap)) : ask_all<double>(q, gap);
}

bool ask_raycast(const Question& q) { return q.is_float ? cast_rays<float>(q) : cast_rays<double>(q); }

}  // namespace thinwall::python
