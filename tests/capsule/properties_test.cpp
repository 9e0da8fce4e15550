// The queries at one instant against the oracle: balls, boxes and capsules.

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/discrete/queries.hpp>

#include "support/contacts.hpp"
#include "support/draw.hpp"
#include "support/judge.hpp"
#include "support/property.hpp"
#include "support/shaker.hpp"

namespace thinwall::testing {
namespace {

/// The rounding of a gap: of all coordinates, for every one of them may decide where the shapes are nearest.
template <class S> oracle::Real rounding_of(const oracle::Pair& pair) {
  return oracle::unit_roundoff<S>() * size_at(pair, 0);
}

/// True if the cores are apart by so little that a query may take them for touching: then the normal is arbitrary, and
/// the points are off by the gap.
inline bool cores_nearly_touch(const oracle::Gap& truth, const oracle::Real& rounding) {
  return truth.core >= 0 && truth.core <= 64 * rounding;
}

/// How far a surface of this radius curves away within the error of the normal: cores that are near each other leave
/// little to tell the direction by.
inline oracle::Real curvature(const oracle::Real& core, const oracle::Real& radius, const oracle::Real& rounding) {
  if (core <= 0) return 0;
  const oracle::Real turned = core > 16 * rounding ? oracle::Real(16 * rounding / core) : oracle::Real(1);
  return radius * turned * turned / 2;
}

/// Is this the direction in which the shapes are that far apart?
template <class S> bool is_contact_normal(const oracle::Pair& pair, const oracle::Gap& truth, const Vec3<S>& normal) {
  if (!is_unit(normal)) return false;
  const oracle::Vector found = oracle::lift_vector(normal);
  const oracle::Real rounding = rounding_of<S>(pair);
  if (cores_nearly_touch(truth, rounding)) return true;
  if (truth.core > 0) return oracle::length(found - truth.normal) * truth.core <= 16 * rounding;
  return oracle::separation_along(pair, 0, found) >= truth.separation - 16 * rounding;
}

template <class A> inline constexpr bool is_capsule = std::is_same_v<A, Capsule<typename A::Scalar>>;

/// All its numbers are halves: where no core lies oblique, no sum or square of them is rounded.
template <class A> bool is_coarse(const A& shape) {
  bool coarse = true;
  for_each_number(shape, [&](const auto& x) {
    using std::floor;
    coarse = coarse && 2 * x == floor(2 * x);
  });
  return coarse;
}

template <class P> class OneInstant : public ::testing::Test {
 protected:
  /// The oracle tries every face of the Minkowski sum: 81 for a capsule and a box.
  static constexpr bool is_slow = is_capsule<typename P::A> && std::is_same_v<typename P::B, Aabb<typename P::S>>;
  static constexpr int runs = is_slow ? 600 : 3000;
};
using Pairs = ::testing::Types<
    PairOf<Sphere<float>, Sphere<float>>, PairOf<Sphere<double>, Sphere<double>>, PairOf<Sphere<Wide>, Sphere<Wide>>,
    PairOf<Aabb<float>, Aabb<float>>, PairOf<Aabb<double>, Aabb<double>>, PairOf<Aabb<Wide>, Aabb<Wide>>,
    PairOf<Aabb<float>, Sphere<float>>, PairOf<Aabb<double>, Sphere<double>>,
    PairOf<Aabb<long double>, Sphere<long double>>, PairOf<Capsule<float>, Sphere<float>>,
    PairOf<Capsule<double>, Sphere<double>>, PairOf<Capsule<float>, Aabb<float>>, PairOf<Capsule<double>, Aabb<double>>,
    PairOf<Capsule<long double>, Aabb<long double>>, PairOf<Capsule<float>, Capsule<float>>,
    PairOf<Capsule<double>, Capsule<double>>, PairOf<Capsule<Wide>, Capsule<Wide>>>;
TYPED_TEST_SUITE(OneInstant, Pairs);

/// overlaps(): the sign of the separation, but for inputs within 4 u of a touch; of what no sum rounds, to the bit. separation(): the
/// distance within 4 u, a normal along which the shapes are that far apart, a point on each surface.
TYPED_TEST(OneInstant, separation_is_the_distance_and_overlaps_its_sign) {
  using S = typename TypeParam::S;
  check_property(this->runs, [] {
    const auto [a, b] = draw_pair<TypeParam>();
    const oracle::Pair pair = oracle::pair(a, b);
    const oracle::Gap truth = oracle::gap(pair, 0);
    const oracle::Real rounding = rounding_of<S>(pair);
    if (!is_capsule<typename TypeParam::A> && is_coarse(a) && is_coarse(b)) {
      RC_ASSERT(overlaps(a, b) == oracle::touching(pair, 0));
    } else if (abs(truth.separation) > 4 * rounding) {
      RC_ASSERT(overlaps(a, b) == (truth.separation < 0));
    }
    const Separation<S> found = separation(a, b);
    const oracle::Real error = abs(oracle::lift(found.distance) - truth.separation);
    RC_ASSERT(error <= 4 * rounding);
    RC_ASSERT(is_contact_normal<S>(pair, truth, found.normal));

    const oracle::Vector normal = oracle::lift_vector(found.normal);
    const oracle::Real allowed =
        (cores_nearly_touch(truth, rounding) ? 96 : 32) * rounding + curvature(truth.core, pair.reach(), rounding);
    const oracle::Vector point_a = oracle::lift_vector(found.point_a), point_b = oracle::lift_vector(found.point_b);
    RC_ASSERT(off_surface(point_a, pair.a) <= allowed);
    RC_ASSERT(off_surface(point_b, pair.b) <= allowed);
    const oracle::Vector between = point_b - point_a;
    RC_ASSERT(oracle::length(between - oracle::lift(found.distance) * normal) <= allowed);
  });
}

/// contact(): there when overlaps() says so; moving B by the penetration along the normal leaves a touch.
TYPED_TEST(OneInstant, contact_moves_out) {
  using S = typename TypeParam::S;
  check_property(this->runs, [] {
    const auto [a, b] = draw_pair<TypeParam>();
    const auto found = contact(a, b);
    RC_ASSERT(found.has_value() == overlaps(a, b));
    if (!found) return;
    RC_ASSERT(found->penetration >= S(0));
    RC_ASSERT(is_unit(found->normal));
    oracle::Pair pair = oracle::pair(a, b);
    const oracle::Real rounding = rounding_of<S>(pair);
    const oracle::Real shortfall = curvature(oracle::gap(pair, 0).core, oracle::lift(found->penetration), rounding);
    pair.b.center = pair.b.center + oracle::lift(found->penetration) * oracle::lift_vector(found->normal);
    RC_ASSERT(abs(oracle::gap(pair, 0).separation) <= 32 * rounding + shortfall);
  });
}

/// Passing A and B the other way round flips the normal and swaps the points: to the bit between different shapes. A
/// normal that is arbitrary (the cores touch) does not flip, and takes the points with it.
TYPED_TEST(OneInstant, other_way_round_is_the_same) {
  using S = typename TypeParam::S;
  using A = typename TypeParam::A;
  using B = typename TypeParam::B;
  check_property(this->runs, [] {
    const auto [a, b] = draw_pair<TypeParam>();
    const oracle::Pair pair = oracle::pair(a, b);
    const oracle::Gap truth = oracle::gap(pair, 0);
    const oracle::Real rounding = rounding_of<S>(pair);
    const Separation<S> there = separation(a, b), back = separation(b, a);
    const auto contact_there = contact(a, b), contact_back = contact(b, a);
    if constexpr (std::is_same_v<A, B>) {
      RC_ASSERT(abs(oracle::lift(there.distance) - oracle::lift(back.distance)) <= 8 * rounding);
      if (abs(truth.separation) <= 4 * rounding) return;  // too near a touch to call
      RC_ASSERT(contact_there.has_value() == contact_back.has_value());
      if (!contact_there) return;
      const auto penetration = oracle::lift(contact_there->penetration),
                 other = oracle::lift(contact_back->penetration);
      RC_ASSERT(abs(oracle::Real(penetration - other)) <= 8 * rounding);
    } else {
      RC_ASSERT(overlaps(a, b) == overlaps(b, a));
      RC_ASSERT(there.distance == back.distance);
      RC_ASSERT(contact_there.has_value() == contact_back.has_value());
      if (contact_there) RC_ASSERT(contact_there->penetration == contact_back->penetration);
      if (there.normal == back.normal) {
        RC_ASSERT(cores_nearly_touch(truth, rounding));
        return;
      }
      RC_ASSERT(same(there, {back.distance, -back.normal, back.point_b, back.point_a}));
      if (!contact_there) return;
      const Contact<S>& met = *contact_back;
      RC_ASSERT(same(*contact_there, {met.local_b, met.local_a, -met.normal, met.penetration}));
    }
  });
}

/// Lengths times 2^k: the same bits, as long as nothing leaves the range of the scalar.
TYPED_TEST(OneInstant, same_bits_at_every_size) {
  using S = typename TypeParam::S;
  using A = typename TypeParam::A;
  using B = typename TypeParam::B;
  check_property(this->runs, [] {
    const auto [a, b] = draw_pair<TypeParam>(*rc::gen::element(Style::lattice, Style::plain));
    const int k = draw_scale<S>();
    const A large_a = scaled(a, k);
    const B large_b = scaled(b, k);
    if (!same_body(oracle::body(large_a), oracle::body(a), k) || !same_body(oracle::body(large_b), oracle::body(b), k))
      return;
    RC_ASSERT(overlaps(large_a, large_b) == overlaps(a, b));
    RC_ASSERT(same(separation(large_a, large_b), scaled(separation(a, b), k)));
    RC_ASSERT(same(contact(large_a, large_b), scaled(contact(a, b), k)));
  });
}

template <class Target> class RayAtOneInstant : public ::testing::Test {};
using RayTargets = ::testing::Types<Sphere<float>, Sphere<double>, Sphere<Wide>, Aabb<float>, Aabb<double>,
                                    Capsule<float>, Capsule<double>, Capsule<Wide>>;
TYPED_TEST_SUITE(RayAtOneInstant, RayTargets);

/// raycast() against the motion of a point over one step.
TYPED_TEST(RayAtOneInstant, raycast_is_the_motion_of_a_point) {
  using S = typename TypeParam::Scalar;
  check_property(is_capsule<TypeParam> ? 1000 : 3000, [] {
    const auto [point, b] = draw_pair<PairOf<Sphere<S>, TypeParam>>();
    const Ray<S> ray{point.center, draw_shaker<S>().vector(), S(1)};
    RC_LOG() << "direction " << ray.direction.transpose() << "\n";
    oracle::Pair pair = oracle::pair(point, b);
    pair.a.radius = 0;
    pair.a.displacement = oracle::lift_vector(ray.direction);
    const oracle::Impact truth = oracle::impact(pair);
    const auto found = raycast(ray, b);

    using oracle::Verdict;
    const oracle::Real u = oracle::unit_roundoff<S>();
    const Verdict said = !found ? Verdict::apart : found->t == S(0) ? Verdict::overlapping : Verdict::hit;
    RC_ASSERT(oracle::verdict_is_near(pair, truth, said, 4 * u));
    if (said != truth.verdict || said == Verdict::apart) return;
    if (said == Verdict::overlapping) {
      RC_ASSERT(found->normal == Vec3<S>(Vec3<S>::Zero()));
      RC_ASSERT(found->point == ray.origin);
      return;
    }
    RC_ASSERT(is_unit(found->normal));
    const oracle::Real backward = oracle::backward_error_in_u(pair, found->t);
    const oracle::Real forward = oracle::forward_error_in_u_kappa(truth, found->t);
    RC_LOG() << "t " << found->t << " forward " << forward << " backward " << backward << "\n";
    RC_ASSERT(backward <= 4);
    RC_ASSERT(forward <= 4);
    RC_ASSERT(off_surface(oracle::lift_vector(found->point), pair.b) <= 16 * u * size_at(pair, truth.time));
  });
}

template <class T> class RayAtEverySize : public ::testing::Test {};
using AllTargets =
    ::testing::Types<Sphere<float>, Sphere<double>, Aabb<float>, Aabb<double>, Obb<float>, Obb<double>, Capsule<float>,
                     Capsule<double>, Triangle<float>, Triangle<double>, Sphere<Wide>, Capsule<Wide>>;
TYPED_TEST_SUITE(RayAtEverySize, AllTargets);

/// The same bits, whichever rung answers at either size, at every shape and turned any way.
TYPED_TEST(RayAtEverySize, says_the_same) {
  using S = typename TypeParam::Scalar;
  std::vector<int> scales = {-90, -70, -52, -36, 36, 52, 70, 90};
  std::ranges::copy(all_scales<S>(), std::back_inserter(scales));
  Shaker<S> draw(23);
  for (int i = 0; i < (std::is_same_v<S, Wide> ? 1000 : 20'000); ++i) {
    TypeParam target = drawn(draw, TypeTag<TypeParam>{});
    const Vec3<S> origin = draw.vector(), direction = draw.vector();
    const Ray<S> ray{origin, direction, draw.pick(0, 1) == 0 ? S(1) : std::numeric_limits<S>::infinity()};
    const Separation<S> gap = separation(Sphere<S>{origin, S(0)}, target);
    if (i % 3 == 0) target = moved(target, Vec3<S>(gap.normal * -gap.distance));  // all but touching
    const auto expected = raycast(ray, target);
    for (const int k : scales) {
      if (!divides_exactly(ray, -k) || !divides_exactly(target, -k)) continue;
      const auto found = raycast(scaled(ray, k), scaled(target, k));
      ASSERT_EQ(found.has_value(), expected.has_value()) << i << " " << k;
      if (!found) continue;
      EXPECT_EQ(found->t, expected->t) << i << " " << k;
      EXPECT_EQ(found->normal, expected->normal) << i << " " << k;
      EXPECT_EQ(found->point, times_power_of_two(expected->point, k)) << i << " " << k;
    }
  }
}

}  // namespace
}  // namespace thinwall::testing
