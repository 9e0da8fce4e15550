#pragma once
/// What a time of impact of shapes that turn must fulfil, whatever the shapes and motions.

#include <algorithm>
#include <string>

#include <thinwall/swept/turning/turning_bounds.hpp>
#include <thinwall/swept/turning/turning_impact.hpp>

#include "fuzz/checks.hpp"

namespace thinwall::fuzz {

template <Shape A> Turning<A> with_spin(const Moving<A>& m, const Vec3<typename A::Scalar>& rotation) {
  return {m.shape, m.displacement, rotation};
}
template <Scalar S> Turning<Obb<S>> with_spin(const Moving<Aabb<S>>& m, const Vec3<S>& rotation) {
  return {to_obb(m.shape), m.displacement, rotation};
}

/// Status, time and normal belong together; nothing touches before, and where they hit there is no gap; the other way round is the same.
template <class A, class B> void check_turning(const Scene<A, B>& scene, Numbers<typename A::Scalar>& numbers) {
  using S = typename A::Scalar;
  const Check check(scene);
  const int spins = numbers.below(4);
  const Vec3<S> none = Vec3<S>::Zero(), u = spins == 0 ? none : numbers.vector(),
                v = spins > 1 ? numbers.vector() : none;
  const auto a = with_spin(scene.a, u);
  const auto b = with_spin(scene.b, v);
  const Toi<S> toi = time_of_impact(a, b), back = time_of_impact(b, a);
  const auto show = [&] { return "rotations " + text(u) + " " + text(v) + "; " + text(toi) + "\n  " + text(back); };
  if (!valid(a) || !valid(b)) {
    check(toi.status == ToiStatus::invalid && toi.time != toi.time, "turning: bad input is not invalid", show);
    return;
  }
  check_answer(scene, "turning", toi);
  if constexpr (!std::is_same_v<A, B> && !(std::is_same_v<A, Obb<S>> && std::is_same_v<B, Aabb<S>>)) {
    check(toi.status == back.status && toi.time == back.time && toi.normal == -back.normal,
          "turning: the other way round differs", show);
  }
  if (!is_moderate(scene, 60)) return;
  const auto wide_a = cast<double>(a);
  const auto wide_b = cast<double>(b);
  const TurningPair<double> pair(wide_a, wide_b, 0);
  if (pair.turn > 1e6) return;
  const double slack = 8 * pair.margin + 8 * std::numeric_limits<S>::epsilon() * double{scene.size()};
  const auto gap_at = [&](double time) {  // unchecked: axes are orthonormal to float only
    return separation_unchecked(pose_at(wide_a, time), pose_at(wide_b, time)).distance;
  };
  const bool moved = toi.status == ToiStatus::hit || toi.status == ToiStatus::apart || toi.status == ToiStatus::gave_up;
  const double free = moved ? double{toi.time} : 0;
  for (int k = 0; k < 8 && moved; ++k) {
    check(gap_at(free * k / 8) >= -slack, "turning: contact before the time of impact", show);
  }
  if (toi.status == ToiStatus::hit && is_moderate(scene, 16)) {  // of slivers the closest points are known less well
    const double near = double{half_digits<S>()} * pair.speed, rounded = std::numeric_limits<S>::epsilon() * pair.speed;
    check(gap_at(free) <= near + rounded + slack, "turning: a hit, and a gap", show);
  }
  const Aabb<double> box = swept_bounds(wide_a);
  const auto pose = pose_at(wide_a, free);
  const Vec3<double> beyond = (center(pose) - box.center).cwiseAbs() + half_widths(pose) - box.half_extents;
  constexpr bool flat = std::is_same_v<A, Triangle<S>>;  // its half widths reach as far to both sides
  check(flat || beyond.maxCoeff() <= slack, "swept_bounds(Turning) does not contain a pose", show);
}

}  // namespace thinwall::fuzz
