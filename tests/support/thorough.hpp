#pragma once
/// How many random cases a test draws.

#include <cstddef>
#include <cstdlib>
#include <string>

namespace thinwall::testing {

/// THINWALL_THOROUGH=100 draws a hundred times as many as the test asks for, where it asks so.
inline std::size_t thorough(std::size_t cases) {
  const char* times = std::getenv("THINWALL_THOROUGH");
  return times != nullptr ? cases * std::stoul(times) : cases;
}

}  // namespace thinwall::testing
