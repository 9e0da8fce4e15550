#pragma once
/// The pictures: heat maps of verdicts, errors and answers withheld, a panel a precision; the textbook's loss with its theory.

#include <vector>

#include <thinwall/experiments/extremes/line.hpp>
#include <thinwall/experiments/figure.hpp>

namespace thinwall {

std::vector<Figure> extreme_figures(const std::vector<ExtremeLine>& lines);

}  // namespace thinwall
