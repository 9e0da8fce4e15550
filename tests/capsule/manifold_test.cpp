// Manifolds: known cases, of capsules two points where the core runs along a face or along another core, else one; then many drawn ones.

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "support/manifold_properties.hpp"

namespace thinwall::testing {
namespace {

template <class S> Mat3<S> turned_eighth(int axis) {
  using std::sqrt;
  const S root = S(1) / S(sqrt(S(2)));
  return turn_in_plane((axis + 1) % 3, (axis + 2) % 3, root, root);
}

/// The area of the convex polygon that the points of a manifold span, seen along z.
template <class S> S spread(const Manifold<S>& m) {
  S area = 0;
  for (std::size_t i = 0; i < m.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      for (std::size_t k = 0; k < m.size(); ++k) {
        for (std::size_t l = 0; l < k; ++l) {  // a quadrilateral's area is half the largest product of its diagonals
          const Vec3<S> first = m[i].local_a - m[j].local_a, second = m[k].local_a - m[l].local_a;
          area = std::max(area, S(largest(S(first[0] * second[1] - first[1] * second[0])) / 2));
        }
      }
    }
  }
  return area;
}

template <class S> class Manifolds : public ::testing::Test {
 protected:
  Aabb<S> floor{{0, 0, 0}, {4, 4, 1}};
};
TYPED_TEST_SUITE(Manifolds, Scalars, ScalarNames);

TYPED_TEST(Manifolds, box_on_a_floor_rests_on_its_four_corners) {
  using S = TypeParam;
  const Aabb<S> box{{1, -1, S(15) / S(8)}, {1, 1, 1}};
  for (const auto& found : {manifold(this->floor, box), manifold(this->floor, to_obb(box)),
                            manifold(to_obb(this->floor), box), manifold(to_obb(this->floor), to_obb(box))}) {
    ASSERT_EQ(found.size(), 4U);
    EXPECT_EQ(spread(found), S(4));
    for (const Contact<S>& c : found) {
      EXPECT_EQ(c.penetration, S(1) / S(8));
      EXPECT_EQ(c.normal, axis_vector<S>(2));
      EXPECT_EQ(c.local_b.cwiseAbs(), (Vec3<S>(1, 1, 1)));
      EXPECT_EQ(c.local_a, (Vec3<S>(c.local_b[0] + 1, c.local_b[1] - 1, 1)));
    }
  }
}

TYPED_TEST(Manifolds, touching_faces_have_four_points_of_no_depth_and_overhanging_ones_are_clipped) {
  using S = TypeParam;
  const Aabb<S> box{{1, -1, 2}, {1, 1, 1}};
  for (const auto& found : {manifold(this->floor, box), manifold(this->floor, to_obb(box))}) {
    ASSERT_EQ(found.size(), 4U);
    for (const Contact<S>& c : found) EXPECT_EQ(c.penetration, S(0));
  }
  const auto overhanging = manifold(this->floor, Obb<S>{{4, 4, 2}, {1, 1, 1}, Mat3<S>::Identity()});
  ASSERT_EQ(overhanging.size(), 4U);
  EXPECT_EQ(spread(overhanging), S(1));
}

TYPED_TEST(Manifolds, octagon_keeps_four_of_eight_corners_far_apart) {
  using S = TypeParam;
  const auto found = manifold(Aabb<S>{{0, 0, 0}, {1, 1, 1}}, Obb<S>{{0, 0, 2}, {1, 1, 1}, turned_eighth<S>(2)});
  ASSERT_EQ(found.size(), 4U);
  EXPECT_GT(spread(found), S(2));  // of the octagon's 8 (sqrt(2) - 1) = 3.31; the best four have 2.83
}

TYPED_TEST(Manifolds, all_but_parallel_boxes_keep_four_points) {
  using S = TypeParam;
  Mat3<S> tilt = Mat3<S>::Identity();  // a turn about x and one about y
  const S sine = parallel_sine<S>() / 8;
  tilt(1, 2) = tilt(2, 0) = -sine;
  tilt(2, 1) = tilt(0, 2) = sine;
  for (const S& x : {S(0), S(4)}) {
    const auto found = manifold(this->floor, Obb<S>{{x, x, S(31) / S(16)}, {1, 1, 1}, tilt});
    ASSERT_EQ(found.size(), 4U) << x;
    for (const Contact<S>& c : found) EXPECT_LE(largest(S(c.penetration - S(1) / S(16))), 4 * sine);
  }
}

TYPED_TEST(Manifolds, edge_on_a_face_is_two_points) {
  using S = TypeParam;
  const Obb<S> box{{1, 0, 2}, {1, 1, 1}, turned_eighth<S>(0)};
  for (const auto& found : {manifold(this->floor, box), flipped(manifold(box, this->floor))}) {
    ASSERT_EQ(found.size(), 2U);
    for (const Contact<S>& c : found) {
      EXPECT_EQ(largest(S(c.local_a[0] - 1)), S(1));
      EXPECT_LE(largest(c.local_a[1]), unit<S>() * 8);
      EXPECT_LE(largest(S(found[0].penetration - found[1].penetration)), unit<S>() * 8);
    }
  }
}

TYPED_TEST(Manifolds, corner_on_a_face_is_one_point) {
  using S = TypeParam;
  Obb<S> box{{0, 0, 0}, {1, 1, 1}, turned_eighth<S>(1) * turned_eighth<S>(2) * turned_eighth<S>(0)};
  box.center[2] = half_widths(box)[2] + S(7) / S(8);
  const auto found = manifold(this->floor, box);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_LE(largest(S(found[0].penetration - S(1) / S(8))), unit<S>() * 8);
}

TYPED_TEST(Manifolds, crossed_edges_are_one_point) {
  using S = TypeParam;
  const Obb<S> below{{0, 0, 0}, {4, 1, 1}, turned_eighth<S>(0)};
  const Obb<S> above{{0, 0, S(11) / S(4)}, {1, 4, 1}, turned_eighth<S>(1)};
  const auto found = manifold(below, above);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_LE(largest<S>(found[0].normal - axis_vector<S>(2)), unit<S>() * 8);
  EXPECT_LE(largest(S(found[0].local_a[0])) + largest(S(found[0].local_a[1])), unit<S>() * 16);
}

TYPED_TEST(Manifolds, flat_boxes_have_no_point_twice) {
  using S = TypeParam;
  const auto count = [&](const Vec3<S>& half) {
    return manifold(this->floor, Obb<S>{{0, 0, 1}, half, Mat3<S>::Identity()}).size();
  };
  EXPECT_EQ(count({1, 1, 0}), 4U);
  EXPECT_EQ(count({1, 0, 0}), 2U);
  EXPECT_EQ(count({0, 0, 0}), 1U);
  EXPECT_EQ(manifold(this->floor, Aabb<S>{{0, 0, 1}, {1, 0, 1}}).size(), 2U);
  EXPECT_EQ(manifold(this->floor, Aabb<S>{{0, 0, 1}, {0, 0, 0}}).size(), 1U);
}

TYPED_TEST(Manifolds, what_is_as_wide_as_a_rounding_has_no_point_twice) {
  using S = TypeParam;
  const S fifth = S(1) / S(5);
  EXPECT_EQ(manifold(Aabb<S>{{0, 0, 0}, {1, fifth, 1}}, Aabb<S>{{2, fifth + fifth / 2, 0}, {1, fifth / 2, 1}}).size(),
            2U);
  const Vec3<S> crumb = Vec3<S>(6, 8, 3) * (gap_noise(S(1)) / 100);
  EXPECT_EQ(manifold(Capsule<S>{{0, 0, 0}, crumb, 1}, Capsule<S>{{0, 0, 0}, crumb / 2, 1}).size(), 1U);
}

TYPED_TEST(Manifolds, points_of_an_aabb_lie_on_it_unlike_its_contact) {
  using S = TypeParam;
  const Sphere<S> ball{{2, 0, 2}, 1};
  EXPECT_EQ(contact(this->floor, ball)->local_a, (Vec3<S>(0, 0, 0)));
  const auto found = manifold(this->floor, ball);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].local_a, (Vec3<S>(2, 0, 1)));
  EXPECT_EQ(found[0].local_b, (Vec3<S>(0, 0, -1)));
}

