#pragma once
/// The two sides of a batch and where its answers go.

#include <array>
#include <concepts>
#include <limits>
#include <utility>

#include <thinwall/discrete/queries.hpp>
#include <thinwall/swept/batch/check_rows.hpp>
#include <thinwall/swept/batch/rows.hpp>
#include <thinwall/swept/batch/run.hpp>

namespace thinwall {

/// Where the answers go, a row each. Empty spans of normals and points: nobody asks for them.
template <Scalar S> struct ToiRows {
  std::span<ToiStatus> status;
  std::span<S> time;                ///< as Toi::time
  VectorRows<S> normal{}, point{};  ///< as Toi; on request, at the scalar code's price for each row in contact

  void set_vectors(std::size_t i, const Toi<S>& toi) const {
    for (const auto& [rows, vector] : {std::pair(normal, toi.normal), std::pair(point, toi.point)}) {
      if (rows.x.empty()) continue;
      rows.x[i] = vector[0];
      rows.y[i] = vector[1];
      rows.z[i] = vector[2];
    }
  }
  void set(std::size_t i, const Toi<S>& toi) const {
    status[i] = toi.status;
    time[i] = toi.time;
    set_vectors(i, toi);
  }
};

namespace batch {

template <class T> inline constexpr bool is_rows = false;
template <class Item> inline constexpr bool is_rows<RowsOf<Item>> = true;

/// Rows of items, or one item.
template <class T>
concept BatchSide = is_rows<T> || requires { typename RowsOf<T>::Item; };

/// One item against every row of the other side.
template <class One> class Side {
 public:
  using Item = One;
  using Layout = RowsOf<One>;
  using Scalar = typename Layout::Scalar;

  explicit Side(const One& one) : one_(one), values_(Layout::values(one)) {}
  const One& item(std::size_t) const { return one_; }
  Rows<Scalar> rows_from(std::size_t) const {
    Rows<Scalar> rows{{}, values_.size(), true};
    for (std::size_t k = 0; k < values_.size(); ++k) rows.columns[k] = &values_[k];
    return rows;
  }
  template <class Visit> void for_each_column(const Visit&) const {}

 private:
  One one_;
  decltype(Layout::values(std::declval<One>())) values_;
};

template <class OneItem> class Side<RowsOf<OneItem>> {
 public:
  using Item = OneItem;
  using Layout = RowsOf<Item>;
  using Scalar = typename Layout::Scalar;

  explicit Side(const Layout& layout) : columns_(layout.columns()) {}
  Item item(std::size_t i) const {
    decltype(Layout::values(std::declval<Item>())) values;
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = columns_[k][i];
    return Layout::item_of(values);
  }
  Rows<Scalar> rows_from(std::size_t begin) const {
    Rows<Scalar> rows{{}, columns_.size(), false};
    for (std::size_t k = 0; k < columns_.size(); ++k) rows.columns[k] = columns_[k].data() + begin;
    return rows;
  }
  template <class Visit> void for_each_column(const Visit& visit) const {
    for (const auto& column : columns_) visit(column);
  }

 private:
  decltype(std::declval<Layout>().columns()) columns_;
};

template <BatchSide T> using ItemOf = typename Side<T>::Item;
template <BatchSide T> using ScalarOf = typename Side<T>::Scalar;
template <BatchSide T> inline constexpr int rank_of = decltype(ItemOf<T>::shape)::rank;

/// How many rows there are, once every span, those read and those of the answers, was found right.
template <class A, class B> std::size_t checked_rows(const A& a, const B& b, std::span<const Column> answers) {
  static_assert(std::same_as<typename A::Scalar, typename B::Scalar>, "both sides must have the same scalar");
  std::array<Column, 2 * most_columns> read{};  // no vectors: a batch may be short
  std::size_t reads = 0;
  const auto add_read = [&](auto column) { read[reads++] = column_of(column, "what is read"); };
  a.for_each_column(add_read);
  b.for_each_column(add_read);
  return common_rows(std::span(read).first(reads), answers);
}
template <class A, class B, class S> std::size_t checked_rows(const A& a, const B& b, const ToiRows<S>& out) {
  std::array<Column, 8> answers{column_of(out.status, "the statuses"), column_of(out.time, "the times")};
  std::size_t writes = 2;
  for (const auto& [rows, what] : {std::pair(out.normal, "the normals"), std::pair(out.point, "the points")}) {
    if (rows.x.empty() && rows.y.empty() && rows.z.empty()) continue;
    for (const auto& column : {rows.x, rows.y, rows.z}) answers[writes++] = column_of(column, what);
  }
  return checked_rows(a, b, std::span<const Column>(answers).first(writes));
}

/// raycast() as a Toi whose time is t.
template <Scalar S> Toi<S> cast(const Ray<S>& ray, const Aabb<S>& box) {
  if (!valid(ray) || !valid(box)) return {ToiStatus::invalid, 0, std::numeric_limits<S>::quiet_NaN()};
  const auto hit = raycast(ray, box);
  if (!hit) return {ToiStatus::apart, 1, ray.max_t};
  const bool starts_inside = hit->normal == Vec3<S>::Zero();
  return {starts_inside ? ToiStatus::overlapping : ToiStatus::hit, 1, hit->t, hit->normal, hit->point};
}

}  // namespace batch
}  // namespace thinwall
