#pragma once
/// Rows that own their memory.

#include <array>
#include <cstddef>
#include <vector>

#include <thinwall/swept/batch/rows.hpp>

namespace thinwall {

/// A table of items, one array a coordinate: `table.rows()` is what a batch takes.
template <class Item> class RowTable {
  using S = typename RowsOf<Item>::Scalar;

 public:
  void push_back(const Item& item) {
    std::size_t k = 0;
    for_each_number(item, [&](const S& x) { columns_[k++].push_back(x); });
  }
  void reserve(std::size_t rows) {
    for (auto& column : columns_) column.reserve(rows);
  }
  std::size_t size() const { return columns_[0].size(); }
  Item operator[](std::size_t i) const {
    std::size_t k = 0;
    return item_of<Item>([&] { return columns_[k++][i]; });
  }
  /// Valid until the table grows or goes.
  RowsOf<Item> rows() const { return rows(0, size()); }
  RowsOf<Item> rows(std::size_t begin, std::size_t end) const {
    RowsOf<Item> rows;
    std::size_t k = 0;
    batch::for_each_column(rows, [&](auto& span) { span = std::span(columns_[k++]).subspan(begin, end - begin); });
    return rows;
  }

 private:
  std::array<std::vector<S>, batch::width<Item>> columns_;
};

}  // namespace thinwall
