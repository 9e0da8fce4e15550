// The oracle judges everything else, so it is judged first: against answers worked out by hand, against itself by
// another way, and against rational arithmetic.

#include <random>

#include <gtest/gtest.h>

#include "support/oracle.hpp"

namespace thinwall::oracle {
namespace {

Body ball(const Vector& center, const Real& radius, const Vector& displacement = {}) {
  return {center, {}, radius, displacement};
}
Body box(const Vector& center, const Vector& half, const Vector& displacement = {}) {
  return {center, {half}, 0, displacement};
}
Body capsule(const Vector& center, const Vector& half_axis, const Real& radius, const Vector& displacement = {}) {
  return {center, {{}, {half_axis}}, radius, displacement};
}

void expect_near(const Real& a, const Real& b, int binary_digits = 250) {
  const Real error = abs(Real(a - b)), allowed = ldexp(Real(abs(a) + abs(b) + 1), -binary_digits);
  EXPECT_TRUE(error <= allowed) << a << " against " << b;
}

class Dice {
 public:
  int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }
  Real real(double low, double high) { return Real(std::uniform_real_distribution<double>(low, high)(engine_)); }
  Vector lattice(int reach) {
    return {Real(integer(-reach, reach)), Real(integer(-reach, reach)), Real(integer(-reach, reach))};
  }
  Vector vector(double reach) { return {real(-reach, reach), real(-reach, reach), real(-reach, reach)}; }

