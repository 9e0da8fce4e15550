#pragma once
/// What the clear rung answers to a query at one instant, and which shapes have one.

#include <cstring>
#include <optional>

#include <thinwall/discrete/clear/clear_entry.hpp>
#include <thinwall/discrete/results.hpp>

namespace thinwall {

/// Empties `held` unless `holds`, without a jump: libstdc++ and libc++ keep that flag behind the value.
template <class Held> THINWALL_HOT void keep_if(bool holds, std::optional<Held>& held) {
#if defined(__GLIBCXX__) || defined(_LIBCPP_VERSION)
  static_assert(sizeof held == sizeof(Held) + alignof(Held));
  const unsigned char flag = holds ? 1 : 0;
  std::memcpy(reinterpret_cast<unsigned char*>(&held) + sizeof(Held), &flag, 1);
#else
  if (!holds) held.reset();
#endif
}

/// Contact data from A to B, if whether they touch is clear; of no meaning unless they do, but for a gap's.
struct ClearContact {
  bool clear, touching;
  packed::Lanes local_a, local_b, normal;
  packed::Pair depth;  ///< [length]

  THINWALL_HOT std::optional<Contact<double>> contact() const {
    std::optional<Contact<double>> made(std::in_place);  // written whatever the verdict: nothing waits for it
    store(local_a, made->local_a);
    store(local_b, made->local_b);
    store(normal, made->normal);
    made->penetration = value(max(depth, packed::both(0)));
    keep_if(touching, made);
    return made;
  }
  THINWALL_HOT Separation<double> separation(const Vec3<double>& center_b) const {
    const packed::Lanes point_b = packed::lanes(center_b) + local_b;
    Separation<double> made;
    made.distance = value(packed::both(0) - depth);
    store(normal, made.normal);
    store(point_b + normal * all(depth), made.point_a);
    store(point_b, made.point_b);
    return made;
  }
};
THINWALL_HOT ClearContact flipped(const ClearContact& c) {
  return {c.clear, c.touching, c.local_b, c.local_a, packed::all(0) - c.normal, c.depth};
}

/// Where a ray meets a shape, if that is clear.
struct ClearRayHit {
  bool clear, hit;
  packed::Pair t;
  packed::Lanes point, normal;

  /// Clear whatever the ray's validity, as nothing is met either way.
  THINWALL_HOT static ClearRayHit miss() { return {true, false, packed::both(0), packed::all(0), packed::all(0)}; }

  THINWALL_HOT std::optional<RayHit<double>> ray_hit() const {
    std::optional<RayHit<double>> made(std::in_place);
    made->t = value(t);
    store(point, made->point);
    store(normal, made->normal);
    keep_if(hit, made);
    return made;
  }
};

/// The hit of the ray p + v t on a core rounded by R, which it enters over `on_core`; `square` is p.p, `speed` v.v. Whether that is before
/// the ray's end is clear if the two are a millionth of the way apart.
THINWALL_HOT ClearRayHit clear_ray_hit(const ClearEntry& entry, const packed::Pair& square, const packed::Pair& speed,
                                       double max_t, const packed::Lanes& on_core, double R) {
  using packed::both;
  const packed::Pair end = both(max_t), beyond = entry.time - end;
  const packed::PairMask apart = square * both(0x1p-40) < beyond * beyond * speed;
  return {both(entry.clear, all_of(apart & (both(0) <= min(end, both(R))))),
          all_of(entry.time < min(end, both(ClearEntry::never))), entry.time, on_core + entry.normal * packed::all(R),
          entry.normal};
}

/// Whether two shapes share a point, if that is clear.
struct ClearOverlap {
  bool clear, overlaps;
};

template <class A, class B>
concept HasClearOverlap = requires(const A& a, const B& b) { clear_overlap(a, b); };
template <class A, class B>
concept HasClearContact = requires(const A& a, const B& b) { clear_contact(a, b); };

/// The gap from A to B: contact data of which, apart, `depth` is below 0 by the distance, and `local_b` the nearest point of B. Of shapes
/// that are round it is that of clear_contact().
template <class A, class B>
  requires HasClearContact<A, B>
THINWALL_HOT ClearContact clear_gap(const A& a, const B& b) {
  return clear_contact(a, b);
}
template <class A>
concept HasClearRaycast = requires(const Ray<double>& ray, const A& shape) { clear_raycast(ray, shape); };

}  // namespace thinwall
