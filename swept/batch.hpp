#pragma once
/// Times of impact of many rows at once, by the widest vectors the machine has (chosen when the program runs).
///
/// A row's verdict is the scalar code's own: a lane answers where no rounding could turn its verdict, the others are
/// asked again of time_of_impact or raycast in scalar code. Times are within the scalar code's bound, 4 u kappa t (u of
/// the rows' own scalar), and not its very bits; they are the same bits for any split of the rows and any number of
/// threads, on one kind of vector. docs/batches.md derives the bounds. Link thinwall::batch.
///
/// Pairs, either way round: sphere with sphere, AABB, OBB, capsule; AABB with AABB; and rays at AABBs. Of float or double.

#include <atomic>

#include <thinwall/swept/batch/rows.hpp>
#include <thinwall/swept/batch/run.hpp>
#include <thinwall/swept/time_of_impact.hpp>

namespace thinwall {

struct BatchReport {
  std::size_t rows = 0;
  std::size_t asked_again = 0;  ///< in scalar code: rounding might turn their verdict, or they are not ordinary
};

namespace batch {

/// Asks the vector code about rows [begin, end), then `ask(a, b)` about those that are not clear, and about those in contact
/// where vectors are wanted.
template <class A, class B, class S, class Ask>
std::size_t answer_block(const A& a, const B& b, const ToiRows<S>& out, std::size_t begin, std::size_t end,
                         const Ask& ask) {
  const Answers<S> answers{out.status.data() + begin, out.time.data() + begin};
  const std::size_t unclear =
      run<typename A::Item, typename B::Item>(a.rows_from(begin), b.rows_from(begin), end - begin, answers);
  const bool wants_vectors = !out.normal.x.empty() || !out.point.x.empty();
  std::size_t left = unclear;
  for (std::size_t i = begin; i < end && (left > 0 || wants_vectors); ++i) {
    const bool in_contact = out.status[i] == ToiStatus::hit || out.status[i] == ToiStatus::overlapping;
    if (out.status[i] == not_clear || (wants_vectors && in_contact)) {
      if (out.status[i] == not_clear) --left;
      out.set(i, ask(a.item(i), b.item(i)));
    } else if (wants_vectors) {
      out.set_vectors(i, Toi<S>{});
    }
  }
  return unclear;
}

/// `answer(begin, end)` answers a block and returns how many of its rows it asked again.
template <class Answer> BatchReport in_blocks(std::size_t rows, const BatchOptions& options, const Answer& answer) {
  constexpr std::size_t block = 2048;  // rows whose answers are still in the first cache when they are asked again
  std::atomic<std::size_t> asked_again = 0;
  for_each_block(rows, block, options, [&](std::size_t begin, std::size_t end) { asked_again += answer(begin, end); });
  return {rows, asked_again};
}

template <class A, class B, class S, class Ask>
BatchReport answer(const A& a, const B& b, const ToiRows<S>& out, const BatchOptions& options, const Ask& ask) {
  return in_blocks(checked_rows(a, b, out), options,
                   [&](std::size_t begin, std::size_t end) { return answer_block(a, b, out, begin, end, ask); });
}

}  // namespace batch

/// time_of_impact of every row of A with that of B, or with the one shape that A or B is: each is a RowsOf<Moving<Shape>>
/// or a Moving<Shape>, and at least one is rows. Every row has its own status, `invalid` ones too; none spoils another.
/// Throws std::invalid_argument where spans differ in length, or answers share memory with what is read or one another.
template <batch::BatchSide A, batch::BatchSide B>
BatchReport time_of_impact(const A& a, const B& b, const ToiRows<batch::ScalarOf<A>>& out, BatchOptions options = {}) {
  static_assert(batch::is_rows<A> || batch::is_rows<B>,
                "one side at least must be rows: RowsOf, or rows() of a RowTable");
  const batch::Side<A> side_a(a);
  const batch::Side<B> side_b(b);
  if constexpr (batch::rank_of<A> < batch::rank_of<B>) {
    return batch::answer(side_b, side_a, out, options,
                         [](const auto& y, const auto& x) { return time_of_impact(x, y); });
  } else {
    return batch::answer(side_a, side_b, out, options,
                         [](const auto& x, const auto& y) { return time_of_impact(x, y); });
  }
}

/// raycast of every ray, with t as the time: a start inside is `overlapping`, a miss `apart` with the ray's max_t. Rays and
/// boxes are a RowsOf<Ray> or a Ray, a RowsOf<Aabb> or an Aabb, and at least one is rows.
/// A NaN, an infinity (but in max_t) or a negative size or max_t is `invalid`. Throws as time_of_impact.
template <batch::BatchSide Rays, batch::BatchSide Boxes>
BatchReport raycast(const Rays& rays, const Boxes& boxes, const ToiRows<batch::ScalarOf<Rays>>& out,
                    BatchOptions options = {}) {
  static_assert(batch::is_rows<Rays> || batch::is_rows<Boxes>, "one side at least must be rows, of rays or of boxes");
  const batch::Side<Rays> ray_side(rays);
  const batch::Side<Boxes> box_side(boxes);
  return batch::answer(box_side, ray_side, out, options,
                       [](const auto& box, const auto& ray) { return batch::cast(ray, box); });
}

}  // namespace thinwall
