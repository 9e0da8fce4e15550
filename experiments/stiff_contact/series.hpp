#pragma once
/// What the pictures of the stiff contact begin a series with.

#include <limits>
#include <string>
#include <utility>

#include <thinwall/experiments/figure.hpp>

namespace thinwall {

inline constexpr double series_gap = std::numeric_limits<double>::quiet_NaN();  ///< a point that parts a line
inline constexpr double last_step_of_bounces = 3;  ///< [1] h omega; beyond it a bounce is a matter of chance

inline Series series_of(std::string label, Mark mark) {
  return {.label = std::move(label), .mark = mark, .x = {}, .y = {}, .lower = {}, .upper = {}};
}

}  // namespace thinwall
