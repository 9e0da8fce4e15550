// No number in any field breaks a time of impact: valid motions get a whole answer from every method, others are `invalid`. And no
// query allocates memory.

#include <cstddef>
#include <cstdlib>
#include <new>

#include <thinwall/swept/methods.hpp>
#include <thinwall/swept/time_of_impact.hpp>
#include <thinwall/swept/turning/turning_impact.hpp>

#include "support/any_number.hpp"
#include "support/shaker.hpp"
#include "support/thorough.hpp"

namespace {
thread_local std::size_t allocations = 0;
}

[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace thinwall::testing {
namespace {

template <class S> void expect_invalid(const Toi<S>& toi) {
  EXPECT_EQ(toi.status, ToiStatus::invalid);
  EXPECT_NE(toi.time, toi.time);
}

template <class S> void expect_whole(const Toi<S>& toi, bool ordinary) {
  EXPECT_NE(toi.status, ToiStatus::invalid);
  EXPECT_GE(toi.time, S(0));
  EXPECT_LE(toi.time, S(1));
  const bool in_contact = toi.status == ToiStatus::hit || toi.status == ToiStatus::overlapping;
  EXPECT_TRUE(in_contact ? is_unit_vector(toi.normal) : toi.normal == Vec3<S>::Zero()) << toi.normal.transpose();
  EXPECT_TRUE(!ordinary || is_finite(toi.point)) << toi.point.transpose();
}

/// visit(Method{}) for every method that serves the pair.
template <class A, class B, class Visit> void for_each_method(const Visit& visit) {
  for_each_type(Methods<double>{}, [&]<class Method>(TypeTag<Method>) {
    if constexpr (serves<Method, A, B>) {
      SCOPED_TRACE(std::string(Method::name));
      visit(Method{});
    }
  });
}

template <class Method, class A, class B>
void ask_with_every_number(const Method& method, TypeTag<A> first, TypeTag<B> second) {
  Moving<A> a{usual(first), {6, 0.25, 0.125}};
  Moving<B> b = at_rest(moved(usual(second), Vec3<double>(5, 0.25, 0.125)));
  const auto ask = [&] {
    const auto toi = time_of_impact(method, a, b);
    if (valid(a) && valid(b)) {
      expect_whole(toi, is_ordinary(magnitude(a) + magnitude(b)));
    } else {
      expect_invalid(toi);
    }
  };
  ask();
  with_every_number<double>(a, ask);
  with_every_number<double>(b, ask);
}

TEST(AnyNumberInMotion, in_a_shape_or_its_displacement) {
  for_each_served_pair<double>(
      [](auto first, auto second) { ask_with_every_number(ClosedForm<double>{}, first, second); });
}

TEST(AnyNumberInMotion, in_a_box_by_every_method) {  // they have one front door: a pair will do
  for_each_method<Obb<double>, Sphere<double>>(
      [](const auto& method) { ask_with_every_number(method, TypeTag<Obb<double>>{}, TypeTag<Sphere<double>>{}); });
}

/// visit(a, b) for shots at each served pair, of boxes whose axes are as long as they may be.
template <class S, class Visit> void with_long_axes(const Visit& visit) {
  for_each_served_pair<S>([&]<class A, class B>(TypeTag<A> first, TypeTag<B> second) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const double from : {-6.0, -1.0, 6.0}) {
        const Vec3<S> start = axis_vector<S>(axis) * S(from);
        visit(Moving{lengthened(usual(first)), Vec3<S>(start * S(1.5))},
              at_rest(lengthened(moved(usual(second), start))));
      }
    }
  });
}

TEST(AnyNumberInMotion, in_axes_that_are_as_long_as_they_may_be) {
  with_long_axes<double>([]<class A, class B>(const Moving<A>& a, const Moving<B>& b) {
    for_each_method<A, B>([&](const auto& method) { expect_whole(time_of_impact(method, a, b), true); });
  });
  with_long_axes<long double>([](const auto& a, const auto& b) { expect_whole(time_of_impact(a, b), true); });
}

TEST(AnyNumberInMotion, in_an_option) {
  const Moving shot{usual(TypeTag<Obb<double>>{}), {6, 0.25, 0.125}};
  const Moving<Sphere<double>> ball{{{5, 0.25, 0.125}, 1}, {0, 0, 0}};
  const auto ask = [&](const auto& method, double option, bool ordinary) {
    const auto toi = time_of_impact(method, shot, ball);
    option >= 0 && is_finite(option) ? expect_whole(toi, ordinary) : expect_invalid(toi);
  };
  for (const double x : special_numbers<double>()) {
    SCOPED_TRACE(x);
    for_each_method<Obb<double>, Sphere<double>>([&](auto method) {
      method.min_separation = x;
      ask(method, x, x < 1e300);
    });
    ask(Speculative<double>{.margin = x}, x, true);
  }
}

/// A method asked in float, whose box is orthonormal to float and no more.
template <class Method> void expect_hit_and_overlap(const Method& method) {
  Obb<float> box{{0, 0, 0}, {1, 1, 1}, Mat3<float>::Identity()};
  box.axes(0, 1) = 0x1p-14F;
  const Sphere<float> ball{{-4, 0.25F, 0}, 1}, inside{{0.5F, 0.25F, 0}, 1};
  const auto hit = time_of_impact(method, Moving{ball, {4, 0, 0}}, at_rest(box));
  EXPECT_EQ(hit.status, ToiStatus::hit);
  EXPECT_TRUE(is_unit_vector(hit.normal)) << hit.normal.transpose();
  const auto overlapping = time_of_impact(method, at_rest(inside), at_rest(box));
  EXPECT_NE(overlapping.status, ToiStatus::apart);
  EXPECT_TRUE(is_unit_vector(overlapping.normal)) << overlapping.normal.transpose();
  box.axes(0, 1) = 0x1p-12F;
  expect_invalid(time_of_impact(method, at_rest(inside), at_rest(box)));
}

