#pragma once
/// Shots that every method is shown, for its tests by cases: template <class S> using Name = MethodCases<S>;

#include <gtest/gtest.h>

#include <thinwall/swept/time_of_impact.hpp>

#include "support/judge.hpp"

namespace thinwall::testing {

template <class S> struct MethodCases : ::testing::Test {
  const Moving<Aabb<S>> wall = at_rest(Aabb<S>{{0, 0, 0}, {0.125, 8, 8}});
  const Moving<Sphere<S>> shot{{{-1, 0, 0}, 0.25}, {2, 0, 0}};  // in contact from 0.3125 on
  const Moving<Sphere<S>> post = at_rest(Sphere<S>{{0, 0, 0}, 1});
  const Moving<Sphere<S>> graze{{{-4, 1.9375, 0}, 1}, {8, 0, 0}};    // of that post
  const Moving<Sphere<S>> passing{{{-4, 2.0625, 0}, 1}, {8, 0, 0}};  // beside it, by 1/16

  /// The fewer evaluations a method may make, the less it has proven: it says how much, and never too much.
  template <class Method> void expect_what_is_proven(bool more_each_time) const {
    const S exact = time_of_impact(graze, post).time;
    const Toi<S> enough = time_of_impact(Method{}, graze, post);
    ASSERT_EQ(enough.status, ToiStatus::hit);
    S before = 0;
    for (int n = 1; n < enough.evaluations - 1; ++n) {
      const Toi<S> toi = time_of_impact(Method{.max_evaluations = n}, graze, post);
      EXPECT_EQ(text(toi.status), text(ToiStatus::gave_up));
      EXPECT_EQ(toi.evaluations, n + 1);
      EXPECT_TRUE((more_each_time ? toi.time > before : toi.time >= before) && toi.time < exact) << n;
      EXPECT_EQ(toi.normal, Vec3<S>(0, 0, 0));
      before = toi.time;
    }
    EXPECT_TRUE(before > exact / 2);
  }
};

}  // namespace thinwall::testing
