// What a segment and a box tell of their nearest points, place after place.

#include <cmath>

#include <gtest/gtest.h>

#include <thinwall/capsule/clear_segment_box.hpp>

#include "support/portable_draw.hpp"

namespace thinwall::testing {
namespace {

using packed::value;

TEST(ClearSegmentBox, a_part_that_is_still_nearest_is_as_near_as_what_is_found_afresh) {
  PortableDraw draw(7);
  int asked = 0, still = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Vec3<double> half = draw.vector(0.1, 2);
    const ClearSegmentBox core(packed::lanes(draw.vector(-2, 2)), packed::lanes(half),
                               packed::lanes(draw.vector(-1, 1)));
    const Vec3<double> from = draw.vector(-5, 5);
    const double most = draw.one_in(2) ? 0.5 : 3;
    const Vec3<double> to = from + draw.vector(-most, most);
    ClearSegmentBox::Part part = core.part(packed::lanes(from));
    const packed::Lanes gap = core.part(packed::lanes(to)).nearest.gap;
    const double distance = std::sqrt(value(dot(gap, gap)));
    if (distance < 1e-3) continue;
    ++asked;
    if (!core.is_still(packed::lanes(to), part)) continue;
    ++still;
    EXPECT_NEAR(std::sqrt(value(dot(part.nearest.gap, part.nearest.gap))), distance, 1e-14) << "draw " << i;
  }
  EXPECT_GT(still, asked / 3);
  EXPECT_LT(still, asked);
}

TEST(ClearSegmentBox, of_a_stretch_that_is_all_as_near_the_middle_is_asked_for_afresh) {
  const ClearSegmentBox core(packed::lanes(Vec3<double>(1, 0, 0)), packed::all(1),
                             packed::lanes(Vec3<double>(0, -1, 0)));
  ClearSegmentBox::Part part = core.part(packed::lanes(Vec3<double>(-3, 2, 0)));  // its end is nearest
  EXPECT_EQ(value(part.nearest.place), 1);
  EXPECT_TRUE(core.is_still(packed::lanes(Vec3<double>(-2.5, 2, 0)), part));
  EXPECT_FALSE(core.is_still(packed::lanes(Vec3<double>(-1.5, 2, 0)), part));  // half of it is above the face
  EXPECT_EQ(value(core.part(packed::lanes(Vec3<double>(-1.5, 2, 0))).nearest.place), 0.75);
}

}  // namespace
}  // namespace thinwall::testing
