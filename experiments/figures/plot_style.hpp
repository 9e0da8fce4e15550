#pragma once
/// How the series of a figure look: apart in color, for the color-blind, and in grayscale.

#include <string>
#include <vector>

#include <thinwall/experiments/figure.hpp>

namespace thinwall {

/// The look of all series that share a label.
struct SeriesStyle {
  std::string label;
  std::string color;   ///< #rrggbb
  int point_type = 7;  ///< gnuplot's number
  int dash_type = 1;   ///< gnuplot's number
  bool has_points = false, has_line = false, has_cells = false;
};

/// One style for each label of the figure, in the order in which they first appear.
std::vector<SeriesStyle> series_styles(const Figure& figure);

/// The style of `label`, which must be there.
const SeriesStyle& style_of(const std::vector<SeriesStyle>& styles, const std::string& label);

}  // namespace thinwall
