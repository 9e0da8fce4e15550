/// The judge itself, on cases that a person can check, each touch with a miss beside it; and the closed form against it.

#include <thinwall/experiments/validate/exact_verdict.hpp>

#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/swept/time_of_impact.hpp>

#include "support/real.hpp"

namespace thinwall {
namespace {

const Rational half = Rational(1) / 2, tiny = Rational(1) / Rational(Integer(1) << 2000);

std::optional<Rational> in_triangle(const RationalPoint& start, const RationalPoint& displacement) {
  return first_contact({FlatSet::triangle, start, displacement, {2, 0, 0}, {0, 2, 0}});
}
std::optional<Rational> in_parallelogram(const RationalPoint& start, const RationalPoint& displacement) {
  return first_contact({FlatSet::parallelogram, start, displacement, {2, 0, 0}, {0, 2, 0}});
}

TEST(ExactVerdict, across_the_plane) {
  EXPECT_EQ(in_triangle({half, half, 1}, {0, 0, -2}), half);
  EXPECT_EQ(in_triangle({half, half, 1}, {0, 0, -1}), 1);  // touches at the end of the step
  EXPECT_EQ(in_triangle({half, half, 1 + tiny}, {0, 0, -1}), std::nullopt);
  EXPECT_EQ(in_triangle({half, half, 0}, {0, 0, -1}), 0);  // and at its start
  EXPECT_EQ(in_triangle({half, half, -tiny}, {0, 0, -1}), std::nullopt);
  EXPECT_EQ(in_triangle({half, half, 1}, {0, 0, 2}), std::nullopt);
}

TEST(ExactVerdict, on_the_rim) {
  EXPECT_EQ(in_triangle({1, 1, 1}, {0, 0, -2}), half);
  EXPECT_EQ(in_triangle({1, 1 + tiny, 1}, {0, 0, -2}), std::nullopt);
  EXPECT_EQ(in_triangle({2, 0, 1}, {0, 0, -2}), half);
  EXPECT_EQ(in_triangle({2 + tiny, 0, 1}, {0, 0, -2}), std::nullopt);
  EXPECT_EQ(in_triangle({0, 0, 1}, {0, 0, -2}), half);
  EXPECT_EQ(in_triangle({0, -tiny, 1}, {0, 0, -2}), std::nullopt);
  EXPECT_EQ(in_parallelogram({2, 2, 1}, {0, 0, -2}), half);
  EXPECT_EQ(in_parallelogram({2, 2 + tiny, 1}, {0, 0, -2}), std::nullopt);
}

TEST(ExactVerdict, within_the_plane) {
  EXPECT_EQ(in_triangle({-1, half, 0}, {2, 0, 0}), half);
  EXPECT_EQ(in_triangle({-1, half, tiny}, {2, 0, 0}), std::nullopt);
  EXPECT_EQ(in_triangle({-1, 2, 0}, {2, 0, 0}), half);  // past the corner only
  EXPECT_EQ(in_triangle({-1, 2 + tiny, 0}, {2, 0, 0}), std::nullopt);
  EXPECT_EQ(in_triangle({-1, 0, 0}, {2, 0, 0}), half);  // along an edge
  EXPECT_EQ(in_parallelogram({3, 2, 0}, {-2, 0, 0}), half);
}

TEST(ExactVerdict, without_motion) {
  EXPECT_EQ(in_triangle({1, half, 0}, {0, 0, 0}), 0);
  EXPECT_EQ(in_triangle({1, 1, 0}, {0, 0, 0}), 0);
  EXPECT_EQ(in_triangle({1, 1 + tiny, 0}, {0, 0, 0}), std::nullopt);
  EXPECT_EQ(in_triangle({1, half, tiny}, {0, 0, 0}), std::nullopt);
}

TEST(ExactVerdict, sets_without_area) {
  const auto line = [](FlatSet set, const RationalPoint& start, const RationalPoint& displacement) {
    return first_contact({set, start, displacement, {2, 2, 0}, {-1, -1, 0}});
  };
  for (const FlatSet set : {FlatSet::triangle, FlatSet::parallelogram}) {
    EXPECT_EQ(line(set, {1, 1, 1}, {0, 0, -2}), half);
    EXPECT_EQ(line(set, {1, 1 + tiny, 1}, {0, 0, -2}), std::nullopt);
    EXPECT_EQ(line(set, {-1, -1, 1}, {0, 0, -2}), half);
    EXPECT_EQ(line(set, {-1 - tiny, -1 - tiny, 1}, {0, 0, -2}), std::nullopt);
    EXPECT_EQ(line(set, {4, 4, 0}, {-4, -4, 0}), half);
    EXPECT_EQ(first_contact({set, {1, 2, 3}, {-2, -4, -6}, {0, 0, 0}, {0, 0, 0}}), half);
    EXPECT_EQ(first_contact({set, {1, 2, 3 + tiny}, {-2, -4, -6}, {0, 0, 0}, {0, 0, 0}}), std::nullopt);
  }
  EXPECT_EQ(first_contact({FlatSet::triangle, {3, 0, 1}, {0, 0, -1}, {2, 0, 0}, {1, 0, 0}}), std::nullopt);
  EXPECT_EQ(first_contact({FlatSet::parallelogram, {3, 0, 1}, {0, 0, -1}, {2, 0, 0}, {1, 0, 0}}), 1);
}

// ---- The closed form against exact arithmetic where published queries hardly go: exact touches, made on a grid of small
// integers so that every number involved is one, and their neighbors one unit in the last place away.

using Vector = Vec3<double>;

RationalPoint exact(const Vector& v) { return {Rational(v[0]), Rational(v[1]), Rational(v[2])}; }

std::vector<Vector> directions() {
  return {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {1, 1, 0}, {2, -1, 0}, {0, 1, -1}, {-1, 1, 1}, {3, 1, 2}, {-2, -2, 0}};
}

/// A point that passes a flat set at the origin, both moving on with the same `drift`.
struct Touch {
  FlatSet set;
  Vector start, displacement, e1, e2;
};

Toi<double> library_answer(const Touch& touch) {
  const Vector place(4, -7, 2), drift(1, -2, 3);
  const Vector start = place + touch.start, moved = touch.displacement + drift;
  if (touch.set == FlatSet::triangle) {
    const Triangle<double> face{place, place + touch.e1, place + touch.e2};
    return time_of_impact(Moving{Sphere<double>{start, 0}, moved}, Moving{face, drift});
  }
  const Capsule<double> first{place, place + touch.e1, 0}, second{start, start - touch.e2, 0};
  return time_of_impact(Moving{first, drift}, Moving{second, moved});
}

struct Wrongs {
  int queries = 0, hits = 0, verdicts = 0, starts = 0, times = 0, normals = 0;
};

void judge(const Touch& touch, Wrongs& wrongs) {
  const auto exactly = first_contact({touch.set, exact(touch.start), exact(touch.displacement), exact(touch.e1),  //
                                      exact(touch.e2)});
  const Toi<double> toi = library_answer(touch);
  ++wrongs.queries;
  wrongs.hits += exactly.has_value();
  const bool hit = toi.status == ToiStatus::hit || toi.status == ToiStatus::overlapping;
  wrongs.verdicts += hit != exactly.has_value();
  if (!hit || !exactly) return;
  wrongs.starts += (toi.status == ToiStatus::overlapping) != (*exactly == 0);
  wrongs.times += abs(Rational(toi.time) - *exactly) > *exactly * Rational(std::ldexp(1, -51));
  const double advance = toi.normal.dot(touch.displacement) * (touch.set == FlatSet::triangle ? 1 : -1);
  if (toi.status == ToiStatus::hit) wrongs.normals += !(advance > 0) || std::abs(toi.normal.norm() - 1) > 1e-15;
}

void expect_none(const Wrongs& wrongs) {
  EXPECT_EQ(wrongs.verdicts, 0) << "of " << wrongs.queries << " queries, " << wrongs.hits << " of them hits";
  EXPECT_EQ(wrongs.starts, 0) << "touching at the start is overlapping, and nothing else is";
  EXPECT_EQ(wrongs.times, 0) << "by more than two units in the last place";
  EXPECT_EQ(wrongs.normals, 0) << "unit, and against the motion";
}

/// Every touch at the start, in the middle and at the end of the step: of corners, edges and faces, of sets with and
/// without area, across the plane, within it, along an edge, and without motion.
template <class Use> void for_each_touch(FlatSet set, const Use& use) {
  const std::array<std::array<double, 2>, 6> places{{{0, 0}, {1, 0}, {0, 1}, {0.5, 0.5}, {0, 0.5}, {0.25, 0.25}}};
  for (const Vector& e1 : directions()) {
    for (const Vector& e2 : directions()) {
      for (const Vector& displacement : directions()) {
        for (const auto& [alpha, beta] : places) {
          for (const double time : {0.0, 0.5, 1.0}) {
            use(Touch{set, e1 * alpha + e2 * beta - displacement * time, displacement, e1, e2});
          }
        }
      }
    }
  }
}

class Touches : public ::testing::TestWithParam<FlatSet> {};

TEST_P(Touches, are_hits) {
  Wrongs wrongs;
  for_each_touch(GetParam(), [&](const Touch& touch) { judge(touch, wrongs); });
  EXPECT_EQ(wrongs.queries, wrongs.hits);
  EXPECT_GT(wrongs.hits, 10000);
  expect_none(wrongs);
}

TEST_P(Touches, one_unit_aside_are_what_exact_arithmetic_says) {
  Wrongs wrongs;
  int turn = 0;
  for_each_touch(GetParam(), [&](Touch touch) {
    if (++turn % 3 != 0) return;  // a third of them: exact arithmetic takes its time
    const int axis = (turn / 3) % 3;
    const double unit = std::ldexp(turn % 2 == 0 ? 1 : -1, -49);  // of the place that the query is moved to
    touch.start[axis] += unit;
    judge(touch, wrongs);
  });
  EXPECT_GT(wrongs.hits, 500);
  EXPECT_GT(wrongs.queries - wrongs.hits, 500);
  expect_none(wrongs);
}

/// How many touches the kernel misses; the front door computes float in double, where all of this is exact too.
template <class S> int kernel_misses(FlatSet set) {
  const FlatShape shape = set == FlatSet::triangle ? FlatShape::triangle : FlatShape::parallelogram;
  int misses = 0, turn = 0;
  for_each_touch(set, [&](const Touch& t) {
    if (++turn % 5 != 0) return;
    const auto entry = flat_entry<S>(shape, t.start.template cast<S>(), t.displacement.template cast<S>(),
                                     t.e1.template cast<S>(), t.e2.template cast<S>(), S(1));
    misses += !entry.inside && !(entry.time <= S(1));
  });
  return misses;
}

TEST_P(Touches, are_hits_for_the_kernel_at_every_scalar) {
  EXPECT_EQ(kernel_misses<float>(GetParam()), 0);
  EXPECT_EQ(kernel_misses<long double>(GetParam()), 0);
  EXPECT_EQ(kernel_misses<testing::Wide>(GetParam()), 0);
}

INSTANTIATE_TEST_SUITE_P(, Touches, ::testing::Values(FlatSet::triangle, FlatSet::parallelogram),
                         [](const auto& chosen) {
                           return chosen.param == FlatSet::triangle ? "vertex_face" : "edge_edge";
                         });

}  // namespace
}  // namespace thinwall
