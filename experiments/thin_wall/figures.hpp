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

}  // namespace thinwall
