#pragma once
/// A figure as data: panels of series. lab/draw.hpp turns it into a script and data, and those into an SVG.

#include <limits>
#include <string>
#include <vector>

namespace thinwall {

/// Cells: a unit square around each point, as in a heat map. Named in this order in draw.cpp.
enum class Mark { points, line, dashes, cells };

/// A tic with a name of its own.
struct Tic {
  double at;
  std::string label;
};

struct Series {
  std::string label;                               ///< legend entry; the same label has the same colour in every panel
  Mark mark = Mark::points;                        ///< theory is drawn with `line`, measurement with `points`
  std::vector<double> x = {}, y = {};              ///< equally long; NaN leaves a gap
  std::vector<double> lower = {}, upper = {};      ///< interval bars, as long as `y`, or both empty
  std::vector<double> x_lower = {}, x_upper = {};  ///< the same for `x`; only beside bars for `y`
  std::string color = {};                          ///< #rrggbb; empty: the next of the palette

  void add(double at, double value) {
    x.push_back(at);
    y.push_back(value);
  }
  /// A line does not lead from the last point to the next.
  void end_line() {
    if (!x.empty()) add(x.back(), std::numeric_limits<double>::quiet_NaN());
  }
};

struct Panel {
  std::string x_label;  ///< with unit
  std::string y_label;  ///< with unit
  bool log_x = false, log_y = false;
  double height = 1;  ///< [1] share of the figure's height, relative to the other panels
  std::vector<Series> series = {};
  std::vector<Tic> x_tics = {}, y_tics = {};  ///< in place of numbers; the axis then ends half a unit beyond its values
  std::vector<Tic> x_groups = {};             ///< names above the panel, of stretches of the x axis
};

struct Figure {
  std::string name;                      ///< the files are plots/<name>.svg, .gp, .dat
  std::string title;                     ///< what is seen, a short phrase
  std::string caption;                   ///< what it means, a sentence or two
  std::vector<Panel> panels = {};        ///< stacked from top to bottom
  bool is_timing = false;                ///< differs from run to run: left out of the manifest's hashes
  std::vector<std::string> roster = {};  ///< labels of points that get their looks first, drawn or not
};

}  // namespace thinwall
