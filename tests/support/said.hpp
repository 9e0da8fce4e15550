#pragma once
/// What a text holds, and what a call throws.

#include <string>
#include <string_view>

#include <gtest/gtest.h>

namespace thinwall {

/// EXPECT_TRUE(holds(reply.err, "unknown key"));
inline ::testing::AssertionResult holds(std::string_view text, std::string_view part) {
  if (text.find(part) != text.npos) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "'" << part << "' is not in: " << text;
}

/// What the Error says that `act` throws; "" if it throws none: EXPECT_EQ(error_of<UsageError>([] { scene_from(""); }), "...").
template <class Error, class Act> std::string error_of(const Act& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace thinwall
