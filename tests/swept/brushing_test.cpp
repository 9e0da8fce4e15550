/// The closed form where little decides, against the oracle at 50 digits: verdicts and times to a backward error of 4 u. Two shapes move past
/// each other: faces, edges and cores parallel but for 2^-50 to 2^-1, parts that touch to rounding where they pass, sizes decades apart, and
/// speeds across that are as small.

#include <cmath>
#include <cstdint>
#include <limits>

#include <gtest/gtest.h>

#include <thinwall/swept/reach_along.hpp>
#include <thinwall/swept/shapes.hpp>
#include <thinwall/swept/time_of_impact.hpp>

#include "fuzz/judge.hpp"
#include "support/judge.hpp"
#include "support/portable_draw.hpp"
#include "support/shaker.hpp"
#include "support/thorough.hpp"

namespace thinwall::testing {
namespace {

using V = Vec3<double>;

/// The same motions by every compiler: nothing is drawn in an order that the language leaves open.
class BrushingDraw : PortableDraw {
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
  V vector() { return {power(-3, 3), power(-3, 3), power(-3, 3)}; }

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

// ---- Faces of boxes: two met at once, one slowly, and those of axes that are not quite of unit length.

using Box = Aabb<double>;
using Ball = Sphere<double>;

const Allowance allowance = {4, 4, 1};
const std::uint64_t motions = thorough(slow_build ? 50 : 1000);

// ---- Two faces of upright boxes met at once to rounding, one of them slowly: the forward error is that of the face met last. And what is
// round, beside a face that it meets slowly at the time at which it comes beside it.

enum class Comes { as_a_box, as_a_point, as_a_ball };

/// A box at rest, and one or a point of half extents `half`, or a ball, every second a speck, that comes beside its faces across two axes at
/// one time but for rounding, half of them through a shift that both have. The axes are any, and every fourth box is a plate.
struct Tie : PortableDraw {
  Moving<Box> box;
  V half, start, path;
  double radius;

