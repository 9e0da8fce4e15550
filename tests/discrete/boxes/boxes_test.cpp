// The points that separation() and contact() name on two boxes lie on both, also where a whole face is nearest; and what a parallelogram
// and a rectangle share.

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <thinwall/discrete/boxes/face_polygon.hpp>

#include "support/manifold_properties.hpp"

namespace thinwall::testing {
namespace {

template <class A, class B> void expect_points_on_surfaces(int runs) {
  using S = typename A::Scalar;
  Shaker<S> draw(20261121);
  for (int run = 0; run < runs && !::testing::Test::HasFailure(); ++run) {
    const auto [a, b] = nearly_touching<A, B>(draw);
    SCOPED_TRACE("run " + std::to_string(run));
    const Separation<S> gap = separation(a, b);
    const Wide allowed = 64 * Wide(unit<S>()) * Wide(S(magnitude(a) + magnitude(b)));
    EXPECT_LE(off_surface(a, Vec3<S>(gap.point_a - center(a))), allowed);
    EXPECT_LE(off_surface(b, Vec3<S>(gap.point_b - center(b))), allowed);
    const Vec3<S> off = (gap.point_b - gap.point_a) - gap.normal * gap.distance;
    EXPECT_LE(Wide(largest(off)), allowed);
  }
}

TEST(BoxGap, points_lie_on_both_boxes) {
  expect_points_on_surfaces<Obb<double>, Obb<double>>(slow_build ? 2000 : 25000);
  expect_points_on_surfaces<Obb<float>, Obb<float>>(slow_build ? 2000 : 25000);
  expect_points_on_surfaces<Obb<double>, Aabb<double>>(2000);
  expect_points_on_surfaces<Obb<Wide>, Obb<Wide>>(500);
}

TEST(BoxGap, axes_orthonormal_to_float_serve_in_double) {  // as the time of impact asks of shapes in float
  Shaker<float> draw(20261121);
  for (int run = 0; run < 2000; ++run) {
    const auto [a, b] = nearly_touching<Obb<float>, Obb<float>>(draw);
    const Obb<double> wide_a = cast<double>(a), wide_b = cast<double>(b);
    const Separation<double> gap = separation_unchecked(wide_a, wide_b);
    const Wide allowed = 64 * Wide(unit<float>()) * Wide(magnitude(a) + magnitude(b));
    ASSERT_LE(off_surface(wide_a, Vec3<double>(gap.point_a - center(wide_a))), allowed) << run;
    ASSERT_LE(off_surface(wide_b, Vec3<double>(gap.point_b - center(wide_b))), allowed) << run;
  }
}

TEST(BoxGap, overhanging_boxes_meet_in_the_middle_of_what_they_share) {
  const Obb<double> floor{{0, 0, 0}, {4, 4, 1}, Mat3<double>::Identity()};
  const Obb<double> plank{{5, 0, 2}, {8, 1, 1}, Mat3<double>::Identity()};
  const auto found = contact(floor, plank);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->local_a, (Vec3<double>(0.5, 0, 1)));  // x from -3 to 4
  EXPECT_EQ(found->local_b, (Vec3<double>(-4.5, 0, -1)));
  Obb<double> tilted = plank;  // by less than rounding can tell: the deepest corner would be beyond the floor
  tilted.axes(2, 0) = -1e-17;
  tilted.axes(0, 2) = 1e-17;
  tilted.center[2] -= 0x1p-51;  // or it hovers above the floor, as its edge beyond it is the lowest
  EXPECT_EQ(contact(floor, tilted)->local_a, found->local_a);
}

// The far face is as near as rounding tells, and the line to it parts the boxes as well.
TEST(BoxGap, of_faces_as_near_as_each_other_to_rounding_the_nearer_is_told) {
  Mat3<float> turned = Mat3<float>::Identity();
  turned(0, 0) = turned(2, 2) = -1;
  const Obb<float> a{{-7.7F, -0.2F, -8}, {4, 0, 256}, Mat3<float>::Identity()};
  const Obb<float> b{{-0.2F, -0x1p26F, -9.2F}, {0, 16, 40}, turned};
  EXPECT_NEAR(separation(a, b).distance, 0x1p26F - 16, 8);
}

TEST(BoxGap, boxes_all_but_parallel_touch_in_places_that_belong_together) {
  Shaker<double> draw(3);
  for (int i = 0; i < 20'000; ++i) {
    const auto size = [&] { return 0.1 + 0.9 * std::abs(draw.plain()); };
    Obb<double> a{{0, 0, 0}, {size(), size(), size()}, draw.axes()}, b = a;
    b.half_extents = {size(), size(), size()};
    const Vec3<double> about = safe_unit(draw.vector()) * std::ldexp(1.0, -draw.pick(30, 48));
    for (int k = 0; k < 3; ++k) b.axes.col(k) += thinwall::cross<double>(about, a.axes.col(k));
    b.center = safe_unit(draw.vector()) * 2 * size();
    const Separation<double> gap = separation(a, b);
    b = moved<double>(b, Vec3<double>(gap.normal * -(gap.distance + std::ldexp(1.0, -draw.pick(4, 40)))));
    const auto found = contact(a, b);
    if (!found) continue;
    const Vec3<double> way = (b.center + found->local_b) - (a.center + found->local_a);
    EXPECT_LE((way + found->normal * found->penetration).norm(), 1e-9) << i;
  }
}

TEST(BoxGap, least_overlap_is_on_an_axis_whatever_the_numbers) {
  for (const double bad : {nan<double>(), infinity<double>()}) {
    const BoxPair<double> pair{{1, 1, 1}, {bad, 1, 1}, {bad, 0, 0}, Mat3<double>::Identity()};
    const LeastOverlap<double> least = least_overlap(pair);
    EXPECT_TRUE(least.axis_a >= 0 || least.axis_b >= 0);
    EXPECT_NE(least.normal, (Vec3<double>::Zero()));
  }
}

TEST(BoxGap, level_faces_meet_in_the_middle_of_what_they_share_at_every_size) {
  for (const double t : {0.0, 1e-17}) {
    Mat3<double> axes;
    axes << 0.8, -0.6, 0, 0.6, 0.8, t, -0.6 * t, -0.8 * t, 1;
    const Obb<double> a{{0, 0, 0}, {1, 1, 1}, Mat3<double>::Identity()}, b{{0.25, 0.125, 2.875}, {4, 4, 2}, axes};
    for (const int e : {0, 300, 360, 500, 600, 900, -300, -514, -520, -600, -900}) {
      SCOPED_TRACE(e);
      const Separation<double> gap = separation(scaled(a, e), scaled(b, e));
      EXPECT_EQ(gap.point_a, times_power_of_two(Vec3<double>(0, 0, 1), e));
      EXPECT_EQ(gap.point_b, times_power_of_two(Vec3<double>(0, 0, 0.875), e));
      EXPECT_EQ(contact(scaled(a, e), scaled(b, e))->local_a, gap.point_a);
    }
  }
}

/// Boxes whose edges face each other, all but parallel or not: of places there, far off, distances tell nothing.
template <class S> void expect_places_far_apart(const S& far) {
  Shaker<S> draw(20261201);
  for (int run = 0; run < 1'000; ++run) {
    using std::cos, std::sin;
    const auto size = [&]() -> Vec3<S> { return draw.plain_vector().cwiseAbs() + Vec3<S>::Constant(S(0.25)); };
    const auto turn = [&](int axis, const S& angle) {
      return turn_in_plane<S>((axis + 1) % 3, (axis + 2) % 3, cos(angle), sin(angle));
    };
    const int axis = draw.pick(0, 2);
    const S angle = 3 * draw.plain(), tilt = draw.pick(0, 1) == 0 ? S(0) : draw.plain(), along = draw.plain();
    Vec3<S> way = draw.plain_vector();
    way[axis] = 0;
    const Aabb<S> a{{0, 0, 0}, size()};
    const Obb<S> b{Vec3<S>(safe_unit(way) * far + axis_vector<S>(axis) * along), size(),
                   turn((axis + 1) % 3, tilt) * turn(axis, angle)};
    const Separation<S> gap = separation(a, b);
    const auto wide = separation(cast<Wide>(a), widened<Wide>(b));
    const Vec3<S> truth = Vec3<Wide>(wide.point_b - wide.point_a).template cast<S>();
    ASSERT_LE(largest(Vec3<S>((gap.point_b - gap.point_a) - truth)), 32 * unit<S>() * far) << run;
    ASSERT_LE(largest(Vec3<S>(gap.normal * gap.distance - truth)), 32 * unit<S>() * far) << run;
  }
}

TEST(BoxGap, between_boxes_far_apart_leads_from_place_to_place) {
  for (const float far : {1e3F, 1e5F}) expect_places_far_apart(far);
  for (const double far : {1e6, 1e8, 1e11}) expect_places_far_apart(far);
}

TEST(BoxGap, boxes_that_hardly_touch_do_so_in_one_place) {  // which end of an edge is deepest is rounding
  Mat3<double> axes;
  axes << 0x1p-63, -0.8, 0.6, 0, 0.6, 0.8, 1, 0, 0x1p-63;
  const Obb<double> a{{-0.5, 2, -0.5}, {0x1.3fa346d2c3ef6p-2, 0x1.d2ae56820563ep-2, 0x1.e6443e39bcaf6p-2}, axes};
  const Obb<double> b{{0x1.98f016e167522p-1, 0x1.c9472c2176566p+0, -0x1.c14f59242722dp-1},
                      {0x1.4c62ae68dfc0ap-1, 0x1.47e4808d87293p-2, 0x1.0bedadd62951dp-4},
                      Mat3<double>::Identity()};
  const Separation<double> gap = separation(a, b);
  EXPECT_LE(largest(Vec3<double>(gap.point_b - gap.point_a)), 1e-14);
}

TEST(BoxGap, turns_too_small_to_square_are_none) {
  for (int e = -400; e > -1000; --e) {
    Obb<double> turned{{1.5, 0.2, 1.4}, {1, 1, 1}, Mat3<double>::Identity()};
    turned.axes(1, 0) = times_power_of_two(1.43, e);
    turned.axes(0, 1) = -turned.axes(1, 0);
    const auto found = contact(Obb<double>{{0, 0, 0}, {1, 1, 1}, Mat3<double>::Identity()}, turned);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->penetration, 0.5) << e;
    EXPECT_EQ(found->normal, (Vec3<double>(1, 0, 0))) << e;
  }
}

