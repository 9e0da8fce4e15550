#pragma once
/// What is known by hand of two shapes, or of a ray and a shape, asked of every query that tells of it.

#include <optional>
#include <source_location>
#include <type_traits>

#include <gtest/gtest.h>

#include <thinwall/discrete/queries.hpp>

namespace thinwall::testing {

/// `distance` [length] from A to B along `normal`, both exact; below zero: how deep they are in each other.
template <class A, class B, class S = typename A::Scalar>
void expect_gap(const A& a, const B& b, const std::type_identity_t<S>& distance,
                const std::type_identity_t<Vec3<S>>& normal,
                std::source_location where = std::source_location::current()) {
  const ::testing::ScopedTrace caller(where.file_name(), static_cast<int>(where.line()), "asked here");
  const Separation<S> gap = separation(a, b);
  EXPECT_EQ(gap.distance, distance);
  EXPECT_EQ(gap.normal, normal);
  EXPECT_EQ(overlaps(a, b), distance <= 0);
  const auto found = contact(a, b);
  ASSERT_EQ(found.has_value(), distance <= 0);
  if (!found) return;
  EXPECT_EQ(found->normal, normal);
  EXPECT_EQ(found->penetration, -distance);
}

/// The points of their contact, from the center of each, whichever is asked first.
template <class A, class B, class S = typename A::Scalar>
void expect_contact_at(const A& a, const B& b, const std::type_identity_t<Vec3<S>>& local_a,
                       const std::type_identity_t<Vec3<S>>& local_b,
                       std::source_location where = std::source_location::current()) {
  const ::testing::ScopedTrace caller(where.file_name(), static_cast<int>(where.line()), "asked here");
  const auto found = contact(a, b), back = contact(b, a);
  ASSERT_TRUE(found && back);
  EXPECT_EQ(found->local_a, local_a);
  EXPECT_EQ(found->local_b, local_b);
  EXPECT_EQ(back->local_a, local_b);
  EXPECT_EQ(back->local_b, local_a);
}

/// The same bits in all that they say.
template <class S> bool same(const Contact<S>& a, const Contact<S>& b) {
  return a.local_a == b.local_a && a.local_b == b.local_b && a.normal == b.normal && a.penetration == b.penetration;
}
template <class S> bool same(const Separation<S>& a, const Separation<S>& b) {
  return a.distance == b.distance && a.normal == b.normal && a.point_a == b.point_a && a.point_b == b.point_b;
}
template <class Answer> bool same(const std::optional<Answer>& a, const std::optional<Answer>& b) {
  return a && b ? same(*a, *b) : a.has_value() == b.has_value();
}

/// Where a ray first meets a shape; no normal: it starts in it, or in touch.
template <class A, class S = typename A::Scalar>
void expect_hit(const std::type_identity_t<Ray<S>>& ray, const A& shape, const std::type_identity_t<S>& t,
                const std::type_identity_t<Vec3<S>>& normal,
                std::source_location where = std::source_location::current()) {
  const ::testing::ScopedTrace caller(where.file_name(), static_cast<int>(where.line()), "asked here");
  const auto hit = raycast(ray, shape);
  ASSERT_TRUE(hit.has_value());
  EXPECT_EQ(hit->t, t);
  EXPECT_EQ(hit->normal, normal);
}

}  // namespace thinwall::testing
