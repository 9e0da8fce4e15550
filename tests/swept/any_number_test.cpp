// No number in any field breaks a query, at one instant or of a motion: what is valid gets a whole answer, as the fuzz target asks for it,
// and the rest none. And no query allocates memory.

#include <cstddef>
#include <cstdlib>
#include <new>

#include <thinwall/swept/methods.hpp>
#include <thinwall/swept/time_of_impact.hpp>
#include <thinwall/swept/turning/turning_impact.hpp>

#include "fuzz/checks.hpp"
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

namespace thinwall {

void fuzz::report(const std::string& kind, const std::string& detail) { ADD_FAILURE() << kind << "\n" << detail; }

namespace testing {
namespace {

/// visit(method) for every method that serves the pair.
template <class A, class B, class Visit> void for_each_method(const Visit& visit) {
  for_each_type(Methods<double>{}, [&]<class Method>(TypeTag<Method>) {
    if constexpr (serves<Method, A, B>) visit(Method{});
  });
}

template <class A, class B> void ask_every_query(const fuzz::Scene<A, B>& scene) {
  fuzz::check_closed_form(scene);
  if (scene.is_valid()) {
    fuzz::check_discrete(scene);
  } else {
    fuzz::check_bad_shapes(scene);
  }
}

template <class A, class B> void ask_every_method(const fuzz::Scene<A, B>& scene) {
  for_each_method<A, B>([&]<class Method>(const Method& method) {
    fuzz::check_answer(scene, std::string(Method::name), time_of_impact(method, scene.a, scene.b));
  });
}

/// ask(scene) with every number in every field of the two, and their displacements.
template <class A, class B, class Ask> void with_every_number_of_both(fuzz::Scene<A, B> scene, const Ask& ask) {
  const auto asked = [&] { ask(scene); };
  asked();
  with_every_number<double>(scene.a, asked);
  with_every_number<double>(scene.b, asked);
}

template <class A, class B> fuzz::Scene<A, B> shot_from(TypeTag<A> first, TypeTag<B> second, double away) {
  return {{usual(first), {6, 0.25, 0.125}}, at_rest(moved(usual(second), Vec3<double>(away, 0.25, 0.125)))};
}

TEST(AnyNumber, in_two_shapes_and_their_displacements) {
  for_each_served_pair<double>([](auto first, auto second) {
    for (const double away : {0.5, 4.0, 5.0}) {
      with_every_number_of_both(shot_from(first, second, away), [](const auto& scene) { ask_every_query(scene); });
      with_every_number_of_both(shot_from(second, first, away), [](const auto& scene) { ask_every_query(scene); });
    }
  });
}

TEST(AnyNumber, in_a_box_by_every_method) {  // they have one front door: a pair will do
  with_every_number_of_both(shot_from(TypeTag<Obb<double>>{}, TypeTag<Sphere<double>>{}, 5),
                            [](const auto& scene) { ask_every_method(scene); });
}

TEST(AnyNumber, in_axes_that_are_as_long_as_they_may_be) {
  for_each_served_pair<double>([]<class A, class B>(TypeTag<A> first, TypeTag<B> second) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const double from : {-6.0, -3.0, -1.75, -0.5, 0.5, 1.75, 3.0, 6.0}) {
        const Vec3<double> start = axis_vector<double>(axis) * from;
        const fuzz::Scene<A, B> shot{{lengthened(usual(first)), Vec3<double>(start * 1.5)},
                                     at_rest(lengthened(moved(usual(second), start)))};
        ask_every_method(shot);
        const auto [a, b] = std::pair{shot.a.shape, shot.b.shape};
        const auto gap = separation(a, b);
        const auto touch = contact(a, b);
        EXPECT_TRUE(fuzz::is_unit(gap.normal) && is_finite(gap.point_a) && is_finite(gap.point_b));
        EXPECT_EQ(touch.has_value(), overlaps(a, b));
        EXPECT_EQ(manifold(a, b).empty(), !touch);
        if (touch) {
          EXPECT_LE(largest<double>(touch->normal - gap.normal), 0x1p-40);
        }
        EXPECT_LE(time_of_impact(cast<long double>(shot.a), cast<long double>(shot.b)).time, 1);  // NaN if invalid
      }
    }
  });
}

TEST(AnyNumber, in_a_margin) {
  for_each_served_pair<double>([]<class A, class B>(TypeTag<A> first, TypeTag<B> second) {
    const A a = usual(first);
    const B b = moved(usual(second), Vec3<double>(4, 0, 0));
    for (const double margin : special_numbers<double>()) {
      const bool reaches = margin > 4 && is_finite(margin);
      EXPECT_EQ(overlaps_within(a, b, margin), reaches) << margin;
      EXPECT_EQ(overlaps_within(b, a, margin), reaches) << margin;
    }
  });
}

TEST(AnyNumber, in_a_ray_and_its_target) {
  for_each_type(Shapes<double>{}, []<class A>(TypeTag<A> tag) {
    for (const double from : {0.125, -4.0}) {
      fuzz::Scene<Sphere<double>, A> scene{{}, at_rest(usual(tag))};
      Ray<double> ray{{from, 0.375, 0.125}, {1, 0.0625, 0.03125}};
      const auto ask = [&] { EXPECT_TRUE(is_finite(fuzz::check_ray(scene, ray).point)); };
      ask();
      with_every_number<double>(ray, ask);
      with_every_number<double>(scene.b.shape, ask);
    }
  });
}

