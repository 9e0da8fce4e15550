// Manifolds of capsules: two points where the core runs along a face or along another core, else one.

#include "support/manifold_properties.hpp"

namespace thinwall::testing {
namespace {

template <class S> class CapsuleManifolds : public ::testing::Test {
 protected:
  Aabb<S> floor{{0, 0, 0}, {4, 4, 1}};
  Capsule<S> lying{{-1, 1, S(3) / S(2)}, {1, 1, S(3) / S(2)}, S(5) / S(8)};  // an eighth deep

  void expect_ends(const Manifold<S>& found, const S& first_x, const S& last_x) {
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].local_a, (Vec3<S>(first_x, 0, -lying.radius)));
    EXPECT_EQ(found[1].local_a, (Vec3<S>(last_x, 0, -lying.radius)));
    for (const Contact<S>& c : found) {
      EXPECT_EQ(c.penetration, S(1) / S(8));
      EXPECT_EQ(c.normal, axis_vector<S>(2, true));
    }
  }
};
TYPED_TEST_SUITE(CapsuleManifolds, Scalars, ScalarNames);

TYPED_TEST(CapsuleManifolds, lying_on_a_box_it_rests_on_its_two_ends) {
  this->expect_ends(manifold(this->lying, this->floor), -1, 1);
  this->expect_ends(manifold(this->lying, to_obb(this->floor)), -1, 1);
  this->expect_ends(flipped(manifold(this->floor, this->lying)), -1, 1);
}

TYPED_TEST(CapsuleManifolds, ends_beyond_the_face_are_clipped) {
  using S = TypeParam;
  const Aabb<S> step{{1, 1, 0}, {S(1) / S(2), 1, 1}};
  this->expect_ends(manifold(this->lying, step), S(1) / S(2), 1);
  this->expect_ends(manifold(this->lying, to_obb(step)), S(1) / S(2), 1);
}

TYPED_TEST(CapsuleManifolds, along_the_rim_of_a_face_counts) {
  using S = TypeParam;
  const Aabb<S> step{{0, 0, 0}, {4, 1, 1}};
  this->expect_ends(manifold(this->lying, step), -1, 1);
}

TYPED_TEST(CapsuleManifolds, standing_tilted_or_a_ball_it_has_one_point) {
  using S = TypeParam;
  EXPECT_EQ(manifold(Capsule<S>{{0, 0, S(3) / S(2)}, {0, 0, 4}, 1}, this->floor).size(), 1U);
  EXPECT_EQ(manifold(Capsule<S>{{0, 0, S(3) / S(2)}, {1, 0, S(25) / S(16)}, 1}, this->floor).size(), 1U);
  EXPECT_EQ(manifold(Capsule<S>{{0, 0, S(3) / S(2)}, {0, 0, S(3) / S(2)}, 1}, this->floor).size(), 1U);
}

TYPED_TEST(CapsuleManifolds, all_but_parallel_it_keeps_two_points) {
  using S = TypeParam;
  Capsule<S> tilted = this->lying;
  tilted.b[2] += parallel_sine<S>();
  EXPECT_EQ(manifold(tilted, this->floor).size(), 2U);
}

TYPED_TEST(CapsuleManifolds, core_inside_a_box_leaves_along_one_face) {
  using S = TypeParam;
  const auto found = manifold(Capsule<S>{{-1, 0, S(1) / S(2)}, {1, 0, S(1) / S(2)}, 1}, this->floor);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].penetration, S(3) / S(2));
  EXPECT_EQ(found[0].local_b, (Vec3<S>(-1, 0, 1)));
}

TYPED_TEST(CapsuleManifolds, lying_on_a_triangle) {
  using S = TypeParam;
  const Triangle<S> large{{-8, -8, 1}, {8, -8, 1}, {0, 8, 1}};
  this->expect_ends(manifold(this->lying, large), -1, 1);
  this->expect_ends(flipped(manifold(large, this->lying)), -1, 1);
  const Triangle<S> turned{large.c, large.b, large.a};
  this->expect_ends(manifold(this->lying, turned), -1, 1);
  const Triangle<S> small{{0, 0, 1}, {4, 0, 1}, {0, 4, 1}};
  this->expect_ends(manifold(this->lying, small), 0, 1);
}

