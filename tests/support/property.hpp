#pragma once
/// Property tests that draw the same cases in every run.
/// RC_PARAMS="seed=1 max_success=1000" draws others, ten times as many.

#include <cstdlib>
#include <sstream>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "support/thorough.hpp"

namespace thinwall::testing {

/// Checks a property on about `runs` random cases; fewer where the oracle is slow, without optimization or sanitized.
template <class Testable> void check_property(int runs, const Testable& testable) {
  if constexpr (slow_build) runs = runs / 20 + 1;
  rc::detail::TestParams params;
  params.seed = 20261121;
  if (std::getenv("RC_PARAMS") != nullptr) params = rc::detail::configuration().testParams;
  params.disableShrinking = true;                      // a smaller number is no simpler case here
  params.maxSuccess = runs * params.maxSuccess / 100;  // RapidCheck's own default is 100
  const auto result = rc::detail::checkTestable(testable, rc::detail::TestMetadata{}, params);
  if (result.template is<rc::detail::SuccessResult>()) return;
  std::ostringstream message;
  rc::detail::printResultMessage(result, message);
  FAIL() << message.str();
}

/// A random integer in [low, high], at full range from the first case on.
inline int draw_integer(int low, int high) {
  return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(low, high + 1));
}

}  // namespace thinwall::testing

/// An assertion of a property that takes a judgment with a message.
#define THINWALL_PROPERTY(judgment)                                         \
  do {                                                                      \
    const ::testing::AssertionResult result_ = (judgment);                  \
    if (!result_) RC_FAIL(#judgment ": " + std::string(result_.message())); \
  } while (false)
