#include <thinwall/experiments/figures/plot_style.hpp>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace thinwall {
namespace {

// The palette of Okabe and Ito, which the color-blind can tell apart, without its yellow (too pale on white); black is
// for the first line, which is the theory.
constexpr std::array palette = {"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"};
constexpr std::array line_grays = {"#000000", "#767676"};

// Circle, square, triangle up, diamond, triangle down: open, because measurements lie on each other, then filled. Then a cross, a
// plus and a star: more shapes than colors, so that entries differ in gray too.
constexpr std::array point_types = {6, 4, 8, 12, 10, 7, 5, 9, 13, 11, 2, 1, 3};

void set_look(std::vector<SeriesStyle>& styles) {
  std::size_t lines = 0, colors = 0;
  for (SeriesStyle& style : styles) {
    if (!style.color.empty()) continue;
    const bool gray = !style.has_points && lines < line_grays.size();
    style.color = gray ? line_grays[lines] : palette[colors % palette.size()];
    style.point_type = point_types[colors % point_types.size()];
    if (!style.has_points) ++lines;
    if (!gray) ++colors;
  }
}

}  // namespace

std::vector<SeriesStyle> series_styles(const Figure& figure) {
  std::vector<SeriesStyle> styles;
  for (const Panel& panel : figure.panels) {
    for (const Series& series : panel.series) {
      auto style = std::ranges::find(styles, series.label, &SeriesStyle::label);
      if (style == styles.end())
        style = styles.insert(styles.end(), SeriesStyle{.label = series.label, .color = series.color});
      if (series.mark == Mark::points) style->has_points = true;
      if (series.mark == Mark::line || series.mark == Mark::dashes) style->has_line = true;
      if (series.mark == Mark::cells) style->has_cells = true;
      if (series.mark == Mark::dashes) style->dash_type = 2;
    }
  }
  set_look(styles);
  return styles;
}

const SeriesStyle& style_of(const std::vector<SeriesStyle>& styles, const std::string& label) {
  const auto style = std::ranges::find(styles, label, &SeriesStyle::label);
  if (style == styles.end()) throw std::logic_error("no series is labeled '" + label + "'");
  return *style;
}

}  // namespace thinwall