TYPED_TEST(Manifolds, apart_is_empty) {
  using S = TypeParam;
  const Aabb<S> box{{0, 0, next_up(S(2))}, {1, 1, 1}};
  EXPECT_TRUE(manifold(this->floor, box).empty());
  EXPECT_TRUE(manifold(this->floor, to_obb(box)).empty());
  EXPECT_TRUE(manifold(this->floor, Sphere<S>{{0, 0, 3}, 1}).empty());
  EXPECT_TRUE(manifold(this->floor, Sphere<S>{{nan<S>(), 0, 2}, 1}).empty());
}

TYPED_TEST(Manifolds, same_bits_at_every_size) {
  using S = TypeParam;
  const int far = std::min(std::numeric_limits<S>::max_exponent, 16000) - 8;
  Shaker<S> draw(7);
  for (int run = 0; run < 200; ++run) {
    const auto [a, b] = nearly_touching<Obb<S>, Obb<S>>(draw);
    const auto here = manifold(a, b);
    for (const int e : {far / 2, -far / 2, far}) {
      const auto there = manifold(scaled(a, e), scaled(b, e));
      ASSERT_EQ(there.size(), here.size()) << run << " at 2^" << e;
      for (std::size_t i = 0; i < here.size(); ++i) {
        EXPECT_EQ(scaled(there[i], -e).local_a, here[i].local_a) << run << " at 2^" << e;
        EXPECT_EQ(scaled(there[i], -e).penetration, here[i].penetration) << run << " at 2^" << e;
      }
    }
  }
}