// ---- What a parallelogram and a rectangle share, against half planes at 100 digits.

using oracle::Real;

/// The points of a plane where u x + v y <= most.
struct HalfPlane {
  Real u, v, most;

  Real beyond(const Real& x, const Real& y) const { return u * x + v * y - most; }
};

/// Both sides of the strip of points that lie no farther than `half` along (u, v) from the point.
void add_strip(std::vector<HalfPlane>& all, const Real& u, const Real& v, const Real& x, const Real& y,
               const Real& half) {
  const Real middle = u * x + v * y;
  all.push_back({u, v, half + middle});
  all.push_back({-u, -v, half - middle});
}

/// A face of a box over a face of another, drawn: edges aligned with its sides or all but, corners on them, some edges of no length.
template <class S> struct Faces {
  Vec3<S> middle, e1, e2;
  S half_x, half_y;

  explicit Faces(Shaker<S>& draw) : middle(draw.vector()), half_x(draw.sizes()[0]), half_y(draw.sizes()[0]) {
    const Mat3<S> axes = draw.axes();
    const Vec3<S> sizes = draw.sizes();
    int across = 0;
    for (int j = 1; j < 3; ++j) across = largest(axes(2, j)) > largest(axes(2, across)) ? j : across;
    e1 = axes.col((across + 1) % 3) * sizes[0];
    e2 = axes.col((across + 2) % 3) * sizes[1];
  }
  std::vector<HalfPlane> half_planes() const {
    const Real x1(e1[0]), y1(e1[1]), x2(e2[0]), y2(e2[1]), area = abs(Real(x1 * y2 - x2 * y1));
    std::vector<HalfPlane> all;
    add_strip(all, 1, 0, 0, 0, Real(half_x));
    add_strip(all, 0, 1, 0, 0, Real(half_y));
    const Real x(middle[0]), y(middle[1]);
    add_strip(all, y1, -x1, x, y, area);
    add_strip(all, y2, -x2, x, y, area);
    add_strip(all, 1, 0, x, y, abs(x1) + abs(x2));  // where it is a line or a point, its ends
    add_strip(all, 0, 1, x, y, abs(y1) + abs(y2));
    return all;
  }
};

