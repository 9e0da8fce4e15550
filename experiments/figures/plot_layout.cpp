#include <thinwall/experiments/figures/plot_layout.hpp>

#include <algorithm>

namespace thinwall {
namespace {

// [pixel], for text of 15 pixels
constexpr double letter_width = 7.6, legend_sample = 60, legend_row = 23;
constexpr double reserved_letter = 10.5;         // what gnuplot sets apart for a letter of the legend
constexpr double panel_height = 360;             // of a panel of height 1
constexpr double shared_gap = 16, own_gap = 74;  // between panels that share their x axis, and others
constexpr double bottom_margin = 66;
constexpr double named_x = 26, group_row = 20;  // more below a panel with named tics, above one with named groups
constexpr double panel_width = 780;             // of a panel with names beside it

/// Room for the longest name beside the panels; 0 if there is none.
double room_for_names(const std::vector<Panel>& panels) {
  std::size_t longest = 0;
  for (const Panel& panel : panels) {
    for (const Tic& tic : panel.y_tics) longest = std::max(longest, tic.label.size());
  }
  return longest == 0 ? 0 : 56 + letter_width * static_cast<double>(longest);
}

/// The last column needs room for its text alone; those before it are as wide as gnuplot makes them.
std::size_t columns_that_fit(const std::vector<SeriesStyle>& styles, double width) {
  std::size_t longest = 0;
  for (const SeriesStyle& style : styles) longest = std::max(longest, style.label.size());
  const double letters = static_cast<double>(longest);
  const double last = legend_sample + letter_width * letters, column = legend_sample + reserved_letter * letters;
  const auto fit = width < last ? std::size_t{1} : static_cast<std::size_t>(1 + (width - last) / column);
  return std::clamp<std::size_t>(fit, 1, std::max<std::size_t>(styles.size(), 1));
}

}  // namespace

PlotLayout plot_layout(const Figure& figure, const std::vector<SeriesStyle>& styles) {
  PlotLayout out;
  out.shared_x = std::ranges::all_of(figure.panels, [&](const Panel& panel) {
    return panel.x_label == figure.panels[0].x_label && panel.log_x == figure.panels[0].log_x;
  });
  if (const double room = room_for_names(figure.panels); room > 0) {
    out.left = room;
    out.right = room + panel_width;
    out.width = out.right + 24;
  }
  const bool named = std::ranges::any_of(figure.panels, [](const Panel& panel) { return !panel.x_tics.empty(); });
  if (named) out.below += named_x;
  const std::size_t legend_columns = columns_that_fit(styles, out.right - out.left);
  out.legend_rows = (styles.size() + legend_columns - 1) / legend_columns;
  double top = out.legend_y + legend_row * static_cast<double>(out.legend_rows) + 16;
  for (const Panel& panel : figure.panels) {
    if (!panel.x_groups.empty()) top += group_row;
    const double bottom = top + panel_height * panel.height;
    out.panels.push_back({top, bottom});
    top = bottom + (out.shared_x ? shared_gap : own_gap + (named ? named_x : 0));
  }
  out.height = out.panels.back().bottom + bottom_margin + (named ? named_x : 0);
  return out;
}

}  // namespace thinwall
