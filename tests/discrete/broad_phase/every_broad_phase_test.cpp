// Every broad phase finds what the half loop finds, in the same order.

#include <sstream>

#include <thinwall/discrete/broad_phase.hpp>

#include "support/property.hpp"
#include "support/shaker.hpp"

namespace thinwall::testing {
namespace {

// ---- Random worlds of boxes, drawn to hit what goes wrong in a broad phase.

/// Lattice coordinates (ties and touching boxes), points, plates, sizes decades apart, one place for all, far outliers,
/// infinite boxes, worlds far from the origin; now and then static, masked and skipped bodies.
std::vector<Proxy> drawn_proxies(Shaker<double>& draw, int most) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const int count = draw.pick(0, most), style = draw.pick(0, 9), roles = draw.pick(0, 2);
  const double extent = std::ldexp(1.0, draw.pick(0, 5)), far_off = draw.pick(0, 3) == 0 ? std::ldexp(1.0, 40) : 0;
  std::vector<Proxy> proxies(static_cast<std::size_t>(count));
  for (Proxy& p : proxies) {
    Vec3<double> corner = draw.vector() * extent;
    Vec3<double> sides = draw.sizes();
    const int chance = draw.pick(0, 15), axis = draw.pick(0, 2);
    if (style == 0) corner.setZero();                                                    // all at one point
    if (style == 1) sides.setZero();                                                     // points
    if (style == 2) sides *= std::ldexp(1.0, draw.pick(-40, 12));                        // sizes decades apart
    if (style == 3 && chance == 0) corner[axis] = std::ldexp(1.0, draw.pick(60, 1020));  // bodies that escaped
    if (style == 4) sides[axis] = chance < 8 ? 0 : 1000;                                 // plates and rods
    if (style == 5) corner[axis] = 0;                                                    // mostly flat
    if (style == 6) {  // on a lattice of touching cubes
      corner = {double(draw.pick(-2, 2)), double(draw.pick(-2, 2)), double(draw.pick(-2, 2))};
      sides.setOnes();
    }
    if (style == 7) sides *= std::ldexp(1.0, -300), corner *= std::ldexp(1.0, -300);  // tiny
    if (style == 8) sides *= std::ldexp(1.0, 1000), corner *= std::ldexp(1.0, 1000);  // huge
    p.low = corner.array() + far_off;
    p.high = p.low + sides;
    if (style == 9 && chance == 0) p.high[axis] = infinity;
    if (style == 9 && chance == 1) p.low[axis] = -infinity;
    if (style == 9 && chance == 2) p.low.setConstant(infinity), p.high.setConstant(infinity);
    if (style == 9 && chance == 3) p.low.setConstant(-infinity), p.high.setConstant(infinity);
    if (roles == 0) continue;
    p.is_static = draw.pick(0, 3) == 0;
    p.skipped = draw.pick(0, 7) == 0;
    if (p.skipped && draw.pick(0, 1) == 0) p.low[axis] = std::numeric_limits<double>::quiet_NaN();
    if (roles == 1) continue;
    p.group = static_cast<std::uint32_t>(draw.pick(0, 3));
    p.mask = static_cast<std::uint32_t>(draw.pick(0, 3));
  }
  return proxies;
}

std::string describe(const std::vector<Proxy>& proxies) {
  std::ostringstream out;
  out.precision(17);
  for (std::size_t i = 0; i < proxies.size(); ++i) {
    const Proxy& p = proxies[i];
    out << i << ": low " << p.low.transpose() << " high " << p.high.transpose() << " group " << p.group << " mask "
        << p.mask << (p.is_static ? " static" : "") << (p.skipped ? " skipped" : "") << "\n";
  }
  return out.str();
}

// ---- Every method.

using Pairs = std::vector<ProxyPair>;

template <class Method> Pairs pairs_of(const std::vector<Proxy>& proxies) {
  Pairs pairs;
  find_pairs(Method{}, proxies, pairs);
  return pairs;
}

Proxy box(const Vec3<double>& low, const Vec3<double>& high) { return {.low = low, .high = high}; }
Proxy cube(double x, double side = 1) { return box({x, 0, 0}, {x + side, side, side}); }

template <class List> struct AsTypes;
template <class... M> struct AsTypes<TypeList<M...>> {
  using type = ::testing::Types<M...>;
};

struct MethodNames {
  template <class M> static std::string GetName(int) { return std::string(M::name); }
};

template <class M> class EveryBroadPhase : public ::testing::Test {};
TYPED_TEST_SUITE(EveryBroadPhase, AsTypes<BroadPhases>::type, MethodNames);

TYPED_TEST(EveryBroadPhase, finds_what_the_half_loop_finds_in_random_worlds) {
  typename TypeParam::Memory memory;  // kept from world to world, as a caller may
  Pairs found;
  check_property(10000, [&] {
    Shaker<double> draw(static_cast<unsigned>(draw_integer(0, 1 << 30)));
    const std::vector<Proxy> proxies = drawn_proxies(draw, draw.pick(0, 9) == 0 ? 200 : 24);
    find_pairs(TypeParam{}, proxies, found, no_pair_limit, memory);
    if (found != pairs_of<AllPairs>(proxies)) RC_FAIL("other pairs than the half loop:\n" + describe(proxies));
  });
}

TYPED_TEST(EveryBroadPhase, finds_the_pairs_of_a_larger_mixed_world) {
  Shaker<double> draw(7);
  std::vector<Proxy> proxies;
  for (int i = 0; i < 3000; ++i) {
    const double size = std::ldexp(1.0, -draw.pick(0, 6));
    const Vec3<double> low = draw.vector() * 3;
    proxies.push_back(box(low, low + draw.sizes() * size));
    proxies.back().is_static = draw.pick(0, 4) == 0;
  }
  const Pairs expected = pairs_of<AllPairs>(proxies);
  EXPECT_GT(expected.size(), 1000U);
  EXPECT_EQ(pairs_of<TypeParam>(proxies), expected);
}

TYPED_TEST(EveryBroadPhase, counts_touching_as_a_pair_and_the_next_number_as_none) {
  EXPECT_EQ(pairs_of<TypeParam>({cube(0), cube(1)}), (Pairs{{0, 1}}));
  EXPECT_EQ(pairs_of<TypeParam>({cube(std::nextafter(1.0, 2.0)), cube(0)}), Pairs{});
  EXPECT_EQ(pairs_of<TypeParam>({cube(0), box({1, 1, 1}, {1, 1, 1})}), (Pairs{{0, 1}}));  // a point at a corner
  EXPECT_EQ(pairs_of<TypeParam>({cube(0, 0), cube(0, 0)}), (Pairs{{0, 1}}));              // two points at one place
  const Vec3<double> zero = Vec3<double>::Zero(), minus_zero = -zero;
  EXPECT_EQ(pairs_of<TypeParam>({box(zero, minus_zero), box(minus_zero, zero)}), (Pairs{{0, 1}}));
  Proxy speck = box(zero, Vec3<double>::Constant(0x1p-1000));
  speck.is_static = true;
  EXPECT_EQ(pairs_of<TypeParam>({speck, box(zero, minus_zero)}), (Pairs{{0, 1}}));
}

TYPED_TEST(EveryBroadPhase,
           knows_a_touch_whatever_a_quotient_is_rounded_to) {  // in units of 0.1 they begin at 7.9.. and at 9
  const double low = std::nextafter(0.8, 0.0), middle = low + 0.1;
  const std::vector<Proxy> proxies = {cube(0, 0.1), cube(0, 0.1), cube(0, 0.1), cube(low, 0.1), cube(middle, 0.1)};
  EXPECT_EQ(pairs_of<TypeParam>(proxies), (Pairs{{0, 1}, {0, 2}, {1, 2}, {3, 4}}));
}

TYPED_TEST(EveryBroadPhase, knows_a_touch_far_from_the_origin) {
  const double far_off = 0x1p52;
  const std::vector<Proxy> proxies = {cube(far_off), cube(far_off + 1), cube(far_off + 3)};
  EXPECT_EQ(pairs_of<TypeParam>(proxies), (Pairs{{0, 1}}));
}

TYPED_TEST(EveryBroadPhase, finds_pairs_among_coordinates_whose_difference_overflows) {
  const Proxy sheet = box({-0x1.6186ba1b161cdp+786, -0x1.83077ed6e86d3p+983, -0x1.6ec1c7b81d0ccp+867},
                          {-0x1.6186ba1b161cdp+786, 0x1.83077ed6e86d3p+983, 0x1.6ec1c7b81d0ccp+867});
  Proxy strip = box({-0x1.b09642ddf46f5p+851, -0x1.17e4208af46dep+555, 0x1.c018b8a5c35cp-400},
                    {0x1.b09642ddf46f5p+851, 0x1.17e4208af46dep+555, 0x1.c018b8a5c35cp-400});
  strip.is_static = true;
  const double most = std::numeric_limits<double>::max();
  const Proxy line = box({0x1.abba7ea37e99bp+776, most, -0x1.4e9dffe149ca5p+983},
                         {0x1.abba7ea37e99bp+776, most, 0x1.4e9dffe149ca5p+983});
  EXPECT_EQ(pairs_of<TypeParam>({sheet, strip, line}), (Pairs{{0, 1}}));
}

TYPED_TEST(EveryBroadPhase, never_pairs_static_bodies_or_skipped_ones) {
  std::vector<Proxy> proxies(4, cube(0));
  proxies[0].is_static = proxies[1].is_static = true;
  proxies[2].skipped = true;
  proxies[2].low[0] = std::numeric_limits<double>::quiet_NaN();  // not read
  EXPECT_EQ(pairs_of<TypeParam>(proxies), (Pairs{{0, 3}, {1, 3}}));
}

TYPED_TEST(EveryBroadPhase, pairs_bodies_only_if_each_mask_has_the_other_group) {
  std::vector<Proxy> proxies(3, cube(0));
  proxies[0].group = 1;
  proxies[0].mask = 6;
  proxies[1].group = 2;
  proxies[1].mask = 4;
  proxies[2].group = 4;
  proxies[2].mask = 3;
  EXPECT_EQ(pairs_of<TypeParam>(proxies), (Pairs{{0, 2}, {1, 2}}));
  proxies[2].group = 0;  // belongs nowhere
  EXPECT_EQ(pairs_of<TypeParam>(proxies), Pairs{});
}

TEST(UniformGrid, is_not_slowed_by_a_heap_of_bodies_that_leave_each_other_out) {  // 5e11 looks if it were
  Proxy debris = cube(0);
  debris.group = 2;
  debris.mask = ~std::uint32_t{2};
  std::vector<Proxy> proxies(1000000, debris);
  proxies.push_back(cube(1));
  const Pairs pairs = pairs_of<UniformGrid>(proxies);
  EXPECT_EQ(pairs.size(), 1000000U);
  EXPECT_EQ(pairs.back(), (ProxyPair{999999, 1000000}));
}

TYPED_TEST(EveryBroadPhase, pairs_a_giant_with_all_and_an_infinite_floor_with_what_reaches_it) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<Proxy> proxies;
  Pairs expected;
  for (std::uint32_t i = 0; i < 50; ++i) {
    proxies.push_back(cube(3.0 * i));
    expected.push_back({i, 50});
    if (i < 2) expected.push_back({i, 51});
  }
  proxies.push_back(cube(-1e9, 2e9));
  proxies.back().low = Vec3<double>::Constant(-1e9);
  proxies.push_back(box(Vec3<double>::Constant(-infinity), {3.5, infinity, infinity}));
  expected.push_back({50, 51});
  EXPECT_EQ(pairs_of<TypeParam>(proxies), expected);
}

