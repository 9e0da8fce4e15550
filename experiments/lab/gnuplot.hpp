#pragma once
/// A figure as a script of gnuplot and its data: axes, marks, legends.

#include <span>
#include <string>
#include <vector>

#include <thinwall/experiments/lab/figure.hpp>

namespace thinwall {

// ---- The range of an axis, and where its tics stand.

struct DrawnAxis {
  bool log = false;
  double lower = 0, upper = 1;
};

/// An axis that shows every finite value (on a logarithmic one: every positive value) with a little air around them.
DrawnAxis axis_around(std::span<const double> values, bool log);

/// What follows `set xtics` in gnuplot, for an axis of so many pixels that `spacing` of them are enough between two tics.
std::string tics(const DrawnAxis& axis, double pixels, double spacing);

// ---- How the series of a figure look: apart in color, for the color-blind, and in grayscale.

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

// ---- The script and the data.

/// The script NAME.gp: run from inside its folder it reads NAME.dat and writes NAME.svg; with the variable `format` set to
/// 'pdf', NAME.pdf; to 'tex', NAME-latex.tex and NAME-latex.pdf. Throws std::logic_error if the figure's name cannot be a file's, or a
/// series' lists differ in length.
std::string plot_script(const Figure& figure);

/// The data NAME.dat: one block a series, in the order of the panels; columns x, y and, where
/// there are bars, lower, upper and x_lower, x_upper.
std::string plot_data(const Figure& figure);

}  // namespace thinwall