TEST(AnyNumber, no_ray_hits_at_infinity) {
  const double far = 0x1p1020, tiny = std::numeric_limits<double>::min();
  const Vec3<double> corner(far, far, far);
  EXPECT_FALSE(raycast(Ray<double>{{0, 0, 0}, {tiny, tiny, tiny}}, Aabb<double>{corner, {1, 1, 1}}));  // t overflows
  EXPECT_FALSE(
      raycast(Ray<double>{{0, 0, 0}, {tiny, tiny, tiny}}, Obb<double>{corner, {1, 1, 1}, Mat3<double>::Identity()}));
}

TEST(AnyNumber, no_ray_hits_a_triangle_beside_it) {
  const Triangle<double> steep{{0.5, 3, 3}, {0.5, 1e200, 1e-300}, {3, 1e-300, 0}};  // z would overflow
  EXPECT_FALSE(raycast(Ray<double>{{-1e308, 0.5, 0}, {1e300, 0, 2e300}}, steep));
  const Triangle<double> low{{0, 0, 0}, {1, 0.5, -2e300}, {0, 1, 1}};  // x is 3 all the way
  EXPECT_FALSE(raycast(Ray<double>{{3, -1e308, 1e300}, {0, 1, 0}}, low));
}

TEST(AnyNumber, in_an_option) {
  const fuzz::Scene<Obb<double>, Sphere<double>> scene{{usual(TypeTag<Obb<double>>{}), {6, 0.25, 0.125}},
                                                       at_rest(Sphere<double>{{5, 0.25, 0.125}, 1})};
  const auto ask = [&](const auto& method, double option) {
    const auto toi = time_of_impact(method, scene.a, scene.b);
    EXPECT_EQ(toi.status == ToiStatus::invalid, !(option >= 0 && is_finite(option))) << option;
    if (toi.status != ToiStatus::invalid && option < 1e300) fuzz::check_answer(scene, "with an option", toi);
  };
  for (const double x : special_numbers<double>()) {
    for_each_method<Obb<double>, Sphere<double>>([&](auto method) {
      method.min_separation = x;
      ask(method, x);
    });
    ask(Speculative<double>{.margin = x}, x);
  }
}

/// A method asked in float, whose box is orthonormal to float and no more.
template <class Method> void expect_hit_and_overlap(const Method& method) {
  Obb<float> box{{0, 0, 0}, {1, 1, 1}, Mat3<float>::Identity()};
  box.axes(0, 1) = 0x1p-14F;
  const Sphere<float> ball{{-4, 0.25F, 0}, 1}, inside{{0.5F, 0.25F, 0}, 1};
  const auto hit = time_of_impact(method, Moving{ball, {4, 0, 0}}, at_rest(box));
  EXPECT_EQ(hit.status, ToiStatus::hit);
  EXPECT_TRUE(fuzz::is_unit(hit.normal)) << hit.normal.transpose();
  const auto overlapping = time_of_impact(method, at_rest(inside), at_rest(box));
  EXPECT_NE(overlapping.status, ToiStatus::apart);
  EXPECT_TRUE(fuzz::is_unit(overlapping.normal)) << overlapping.normal.transpose();
  box.axes(0, 1) = 0x1p-12F;
  EXPECT_EQ(time_of_impact(method, at_rest(inside), at_rest(box)).status, ToiStatus::invalid);
}

TEST(AnyNumber, boxes_in_float_have_axes_as_good_as_float) {  // though a query in float is computed in double
  expect_hit_and_overlap(ClosedForm<float>{});
  expect_hit_and_overlap(EndOfStep<float>{});
  expect_hit_and_overlap(CentreRay<float>{});
  expect_hit_and_overlap(Inclusion<float>{});
}

TEST(AnyNumber, a_method_in_float_serves_shapes_in_double) {
  const Moving shot{Sphere<double>{{-4, 0.25, 0}, 1}, {4, 0, 0}};
  EXPECT_EQ(time_of_impact(ClosedForm<float>{}, shot, at_rest(Aabb<double>{{0, 0, 0}, {1, 1, 1}})).time, 0.5);
}

TEST(AnyNumber, boxes_in_float_that_turn_have_too) {
  Obb<float> box{{0, 0, 0}, {1, 1, 1}, Mat3<float>::Identity()};
  box.axes(0, 1) = 0x1p-14F;
  const Turning shot{Sphere<float>{{-4, 0.25F, 0}, 1}, {4, 0, 0}, {0, 0, 1}};
  EXPECT_EQ(time_of_impact(LinearSweep<float>{}, shot, at_rest(box)).status, ToiStatus::hit);
  EXPECT_EQ(time_of_impact(shot, at_rest(box)).status, ToiStatus::hit);
  box.axes(0, 1) = 0x1p-12F;
  EXPECT_EQ(time_of_impact(shot, at_rest(box)).status, ToiStatus::invalid);
}

TEST(AnyNumber,
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

TEST(AnyNumber, boxes_far_beyond_their_sizes_are_apart) {  // products of their lengths overflow
  const Obb<double> box = scaled(usual(TypeTag<Obb<double>>{}), 480);
  const Vec3<double> far(-0x1p480, -0x1p987, 0x1p481);
  for (const double speed : {0x1p453, 0x1p480, 0x1p986}) {
    const Moving passing{moved(box, far), Vec3<double>(speed, speed, 0)};
    const auto toi = time_of_impact(ClosedForm<double>{.min_separation = 0.25}, passing, at_rest(box));
    EXPECT_EQ(toi.status, ToiStatus::apart) << speed;
  }
}

TEST(AnyNumber, a_turn_that_underflows_is_none) {
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
        EXPECT_TRUE(fuzz::is_unit(separation(box, turned).normal)) << e << " " << x << " " << y;
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
}  // namespace testing
}  // namespace thinwall
