// What holds of every query at one instant: capsules with balls, boxes and capsules against the oracle, and any number in every pair.

#include <gtest/gtest.h>

#include <thinwall/capsule/capsule_manifold.hpp>

#include "support/any_number.hpp"
#include "support/discrete_properties.hpp"

namespace thinwall::testing {
namespace {

using Pairs = ::testing::Types<PairOf<Capsule<float>, Sphere<float>>, PairOf<Capsule<double>, Sphere<double>>,
                               PairOf<Capsule<float>, Aabb<float>>, PairOf<Capsule<double>, Aabb<double>>,
                               PairOf<Capsule<long double>, Aabb<long double>>, PairOf<Capsule<float>, Capsule<float>>,
                               PairOf<Capsule<double>, Capsule<double>>, PairOf<Capsule<Wide>, Capsule<Wide>>>;
INSTANTIATE_TYPED_TEST_SUITE_P(CapsulePair, OneInstant, Pairs);

using RayTargets = ::testing::Types<Capsule<float>, Capsule<double>, Capsule<Wide>>;
INSTANTIATE_TYPED_TEST_SUITE_P(CapsuleRay, RayAtOneInstant, RayTargets);

// ---- No number in any field breaks a query: valid shapes get a whole answer, others false, nothing or NaN.

template <class A, class B> void expect_nothing(const A& a, const B& b) {
  EXPECT_FALSE(overlaps(a, b));
  EXPECT_FALSE(contact(a, b));
  EXPECT_TRUE(manifold(a, b).empty());
  const auto gap = separation(a, b);
  EXPECT_NE(gap.distance, gap.distance);
  EXPECT_TRUE(is_nan(gap.normal) && is_nan(gap.point_a) && is_nan(gap.point_b));
}

template <class A, class B> void expect_whole_answers(const A& a, const B& b) {
  using S = typename A::Scalar;
  const bool ordinary = is_ordinary(S(magnitude(a) + magnitude(b)));  // else a sum of two lengths may overflow
  const bool overlap = overlaps(a, b);
  const auto gap = separation(a, b);
  const auto touch = contact(a, b);
  EXPECT_TRUE(is_unit_vector(gap.normal)) << gap.normal.transpose();
  EXPECT_EQ(gap.distance, gap.distance);
  EXPECT_TRUE(!ordinary || (is_finite(gap.distance) && is_finite(gap.point_a) && is_finite(gap.point_b)));
  ASSERT_EQ(touch.has_value(), overlap);
  ASSERT_EQ(manifold(a, b).empty(), !overlap);
  if (!touch) return;
  const S apart = (touch->normal - gap.normal).cwiseAbs().maxCoeff();  // either may be of another rung
  EXPECT_LE(apart, S(0x1p-40));
  EXPECT_GE(touch->penetration, S(0));
  EXPECT_TRUE(!ordinary || (is_finite(touch->local_a) && is_finite(touch->local_b)));
  for (const Contact<S>& point : manifold(a, b)) {
    EXPECT_TRUE(is_unit_vector(point.normal)) << point.normal.transpose();
    EXPECT_GE(point.penetration, S(0));
    EXPECT_TRUE(!ordinary || (is_finite(point.local_a) && is_finite(point.local_b)));
  }
}

TEST(AnyNumber, in_axes_that_are_as_long_as_they_may_be) {
  for_each_served_pair<double>([]<class A, class B>(TypeTag<A> first, TypeTag<B> second) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const double away : {-3.0, -1.75, -0.5, 0.5, 1.75, 3.0}) {
        const Vec3<double> by = axis_vector<double>(axis) * away;
        expect_whole_answers(lengthened(usual(first)), lengthened(moved(usual(second), by)));
      }
    }
  });
}

TEST(AnyNumber, in_a_shape) {
  for_each_served_pair<double>([]<class A, class B>(TypeTag<A> first, TypeTag<B> second) {
    for (const double away : {0.5, 4.0}) {
      A a = usual(first);
      B b = moved(usual(second), Vec3<double>(away, 0.25, 0.125));
      const auto ask = [&] {
        if (valid(a) && valid(b)) {
          expect_whole_answers(a, b);
          expect_whole_answers(b, a);
        } else {
          expect_nothing(a, b);
          expect_nothing(b, a);
        }
      };
      ask();
      with_every_number<double>(a, ask);
      with_every_number<double>(b, ask);
    }
  });
}

TEST(AnyNumber, in_a_margin) {
  for_each_served_pair<double>([]<class A, class B>(TypeTag<A> first, TypeTag<B> second) {
    const A a = usual(first);
    const B b = moved(usual(second), Vec3<double>(4, 0, 0));
    for (const double margin : special_numbers<double>()) {
      const bool reaches = margin > 4 && is_finite(margin);
      EXPECT_EQ(overlaps_within(a, b, margin), reaches) << margin;
      EXPECT_EQ(overlaps_within(b, a, margin), reaches) << margin;
    }
  });
}

TEST(AnyNumber, in_a_ray_and_its_target) {
  for_each_type(Shapes<double>{}, []<class A>(TypeTag<A> tag) {
    for (const double from : {0.125, -4.0}) {
      SCOPED_TRACE("rank " + std::to_string(A::rank));
      A shape = usual(tag);
      Ray<double> ray{{from, 0.375, 0.125}, {1, 0.0625, 0.03125}};
      const auto ask = [&] {
        const auto hit = raycast(ray, shape);
        EXPECT_TRUE(!hit || (valid(ray) && valid(shape)));
        if (!hit) return;
        EXPECT_GE(hit->t, 0);
        EXPECT_LE(hit->t, ray.max_t);
        EXPECT_TRUE(is_finite(hit->t));
        EXPECT_TRUE(is_finite(hit->point)) << hit->point.transpose();
        EXPECT_TRUE(hit->normal == Vec3<double>::Zero() ? hit->t == 0 : is_unit_vector(hit->normal))
            << hit->normal.transpose();
      };
      ask();
      with_every_number<double>(ray, ask);
      with_every_number<double>(shape, ask);
    }
  });
}

TEST(AnyNumber, no_ray_hits_at_infinity) {
  const double far = 0x1p1020, tiny = std::numeric_limits<double>::min();
  const Vec3<double> corner(far, far, far);
  EXPECT_FALSE(raycast(Ray<double>{{0, 0, 0}, {tiny, tiny, tiny}}, Aabb<double>{corner, {1, 1, 1}}));  // t overflows
  EXPECT_FALSE(
      raycast(Ray<double>{{0, 0, 0}, {tiny, tiny, tiny}}, Obb<double>{corner, {1, 1, 1}, Mat3<double>::Identity()}));
}

TEST(AnyNumber, no_ray_hits_a_triangle_beside_it) {
  const Triangle<double> steep{{0.5, 3, 3}, {0.5, 1e200, 1e-300}, {3, 1e-300, 0}};  // z would overflow
  EXPECT_FALSE(raycast(Ray<double>{{-1e308, 0.5, 0}, {1e300, 0, 2e300}}, steep));
  const Triangle<double> low{{0, 0, 0}, {1, 0.5, -2e300}, {0, 1, 1}};  // x is 3 all the way
  EXPECT_FALSE(raycast(Ray<double>{{3, -1e308, 1e300}, {0, 1, 0}}, low));
}

}  // namespace
}  // namespace thinwall::testing
