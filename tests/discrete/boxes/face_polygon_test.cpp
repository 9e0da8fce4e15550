// What a parallelogram and a rectangle share, against half planes at 100 digits.

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <thinwall/discrete/boxes/face_polygon.hpp>

#include "support/shaker.hpp"

namespace thinwall::testing {
namespace {

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
    const FacePolygon<S> found = parallelogram_over_face<S>(m, e1, e2, faces.half_x, faces.half_y);
    const Real noise = 2 * Real(gap_noise(largest(m, e1, e2))), x1(e1[0]), y1(e1[1]), x2(e2[0]), y2(e2[1]);
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
