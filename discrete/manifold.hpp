#pragma once
/// Contact manifolds: up to four points where a face meets a face or an edge, the one point of contact() elsewhere.
/// This header has the type and the front door; box_manifold.hpp and the capsule's own header serve their pairs by
///
///   Manifold<S> touching_manifold(const A& a, const B& b)    the shape of later rank first; they touch or overlap
///
/// A pair whose header is missing is a compile error, never a manifold with points left out.

#include <array>
#include <cstddef>

#include <thinwall/discrete/directions.hpp>
#include <thinwall/discrete/queries.hpp>
#include <thinwall/discrete/sphere.hpp>

namespace thinwall {

/// Where two shapes touch, the deepest point first.
template <Scalar S> struct Manifold {
  std::array<Contact<S>, 4> contacts{};  ///< the first `count` are points of contact
  int count = 0;                         ///< [1] 0 to 4; 0: the shapes are apart

  const Contact<S>* begin() const { return contacts.data(); }
  const Contact<S>* end() const { return contacts.data() + count; }
  std::size_t size() const { return static_cast<std::size_t>(count); }
  bool empty() const { return count == 0; }
  const Contact<S>& operator[](std::size_t i) const { return contacts[i]; }
};

/// Calls change(contact) on each point.
template <Scalar S, class Change> Manifold<S> changed(Manifold<S> manifold, const Change& change) {
  for (std::size_t i = 0; i < manifold.size(); ++i) manifold.contacts[i] = change(manifold.contacts[i]);
  return manifold;
}

template <Scalar S> Manifold<S> scaled(const Manifold<S>& manifold, int e) {
  return changed(manifold, [&](const Contact<S>& c) { return scaled(c, e); });
}
template <Scalar S> Manifold<S> flipped(const Manifold<S>& manifold) {
  return changed(manifold, [](const Contact<S>& c) { return flipped(c); });
}

/// The closest or deepest points alone. Unlike contact(), a point of an axis-aligned box too, not its center.
template <Shape A, Shape B>
Manifold<typename A::Scalar> single_point(const A& a, const B& b, const CoreGap<typename A::Scalar>& gap) {
  using S = typename A::Scalar;
  const Vec3<S> normal = gap.normal == Vec3<S>::Zero() ? arbitrary_normal(gap.along) : gap.normal;
  Manifold<S> manifold;
  manifold.contacts[0] = {gap.local_a + normal * skin_radius(a), gap.local_b - normal * skin_radius(b), normal,
                          std::max(S(0), S(skin_radius(a) + skin_radius(b) - gap.distance))};
  manifold.count = 1;
  return manifold;
}

/// A sphere has no face.
template <Shape A, Scalar S> Manifold<S> touching_manifold(const A& a, const Sphere<S>& b) {
  return single_point(a, b, core_gap(a, b));
}

template <class A, class B>
concept ManifoldInOrder = requires(const A& a, const B& b) { touching_manifold(a, b); };

/// True if manifold(a, b) can be asked, in either order, with the headers included so far.
template <class A, class B>
inline constexpr bool serves_manifold = A::rank < B::rank ? ManifoldInOrder<B, A> : ManifoldInOrder<A, B>;

template <class A, class B>
concept HasClearManifold =
    requires(const A& a, const B& b, Manifold<typename A::Scalar>& made) { clear_manifold(a, b, made); };

/// The careful rung of manifold(), the shape of later rank first: any input, at any scale.
template <Shape A, Shape B> [[gnu::noinline]] Manifold<typename A::Scalar> careful_manifold(const A& a, const B& b) {
  using S = typename A::Scalar;
  const auto ask = [](const A& x, const B& y, int e) { return scaled(manifold(x, y), e); };
  if (const auto near = asked_near_one(a, b, ask)) return *near;
  if (!overlaps(a, b)) return {};
  if (is_ordinary(S(magnitude(a) + magnitude(b)))) return touching_manifold(a, b);
  return scaled(touching_manifold(scaled(a, -huge_exponent), scaled(b, -huge_exponent)), huge_exponent);
}

/// All points of contact, up to four; empty exactly where overlaps() is false. Every normal is the same.
/// `local_a` and `local_b` are points of the surfaces relative to center(shape), for an axis-aligned box too (contact()
/// keeps the rule that such a box's contact acts at its center; a manifold is geometry). Each point has its own
/// penetration >= 0. The deepest comes first; its penetration and normal are those of contact(), to rounding.
/// Error: a few u of the coordinates and sizes involved.
/// Degenerate: a face turned from the contact normal by less than half the digits of S is the face of contact, so that
/// boxes all but parallel keep four points; points nearer to each other than rounding are one.
template <Shape A, Shape B> Manifold<typename A::Scalar> manifold(const A& a, const B& b) {
  using S = typename A::Scalar;
  static_assert(std::same_as<S, typename B::Scalar>, "both shapes must have the same scalar");
  static_assert(serves_manifold<A, B>,
                "no manifold of these two shapes: of boxes include <thinwall/discrete/boxes/box_manifold.hpp>, of "
                "capsules <thinwall/capsule/capsule_manifold.hpp>; docs/pairs.md says which are served");
  if constexpr (A::rank < B::rank) {
    return flipped(manifold(b, a));
  } else {
    if constexpr (HasClearManifold<A, B>) {
      Manifold<S> made;
      if (clear_manifold(a, b, made)) return made;
    }
    return careful_manifold(a, b);
  }
}

}  // namespace thinwall
