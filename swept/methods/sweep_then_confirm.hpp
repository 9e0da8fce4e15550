#pragma once
/// Two fast bodies by the tutorial's rule: when does the one enter the other's track, and is the other there by then?

#include <string_view>

#include <thinwall/swept/methods/centre_ray.hpp>
#include <thinwall/swept/swept_volume.hpp>

namespace thinwall {

/// A shape whose swept volume is a shape.
template <class A>
concept Sweepable = Shape<A> && requires(const Moving<A>& moving) { swept_volume(moving); };

/// Casts a ray from the center of the body that travels farther, along its own motion, against all that the other sweeps.
/// Where it hits, both bodies are placed at that time and their true volumes tested: touching is a hit, anything else a
/// miss. Serves spheres and axis-aligned boxes, whose swept volumes are shapes.
/// Claims: none of its hits is false. It misses most true ones between two moving bodies, three in five: the one enters the
/// other's track before the other arrives, and starting in that track it looks at the start alone. Against a body at rest, the
/// track is the body: then it sees what the ray from the center sees, as late, and a point that rounding leaves before
/// the surface is missed.
/// Degenerate: shapes that touch at the start are `overlapping`; no relative motion is `apart` if they do not.
/// Source: a tutorial's rule for two fast objects; what it misses is derived in docs/methods.md.
template <Scalar S = double> struct SweepThenConfirm {
  static constexpr std::string_view name = "sweep_then_confirm";
  S min_separation = 0;  ///< [length] >= 0: at the start and in the second test, a gap this small counts as contact
};

/// When the center of `shooter` first meets what `target` sweeps; nothing if it does not.
template <Scalar T, Shape A, Sweepable B>
std::optional<RayHit<T>> enters_track(const Moving<A>& shooter, const Moving<B>& target) {
  return ray_entry(Ray<T>{center(shooter.shape), shooter.displacement, T(1)}, swept_volume(target));
}

template <Scalar S, Sweepable A, Sweepable B>
  requires ServedPair<A, B>
Toi<typename A::Scalar> impact(const SweepThenConfirm<S>& method, const Moving<A>& a, const Moving<B>& b) {
  using T = typename A::Scalar;
  const T margin(method.min_separation);
  if (overlaps_unchecked(a.shape, b.shape, margin)) return overlapping_at_start(a, b, 1);
  if (relative_displacement(a, b) == Vec3<T>::Zero()) return {ToiStatus::apart, 1};  // where they are later is rounded
  const auto entry = first_shoots(a, b) ? enters_track<T>(a, b) : enters_track<T>(b, a);
  if (!entry) return {ToiStatus::apart, 2};
  const A a_then = pose_at(a, entry->t);
  const B b_then = pose_at(b, entry->t);
  if (!overlaps_unchecked(a_then, b_then, margin)) return {ToiStatus::apart, 3};
  const Separation<T> deepest = separation_unchecked(a_then, b_then);
  return {ToiStatus::hit, 3, entry->t, deepest.normal, middle(deepest)};
}

}  // namespace thinwall