/// Every point where two of their edges cross and that all of them hold.
std::vector<std::pair<Real, Real>> corners_of(const std::vector<HalfPlane>& all) {
  std::vector<std::pair<Real, Real>> corners;
  for (const HalfPlane& a : all) {
    for (const HalfPlane& b : all) {
      const Real cross = a.u * b.v - a.v * b.u;
      if (cross == 0) continue;
      const Real x = (a.most * b.v - b.most * a.v) / cross, y = (a.u * b.most - b.u * a.most) / cross;
      if (std::ranges::all_of(all, [&](const HalfPlane& c) { return c.beyond(x, y) <= Real("1e-80"); }))
        corners.emplace_back(x, y);
    }
  }
  return corners;
}

template <class S> void expect_what_both_hold(int runs) {
  Shaker<S> draw(20261127);
  int shared = 0, flat = 0;
  for (int run = 0; run < runs && !::testing::Test::HasFailure(); ++run) {
    const Faces<S> faces(draw);
    SCOPED_TRACE("run " + std::to_string(run));
    const Vec3<S>&m = faces.middle, &e1 = faces.e1, &e2 = faces.e2;
    const S rounding = gap_noise(largest(m, e1, e2));
    const FacePolygon<S> found = parallelogram_over_face<S>(m, e1, e2, faces.half_x, faces.half_y, rounding);
    const Real noise = 2 * Real(rounding), x1(e1[0]), y1(e1[1]), x2(e2[0]), y2(e2[1]);
    const std::vector<HalfPlane> all = faces.half_planes();
    const Real area = x1 * y2 - x2 * y1;
    for (int i = 0; i < found.count; ++i) {
      const Real x(found[i][0]), y(found[i][1]), dx = x - Real(m[0]), dy = y - Real(m[1]);
      for (const HalfPlane& one : all) EXPECT_LE(one.beyond(x, y), noise * (abs(one.u) + abs(one.v))) << i;
      if (area == 0) continue;
      const Real depth = Real(m[2]) + ((dx * y2 - dy * x2) * Real(e1[2]) + (dy * x1 - dx * y1) * Real(e2[2])) / area;
      EXPECT_LE(abs(Real(found[i][2]) - depth), 8 * noise) << i;
    }
    const std::vector<std::pair<Real, Real>> corners = corners_of(all);
    shared += static_cast<int>(!corners.empty());
    flat += static_cast<int>(area == 0);
    for (int k = 0; k < 16; ++k) {  // no corner is farther out than those found, whatever the direction
      const Real u = cos(Real(k)), v = sin(Real(k));
      const auto out = [&](const auto& x, const auto& y) { return Real(u * Real(x) + v * Real(y)); };
      for (const auto& [x, y] : corners) {
        const Real here = out(x, y) - 8 * noise;
        bool reached = false;
        for (int i = 0; i < found.count; ++i) reached = reached || out(found[i][0], found[i][1]) >= here;
        EXPECT_TRUE(reached) << k << ": " << x << " " << y;
      }
    }
  }
  EXPECT_GT(shared, runs / 4);
  EXPECT_GT(flat, 0);
}

TEST(FacePolygon, holds_what_both_hold_and_all_of_it) {
  expect_what_both_hold<double>(2000);
  expect_what_both_hold<float>(1000);
  expect_what_both_hold<long double>(500);
}

}  // namespace
}  // namespace thinwall::testing