/// Counts what the clear rung answers, which must agree with the careful one: as many points, as deep, along the same normal. Of faces
/// parallel to half the digits the careful rung takes one for the other.
template <class B> std::size_t clear_ones(std::size_t runs) {
  Shaker<double> draw(20261127);
  std::size_t clear = 0;
  for (std::size_t run = 0; run < runs && !::testing::Test::HasFailure(); ++run) {
    const auto [a, b] = nearly_touching<Obb<double>, B>(draw);
    Manifold<double> found;
    if (!clear_manifold(a, b, found)) continue;
    ++clear;
    SCOPED_TRACE("run " + std::to_string(run));
    EXPECT_EQ(found.empty(), !careful_overlaps(a, b));
    if (found.empty()) continue;
    const Manifold<double> careful = touching_manifold(a, b);
    const double off = 64 * unit<double>() * (magnitude(a) + magnitude(b));
    const double turned = largest<double>(found[0].normal - careful[0].normal);
    EXPECT_LE(turned, 2 * parallel_sine<double>());
    if (turned > off) continue;
    EXPECT_EQ(found.size(), careful.size());
    for (const Contact<double>& c : found) {
      EXPECT_TRUE(std::ranges::any_of(careful, [&](const Contact<double>& other) {
        return largest(other.penetration - c.penetration) <= off &&
               largest<double>(other.local_a - c.local_a) <= 16 * off;
      }));
    }
  }
  return clear;
}

TEST(ClearManifold, agrees_with_the_careful_one) {
  const std::size_t runs = thorough(slow_build ? 2'000 : 20'000);
  EXPECT_GE(clear_ones<Obb<double>>(runs), runs / 3);
  EXPECT_GE(clear_ones<Aabb<double>>(runs), runs / 3);
}

TEST(ClearManifold, keeps_a_corner_that_is_on_a_side_to_rounding) {
  Shaker<double> draw(20261127);
  for (int run = 0; run < 20'000; ++run) {  // by as much as counts as on it, and a few roundings
    const auto size = [&] { return 0.55 + 0.4 * draw.plain(); };
    Obb<double> b{{0, 0, 1.99}, {size(), size(), 1}, Mat3<double>::Identity()};
    const double beyond = (32 + draw.pick(-6, 6)) * unit<double>();
    b.center[0] = 1 - b.half_extents[0] + beyond;
    b.center[1] = draw.plain() * (1 - b.half_extents[1]);
    EXPECT_EQ(manifold(Obb<double>{{0, 0, 0}, {1, 1, 1}, Mat3<double>::Identity()}, b).size(), 4U) << run;
  }
}

