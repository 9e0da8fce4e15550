#pragma once
/// The thin wall's results as pictures: double only, since float's points would lie on the same spots.

#include <vector>

#include <thinwall/experiments/figure.hpp>
#include <thinwall/experiments/thin_wall/line.hpp>

namespace thinwall {

Figure probability_figure(const std::vector<Line>& lines);  ///< infinite walls, with residuals: the headline
Figure bounce_figure(const std::vector<Line>& lines);       ///< the same with a response, the wrong side included
Figure lateness_figure(const std::vector<Line>& lines);     ///< infinite walls
Figure finite_figure(const std::vector<Line>& lines);       ///< finite walls

/// Without the panels in which nothing was measured, and without the figures that then have none.
std::vector<Figure> with_points(std::vector<Figure> figures);

}  // namespace thinwall
