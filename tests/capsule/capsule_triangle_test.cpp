// Which way a capsule leaves a triangle that its core only touches.

#include <gtest/gtest.h>
#include <thinwall/capsule/capsule.hpp>

#include "support/scalars.hpp"

namespace thinwall::testing {
namespace {

template <class S> class CapsuleOnTriangle : public ::testing::Test {
 protected:
  const Triangle<S> floor{{-4, -4, 0}, {4, -4, 0}, {0, 4, 0}};

  static void expect_normal(const Capsule<S>& capsule, const Triangle<S>& triangle, const Vec3<S>& normal) {
    const Separation<S> there = separation(capsule, triangle), back = separation(triangle, capsule);
    EXPECT_EQ(there.distance, -capsule.radius);
    EXPECT_EQ(there.normal, normal);
    EXPECT_EQ(back.normal, -normal);
    const Triangle<S> parted = moved(triangle, Vec3<S>(normal * capsule.radius));
    EXPECT_EQ(separation(capsule, parted).distance, S(0));
  }
};
TYPED_TEST_SUITE(CapsuleOnTriangle, Scalars, ScalarNames);

TYPED_TEST(CapsuleOnTriangle, an_end_on_the_face_leaves_to_its_own_side) {
  this->expect_normal({{0, 0, 0}, {0, 0, 2}, 0.5}, this->floor, {0, 0, -1});
  this->expect_normal({{0, 0, -2}, {0, 0, 0}, 0.5}, this->floor, {0, 0, 1});
  this->expect_normal({{0, 0, 0}, {1, 1, 2}, 0.5}, this->floor, {0, 0, -1});
}

TYPED_TEST(CapsuleOnTriangle, a_core_along_the_face_leaves_upwards) {
  this->expect_normal({{-1, -1, 0}, {1, -1, 0}, 0.5}, this->floor, {0, 0, 1});
}

TYPED_TEST(CapsuleOnTriangle, a_core_across_an_edge_leaves_across_both) {
  this->expect_normal({{0, -4, -1}, {0, -4, 1}, 0.5}, this->floor, {0, 1, 0});
  this->expect_normal({{-1, -4, -1}, {1, -4, 1}, 0.5}, this->floor, {0, 1, 0});
}

TYPED_TEST(CapsuleOnTriangle, a_triangle_without_area_is_its_edges) {
  using S = TypeParam;
  const Triangle<S> wire{{-4, 0, 0}, {4, 0, 0}, {0, 0, 0}};
  this->expect_normal({{0, -1, 0}, {0, 1, 0}, 0.5}, wire, {0, 0, 1});
}

}  // namespace
}  // namespace thinwall::testing