TYPED_TEST(EveryBroadPhase, stops_when_pairs_explode_with_bounded_memory) {
  const std::vector<Proxy> proxies(1000, cube(0));  // half a million pairs
  Pairs pairs(3);
  typename TypeParam::Memory memory;
  EXPECT_THROW(find_pairs(TypeParam{}, proxies, pairs, 5000, memory), TooManyPairs);
  EXPECT_TRUE(pairs.empty());
  EXPECT_LE(pairs.capacity(), 3 * 5000U);
  find_pairs(TypeParam{}, proxies, pairs, 499500, memory);  // as many as there are: allowed
  EXPECT_EQ(pairs.size(), 499500U);
  EXPECT_THROW(find_pairs(TypeParam{}, proxies, pairs, 499499, memory), TooManyPairs);
  try {
    find_pairs(TypeParam{}, proxies, pairs, 7, memory);
    FAIL() << "no complaint";
  } catch (const TooManyPairs& complaint) {
    EXPECT_EQ(complaint.max_pairs, 7U);
    EXPECT_EQ(std::string(complaint.what()),
              "more than 7 pairs of bodies may touch: allow more pairs, or part bodies that lie on one another");
  }
}

TYPED_TEST(EveryBroadPhase, refuses_a_box_that_is_no_box_by_its_index) {
  std::vector<Proxy> proxies(3, cube(0));
  proxies[1].high[2] = std::numeric_limits<double>::quiet_NaN();
  const auto complaint = [&] {
    try {
      pairs_of<TypeParam>(proxies);
    } catch (const InvalidProxy& invalid) {
      return std::to_string(invalid.index) + " | " + invalid.what();
    }
    return std::string("none");
  };
  EXPECT_EQ(complaint(), "1 | proxy 1: its box is not a number");
  proxies[1] = cube(0);
  proxies[2].low[0] = 2;
  EXPECT_EQ(complaint(), "2 | proxy 2: its box has low > high");
}

}  // namespace
}  // namespace thinwall::testing
