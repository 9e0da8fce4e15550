#pragma once
/// A number with its interval, rounded to what the interval supports.

#include <string>

namespace thinwall {

struct IntervalText {
  std::string value, lower, upper;
};

/// The last digit shown is the first of half the interval's width, or the second where the first is 1 or 2:
/// 0.28723 in [0.28591, 0.28851] is 0.2872 [0.2859, 0.2885]. Whole numbers, such as a probability of 0, stay as they are. Four
/// significant digits where the interval has no width. All three finite, `lower` <= `upper`.
IntervalText interval_text(double value, double lower, double upper);

}  // namespace thinwall
