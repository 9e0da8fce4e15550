// Moving bodies of any type, one by one and grouped by type pair.

#include <thinwall/swept/dispatch.hpp>
#include <thinwall/swept/methods.hpp>

#include "support/shaker.hpp"

namespace thinwall::testing {
namespace {

using Any = std::variant<std::monostate, Sphere<double>, Aabb<double>, Capsule<double>>;

Any drawn_any(Shaker<double>& draw) {
  switch (draw.pick(0, 3)) {
    case 1: return drawn(draw, TypeTag<Sphere<double>>{});
    case 2: return drawn(draw, TypeTag<Aabb<double>>{});
    case 3: return drawn(draw, TypeTag<Capsule<double>>{});
    default: return std::monostate{};
  }
}

void expect_same(const Toi<double>& a, const Toi<double>& b) {
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.normal, b.normal);
  EXPECT_EQ(a.point, b.point);
  EXPECT_EQ(a.evaluations, b.evaluations);
}

TEST(MovingDispatch, asks_the_shapes_that_are_held_by_any_method_in_either_order) {
  const Sphere<double> ball{{-4, 0, 0}, 1};
  const Aabb<double> box{{0, 0, 0}, {1, 1, 1}};
  const Vec3<double> path{4, 0, 0};
  const Moving a{Any{ball}, path}, b{Any{box}, Vec3<double>(0, 0, 0)};
  expect_same(time_of_impact(a, b), time_of_impact(Moving{ball, path}, at_rest(box)));
  expect_same(time_of_impact(b, a), time_of_impact(at_rest(box), Moving{ball, path}));
  EXPECT_EQ(time_of_impact(a, b).time, 0.5);
  EXPECT_EQ(time_of_impact(EndOfStep<double>{}, a, b).time, 1.0);
}

TEST(MovingDispatch, no_volume_is_apart) {
  const Moving none{Any{}, Vec3<double>(1, 0, 0)}, ball{Any{Sphere<double>{{0, 0, 0}, 1}}, Vec3<double>(0, 0, 0)};
  EXPECT_EQ(time_of_impact(none, ball).status, ToiStatus::apart);
  EXPECT_EQ(time_of_impact(ball, none).status, ToiStatus::apart);
  EXPECT_EQ(time_of_impact(ball, none).time, 1.0);
}

TEST(MovingDispatch, grouped_answers_are_those_of_one_by_one_calls_in_the_order_asked) {
  Shaker<double> draw(1);
  std::vector<Moving<Any>> bodies;
  for (int i = 0; i < 60; ++i) bodies.push_back({drawn_any(draw), draw.vector() * 4});
  std::vector<IndexPair> pairs;
  for (std::uint32_t i = 0; i < bodies.size(); ++i) {
    for (std::uint32_t j = 0; j < i; ++j) pairs.push_back(draw.pick(0, 1) == 0 ? IndexPair{i, j} : IndexPair{j, i});
  }
  const auto found = answers(group_pairs(bodies, bodies, pairs), bodies, bodies, pairs, Toi<double>{},
                             [](const auto& a, const auto& b) { return time_of_impact(a, b); });
  ASSERT_EQ(found.size(), pairs.size());
  int hits = 0;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto one = time_of_impact(bodies[pairs[k].a], bodies[pairs[k].b]);
    expect_same(found[k], one);
    hits += one.status == ToiStatus::hit;
  }
  EXPECT_GT(hits, 50);
}

}  // namespace
}  // namespace thinwall::testing
