#pragma once
/// The queries of certified answers, and their judge.

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include <thinwall/swept/certified.hpp>

#include "support/any_number.hpp"
#include "support/shaker.hpp"

// ---- Motions to be certified, and the pairs that can be: plain ones, as a scene has them, and the worst.

namespace thinwall::testing {

/// visit(name, PairOf<A, B>) for every pair that can be certified, in one order.
template <class Visit> void for_each_certified_pair(const Visit& visit) {
  for_each_served_pair<double>([&]<class A, class B>(TypeTag<A>, TypeTag<B>) {
    if constexpr (certifies<A, B>) visit(std::string(shape_name<A>) + " " + std::string(shape_name<B>), PairOf<A, B>{});
  });
}

// Shapes of about half a unit, no two numbers related.
inline Sphere<double> plain_shape(Shaker<double>& draw, TypeTag<Sphere<double>>) {
  return {draw.plain_vector(), 0.5 + 0.4 * draw.plain()};
}
inline Aabb<double> plain_shape(Shaker<double>& draw, TypeTag<Aabb<double>>) {
  return {draw.plain_vector(), draw.plain_vector().cwiseAbs()};
}
inline Obb<double> plain_shape(Shaker<double>& draw, TypeTag<Obb<double>>) {
  return {draw.plain_vector(), draw.plain_vector().cwiseAbs(), draw.plain_axes()};
}
inline Capsule<double> plain_shape(Shaker<double>& draw, TypeTag<Capsule<double>>) {
  return {draw.plain_vector(), draw.plain_vector(), 0.3 + 0.2 * draw.plain()};
}
inline Triangle<double> plain_shape(Shaker<double>& draw, TypeTag<Triangle<double>>) {
  return {draw.plain_vector(), draw.plain_vector(), draw.plain_vector()};
}

/// As a scene has them: both move, some hit, some miss, some overlap.
template <class A, class B> Motion<A, B> plain_motion(Shaker<double>& draw) {
  Motion<A, B> motion{at_rest(plain_shape(draw, TypeTag<A>{})), at_rest(plain_shape(draw, TypeTag<B>{}))};
  const Vec3<double> from = 3 * draw.plain_vector();
  motion.a.shape = moved<double>(motion.a.shape, from);
  motion.b.displacement = draw.plain_vector();
  motion.a.displacement = motion.b.displacement - from * (1 + draw.plain()) + draw.plain_vector();
  return motion;
}

/// Axes that are neither unit nor at right angles, by up to all that a box may have.
template <class S> void skew(Obb<S>& box, Shaker<S>& draw) {
  for (int i = 0; i < 3; ++i) box.axes.col(i) += draw.plain_vector() * power<S>(-draw.pick(35, 60));
}
template <class Shape, class S> void skew(Shape&, Shaker<S>&) {}

/// The worst: all but touching, grazing, on a lattice (shaker.hpp); as large and as small as numbers go, mixed;
/// without motion, radius or extent.
template <class A, class B, class S> Motion<A, B> worst_motion(Shaker<S>& draw) {
  using Limits = std::numeric_limits<S>;
  constexpr int least = Limits::min_exponent - Limits::digits + 4, most = Limits::max_exponent - 34;
  Motion<A, B> motion = drawn_motion<A, B>(draw);
  const auto resize = [&](int e) { motion = {scaled(motion.a, e), scaled(motion.b, e)}; };
  switch (draw.pick(0, 12)) {
    case 0: resize(draw.pick(0, 1) == 0 ? draw.pick(least, least * 5 / 6) : draw.pick(most * 10 / 11, most)); break;
    case 1: resize(draw.pick(least, most)); break;
    case 2: motion.a.displacement = motion.b.displacement; break;
    case 3: motion.a.displacement = times_power_of_two(motion.a.displacement, draw.pick(least, most)); break;
    case 4: motion.a.shape = scaled(motion.a.shape, -draw.pick(20, -least)); break;
    case 5: motion.b.shape = scaled(motion.b.shape, -draw.pick(20, -least)); break;
    case 6:
      skew(motion.a.shape, draw);
      skew(motion.b.shape, draw);
      break;
    default: break;
  }
  return motion;
}

// ---- Judges a certified answer by the exact integers of the last stage, themselves judged in certified_test.cpp.

/// How often each stage decided.
struct Tally {
  std::array<int, 4> by{};

  void count(const CertifiedToi& toi) { ++by[static_cast<std::size_t>(toi.decided_by)]; }
  int decided(DecidedBy stage) const { return by[static_cast<std::size_t>(stage)]; }
};

template <Shape A, Shape B> ExactCore exact_core_of(const Moving<A>& a, const Moving<B>& b) {
  if constexpr (A::rank < B::rank) {
    return exact_core(b, a);
  } else {
    return exact_core(a, b);
  }
}

/// The form every answer has, whatever the truth.
inline ::testing::AssertionResult has_form(const CertifiedToi& toi) {
  switch (toi.verdict) {
    case ToiStatus::apart:
      if (toi.lower == 1 && toi.upper == 1) return ::testing::AssertionSuccess();
      break;
    case ToiStatus::overlapping:
      if (toi.lower == 0 && toi.upper == 0) return ::testing::AssertionSuccess();
      break;
    case ToiStatus::hit:
      if (toi.lower >= 0 && toi.lower <= toi.upper && toi.upper <= 1) return ::testing::AssertionSuccess();
      break;
    default: break;
  }
  return ::testing::AssertionFailure() << "verdict " << static_cast<int>(toi.verdict) << " with [" << toi.lower << ", "
                                       << toi.upper << "]";
}

/// Against the integers: one predicate at the start, the end, and either side of the bracket.
template <Shape A, Shape B>
::testing::AssertionResult judge_exactly(const Moving<A>& a, const Moving<B>& b, const CertifiedToi& toi) {
  const ExactCore core = exact_core_of(a, b);
  const ToiStatus truth = touched_by(core, 0)   ? ToiStatus::overlapping
                          : touched_by(core, 1) ? ToiStatus::hit
                                                : ToiStatus::apart;
  if (truth != toi.verdict)
    return ::testing::AssertionFailure() << static_cast<int>(toi.verdict) << " but is " << static_cast<int>(truth);
  if (truth != ToiStatus::hit) return has_form(toi);
  if (!touched_by(core, toi.upper)) return ::testing::AssertionFailure() << "no contact by upper " << toi.upper;
  if (toi.lower > 0 && touched_by(core, std::nextafter(toi.lower, 0.0)))
    return ::testing::AssertionFailure() << "contact before lower " << toi.lower;
  return has_form(toi);
}

}  // namespace thinwall::testing
