// Every pair with one shape as the later, at one scalar: compiled once for each, for all of them in one file take minutes.

#include <thinwall/swept/turning/turning_bounds.hpp>
#include <thinwall/swept/turning/turning_impact.hpp>

#include "fuzz/checks.hpp"

namespace thinwall::fuzz {
namespace {

// ---- What a time of impact of shapes that turn must fulfil, whatever the shapes and motions.

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
  const Aabb<double> pose = swept_bounds(at_rest(pose_at(wide_a, free)));  // rounded outward itself
  const Vec3<double> beyond = (pose.center - box.center).cwiseAbs() + pose.half_extents - box.half_extents;
  const double outward = 8 * std::numeric_limits<double>::denorm_min();
  check(beyond.maxCoeff() <= slack + outward, "swept_bounds(Turning) does not contain a pose", show);
}

// ---- All checks.

template <class A, class B> void check_pair(Bytes& bytes, Reading reading) {
  using S = typename A::Scalar;
  const int plan = bytes();
  Numbers<S> numbers(bytes, reading);
  const Scene<A, B> scene = draw_scene<A, B>(numbers);
  const Toi<S> toi = check_closed_form(scene);
  const int choice = plan / 8;
  if (!scene.is_valid()) {
    check_bad_shapes(scene);
    check_raycast(scene);
    check_methods(scene, choice);
    check_certified(scene, toi);
    check_turning(scene, numbers);
    return;
  }
  check_discrete(scene);
  switch (plan % 8) {
    case 0: judge_discrete(scene); break;
    case 1: check_raycast(scene); break;
    case 2: check_scale(scene, choice); break;
    case 3: check_methods(scene, choice); break;
    case 4: check_certified(scene, toi); break;
    case 5: check_turning(scene, numbers); break;
    default: judge_closed_form(scene, toi); break;
  }
}

}  // namespace

template <class A> void check_one_pair_of(Bytes& bytes) {
  const int kind = bytes.below(8);
  const Reading reading = kind == 0 ? Reading::raw : kind == 1 ? Reading::unruly : Reading::nasty;
  const auto for_each_partner = [&](const auto& f) {
    for_each_type(Shapes<typename A::Scalar>{}, [&]<class B>(TypeTag<B> tag) {
      if constexpr (ServedPair<A, B> && A::rank >= B::rank) f(tag);
    });
  };
  visit_one(for_each_partner, bytes(), [&]<class B>(TypeTag<B>) { check_pair<A, B>(bytes, reading); });
}

template void check_one_pair_of<THINWALL_FUZZ_SHAPE<THINWALL_FUZZ_SCALAR>>(Bytes& bytes);

}  // namespace thinwall::fuzz
