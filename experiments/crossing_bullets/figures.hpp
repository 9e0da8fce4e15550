#pragma once
/// The crossing bullets' pictures.

#include <vector>

#include <thinwall/experiments/crossing_bullets/line.hpp>
#include <thinwall/experiments/figure.hpp>

namespace thinwall {

/// What the tutorial's rule misses, how many false hits sweeping both makes, how late the rule is: those of the three
/// whose rule was asked.
std::vector<Figure> crossing_figures(const std::vector<CrossingLine>& lines);

}  // namespace thinwall
