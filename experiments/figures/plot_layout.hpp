#pragma once
/// Where the parts of a figure stand on its page, in pixels from the top left.

#include <vector>

#include <thinwall/experiments/figure.hpp>
#include <thinwall/experiments/figures/plot_style.hpp>

namespace thinwall {

struct PanelBox {
  double top = 0, bottom = 0;
};

struct PlotLayout {
  double width = 760, height = 0;
  double left = 104, right = 736;      ///< of every panel: stacked panels are aligned
  double title_y = 24, legend_y = 44;  ///< middle of the title, top of the legend
  std::size_t legend_rows = 1;
  double below = 50;     ///< from the panel's lower edge to the middle of its x label
  bool shared_x = true;  ///< one x axis for all panels, labeled once
  std::vector<PanelBox> panels;
};

PlotLayout plot_layout(const Figure& figure, const std::vector<SeriesStyle>& styles);

}  // namespace thinwall