TEST(AnyNumberInMotion, boxes_in_float_have_axes_as_good_as_float) {  // though a query in float is computed in double
  expect_hit_and_overlap(ClosedForm<float>{});
  expect_hit_and_overlap(EndOfStep<float>{});
  expect_hit_and_overlap(CentreRay<float>{});
  expect_hit_and_overlap(Inclusion<float>{});
}

TEST(AnyNumberInMotion, boxes_in_float_that_turn_have_too) {
  Obb<float> box{{0, 0, 0}, {1, 1, 1}, Mat3<float>::Identity()};
  box.axes(0, 1) = 0x1p-14F;
  const Turning shot{Sphere<float>{{-4, 0.25F, 0}, 1}, {4, 0, 0}, {0, 0, 1}};
  EXPECT_EQ(time_of_impact(LinearSweep<float>{}, shot, at_rest(box)).status, ToiStatus::hit);
  EXPECT_EQ(time_of_impact(shot, at_rest(box)).status, ToiStatus::hit);
  box.axes(0, 1) = 0x1p-12F;
  expect_invalid(time_of_impact(shot, at_rest(box)));
}

TEST(AnyNumberInMotion,
     boxes_have_the_same_answer_at_every_size) {  // a minimal separation has them walk plane by plane
  const Moving<Obb<double>> a{usual(TypeTag<Obb<double>>{}), {6, 0.25, 0.125}};
  const auto b = at_rest(moved(usual(TypeTag<Obb<double>>{}), Vec3<double>(5, 0.25, 1.5)));
  const auto here = time_of_impact(ClosedForm<double>{.min_separation = 0.25}, a, b);
  EXPECT_EQ(here.status, ToiStatus::hit);
  for (int e = -900; e <= 1000; e += 20) {
    const ClosedForm<double> method{.min_separation = std::ldexp(1.0, e - 2)};
    const auto there = time_of_impact(method, scaled(a, e), scaled(b, e));
    EXPECT_EQ(there.status, here.status) << e;
    EXPECT_EQ(there.time, here.time) << e;
    EXPECT_EQ(there.normal, here.normal) << e;
    EXPECT_EQ(there.point, times_power_of_two(here.point, e)) << e;
  }
}

TEST(AnyNumberInMotion, boxes_far_beyond_their_sizes_are_apart) {  // products of their lengths overflow
  const Obb<double> box = scaled(usual(TypeTag<Obb<double>>{}), 480);
  const Vec3<double> far(-0x1p480, -0x1p987, 0x1p481);
  for (const double speed : {0x1p453, 0x1p480, 0x1p986}) {
    const Moving passing{moved(box, far), Vec3<double>(speed, speed, 0)};
    const auto toi = time_of_impact(ClosedForm<double>{.min_separation = 0.25}, passing, at_rest(box));
    EXPECT_EQ(toi.status, ToiStatus::apart) << speed;
  }
}

TEST(AnyNumberInMotion, a_turn_that_underflows_is_none) {
  const Aabb<double> box{{0, 0, 0}, {1.4, 0.4, 1}};
  for (int e = -1074; e < -1060; ++e) {
    const double tilt = std::ldexp(1.0, e);
    Obb<double> turned{{0, 0, 0}, {0.4, 1.4, 1}, Mat3<double>::Identity()};
    turned.axes(0, 2) = tilt;
    turned.axes(2, 0) = -tilt;
    for (double x = -1.75; x <= 1.75; x += 0.25) {
      for (double y = -1.75; y <= 1.75; y += 0.25) {
        turned.center = {x, y, 0.25};
        EXPECT_TRUE(overlaps(box, turned)) << e << " " << x << " " << y;
        EXPECT_TRUE(is_unit_vector(separation(box, turned).normal)) << e << " " << x << " " << y;
      }
    }
  }
}

// ---- No query of a scalar of the processor's own allocates memory: not a plain one, and not one that takes every care.

template <class A, class B> std::size_t allocations_of_queries(int motions) {
  using S = typename A::Scalar;
  Shaker<S> draw(7);
  const std::size_t before = allocations;
  for (int i = 0; i < motions; ++i) {
    Motion<A, B> motion = drawn_motion<A, B>(draw);
    if (i % 7 == 0) motion = {scaled(motion.a, 90), scaled(motion.b, 90)};
    (void)time_of_impact(motion.a, motion.b);
    (void)separation(motion.a.shape, motion.b.shape);
    (void)overlaps(motion.a.shape, motion.b.shape);
    (void)contact(motion.a.shape, motion.b.shape);
    (void)raycast(Ray<S>{center(motion.a.shape), motion.a.displacement}, motion.b.shape);
  }
  return allocations - before;
}

template <class S> void expect_no_allocation() {
  const std::size_t before = allocations;
  ::operator delete(::operator new(1));
  ASSERT_GT(allocations, before);
  for_each_served_pair<S>(
      []<class A, class B>(TypeTag<A>, TypeTag<B>) { EXPECT_EQ((allocations_of_queries<A, B>(4000)), 0u); });
}

TEST(Allocations, are_none_in_any_query_in_double) { expect_no_allocation<double>(); }
TEST(Allocations, are_none_in_any_query_in_float) { expect_no_allocation<float>(); }

}  // namespace
}  // namespace thinwall::testing