  Tie(std::uint64_t seed, Comes comes)
      : PortableDraw(seed),
        radius(comes == Comes::as_a_ball ? std::ldexp(between(0.1, 0.5), one_in(2) ? 0 : -below(48)) : 0) {
    const int quick = below(3), slow = (quick + 1 + below(2)) % 3, other = 3 - quick - slow;
    const V shift = one_in(2) ? vector(-64, 64) : V(V::Zero());
    box = {{vector(-1, 1), vector(0.2, 0.8)}, shift};
    if (one_in(4)) box.shape.half_extents[slow] = 0;
    half = comes == Comes::as_a_box ? vector(0.1, 0.5) : V(V::Zero());
    const double time = between(0.1, 0.9);
    V beside;
    path[quick] = between(0.5, 2);
    path[slow] = std::ldexp(between(0.5, 1), comes == Comes::as_a_ball ? -20 - below(30) : -below(50));
    path[other] = between(-0.2, 0.2);
    for (const int i : {quick, slow}) {
      if (one_in(2)) path[i] = -path[i];
      const double reach = box.shape.half_extents[i] + half[i] + (i == slow ? radius : 0);
      beside[i] = (path[i] < 0 ? reach : -reach) - path[i] * time;
    }
    beside[other] = between(-0.1, 0.1);
    start = box.shape.center + beside;
    path += shift;
  }
};

template <class A, class B>
void meets_the_contract(const Moving<A>& a, const Moving<B>& b, std::uint64_t seed, double min_separation = 0) {
  oracle::Pair pair = oracle::pair(a, b);
  pair.min_separation = min_separation;
  const ClosedForm<double> method{min_separation};
  EXPECT_TRUE(judge(pair, time_of_impact(method, a, b), allowance)) << "seed " << seed;
  EXPECT_TRUE(judge(pair, careful_impact(method, a, b), allowance)) << "careful, seed " << seed;
}

TEST(Ties, of_a_box_with_what_comes_beside_two_faces_at_once) {
  for (std::uint64_t seed = 0; seed < motions; ++seed) {
    const Tie box(seed, Comes::as_a_box), point(seed, Comes::as_a_point);
    meets_the_contract(box.box, Moving{Box{box.start, box.half}, box.path}, seed);
    meets_the_contract(point.box, Moving{Ball{point.start, 0}, point.path}, seed);
    Tie ball(seed, Comes::as_a_ball);
    const double gap = seed % 2 == 0 ? 0 : ball.radius / 4;
    meets_the_contract(ball.box, Moving{Ball{ball.start, ball.radius - gap}, ball.path}, seed, gap);
    if (seed % 5 != 0)
      continue;  // of a capsule one end comes as the ball does, the rest of its core leans away from the box
    const V away = (ball.start - ball.box.shape.center).cwiseSign();
    const V end = ball.start + away.cwiseProduct(ball.vector(0, 0.2));
    meets_the_contract(Moving{Capsule<double>{end, ball.start, ball.radius}, ball.path}, ball.box, seed);
  }
}

// Products of such numbers lose digits: then the plain times decide.
TEST(Ties, are_not_asked_without_rounding_of_what_underflows) {
  const double tiny = 0x1p-1074;
  const Box plate{{0, 0, 0}, {8 * tiny, 0x1.9635514f14f96p-31, 0x1p-25}};
  const Moving<Box> point{{{12 * tiny, -0x1p-23, 0x1.000008p-25}, {0, 0, 0}},
                          {-17 * tiny, 0x1.73c2e24dfb42ep-23, -0x1.74fa72e88df54p-24}};
  const Toi<double> careful = careful_impact({}, at_rest(plate), point);
  EXPECT_NEAR(careful.time, (0x1p-23 - 0x1.9635514f14f96p-31) / 0x1.73c2e24dfb42ep-23, 1e-15);
  EXPECT_EQ(careful.normal, V(0, -1, 0));

  const Moving<Box> slow{
      {{-0x1.52659df7b2cb7p+9, 0x1p-1009, -0x1.2aeaad80df65fp+9}, {0, 0, 0}},
      {0x1.9358467e46bcap+9, 0x0.0000009891069p-1022, 0x1.031ffd25b9dafp+10}};  // without a reciprocal
  const Box left_at_once{{0, 0, 0}, {0x1.52659df7b2224p+9, 0x1p-1009, 0x1.2aeaad7788108p+9}};
  EXPECT_EQ(careful_impact({}, at_rest(left_at_once), slow).status, ToiStatus::apart);
}

TEST(Ties, a_box_and_a_ray) {
  constexpr double never = std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::max();
  for (std::uint64_t seed = 0; seed < motions; ++seed) {
    const Tie tie(seed, Comes::as_a_point);
    const V direction = tie.path - tie.box.displacement;
    const oracle::Pair pair = oracle::pair(at_rest(tie.box.shape), Moving{Ball{tie.start, 0}, direction});
    const oracle::Impact truth = oracle::impact(pair);
    for (const double max_t : {1.0, 1e300, most, never}) {
      const Ray<double> ray{tie.start, direction, max_t};
      for (const auto& hit : {raycast(ray, tie.box.shape), careful_raycast(ray, tie.box.shape)}) {
        const bool is_hit = hit && hit->t <= 1;
        EXPECT_TRUE(oracle::verdict_is_near(pair, truth, is_hit ? oracle::Verdict::hit : oracle::Verdict::apart,
                                            oracle::unit_roundoff<double>()))
            << "seed " << seed << ", to " << max_t;
        if (!is_hit) continue;
        EXPECT_LE(oracle::forward_error_in_u_kappa(truth, hit->t), 4) << "seed " << seed;
      }
    }
  }
}

/// What leaves its face, or a corner, is clear as well.
TEST(Ties, what_recedes_is_clear) {
  const Box box{V::Zero(), V::Constant(0.5)};
  for (const V& path : {V(0, 0, 1), V(0.1, 0.2, 1), V(1, 1, 1), V(-0.1, 0, 0)}) {
    const ClearToi toi = clear_impact(at_rest(box), Moving{Box{{0.25, 0.25, 2}, box.half_extents}, path}, 0.0);
    EXPECT_TRUE(toi.clear) << path.transpose();
    EXPECT_EQ(toi.toi().status, ToiStatus::apart);
    const ClearRayHit hit = clear_raycast(Ray<double>{{0.25, 0.25, 2}, path, 1e3}, box);
    EXPECT_TRUE(hit.clear && !hit.hit) << path.transpose();
  }
  const ClearRayHit far = clear_raycast(Ray<double>{{-2, 0, 0}, {1e10, 1, 1}, 1}, box);
  EXPECT_TRUE(far.clear && far.hit);
}

/// What rests on a floor, or drifts to it, is as clear as what falls: it stays far from the floor's edges.
TEST(Ties, what_comes_from_near_is_clear) {
  for (const double gap : {3e-3, 3e-6, 3e-9, 3e-12}) {
    for (const double speed : {1e-2, 1e-6, 1e-14}) {
      const Moving<Ball> ball{{{3, 4, 1.5 + gap}, 0.5}, {0.1, 0.02, -speed}};
      const Box floor{V::Zero(), {50, 50, 1}};
      EXPECT_TRUE(clear_impact(at_rest(floor), ball, 0.0).clear) << gap << " away, " << speed;
      const Obb<double> turned{floor.center, floor.half_extents, Mat3<double>::Identity()};
      EXPECT_TRUE(clear_impact(at_rest(turned), ball, 0.0).clear) << gap << " away, " << speed;
    }
  }
}

/// As boxes in a grid: which axis is the last has no answer, and any will do.
TEST(Ties, two_axes_alike) {
  const Moving<Box> still = at_rest(Box{V::Zero(), V::Constant(0.5)});
  for (const V& from : {V(2, 2, 0), V(2, 2, 2), V(-3, 3, 0.25)}) {
    const Toi<double> toi = time_of_impact(still, Moving{Box{from, V::Constant(0.5)}, V(-from)});
    EXPECT_EQ(toi.status, ToiStatus::hit);
    EXPECT_DOUBLE_EQ(toi.time, 1 - 1 / std::abs(from[0]));
    EXPECT_EQ(toi.normal, V(from[0] > 0 ? 1 : -1, 0, 0));
  }
}

// ---- A floor without thickness, and what is as flat, laid level, that passes through it: of the axes that may part them several are one and
// the same, and each tells its one time by roundings of its own.

struct LevelShot : PortableDraw {
  double time;
  V start, path, along;  ///< seen in the floor's axes: y is up
  Mat3<double> yawed, tilted = Mat3<double>::Identity();

