#pragma once
/// Many shapes as a structure of arrays: one array a coordinate, row i of each belonging to item i.
///
/// Every specialization tells a batch how to read it: its arrays in the order of its members (`columns`), one item's
/// numbers in that order (`values`), and the way back from either (`of`, `item_of`).

#include <array>
#include <concepts>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/discrete/obb.hpp>
#include <thinwall/discrete/queries.hpp>
#include <thinwall/swept/batch/run.hpp>
#include <thinwall/swept/moving.hpp>

namespace thinwall {

/// One vector a row, of what S is: `const double` is read only.
template <class S> struct VectorRows {
  std::span<S> x, y, z;
};

/// Rows of what Item is: `RowsOf<Moving<Sphere<double>>>`.
template <class Item> struct RowsOf;

template <Scalar S> struct RowsOf<Moving<Sphere<S>>> {
  using Scalar = S;
  using Item = Moving<Sphere<S>>;
  VectorRows<const S> center;        ///< [length]
  std::span<const S> radius;         ///< [length]
  VectorRows<const S> displacement;  ///< [length]

  std::array<std::span<const S>, 7> columns() const {
    return {center.x, center.y, center.z, radius, displacement.x, displacement.y, displacement.z};
  }
  static RowsOf of(const std::array<std::span<const S>, 7>& c) {
    return {{c[0], c[1], c[2]}, c[3], {c[4], c[5], c[6]}};
  }
  static std::array<S, 7> values(const Item& m) {
    const auto &c = m.shape.center, &v = m.displacement;
    return {c[0], c[1], c[2], m.shape.radius, v[0], v[1], v[2]};
  }
  static Item item_of(const std::array<S, 7>& x) { return {{{x[0], x[1], x[2]}, x[3]}, {x[4], x[5], x[6]}}; }
};

template <Scalar S> struct RowsOf<Moving<Aabb<S>>> {
  using Scalar = S;
  using Item = Moving<Aabb<S>>;
  VectorRows<const S> center, half_extents;  ///< [length]
  VectorRows<const S> displacement;          ///< [length]

  std::array<std::span<const S>, 9> columns() const {
    return {center.x,       center.y,       center.z,       half_extents.x, half_extents.y,
            half_extents.z, displacement.x, displacement.y, displacement.z};
  }
  static RowsOf of(const std::array<std::span<const S>, 9>& c) {
    return {{c[0], c[1], c[2]}, {c[3], c[4], c[5]}, {c[6], c[7], c[8]}};
  }
  static std::array<S, 9> values(const Item& m) {
    const auto &c = m.shape.center, &h = m.shape.half_extents, &v = m.displacement;
    return {c[0], c[1], c[2], h[0], h[1], h[2], v[0], v[1], v[2]};
  }
  static Item item_of(const std::array<S, 9>& x) {
    return {{{x[0], x[1], x[2]}, {x[3], x[4], x[5]}}, {x[6], x[7], x[8]}};
  }
};

template <Scalar S> struct RowsOf<Moving<Obb<S>>> {
  using Scalar = S;
  using Item = Moving<Obb<S>>;
  VectorRows<const S> center, half_extents;  ///< [length]
  std::array<VectorRows<const S>, 3> axes;   ///< unit, at right angles: the directions of the three extents
  VectorRows<const S> displacement;          ///< [length]

  std::array<std::span<const S>, 18> columns() const {
    const auto &h = half_extents, &v = displacement;
    return {center.x,  center.y,  center.z,  h.x,       h.y,       h.z,       axes[0].x, axes[0].y, axes[0].z,
            axes[1].x, axes[1].y, axes[1].z, axes[2].x, axes[2].y, axes[2].z, v.x,       v.y,       v.z};
  }
  static RowsOf of(const std::array<std::span<const S>, 18>& c) {
    return {{c[0], c[1], c[2]},
            {c[3], c[4], c[5]},
            {{{c[6], c[7], c[8]}, {c[9], c[10], c[11]}, {c[12], c[13], c[14]}}},
            {c[15], c[16], c[17]}};
  }
  static std::array<S, 18> values(const Item& m) {
    const auto &c = m.shape.center, &h = m.shape.half_extents, &v = m.displacement;
    const auto& axes = m.shape.axes;
    return {c[0],       c[1],       c[2],       h[0],       h[1],       h[2],       axes(0, 0), axes(1, 0), axes(2, 0),
            axes(0, 1), axes(1, 1), axes(2, 1), axes(0, 2), axes(1, 2), axes(2, 2), v[0],       v[1],       v[2]};
  }
  static Item item_of(const std::array<S, 18>& x) {
    Mat3<S> axes;
    axes << x[6], x[9], x[12], x[7], x[10], x[13], x[8], x[11], x[14];
    return {{{x[0], x[1], x[2]}, {x[3], x[4], x[5]}, axes}, {x[15], x[16], x[17]}};
  }
};

template <Scalar S> struct RowsOf<Moving<Capsule<S>>> {
  using Scalar = S;
  using Item = Moving<Capsule<S>>;
  VectorRows<const S> a, b;          ///< [length] ends of the core segments
  std::span<const S> radius;         ///< [length]
  VectorRows<const S> displacement;  ///< [length]

  std::array<std::span<const S>, 10> columns() const {
    return {a.x, a.y, a.z, b.x, b.y, b.z, radius, displacement.x, displacement.y, displacement.z};
  }
  static RowsOf of(const std::array<std::span<const S>, 10>& c) {
    return {{c[0], c[1], c[2]}, {c[3], c[4], c[5]}, c[6], {c[7], c[8], c[9]}};
  }
  static std::array<S, 10> values(const Item& m) {
    const auto &a = m.shape.a, &b = m.shape.b, &v = m.displacement;
    return {a[0], a[1], a[2], b[0], b[1], b[2], m.shape.radius, v[0], v[1], v[2]};
  }
  static Item item_of(const std::array<S, 10>& x) {
    return {{{x[0], x[1], x[2]}, {x[3], x[4], x[5]}, x[6]}, {x[7], x[8], x[9]}};
  }
};

template <Scalar S> struct RowsOf<Ray<S>> {
  using Scalar = S;
  using Item = Ray<S>;
  VectorRows<const S> origin;     ///< [length]
  VectorRows<const S> direction;  ///< [length] of any length; t counts in lengths of it
  std::span<const S> max_t;       ///< [1]

  std::array<std::span<const S>, 7> columns() const {
    return {origin.x, origin.y, origin.z, direction.x, direction.y, direction.z, max_t};
  }
  static RowsOf of(const std::array<std::span<const S>, 7>& c) {
    return {{c[0], c[1], c[2]}, {c[3], c[4], c[5]}, c[6]};
  }
  static std::array<S, 7> values(const Ray<S>& ray) {
    const auto &o = ray.origin, &d = ray.direction;
    return {o[0], o[1], o[2], d[0], d[1], d[2], ray.max_t};
  }
  static Ray<S> item_of(const std::array<S, 7>& x) { return {{x[0], x[1], x[2]}, {x[3], x[4], x[5]}, x[6]}; }
};

/// Boxes at rest, for rays.
template <Scalar S> struct RowsOf<Aabb<S>> {
  using Scalar = S;
  using Item = Aabb<S>;
  VectorRows<const S> center, half_extents;  ///< [length]

  std::array<std::span<const S>, 6> columns() const {
    return {center.x, center.y, center.z, half_extents.x, half_extents.y, half_extents.z};
  }
  static RowsOf of(const std::array<std::span<const S>, 6>& c) { return {{c[0], c[1], c[2]}, {c[3], c[4], c[5]}}; }
  static std::array<S, 6> values(const Aabb<S>& box) {
    const auto &c = box.center, &h = box.half_extents;
    return {c[0], c[1], c[2], h[0], h[1], h[2]};
  }
  static Aabb<S> item_of(const std::array<S, 6>& x) { return {{x[0], x[1], x[2]}, {x[3], x[4], x[5]}}; }
};

// ---- The two sides of a batch and where its answers go.

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
