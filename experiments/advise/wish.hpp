#pragma once
/// What the user of `thinwall advise` says: how the ball flies, and what must not happen to it.

#include <optional>
#include <string>

#include <thinwall/experiments/thin_wall/model.hpp>

namespace thinwall {

/// [1] What a chance or a ratio may be off by for rounding; a chance no larger is none.
inline constexpr double no_chance = 0x1p-50;

struct Wish {
  Cell cell;                        ///< the wall is infinite
  double miss = 0;                  ///< [1] the largest acceptable chance that a shot tunnels, 0 to 1
  std::optional<double> late = {};  ///< [m] >= 0: the farthest a ball may get past first contact before it is seen
};

/// The words behind the options, where given.
struct WishWords {
  std::optional<std::string> speed, radius, thickness, angle, step, fps, miss, late;
};

/// Throws UsageError.
Wish read_wish(const WishWords& words);

}  // namespace thinwall