  explicit LevelShot(std::uint64_t seed) : PortableDraw(seed), time(between(0.2, 0.8)) {
    path = {between(-3, 3), -between(1, 3), between(-3, 3)};
    const V to{between(-2, 2), 0, between(-2, 2)};
    start = to - path * time;
    const double yaw = between(0, 3);
    along = {std::cos(yaw), 0, std::sin(yaw)};
    yawed << along, V::UnitY(), cross<double>(along, V::UnitY());
    const V any = direction(), other = direction();
    if (one_in(2)) tilted << any, safe_unit(cross(any, other)), cross<double>(any, safe_unit(cross(any, other)));
  }
  Obb<double> box(const V& at, const V& half, const Mat3<double>& axes) const {
    return {V(tilted * at), half, Mat3<double>(tilted * axes)};
  }
};

template <class A, class B> void expect_met(const Moving<A>& flat, const B& floor, const LevelShot& shot) {
  for (const Toi<double>& toi : {time_of_impact(flat, at_rest(floor)), time_of_impact(at_rest(floor), flat)}) {
    EXPECT_EQ(toi.status, ToiStatus::hit);
    EXPECT_NEAR(toi.time, shot.time, 0x1p-46);
    EXPECT_NEAR(std::abs(toi.normal.dot(shot.tilted.col(1))), 1, 0x1p-46);
  }
}

TEST(LevelFaces, are_not_passed) {
  for (std::uint64_t seed = 0; seed < motions; ++seed) {
    SCOPED_TRACE(seed);
    const LevelShot shot(seed);
    const V path = shot.tilted * shot.path, half{5, 0, 5};
    const Mat3<double> level = Mat3<double>::Identity();
    const Obb<double> floor = shot.box(V::Zero(), half, level), yawed_floor = shot.box(V::Zero(), half, shot.yawed);
    const V from = shot.tilted * (shot.start - shot.along), to = shot.tilted * (shot.start + shot.along);
    const Moving segment{Capsule<double>{from, to, 0}, path};
    const Moving card{shot.box(shot.start, {0.3, 0, 0.2}, shot.yawed), path};
    const Moving rod{shot.box(shot.start, {0.3, 0, 0}, shot.yawed), path};
    for (const Obb<double>& wall : {floor, yawed_floor}) {
      expect_met(segment, wall, shot);
      expect_met(card, wall, shot);
      expect_met(rod, wall, shot);
    }
    if (shot.tilted != level) continue;
    const Aabb<double> upright{V::Zero(), half};
    expect_met(segment, upright, shot);
    expect_met(card, upright, shot);
    expect_met(rod, upright, shot);
  }
}

/// A little above the floor and rising, or beside a thick box and leaving: at no time >= 0 they touch.
template <class S> void expect_left() {
  const Mat3<S> yawed = turn_in_plane(2, 0, S(0.8), S(0.6));
  const Aabb<S> floor{{0, 0, 0}, {8, 0, 8}}, block{{-1, 0, 0}, {1, 1, 1}};
  for (int eps = 8; eps <= 64; eps *= 2) {
    const S gap = eps * std::numeric_limits<S>::epsilon();
    const Moving card{Obb<S>{{0, gap, 0}, {1, 0, 1}, yawed}, {S(0.25), S(0.5), 0}};
    const Moving rod{Capsule<S>{{-1, gap, 0}, {1, gap, S(0.25)}, 0}, {S(0.25), S(0.5), 0}};
    const Moving core{Capsule<S>{{gap, S(-0.25), 0}, {gap + S(0.125), S(0.25), S(0.25)}, 0}, {2, 1, S(0.5)}};
    EXPECT_EQ(time_of_impact(card, at_rest(floor)).status, ToiStatus::apart) << eps;
    EXPECT_EQ(time_of_impact(rod, at_rest(floor)).status, ToiStatus::apart) << eps;
    EXPECT_EQ(time_of_impact(core, at_rest(block)).status, ToiStatus::apart) << eps;
  }
}
TEST(LevelFaces, are_left) {
  expect_left<double>();
  expect_left<long double>();
}

// ---- Axes are of unit length to rounding only. A box along the world's axes, whose own are off by 8 u, is met as the upright box of its
// edges' true lengths is.

/// A plate or a block at the origin, and a ball that comes from near one of its faces.
struct NearShot : PortableDraw {
  Moving<Obb<double>> box;
  Moving<Aabb<double>> upright;
  Moving<Ball> ball;

