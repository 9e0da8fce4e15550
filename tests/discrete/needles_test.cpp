// Triangles almost without an area, whose plane roundings may turn by any angle: their distance from a point is that of the exact corners.

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include <gtest/gtest.h>

#include <thinwall/discrete/triangle.hpp>

#include "support/real.hpp"
#include "support/shaker.hpp"

namespace thinwall::testing {
namespace {

using oracle::Real;
using oracle::Vector;

Real from_edge(const Vector& x, const Vector& start, const Vector& end) {
  const Vector along = end - start;
  const Real square = dot(along, along), wanted = square > 0 ? Real(dot(x - start, along) / square) : Real(0);
  return length(x - (start + std::clamp<Real>(wanted, 0, 1) * along));
}

/// From every edge, and from the plane where the foot lies between the edges. 100 digits hold every product of the corners.
Real distance_of(const Vector& x, const Vector& a, const Vector& b, const Vector& c) {
  const Real from_edges = std::min({from_edge(x, a, b), from_edge(x, b, c), from_edge(x, c, a)});
  const Vector normal = cross(b - a, c - a);
  const auto within = [&](const Vector& start, const Vector& end) {
    return dot(cross(normal, end - start), x - start) >= 0;
  };
  if (dot(normal, normal) == 0 || !within(a, b) || !within(b, c) || !within(c, a)) return from_edges;
  return std::min(from_edges, Real(abs(dot(normal, x - a)) / length(normal)));
}

template <class S> class Needles : public ::testing::Test {};
TYPED_TEST_SUITE(Needles, Scalars, ScalarNames);

template <class S> S at_most(Shaker<S>& draw, int bits) { return power<S>(-draw.pick(0, bits - 1)); }

/// What lies next to a place on the line from a to b.
template <class S> Vec3<S> beside(Shaker<S>& draw, const Vec3<S>& a, const Vec3<S>& b, const S& place, int bits) {
  const Vec3<S> aside = draw.plain_vector();
  return a + (b - a) * place + aside * at_most(draw, bits);
}

template <class S> void expect_as_far(const Vec3<S>& x, const Vec3<S>& a, const Vec3<S>& b, const Vec3<S>& c, int i) {
  const S distance = separation(Triangle<S>{a, b, c}, Sphere<S>{x, S(0)}).distance;
  const auto [X, A, B, C] =
      std::tuple{oracle::lift_vector(x), oracle::lift_vector(a), oracle::lift_vector(b), oracle::lift_vector(c)};
  const Real size = length(B - A) + length(C - A) + length(X - A);
  ASSERT_LE(abs(oracle::lift(distance) - distance_of(X, A, B, C)), 4 * oracle::unit_roundoff<S>() * size) << i;
}

TYPED_TEST(Needles, are_as_far_as_their_corners_say) {
  using S = TypeParam;
  Shaker<S> draw(1);
  constexpr int bits = std::numeric_limits<S>::digits + 10;
  for (int i = 0; i < 20'000; ++i) {
    const Vec3<S> a = draw.plain_vector() * S(i % 3 == 0 ? 0 : 1), b = draw.plain_vector();
    const Vec3<S> c = beside<S>(draw, a, b, S(0.7) + S(0.3) * draw.plain(), bits);
    expect_as_far<S>(beside<S>(draw, a, b, draw.plain(), bits), a, b, c, i);
  }
}

TYPED_TEST(Needles, are_as_far_from_what_lies_past_their_tips) {  // where all three sides are one line to rounding
  using S = TypeParam;
  Shaker<S> draw(2);
  constexpr int bits = std::numeric_limits<S>::digits;
  for (int i = 0; i < 20'000; ++i) {
    const Vec3<S> a = draw.plain_vector(), b = draw.plain_vector(),
                  c = beside<S>(draw, a, b, S(0.5) + S(0.4) * draw.plain(), bits);
    expect_as_far<S>(beside<S>(draw, a, b, S(1) + at_most(draw, bits / 2), bits), a, b, c, i);
  }
}

TYPED_TEST(Needles, whose_area_all_but_vanishes_have_no_plane) {
  using S = TypeParam;
  const Triangle<S> line{{-3, -3, 0}, {3, -2, -std::numeric_limits<S>::denorm_min()}, {0, S(-2.5), 0}};
  EXPECT_NEAR(double(separation(line, Sphere<S>{{-1, 2, 0}, 0}).distance), 4.6031716445500041, 8 * double(unit<S>()));
}

}  // namespace
}  // namespace thinwall::testing
