#pragma once
/// What a race is run with.

#include <cstdint>
#include <string>
#include <vector>

namespace thinwall {

/// What the methods' options take, from rough to fine.
struct Ladder {
  std::vector<double> tolerances;   ///< [1] epsilon of double to 1; those that float cannot resolve are left out for it
  std::vector<std::int64_t> poses;  ///< [1] >= 1, of methods with a number of poses
};

struct RaceOptions {
  std::vector<std::string> methods;  ///< by name, of the method list
  Ladder ladder;
  std::int64_t queries = 0;  ///< >= 1, of each set, class and scalar
  std::int64_t rounds = 0;   ///< >= 1
  std::uint64_t seed = 0;
};

}  // namespace thinwall