 private:
  std::mt19937 engine_{20261121};
};

TEST(Oracle, exact_lifts_every_bit) {
  EXPECT_EQ(exact(Real(0.75)), Rational(3, 4));
  EXPECT_EQ(exact(Real(-3)), Rational(-3));
  EXPECT_EQ(exact(Real(0)), Rational(0));
  EXPECT_EQ(exact(ldexp(Real(5), -1074)) * Rational(Integer(1) << 1074), Rational(5));
  EXPECT_EQ(exact(ldexp(Real(5), 1000)), Rational(Integer(5) << 1000));
}

TEST(Oracle, face_search_finds_what_clamping_finds) {
  Dice dice;
  for (int i = 0; i < 300; ++i) {
    const bool lattice = i % 2 == 0;
    Zonotope z;
    z.box = magnitude(lattice ? dice.lattice(2) : dice.vector(2));
    const Vector p = lattice ? dice.lattice(4) : dice.vector(4);
    expect_near(length(p - FaceSearch(all_generators(z), p).nearest()), length(p - nearest(z, p)));
  }
}

TEST(Oracle, a_proven_guess_is_what_trying_every_face_finds) {
  Dice dice;
  int proven = 0;
  for (int i = 0; i < 200; ++i) {
    Zonotope z;
    z.box = magnitude(dice.lattice(2));
    z.generators = {i % 3 == 0 ? dice.lattice(1) : dice.vector(2), i % 5 == 0 ? dice.lattice(1) : dice.vector(1)};
    const std::vector<Vector> generators = all_generators(z);
    const Vector p = i % 2 == 0 ? dice.lattice(6) : dice.vector(6);
    Vector found;
    if (!nearest_on_guess(generators, p, found)) continue;
    ++proven;
    expect_near(length(p - found), length(p - FaceSearch(generators, p).nearest()), 200);
  }
  EXPECT_GT(proven, 100);
}

TEST(Oracle, nearest_point_has_a_supporting_plane) {  // the condition that makes it the nearest
  Dice dice;
  for (int i = 0; i < 100; ++i) {
    Zonotope z;
    z.box = magnitude(dice.lattice(2));
    z.generators = {i % 3 == 0 ? dice.lattice(1) : dice.vector(2), i % 5 == 0 ? dice.lattice(1) : dice.vector(1)};
    const Vector p = dice.vector(8);
    const Vector across = p - nearest(z, p);
    if (length(across) > noise(z, p)) expect_near(dot(across, p) - support(z, across), dot(across, across), 220);
  }
}

TEST(Oracle, parallel_generators_add_up) {  // dependent edges: a longer box, spelled in pieces
  Dice dice;
  for (int i = 0; i < 50; ++i) {
    Zonotope whole, pieces;
    whole.box = {3, 2, 1};
    pieces.box = {1, 2, Real(0.5)};
    pieces.generators = {{2, 0, 0}, {0, 0, Real(-0.5)}};
    const Vector p = dice.vector(6), inner = dice.vector(1);
    expect_near(length(p - nearest(pieces, p)), length(p - nearest(whole, p)));
    expect_near(depth_inside(pieces, inner).distance, depth_inside(whole, inner).distance);
  }
}

TEST(Oracle, depth_of_a_point_in_a_box_is_the_nearest_face) {
  Zonotope z;
  z.box = {1, 2, 3};
  const Depth depth = depth_inside(z, {Real(-0.75), 0, 0});
  EXPECT_EQ(depth.distance, Real(-0.25));
  EXPECT_EQ(depth.normal, (Vector{-1, 0, 0}));
}

TEST(Oracle, a_core_without_volume_has_no_depth) {
  Zonotope flat;
  flat.box = {0, 2, 3};
  EXPECT_EQ(depth_inside(flat, {0, 1, 1}).distance, 0);
  EXPECT_EQ(depth_inside(Zonotope{}, {0, 0, 0}).distance, 0);
}

TEST(Oracle, separation_of_crossing_capsules) {
  const Pair pair{capsule({0, 0, 0}, {1, 0, 0}, Real(0.5)), capsule({0, 0, 3}, {0, 1, 0}, Real(0.25)), 0};
  expect_near(gap(pair, 0).separation, Real(2.25));
  EXPECT_EQ(gap(pair, 0).normal, (Vector{0, 0, 1}));
}

TEST(Oracle, separation_of_a_capsule_through_a_box) {
  const Pair pair{box({0, 0, 0}, {2, 1, 3}), capsule({0, 0, 0}, {4, 0, 0}, Real(0.5)), 0};
  expect_near(gap(pair, 0).separation, Real(-1.5));  // out through the face at y = 1
}

TEST(Oracle, head_on) {
  const Pair pair{ball({-4, 0, 0}, 1, {4, 0, 0}), ball({0, 0, 0}, 1), 0};
  const Impact truth = impact(pair);
  EXPECT_EQ(truth.verdict, Verdict::hit);
  expect_near(truth.time, Real(0.5));
  EXPECT_EQ(truth.normal, (Vector{1, 0, 0}));
  expect_near(truth.conditioning, Real(4 + 2 + 2) / 4);
  EXPECT_EQ(forward_error_in_u_kappa(truth, 0.5), 0);
  EXPECT_GT(forward_error_in_u_kappa(truth, 0.50001), 1e9);
  EXPECT_GT(backward_error_in_u(pair, 0.50001), 1e9);
}

TEST(Oracle, a_wall_crossed_between_the_end_poses_is_found) {
  const Pair pair{ball({-1, 0, 0}, 0, {2, 0, 0}), box({0, 0, 0}, {ldexp(Real(1), -40), 8, 8}), 0};
  EXPECT_FALSE(touching(pair, 0));
  EXPECT_FALSE(touching(pair, 1));
  EXPECT_EQ(impact(pair).verdict, Verdict::hit);
  expect_near(impact(pair).time, (1 - ldexp(Real(1), -40)) / 2);
}

TEST(Oracle, an_exact_touch_is_a_hit_and_the_least_gap_is_a_miss) {
  for (const int exponent : {-30, -200, -1074, -16445}) {
    const Real gap_size = ldexp(Real(1), exponent);
    const auto graze = [&](const Real& y) {
      return impact({ball({-4, y, 0}, 1, {8, 0, 0}), ball({0, 0, 0}, 1), 0}).verdict;
    };
    EXPECT_EQ(graze(2), Verdict::hit);
    const Pair points{ball({-1, gap_size, 0}, 0, {2, 0, 0}), ball({0, 0, 0}, 0), 0};
    EXPECT_EQ(impact(points).verdict, Verdict::apart) << exponent;
    const Pair start{ball({-gap_size, 0, 0}, 0, {1, 0, 0}), ball({0, 0, 0}, 0), 0};
    EXPECT_EQ(impact(start).verdict, Verdict::hit) << exponent;
    expect_near(impact(start).time / gap_size, 1);
  }
}

TEST(Oracle, the_first_of_many_times_of_touching_counts) {  // slides along the face, exactly touching
  const Pair pair{ball({-10, Real(1.5), 0}, Real(0.5), {20, 0, 0}), box({0, 0, 0}, {1, 1, 1}), 0};
  EXPECT_EQ(impact(pair).verdict, Verdict::hit);
  expect_near(impact(pair).time, Real(9) / 20, 160);
}

TEST(Oracle, oblique_cores_meet_in_time) {  // crossed capsules, and two that slide parallel
  const Pair crossed{capsule({-4, 0, 0}, {0, 1, 0}, Real(0.5), {4, 0, 0}), capsule({0, 0, 0}, {0, 0, 1}, Real(0.5)), 0};
  expect_near(impact(crossed).time, Real(0.75));
  const Pair miss{capsule({-4, 2, 0}, {0, 1, 0}, Real(0.5), {8, 0, 0}), capsule({0, 0, 0}, {0, 0, 1}, Real(0.25)), 0};
  EXPECT_EQ(impact(miss).verdict, Verdict::apart);
  expect_near(impact(miss).time, Real(0.5), 120);
}

TEST(Oracle, decimals_and_fractions_agree) {
  Dice dice;
  int hits = 0, touches = 0;
  for (int i = 0; i < 3000; ++i) {
    const bool lattice = i % 3 != 0;
    const auto draw = [&](int reach) { return lattice ? dice.lattice(reach) : dice.vector(reach); };
    const Pair pair{ball(draw(6), Real(dice.integer(0, 2)), draw(8)), box(draw(2), magnitude(draw(2)), draw(2)), 0};
    const Impact truth = impact(pair);
    const ExactApproach exactly = exact_approach(pair);
    EXPECT_EQ(truth.verdict == Verdict::overlapping, exactly.start_sign <= 0);
    EXPECT_EQ(truth.verdict == Verdict::apart, exactly.start_sign > 0 && exactly.sign > 0);
    expect_near(closest_approach(pair), Real(exactly.time), 120);
    if (truth.verdict != Verdict::hit) continue;
    ++hits;
    touches += exactly.sign == 0;
    EXPECT_LE(backward_error_in_u(pair, truth.time.convert_to<double>()), 1);
    EXPECT_FALSE(touching(pair, truth.time - ldexp(Real(1), -90)));
  }
  EXPECT_GT(hits, 100);
  EXPECT_GT(touches, 10);
}

}  // namespace
}  // namespace thinwall::oracle
