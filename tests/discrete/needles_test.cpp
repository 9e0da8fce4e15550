// Triangles almost without an area, whose plane roundings may turn by any angle: their distance from a point is that of the exact corners.

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <tuple>

#include <gtest/gtest.h>

#include <thinwall/discrete/triangle.hpp>

#include "support/real.hpp"

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

/// Draws what thin triangles and points beside them are made of.
template <class S> class NeedleDraw {
 public:
  explicit NeedleDraw(unsigned seed) : engine_(seed) {}
  S part() { return S(draw_(engine_)); }
  Vec3<S> vector() { return {part(), part(), part()}; }
  S at_most(int bits) { return power<S>(-static_cast<int>(engine_() % static_cast<unsigned>(bits))); }
  /// A third corner beside the line from a to b, and next to it.
  Vec3<S> beside(const Vec3<S>& a, const Vec3<S>& b, const S& place, int bits) {
    const Vec3<S> aside = vector();
    return a + (b - a) * place + aside * at_most(bits);
  }

 private:
  std::mt19937_64 engine_;
  std::uniform_real_distribution<double> draw_{-1, 1};
};

template <class S> void expect_as_far(const Vec3<S>& x, const Vec3<S>& a, const Vec3<S>& b, const Vec3<S>& c, int i) {
  const S distance = separation(Triangle<S>{a, b, c}, Sphere<S>{x, S(0)}).distance;
  const auto [X, A, B, C] =
      std::tuple{oracle::lift_vector(x), oracle::lift_vector(a), oracle::lift_vector(b), oracle::lift_vector(c)};
  const Real size = length(B - A) + length(C - A) + length(X - A);
  ASSERT_LE(abs(oracle::lift(distance) - distance_of(X, A, B, C)), 4 * oracle::unit_roundoff<S>() * size) << i;
}

TYPED_TEST(Needles, are_as_far_as_their_corners_say) {
  using S = TypeParam;
  NeedleDraw<S> draw(1);
  constexpr int bits = std::numeric_limits<S>::digits + 10;
  for (int i = 0; i < 20'000; ++i) {
    const Vec3<S> a = draw.vector() * S(i % 3 == 0 ? 0 : 1), b = draw.vector();
    const Vec3<S> c = draw.beside(a, b, S(0.7) + S(0.3) * draw.part(), bits);
    expect_as_far<S>(draw.beside(a, b, draw.part(), bits), a, b, c, i);
  }
}

TYPED_TEST(Needles, are_as_far_from_what_lies_past_their_tips) {  // where all three sides are one line to rounding
  using S = TypeParam;
  NeedleDraw<S> draw(2);
  constexpr int bits = std::numeric_limits<S>::digits;
  for (int i = 0; i < 20'000; ++i) {
    const Vec3<S> a = draw.vector(), b = draw.vector(), c = draw.beside(a, b, S(0.5) + S(0.4) * draw.part(), bits);
    expect_as_far<S>(draw.beside(a, b, S(1) + draw.at_most(bits / 2), bits), a, b, c, i);
  }
}

TYPED_TEST(Needles, whose_area_all_but_vanishes_have_no_plane) {
  using S = TypeParam;
  const Triangle<S> line{{-3, -3, 0}, {3, -2, -std::numeric_limits<S>::denorm_min()}, {0, S(-2.5), 0}};
  EXPECT_NEAR(double(separation(line, Sphere<S>{{-1, 2, 0}, 0}).distance), 4.6031716445500041, 8 * double(unit<S>()));
}

}  // namespace
}  // namespace thinwall::testing
