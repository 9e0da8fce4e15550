#pragma once
/// Many shapes as a structure of arrays: one array a coordinate, row i of each belonging to item i.
///
/// Every specialization tells a batch how to read it: its arrays in the order of its members (`columns`), one item's
/// numbers in that order (`values`), and the way back from either (`of`, `item_of`).

#include <array>
#include <cstddef>
#include <span>

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/discrete/obb.hpp>
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

}  // namespace thinwall
