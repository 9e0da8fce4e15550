#pragma once
/// How much a test does.

#include <cstddef>
#include <cstdlib>
#include <string>

namespace thinwall::testing {

/// Not optimized, or sanitized: everything takes ten times as long, and it is the ways through the code that are looked at.
#if !defined(__OPTIMIZE__) || defined(__SANITIZE_ADDRESS__) || defined(THINWALL_SLOW_BUILD)
inline constexpr bool slow_build = true;
#else
inline constexpr bool slow_build = false;
#endif

/// THINWALL_THOROUGH=100 draws a hundred times as many as the test asks for, where it asks so.
inline std::size_t thorough(std::size_t cases) {
  const char* times = std::getenv("THINWALL_THOROUGH");
  return times != nullptr ? cases * std::stoul(times) : cases;
}

}  // namespace thinwall::testing
