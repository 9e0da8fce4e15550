#pragma once
/// The pictures: error against run time, and against evaluations, one panel a set.

#include <vector>

#include <thinwall/experiments/figure.hpp>
#include <thinwall/experiments/work_precision/heat.hpp>

namespace thinwall {

std::vector<Figure> work_precision_figures(const std::vector<Heat>& heats);

}  // namespace thinwall
