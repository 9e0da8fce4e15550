#pragma once
/// The kernels of swept/batch/ over NumPy's memory: what does not lie as they read it, a number after the other, is copied there
/// by blocks that stay in the first cache.

#include <algorithm>
#include <array>
#include <cstdint>

#include <thinwall/swept/batch.hpp>

#include "rows.hpp"

namespace thinwall::python {

/// A block of one side.
template <class S> class Block {
 public:
  batch::Rows<S> rows(const Side& side, bool is_one, std::size_t begin, std::size_t n) {
    batch::Rows<S> rows{{}, side.count, is_one};
    for (std::size_t k = 0; k < side.count; ++k) rows.columns[k] = column(side, k, begin, is_one ? 1 : n);
    return rows;
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

  std::array<std::array<S, block_of_rows>, batch::most_columns> copied_;  // filled as far as it is read
};

/// Answers q's rows by the kernel of ItemA and ItemB. `ask(i)` is the scalar code's answer to row i, asked where the kernel is not sure
/// and, if `vectors` are wanted, where there is contact; `set(i, answer)` takes it, and `quick(i, status, time)` the kernel's.
template <class ItemA, class ItemB, class S, class Ask, class Set, class Quick>
void answer_by_kernel(const Question& q, bool vectors, const Ask& ask, const Set& set, const Quick& quick) {
  batch::for_each_block(q.rows, block_of_rows, {q.threads}, [&](std::size_t begin, std::size_t end) {
    Block<S> block_a, block_b;
    std::array<ToiStatus, block_of_rows> status;
    std::array<S, block_of_rows> time;
    const std::size_t n = end - begin;
    const bool b_is_one = q.b.is_one && !q.a.is_one;  // a kernel takes one shape on one side
    batch::run<ItemA, ItemB>(block_a.rows(q.a, q.a.is_one, begin, n), block_b.rows(q.b, b_is_one, begin, n), n,
                             batch::Answers<S>{status.data(), time.data()});
    for (std::size_t j = 0; j < n; ++j) {
      const bool in_contact = status[j] == ToiStatus::hit || status[j] == ToiStatus::overlapping;
      if (status[j] == batch::not_clear || (vectors && in_contact)) {
        set(begin + j, ask(begin + j));
      } else {
        quick(begin + j, status[j], time[j]);
      }
    }
  });
}

}  // namespace thinwall::python
