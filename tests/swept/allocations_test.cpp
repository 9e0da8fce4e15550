/// No query of a scalar of the processor's own allocates memory: not a plain one, and not one that takes every care.

#include <cstddef>
#include <cstdlib>
#include <new>

#include <gtest/gtest.h>

#include <thinwall/swept/time_of_impact.hpp>

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
