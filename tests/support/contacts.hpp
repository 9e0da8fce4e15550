#pragma once
/// expect_contact(contact(a, b), normal, depth);

#include <optional>

#include <gtest/gtest.h>

#include <thinwall/discrete/results.hpp>

namespace thinwall::testing {

template <class S>
void expect_contact(const std::optional<Contact<S>>& found, const Vec3<S>& normal, const S& penetration) {
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->normal, normal);
  EXPECT_EQ(found->penetration, penetration);
}

}  // namespace thinwall::testing
