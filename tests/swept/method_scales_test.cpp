// Every method at any scale: lengths times a power of two change no bit of time and normal, as far as squares overflow.

#include <gtest/gtest.h>
#include <thinwall/swept/methods.hpp>
#include <thinwall/swept/shapes.hpp>
#include <thinwall/swept/time_of_impact.hpp>

#include "support/shaker.hpp"

namespace thinwall::testing {
namespace {

template <class S> class MethodScales : public ::testing::Test {};
TYPED_TEST_SUITE(MethodScales, Scalars, ScalarNames);

template <class A, class B> void expect_same_at_every_size(Shaker<typename A::Scalar>& draw) {
  using S = typename A::Scalar;
  const Motion<A, B> motion = drawn_motion<A, B>(draw);
  for_each_type(Methods<S>{}, [&]<class Method>(TypeTag<Method>) {
    if constexpr (serves<Method, A, B>) {
      const Toi<S> toi = time_of_impact(Method{}, motion.a, motion.b);
      // a drawn coordinate may have all digits of S and be 2^-70 of the largest
      constexpr int most = std::numeric_limits<S>::max_exponent > 1000 ? 700 : 30;
      for (const int k : {-most, -1, 1, most}) {
        const Toi<S> there = time_of_impact(Method{}, scaled(motion.a, k), scaled(motion.b, k));
        EXPECT_EQ(there.status, toi.status) << Method::name << " " << k;
        EXPECT_EQ(there.time, toi.time) << Method::name << " " << k;
        EXPECT_EQ(there.normal, toi.normal) << Method::name << " " << k;
        EXPECT_EQ(there.evaluations, toi.evaluations) << Method::name << " " << k;
      }
    }
  });
}

TYPED_TEST(MethodScales, no_bit_depends_on_the_unit_of_length) {
  using S = TypeParam;
  Shaker<S> draw(7);
  for (int i = 0; i < 200; ++i) {
    expect_same_at_every_size<Sphere<S>, Sphere<S>>(draw);
    expect_same_at_every_size<Aabb<S>, Sphere<S>>(draw);
    expect_same_at_every_size<Aabb<S>, Aabb<S>>(draw);
  }
}

TYPED_TEST(MethodScales, a_query_as_large_as_the_largest_number_is_answered) {
  using S = TypeParam;
  const S unit_length = std::numeric_limits<S>::max() / 16;
  for_each_type(Methods<S>{}, [&]<class Method>(TypeTag<Method>) {
    const Moving<Sphere<S>> shot{{Vec3<S>(-4, 0, 0) * unit_length, unit_length}, Vec3<S>(4, 0, 0) * unit_length};
    const auto box = at_rest(Aabb<S>{{0, 0, 0}, Vec3<S>(1, 1, 1) * unit_length});
    const Toi<S> toi = time_of_impact(Method{}, shot, box);
    EXPECT_EQ(toi.status, ToiStatus::hit) << Method::name;
    EXPECT_TRUE(toi.time >= S(0.5) - power<S>(-8) && toi.time <= S(1)) << Method::name;
  });
}

}  // namespace
}  // namespace thinwall::testing