/// Middle in middle, up and down are as short.
TEST(ClearManifold, of_two_ways_out_takes_the_one_that_contact_takes) {
  Shaker<double> draw(20261201);
  for (int run = 0; run < 2'000; ++run) {
    const auto size = [&] { return 8 + draw.plain(); };
    const double height = draw.plain(), angle = 3 * draw.plain();
    const Aabb<double> a{{draw.plain(), height, draw.plain()}, {size(), std::abs(draw.plain()), size()}};
    const Obb<double> b{{draw.plain(), height, draw.plain()},
                        {size(), std::abs(draw.plain()), size()},
                        turn_in_plane(2, 0, std::cos(angle), std::sin(angle))};
    ASSERT_EQ(manifold(a, b)[0].normal, contact(a, b)->normal) << run;
    ASSERT_EQ(manifold(to_obb(a), b)[0].normal, contact(to_obb(a), b)->normal) << run;
    ASSERT_EQ(manifold(b, to_obb(a))[0].normal, contact(b, to_obb(a))->normal) << run;
  }
}

// ---- Capsules.

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
  this->expect_ends(manifold(this->lying, Aabb<S>{{0, 0, 0}, {4, 1, 1}}), -1, 1);  // along the rim
}

TYPED_TEST(CapsuleManifolds, has_one_point_where_its_core_is_not_along) {
  using S = TypeParam;
  EXPECT_EQ(manifold(Capsule<S>{{0, 0, S(3) / S(2)}, {0, 0, 4}, 1}, this->floor).size(), 1U);  // standing
  EXPECT_EQ(manifold(Capsule<S>{{0, 0, S(3) / S(2)}, {1, 0, S(25) / S(16)}, 1}, this->floor).size(), 1U);
  EXPECT_EQ(manifold(Capsule<S>{{0, 0, S(3) / S(2)}, {0, 0, S(3) / S(2)}, 1}, this->floor).size(), 1U);  // a ball
  EXPECT_EQ(manifold(this->lying, Capsule<S>{{0, 0, 1}, {0, 2, 1}, 1}).size(), 1U);
  EXPECT_EQ(manifold(this->lying, Capsule<S>{{2, 1, S(3) / S(2)}, {3, 1, S(3) / S(2)}, 1}).size(), 1U);  // end to end
  Capsule<S> all_but_parallel = this->lying;
  all_but_parallel.b[2] += parallel_sine<S>();
  EXPECT_EQ(manifold(all_but_parallel, this->floor).size(), 2U);
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

// ---- Of every pair.

template <class P> class ManifoldsOf : public ::testing::Test {};
using ManifoldPairs = ::testing::Types<
    PairOf<Sphere<double>, Sphere<double>>, PairOf<Aabb<double>, Sphere<double>>, PairOf<Obb<double>, Sphere<double>>,
    PairOf<Triangle<double>, Sphere<double>>, PairOf<Aabb<double>, Aabb<double>>, PairOf<Obb<double>, Aabb<double>>,
    PairOf<Obb<float>, Obb<float>>, PairOf<Obb<double>, Obb<double>>, PairOf<Obb<long double>, Obb<long double>>,
    PairOf<Obb<Wide>, Obb<Wide>>, PairOf<Obb<float>, Aabb<float>>, PairOf<Aabb<Wide>, Aabb<Wide>>,
    PairOf<Capsule<double>, Sphere<double>>, PairOf<Capsule<float>, Aabb<float>>, PairOf<Capsule<double>, Aabb<double>>,
    PairOf<Capsule<double>, Obb<double>>, PairOf<Capsule<Wide>, Obb<Wide>>, PairOf<Capsule<float>, Triangle<float>>,
    PairOf<Capsule<double>, Triangle<double>>, PairOf<Capsule<float>, Capsule<float>>,
    PairOf<Capsule<double>, Capsule<double>>, PairOf<Capsule<long double>, Capsule<long double>>>;
TYPED_TEST_SUITE(ManifoldsOf, ManifoldPairs);

TYPED_TEST(ManifoldsOf, are_real_points_as_deep_as_the_contact) {
  using A = typename TypeParam::A;
  using S = typename A::Scalar;
  const bool is_slow = slow_build || std::is_same_v<S, Wide> || std::is_same_v<A, Capsule<S>>;
  expect_manifolds<A, typename TypeParam::B>(is_slow ? 2000 : 25000);
}

}  // namespace
}  // namespace thinwall::testing