  explicit NearShot(std::uint64_t seed) : PortableDraw(seed) {
    const auto length = [this] { return 1 + (below(17) - 8) * 0x1p-53; };
    const int side = below(3);
    V lengths;
    for (int i = 0; i < 3; ++i) lengths[i] = length();
    V halves = V::Constant(8);  // powers of two: products with lengths are exact
    halves[side] = std::ldexp(1.0, -below(8));
    box = at_rest(Obb<double>{V::Zero(), halves, Mat3<double>(lengths.asDiagonal())});
    upright = at_rest(Aabb<double>{V::Zero(), halves.cwiseProduct(lengths)});
    V from = vector(-3, 3), to = vector(-6, 6);
    from[side] = (one_in(2) ? -1 : 1) * (halves[side] + 0x1p-4 + between(0.01, 0.3));
    to[side] = 0;
    ball = {{from, 0x1p-4}, to - from};
  }
};

TEST(AxesLengths, count_for_a_sphere_and_a_capsule) {
  for (std::uint64_t seed = 0; seed < motions; ++seed) {
    NearShot shot(seed);
    const oracle::Pair pair = oracle::pair(shot.upright, shot.ball);
    EXPECT_TRUE(clear_impact(shot.box, shot.ball, 0.0).clear) << "seed " << seed;
    EXPECT_TRUE(judge(pair, time_of_impact(shot.box, shot.ball), allowance)) << "seed " << seed;
    EXPECT_TRUE(judge(pair, careful_impact(ClosedForm<double>{}, shot.box, shot.ball), allowance)) << "seed " << seed;
    if (seed % 10 != 0) continue;
    const V start = shot.ball.shape.center, away = start.cwiseSign() * shot.between(0, 0.5);
    const Moving capsule{Capsule<double>{start, start + away, shot.ball.shape.radius}, shot.ball.displacement};
    EXPECT_TRUE(judge(oracle::pair(shot.upright, capsule), time_of_impact(shot.box, capsule), allowance))
        << "seed " << seed;
  }
}

TEST(AxesLengths, count_for_a_ray) {
  for (std::uint64_t seed = 0; seed < motions; ++seed) {
    const NearShot shot(seed);
    const Ray<double> ray{shot.ball.shape.center, shot.ball.displacement, 1};
    const oracle::Pair pair = oracle::pair(shot.upright, Moving{Ball{ray.origin, 0}, ray.direction});
    const oracle::Impact truth = oracle::impact(pair);
    for (const auto& hit : {raycast(ray, shot.box.shape), careful_raycast(ray, shot.box.shape)}) {
      ASSERT_EQ(hit.has_value(), truth.verdict == oracle::Verdict::hit) << "seed " << seed;
      if (!hit) continue;
      EXPECT_LE(oracle::forward_error_in_u_kappa(truth, hit->t), 4) << "seed " << seed;
      EXPECT_TRUE(is_unit(hit->normal)) << "seed " << seed;
      EXPECT_LE(oracle::length(oracle::lift_vector(hit->point) - pair.offset(truth.time)), 0x1p-46) << "seed " << seed;
    }
  }
}

/// A floor whose long edges lean by 8 u is 40 u lower or higher at a ball than at its middle, where its own axis has all of it.
TEST(AxesLengths, are_not_all_where_edges_lean) {
  Obb<double> floor{V::Zero(), {10, 1, 0x1p-4}, Mat3<double>::Identity()};
  const Moving<Ball> ball{{{5, 0, 0x1p-3 + 0x1p-5}, 0x1p-5}, {0, 0, -0.125}};
  floor.axes(2, 0) = 0x1p-50;
  const ClearToi clear = clear_impact(at_rest(floor), ball, 0.0);
  EXPECT_TRUE(clear.clear);
  for (const auto& toi : {clear.toi(), careful_impact(ClosedForm<double>{}, at_rest(floor), ball)})
    EXPECT_NEAR(toi.time, 0.5 - 5 * 0x1p-50 / 0.125, 8 * 0x1p-53);
  floor.axes(2, 0) = 0x1p-49;
  EXPECT_FALSE(clear_impact(at_rest(floor), ball, 0.0).clear);
}

}  // namespace
}  // namespace thinwall::testing
