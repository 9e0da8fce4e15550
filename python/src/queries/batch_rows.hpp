#pragma once
/// The kernels of swept/batch/ over NumPy's memory: what does not lie as they read it, a number after the other, is copied there
/// by blocks that stay in the first cache.

#include <algorithm>
#include <array>
#include <cstdint>

#include <thinwall/swept/batch.hpp>

#include "rows.hpp"

namespace thinwall::python {

/// As long as swept/batch.hpp's own: shorter ones begin each column's memory anew too often.
inline constexpr std::size_t rows_of_kernel = 2048;

/// A block of one side, as its kernel reads it.
template <class Item, class S> class Block {
 public:
  Block(const Side& side, bool is_one, std::size_t begin, std::size_t n) : rows_{{}, side.count, is_one} {
    for (std::size_t k = 0; k < side.count; ++k) rows_.columns[k] = column(side, k, begin, is_one ? 1 : n);
  }
  Block(const Block&) = delete;
  Block& operator=(const Block&) = delete;

  const batch::Rows<S>& rows() const { return rows_; }
  Item item(std::size_t j) const {
    decltype(RowsOf<Item>::values(std::declval<Item>())) values;
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = rows_.columns[k][rows_.is_one ? 0 : j];
    return RowsOf<Item>::item_of(values);
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
  std::array<std::array<S, rows_of_kernel>, batch::most_columns> copied_;  // filled as far as it is read
};

/// Answers q's rows by the kernel of ItemA and ItemB. `set(row, a, b)` puts the scalar code's answer into a row, where the kernel is not
/// sure and, if `vectors` are wanted, where there is contact; `quick(status, time)` is the row of the kernel's.
template <class ItemA, class ItemB, class S, class Row, class Set, class Quick>
void answer_by_kernel(const Question& q, bool vectors, Row* out, const Set& set, const Quick& quick) {
  batch::for_each_block(q.rows, rows_of_kernel, {q.threads}, [&](std::size_t begin, std::size_t end) {
    const std::size_t n = end - begin;
    const Block<ItemA, S> a(q.a, q.a.is_one, begin, n);
    const Block<ItemB, S> b(q.b, q.b.is_one && !q.a.is_one, begin, n);  // a kernel takes one shape on one side
    std::array<ToiStatus, rows_of_kernel> status;
    std::array<S, rows_of_kernel> time;
    const std::size_t unclear =
        batch::run<ItemA, ItemB>(a.rows(), b.rows(), n, batch::Answers<S>{status.data(), time.data()});
    Row* const row = out + begin;
    if (unclear == 0 && !vectors) {
      for (std::size_t j = 0; j < n; ++j) row[j] = quick(status[j], time[j]);
      return;
    }
    for (std::size_t j = 0; j < n; ++j) {
      const bool in_contact = status[j] == ToiStatus::hit || status[j] == ToiStatus::overlapping;
      if (status[j] == batch::not_clear || (vectors && in_contact)) {
        set(row[j], a.item(j), b.item(j));
      } else {
        row[j] = quick(status[j], time[j]);
      }
    }
  });
}

}  // namespace thinwall::python