TYPED_TEST(CapsuleManifolds, past_the_tip_of_a_needle_there_is_no_point) {
  using S = TypeParam;
  const S wide = std::numeric_limits<S>::epsilon();
  const Triangle<S> needle{{0, 0, 0}, {-1, wide, 0}, {-1, -wide, 0}};
  const Manifold<S> beside = manifold(Capsule<S>{{0, 0, 1}, {0.5, 0, 1}, 1}, needle);
  ASSERT_FALSE(beside.empty());
  for (const Contact<S>& c : beside) EXPECT_LE((center(needle) + c.local_b)[0], 4 * wide);
}

TYPED_TEST(CapsuleManifolds, on_a_triangle_they_have_as_many_points_at_any_scale) {
  using S = TypeParam;
  const Capsule<S> rod{{-4, 3, 0}, {-2, 3, 0}, 1};
  const Triangle<S> triangle{{-4, 3, 1}, {1, -4, 1}, {0, 4, 1}};
  const int far = std::min(std::numeric_limits<S>::max_exponent, 16000);
  for (const int e : {0, -far * 5 / 8, -far * 7 / 8, far * 5 / 8, far * 7 / 8}) {
    EXPECT_EQ(manifold(scaled(rod, e), scaled(triangle, e)).count, 2) << e;
  }
}

TYPED_TEST(CapsuleManifolds, side_by_side_capsules_have_two_points) {
  using S = TypeParam;
  const Capsule<S> below{{4, 1, S(1) / S(2)}, {0, 1, S(1) / S(2)}, S(1) / S(2)};
  this->expect_ends(manifold(this->lying, below), 0, 1);
  const auto other = manifold(below, this->lying);
  ASSERT_EQ(other.size(), 2U);
  EXPECT_EQ(other[0].normal, axis_vector<S>(2));
}

TYPED_TEST(CapsuleManifolds, crossed_or_end_to_end_capsules_have_one_point) {
  using S = TypeParam;
  EXPECT_EQ(manifold(this->lying, Capsule<S>{{0, 0, 1}, {0, 2, 1}, 1}).size(), 1U);
  EXPECT_EQ(manifold(this->lying, Capsule<S>{{2, 1, S(3) / S(2)}, {3, 1, S(3) / S(2)}, 1}).size(), 1U);
}

TYPED_TEST(CapsuleManifolds, cores_on_one_line_share_a_stretch) {
  using S = TypeParam;
  const auto found = manifold(this->lying, Capsule<S>{{0, 1, S(3) / S(2)}, {3, 1, S(3) / S(2)}, 1});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].penetration, this->lying.radius + S(1));
  EXPECT_EQ(found[0].normal, axis_vector<S>(1));
}

// A triangle whose third corner is on the line of the others, to rounding.
TEST(CapsuleOnNeedle, has_no_point_beside_it) {
  const Capsule<float> rod{{-0x1p-1F, -0x1.e26714p+1F, -0x1.8p+0F}, {-0x1p-1F, 0x1.240124p+1F, -0x1.8p+0F}, 8};
  const Triangle<float> needle{
      {-1, 0.5F, 0x1.9ffffep+2F}, {-0.5F, 1, 0x1.9ffffep+2F}, {-0x1.751c54p+0F, 0x1.5c757p-5F, 0x1.9ffffep+2F}};
  const Manifold<float> found = manifold(rod, needle);
  EXPECT_FALSE(found.empty());
  for (const Contact<float>& c : found) EXPECT_LE(off_surface(needle, c.local_b), 1e-5);
}

template <class P> class CapsuleManifoldsOf : public ::testing::Test {};
using ManifoldPairs =
    ::testing::Types<PairOf<Capsule<double>, Sphere<double>>, PairOf<Capsule<float>, Aabb<float>>,
                     PairOf<Capsule<double>, Aabb<double>>, PairOf<Capsule<double>, Obb<double>>,
                     PairOf<Capsule<Wide>, Obb<Wide>>, PairOf<Capsule<float>, Triangle<float>>,
                     PairOf<Capsule<double>, Triangle<double>>, PairOf<Capsule<float>, Capsule<float>>,
                     PairOf<Capsule<double>, Capsule<double>>, PairOf<Capsule<long double>, Capsule<long double>>>;
TYPED_TEST_SUITE(CapsuleManifoldsOf, ManifoldPairs);

TYPED_TEST(CapsuleManifoldsOf, are_real_points_as_deep_as_the_contact) {
  expect_manifolds<typename TypeParam::A, typename TypeParam::B>(2000);
}

}  // namespace
}  // namespace thinwall::testing
