#pragma once
/// Rows that own their memory.

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include <thinwall/swept/batch/rows.hpp>

namespace thinwall {

/// A table of items, one array a coordinate: `table.rows()` is what a batch takes.
template <class Item> class RowTable {
  using Layout = RowsOf<Item>;
  using S = typename Layout::Scalar;
  static constexpr std::size_t width = std::tuple_size_v<decltype(Layout::values(std::declval<Item>()))>;

 public:
  void push_back(const Item& item) {
    const auto values = Layout::values(item);
    for (std::size_t k = 0; k < width; ++k) columns_[k].push_back(values[k]);
  }
  void reserve(std::size_t rows) {
    for (auto& column : columns_) column.reserve(rows);
  }
  std::size_t size() const { return columns_[0].size(); }
  Item operator[](std::size_t i) const {
    std::array<S, width> values;
    for (std::size_t k = 0; k < width; ++k) values[k] = columns_[k][i];
    return Layout::item_of(values);
  }
  /// Valid until the table grows or goes.
  Layout rows() const { return rows(0, size()); }
  Layout rows(std::size_t begin, std::size_t end) const {
    std::array<std::span<const S>, width> spans;
    for (std::size_t k = 0; k < width; ++k) spans[k] = std::span(columns_[k]).subspan(begin, end - begin);
    return Layout::of(spans);
  }

 private:
  std::array<std::vector<S>, width> columns_;
};

}  // namespace thinwall
