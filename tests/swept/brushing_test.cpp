/// The closed form where little decides, against the oracle at 50 digits: verdicts and times to a backward error of 4 u. Two shapes move past
/// each other: faces, edges and cores parallel but for 2^-50 to 2^-1, parts that touch to rounding where they pass, sizes decades apart, and
/// speeds across that are as small.

#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include <thinwall/discrete/type_list.hpp>
#include <thinwall/swept/reach_along.hpp>
#include <thinwall/swept/time_of_impact.hpp>

#include "fuzz/judge.hpp"
#include "support/portable_draw.hpp"
#include "support/shaker.hpp"
#include "support/thorough.hpp"

namespace thinwall::testing {
namespace {

/// The same motions by every compiler: nothing is drawn in an order that the language leaves open.
class BrushingDraw : PortableDraw {
  using V = Vec3<double>;

 public:
  /// Sizes are 2^smallest or more, and at most 2.
  BrushingDraw(std::uint64_t seed, int smallest) : PortableDraw(seed), smallest_(smallest) {}

  template <class A, class B> Motion<A, B> motion() {
    Mat3<double> frame = one_in(3) ? turned(-1, 1) : nearly_upright();
    if constexpr (std::is_same_v<A, Aabb<double>> || std::is_same_v<B, Aabb<double>>) frame = nearly_upright();
    const A a = shape(TypeTag<A>{}, frame);
    const Mat3<double> other = one_in(4) ? frame : frame * nearly_upright();
    const B b = shape(TypeTag<B>{}, other);
    const int face = below(3);
    V offset, velocity;
    for (int k = 0; k < 3; ++k) offset[k] = passing(a, b, V(frame.col(k)), k == face);
    for (int k = 0; k < 3; ++k) velocity[k] = one_in(4) ? 0 : one_in(3) ? power(-45, 0) : between(-1, 1);
    if (velocity[face] * offset[face] > 0) velocity[face] = -velocity[face];
    if (velocity == V::Zero()) velocity[face] = offset[face] > 0 ? -1 : 1;
    const double when = one_in(3) ? 0.5 : between(0, 1);
    V path = frame * velocity * std::ldexp(1.0, below(8)), place = frame * offset - path * when;
    V start = V::Zero(), own = V::Zero();
    if (one_in(3)) start = vector();
    if (one_in(3)) own = vector();
    return {{moved<double>(a, start - center(a)), own}, {moved<double>(b, start + place - center(b)), own + path}};
  }

 private:
  /// A power of two, or that and its half, of either sign.
  double power(int low, int high) {
    const double size = std::ldexp(one_in(2) ? 1.0 : between(1, 2), low + below(high - low + 1));
    return one_in(2) ? size : -size;
  }
  double size() { return std::abs(power(smallest_, 0)); }
  V vector() {
    const double x = power(-3, 3), y = power(-3, 3);
    return {x, y, power(-3, 3)};
  }

  /// Turned about one axis or another by 2^low to 2^(high + 1).
  Mat3<double> turned(int low, int high) {
    Mat3<double> all = Mat3<double>::Identity();
    for (int turns = below(3); turns >= 0; --turns) {
      const int u = below(3);
      const double angle = power(low, high);
      all = all * turn_in_plane(u, (u + 1) % 3, std::cos(angle), std::sin(angle));
    }
    return all;
  }
  Mat3<double> nearly_upright() { return one_in(4) ? Mat3<double>(Mat3<double>::Identity()) : turned(-50, -2); }

  // Around the origin.
  double radius() { return one_in(4) ? 0 : size(); }
  V sizes() {
    V all;
    for (int k = 0; k < 3; ++k) all[k] = one_in(12) ? 0 : size();
    return all;
  }
  Sphere<double> shape(TypeTag<Sphere<double>>, const Mat3<double>&) { return {V::Zero(), radius()}; }
  Aabb<double> shape(TypeTag<Aabb<double>>, const Mat3<double>&) { return {V::Zero(), sizes()}; }
  Obb<double> shape(TypeTag<Obb<double>>, const Mat3<double>& frame) { return {V::Zero(), sizes(), frame}; }
  Triangle<double> shape(TypeTag<Triangle<double>>, const Mat3<double>& frame) {
    const double x = size(), y = size(), tip = one_in(2) ? -1 : between(-1, 1);
    const V e1 = frame.col(0) * x, e2 = frame.col(1) * y;
    return {-e1 - e2, e1 - e2, e1 * tip + e2};
  }
  Capsule<double> shape(TypeTag<Capsule<double>>, const Mat3<double>& frame) {
    const int axis = below(3);
    const double length = size();
    const V half = (one_in(4) ? V(turned(-1, 1).col(axis)) : V(frame.col(axis))) * length;
    return {-half, half, radius()};
  }

  /// Where B's center passes A's along n: where they touch, or their cores, all but that, or somewhere beside.
  template <class A, class B> double passing(const A& a, const B& b, const V& n, bool touching) {
    const double skins = skin_radius(a) + skin_radius(b);
    const double cores = reach_along<double>(a, n) + reach_along<double>(b, -n) - skins;
    const double way = one_in(2) ? cores : cores + skins, side = one_in(2) ? 1 : -1;
    const int how = touching ? 0 : below(4);
    if (touching && skins > 0) return side * (cores + skins);
    if (how == 1) return side * way * (1 + power(-52, -4));
    if (how == 2) return between(-way, way);
    return how == 3 ? 0 : side * way;
  }

  int smallest_;
};

using Pairs = ::testing::Types<PairOf<Sphere<double>, Sphere<double>>, PairOf<Aabb<double>, Sphere<double>>,
                               PairOf<Aabb<double>, Aabb<double>>, PairOf<Obb<double>, Sphere<double>>,
                               PairOf<Obb<double>, Aabb<double>>, PairOf<Obb<double>, Obb<double>>,
                               PairOf<Triangle<double>, Sphere<double>>, PairOf<Capsule<double>, Sphere<double>>,
                               PairOf<Capsule<double>, Aabb<double>>, PairOf<Capsule<double>, Obb<double>>,
                               PairOf<Capsule<double>, Capsule<double>>, PairOf<Capsule<double>, Triangle<double>>>;

template <class P> class Brushing : public ::testing::Test {};
TYPED_TEST_SUITE(Brushing, Pairs);

TYPED_TEST(Brushing, meets_the_contract_where_little_decides) {
  const std::size_t motions = slow_build ? 20 : thorough(500);
  std::size_t faults = 0;
  for (const int smallest : {-3, -30}) {
    for (std::size_t seed = 0; seed < motions; ++seed) {
      const auto [a, b] = BrushingDraw(seed, smallest).template motion<typename TypeParam::A, typename TypeParam::B>();
      const Toi<double> toi = time_of_impact(a, b);
      const auto fault = fuzz::judge_impact(fuzz::exhibit(a, b), toi.status, toi.time, 4);
      if (!fault) continue;
      if (++faults > 10) continue;
      ADD_FAILURE() << fault->property << ": " << fault->details << ", seed " << seed << ", sizes from 2^" << smallest;
    }
  }
  EXPECT_EQ(faults, 0U) << "of " << 2 * motions;
}

}  // namespace
}  // namespace thinwall::testing
