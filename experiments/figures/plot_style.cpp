#include <thinwall/experiments/figures/plot_style.hpp>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>

namespace thinwall {
namespace {

// The palette of Okabe and Ito, which the color-blind can tell apart, without its yellow (too pale on white); black is
// for the first line, which is the theory.
constexpr std::array palette = {"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"};
constexpr std::array line_grays = {"#000000", "#767676"};

// Circle, square, triangle up, diamond, triangle down: open, because measurements lie on each other, then filled. Then a cross, a
// plus and a star: more shapes than colors, so that entries differ in gray too.
constexpr std::array point_types = {6, 4, 8, 12, 10, 7, 5, 9, 13, 11, 2, 1, 3};

/// A method's own look, in every figure of every report: color and open mark, the filled one for its float. No two share both.
struct MethodLook {
  std::string_view name;
  const char* color;
  int point_type, filled;
};
constexpr std::array method_looks = {
    MethodLook{"end_of_step", "#D55E00", 4, 5},
    MethodLook{"substeps", "#E69F00", 8, 9},
    MethodLook{"centre_ray", "#CC79A7", 12, 13},
    MethodLook{"swept_volume_ray", "#56B4E9", 10, 11},
    MethodLook{"sweep_then_confirm", "#CC79A7", 2, 2},
    MethodLook{"speculative", "#009E73", 8, 9},
    MethodLook{"conservative_advancement", "#009E73", 12, 13},
    MethodLook{"bisection", "#E69F00", 1, 1},
    MethodLook{"inclusion", "#56B4E9", 4, 5},
    MethodLook{"closed_form", "#0072B2", 6, 7},
};

/// Of `closed_form`, `closed_form float` or `substeps_16`; of a label that is no method's, nothing.
const MethodLook* look_of(std::string_view label) {
  const std::string_view word = label.substr(0, label.find(' '));
  const auto is_its = [&](const MethodLook& look) {
    if (!word.starts_with(look.name)) return false;
    const std::string_view rest = word.substr(look.name.size());
    return rest.empty() || (rest[0] == '_' && rest.find_first_not_of("_0123456789") == std::string_view::npos);
  };
  const auto found = std::ranges::find_if(method_looks, is_its);
  return found == method_looks.end() ? nullptr : &*found;
}

void set_look(std::vector<SeriesStyle>& styles) {
  std::size_t steps = 0;  // of substeps_2, substeps_8, ... in one figure: one color, other marks
  for (SeriesStyle& style : styles) {
    const MethodLook* const look = style.color.empty() ? look_of(style.label) : nullptr;
    if (look == nullptr) continue;
    style.color = look->color;
    style.point_type = style.label.ends_with(" float") ? look->filled : look->point_type;
    if (look->name != "substeps") continue;
    constexpr std::array of_substeps = {8, 10, 3, 9, 11};
    style.point_type = of_substeps[steps++ % of_substeps.size()];
  }
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
