#pragma once
/// The swept bounds' pictures: false hits against the path, the direction and the size of what is hit.

#include <vector>

#include <thinwall/experiments/figure.hpp>
#include <thinwall/experiments/swept_bounds/line.hpp>

namespace thinwall {

/// Around `view`: one factor varies, the others are its. Bounds that are exact by construction are not drawn.
std::vector<Figure> sweep_figures(const std::vector<SweepLine>& lines, const std::vector<SweptBound>& bounds,
                                  const Sweep& view);

}  // namespace thinwall
