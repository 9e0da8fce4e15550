#pragma once
/// The relative core of two moving shapes in double, with what its numbers may be off by.
///
/// Seen from B, A's core less B's is the zonotope p + sum of [-1, 1] g_k that moves by v; the shapes touch where it comes
/// within R of the origin. Every number is rounded: p by at most 5 u S and g, v and R by one unit each, where S_i, the size
/// of coordinate i, is |p_i| + sum |g_ki|.
/// A triangle's core is p, p + e_1, p + e_2 instead.

#include <array>

#include <thinwall/swept/certified/filters.hpp>
#include <thinwall/swept/certified/simplex.hpp>
#include <thinwall/swept/serves.hpp>

namespace thinwall {

/// What a shape's core adds to the relative one: half axes about a middle that lies `offset` from `base`.
template <class A> struct HalfAxes;

template <> struct HalfAxes<Sphere<double>> {
  static constexpr int count = 0;
  Vec3<double> base;

  explicit HalfAxes(const Sphere<double>& s) : base(s.center) {}
  Vec3<double> half_axis(int) const { return Vec3<double>::Zero(); }
  double reach_along(const Vec3<double>&) const { return 0; }
  Vec3<double> reach() const { return Vec3<double>::Zero(); }
  Vec3<double> offset() const { return Vec3<double>::Zero(); }
};

template <> struct HalfAxes<Aabb<double>> {
  static constexpr int count = 3;
  Vec3<double> base, half;

  explicit HalfAxes(const Aabb<double>& box) : base(box.center), half(box.half_extents) {}
  Vec3<double> half_axis(int i) const { return axis_vector<double>(i) * half[i]; }
  double reach_along(const Vec3<double>& n) const { return half.dot(n.cwiseAbs()); }
  Vec3<double> reach() const { return half; }
  Vec3<double> offset() const { return Vec3<double>::Zero(); }
};

template <> struct HalfAxes<Obb<double>> {
  static constexpr int count = 3;
  Vec3<double> base;
  Mat3<double> half;  ///< its columns

  explicit HalfAxes(const Obb<double>& box) : base(box.center) {
    for (int i = 0; i < 3; ++i) half.col(i) = box.axes.col(i) * box.half_extents[i];
  }
  Vec3<double> half_axis(int i) const { return half.col(i); }
  double reach_along(const Vec3<double>& n) const {
    return std::abs(n.dot(half.col(0))) + std::abs(n.dot(half.col(1))) + std::abs(n.dot(half.col(2)));
  }
  Vec3<double> reach() const { return half.cwiseAbs().rowwise().sum(); }
  Vec3<double> offset() const { return Vec3<double>::Zero(); }
};

template <> struct HalfAxes<Capsule<double>> {
  static constexpr int count = 1;
  Vec3<double> base, half;

  explicit HalfAxes(const Capsule<double>& c) : base(c.a), half((c.b - c.a) / 2) {}
  Vec3<double> half_axis(int) const { return half; }
  double reach_along(const Vec3<double>& n) const { return std::abs(n.dot(half)); }
  Vec3<double> reach() const { return half.cwiseAbs(); }
  Vec3<double> offset() const { return half; }
};

/// The relative core of two rounded zonotopes.
template <class A, class B> struct RoundedCore {
  static constexpr int count = HalfAxes<A>::count + HalfAxes<B>::count;  ///< of half axes
  static constexpr bool is_zonotope = true;

  HalfAxes<A> part_a;
  HalfAxes<B> part_b;
  Vec3<double> p, v;  ///< [length] the middle at time 0, its displacement
  double R;           ///< [length]
  Vec3<double> size;  ///< [length] S

  RoundedCore(const Moving<A>& a, const Moving<B>& b)
      : part_a(a.shape),
        part_b(b.shape),
        p(((part_a.base - part_b.base) + part_a.offset()) - part_b.offset()),
        v(relative_displacement(a, b)),
        R(skin_radius(a.shape) + skin_radius(b.shape)),
        size(p.cwiseAbs() + (part_a.reach() + part_b.reach())) {}

  /// The least n . x of the core at time 0.
  double lowest(const Vec3<double>& n) const { return n.dot(p) - (part_a.reach_along(n) + part_b.reach_along(n)); }

  Vec3<double> half_axis(int k) const {
    return k < HalfAxes<A>::count ? part_a.half_axis(k) : part_b.half_axis(k - HalfAxes<A>::count);
  }

  /// A corner that lies least far along n, at time 0.
  Triple<double> lowest_corner(const Vec3<double>& n) const {
    Vec3<double> corner = p;
    for (int k = 0; k < count; ++k) {
      const Vec3<double> g = half_axis(k);
      corner -= n.dot(g) > 0 ? g : Vec3<double>(-g);
    }
    return {corner[0], corner[1], corner[2]};
  }
};

/// The relative core of a triangle and a ball.
template <> struct RoundedCore<Triangle<double>, Sphere<double>> {
  static constexpr bool is_zonotope = false;

  std::array<Vec3<double>, 3> corners;
  Vec3<double> p, v;
  double R;
  Vec3<double> size;

  RoundedCore(const Moving<Triangle<double>>& a, const Moving<Sphere<double>>& b)
      : corners{a.shape.a - b.shape.center, a.shape.b - b.shape.center, a.shape.c - b.shape.center},
        p((corners[0] + corners[1] + corners[2]) / 3),
        v(relative_displacement(a, b)),
        R(b.shape.radius),
        size(corners[0].cwiseAbs().cwiseMax(corners[1].cwiseAbs()).cwiseMax(corners[2].cwiseAbs())) {}

  double lowest(const Vec3<double>& n) const {
    return std::min(std::min(n.dot(corners[0]), n.dot(corners[1])), n.dot(corners[2]));
  }
  Triple<double> lowest_corner(const Vec3<double>& n) const {
    const double x = n.dot(corners[0]), y = n.dot(corners[1]), z = n.dot(corners[2]);
    const Vec3<double>& corner = corners[x <= y && x <= z ? 0 : y <= z ? 1 : 2];
    return {corner[0], corner[1], corner[2]};
  }
};

}  // namespace thinwall
