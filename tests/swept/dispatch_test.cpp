// Bodies of any type through std::variant, at one instant and in motion, one by one and grouped by type pair.

#include <thinwall/discrete/boxes/box_manifold.hpp>
#include <thinwall/discrete/dispatch.hpp>
#include <thinwall/swept/dispatch.hpp>
#include <thinwall/swept/methods.hpp>

#include "support/contacts.hpp"
#include "support/judge.hpp"
#include "support/shaker.hpp"

namespace thinwall::testing {
namespace {

template <class S> using Any = std::variant<std::monostate, Sphere<S>, Aabb<S>, Obb<S>>;
using AnyThatMoves = std::variant<std::monostate, Sphere<double>, Aabb<double>, Capsule<double>>;

template <class Variant, class S> Variant drawn_any(Shaker<S>& draw) {
  switch (draw.pick(0, 3)) {
    case 1: return drawn(draw, TypeTag<std::variant_alternative_t<1, Variant>>{});
    case 2: return drawn(draw, TypeTag<std::variant_alternative_t<2, Variant>>{});
    case 3: return drawn(draw, TypeTag<std::variant_alternative_t<3, Variant>>{});
    default: return std::monostate{};
  }
}

/// Every pair of so many bodies, in either order.
template <class S> std::vector<IndexPair> every_pair(Shaker<S>& draw, std::size_t bodies) {
  std::vector<IndexPair> pairs;
  for (std::uint32_t i = 0; i < bodies; ++i) {
    for (std::uint32_t j = 0; j < i; ++j) pairs.push_back(draw.pick(0, 1) == 0 ? IndexPair{i, j} : IndexPair{j, i});
  }
  return pairs;
}

template <class S> class Dispatch : public ::testing::Test {};
TYPED_TEST_SUITE(Dispatch, Scalars, ScalarNames);

TYPED_TEST(Dispatch, asks_the_shapes_that_are_held_in_either_order) {
  using S = TypeParam;
  const Sphere<S> ball{{0, 0, 0}, 1};
  const Aabb<S> box{{S(3) / S(2), 0, 0}, {1, 1, 1}};
  const Any<S> a = ball, b = box;
  EXPECT_TRUE(overlaps(a, b));
  EXPECT_EQ(contact(a, b)->normal, contact(ball, box)->normal);
  EXPECT_EQ(contact(b, a)->normal, contact(box, ball)->normal);
  EXPECT_EQ(contact(a, b)->penetration, S(1) / S(2));
  EXPECT_EQ(separation(a, b)->distance, -S(1) / S(2));
  EXPECT_EQ(manifold(a, b)[0].local_b, manifold(ball, box)[0].local_b);
  EXPECT_EQ(manifold(b, b).size(), 4U);
  const Ray<S> ray{{-4, 0, 0}, {1, 0, 0}};
  EXPECT_EQ(raycast(ray, a)->t, S(3));
}

TYPED_TEST(Dispatch, no_volume_collides_with_nothing) {
  using S = TypeParam;
  const Any<S> none, ball = Sphere<S>{{0, 0, 0}, 1};
  for (const auto& [a, b] : {std::pair{none, ball}, std::pair{ball, none}, std::pair{none, none}}) {
    EXPECT_FALSE(overlaps(a, b));
    EXPECT_FALSE(contact(a, b));
    EXPECT_FALSE(separation(a, b));
    EXPECT_TRUE(manifold(a, b).empty());
  }
  EXPECT_FALSE(raycast(Ray<S>{{-4, 0, 0}, {1, 0, 0}}, none));
}

TYPED_TEST(Dispatch, lists_may_differ_and_then_a_list_may_hold_what_does_not_meet_itself) {
  using S = TypeParam;
  const std::variant<Sphere<S>> mover = Sphere<S>{{0, 0, 1}, 1};
  const std::variant<Triangle<S>, Aabb<S>> wall = Triangle<S>{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  EXPECT_TRUE(overlaps(mover, wall));
  EXPECT_TRUE(overlaps(wall, mover));
}

TYPED_TEST(Dispatch, grouped_answers_are_those_of_one_by_one_calls_in_the_order_asked) {
  using S = TypeParam;
  Shaker<S> draw(1);
  std::vector<Any<S>> bodies;
  for (int i = 0; i < 60; ++i) bodies.push_back(drawn_any<Any<S>>(draw));
  const std::vector<IndexPair> pairs = every_pair(draw, bodies.size());
  const auto found = answers(group_pairs(bodies, bodies, pairs), bodies, bodies, pairs, std::optional<Contact<S>>{},
                             [](const auto& a, const auto& b) { return contact(a, b); });
  ASSERT_EQ(found.size(), pairs.size());
  int hits = 0;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto one = contact(bodies[pairs[k].a], bodies[pairs[k].b]);
    EXPECT_TRUE(same(found[k], one)) << k;
    if (one) ++hits;
  }
  EXPECT_GT(hits, 50);
}

TEST(PairGroups, hold_every_pair_once_by_type_and_in_order) {
  const std::vector<Any<double>> bodies{Sphere<double>{{0, 0, 0}, 1}, Aabb<double>{{0, 0, 0}, {1, 1, 1}},
                                        Sphere<double>{{0, 0, 0}, 1}};
  const std::vector<IndexPair> pairs{{0, 1}, {0, 2}, {1, 0}, {2, 1}, {2, 0}};
  const PairGroups groups = group_pairs(bodies, bodies, pairs);
  EXPECT_EQ(groups.order, (std::vector<std::uint32_t>{1, 4, 0, 3, 2}));  // ball-ball, ball-box, box-ball
  ASSERT_EQ(groups.start.size(), 17U);
  EXPECT_EQ(groups.start[1 * 4 + 1], 0U);
  EXPECT_EQ(groups.start[1 * 4 + 2], 2U);
  EXPECT_EQ(groups.start[2 * 4 + 1], 4U);
  EXPECT_EQ(groups.start[16], 5U);
  const std::vector<IndexPair> none;
  const PairGroups no_groups = group_pairs(bodies, bodies, none);
  EXPECT_TRUE(no_groups.order.empty());
  EXPECT_TRUE(answers(no_groups, bodies, bodies, none, 0, [](const auto&, const auto&) { return 1; }).empty());
}

TEST(MovingDispatch, asks_the_shapes_that_are_held_by_any_method_in_either_order) {
  const Sphere<double> ball{{-4, 0, 0}, 1};
  const Aabb<double> box{{0, 0, 0}, {1, 1, 1}};
  const Vec3<double> path{4, 0, 0}, none(0, 0, 0);
  const Moving a{AnyThatMoves{ball}, path}, b{AnyThatMoves{box}, none}, nothing{AnyThatMoves{}, path};
  EXPECT_TRUE(same_answer(time_of_impact(a, b), time_of_impact(Moving{ball, path}, at_rest(box))));
  EXPECT_TRUE(same_answer(time_of_impact(b, a), time_of_impact(at_rest(box), Moving{ball, path})));
  EXPECT_EQ(time_of_impact(a, b).time, 0.5);
  EXPECT_EQ(time_of_impact(EndOfStep<double>{}, a, b).time, 1.0);
  for (const Toi<double>& toi : {time_of_impact(nothing, b), time_of_impact(b, nothing)}) {
    EXPECT_EQ(toi.status, ToiStatus::apart);
    EXPECT_EQ(toi.time, 1);
  }
}

TEST(MovingDispatch, methods_are_of_double_where_no_scalar_is_named) {
  const Moving<Sphere<double>> ball{{{-4, 0, 0}, 1}, {8, 0, 0}};
  const auto wall = at_rest(Aabb<double>{{0, 0, 0}, {1, 1, 1}});
  EXPECT_EQ(time_of_impact(EndOfStep{}, ball, wall).status, ToiStatus::apart);
  EXPECT_EQ(time_of_impact(Substeps{4}, ball, wall).time, 0.25);
  EXPECT_EQ(time_of_impact(ClosedForm{}, ball, wall).time, 0.25);
}

TEST(MovingDispatch, grouped_answers_are_those_of_one_by_one_calls_in_the_order_asked) {
  Shaker<double> draw(1);
  std::vector<Moving<AnyThatMoves>> bodies;
  for (int i = 0; i < 60; ++i) bodies.push_back({drawn_any<AnyThatMoves>(draw), draw.vector() * 4});
  const std::vector<IndexPair> pairs = every_pair(draw, bodies.size());
  const auto found = answers(group_pairs(bodies, bodies, pairs), bodies, bodies, pairs, Toi<double>{},
                             [](const auto& a, const auto& b) { return time_of_impact(a, b); });
  ASSERT_EQ(found.size(), pairs.size());
  int hits = 0;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto one = time_of_impact(bodies[pairs[k].a], bodies[pairs[k].b]);
    EXPECT_TRUE(same_answer(found[k], one));
    EXPECT_EQ(found[k].evaluations, one.evaluations);
    hits += one.status == ToiStatus::hit;
  }
  EXPECT_GT(hits, 50);
}

}  // namespace
}  // namespace thinwall::testing
