#pragma once
/// The bouncing ball's results as pictures.

#include <vector>

#include <thinwall/experiments/bouncing/results.hpp>
#include <thinwall/experiments/figure.hpp>

namespace thinwall {

/// `policies` draw the heights of one ball at the coarsest step.
std::vector<Figure> bouncing_figures(const BouncingResults& results, const std::vector<BouncePolicy>& policies);

}  // namespace thinwall
