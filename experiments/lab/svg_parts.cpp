#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include <thinwall/experiments/lab/method_looks.hpp>
#include <thinwall/experiments/lab/svg.hpp>
#include <thinwall/experiments/lab/text.hpp>

namespace thinwall {

namespace {

/// The least of 1, 2 and 5 times a power of ten that is not below `step`.
double round_step(double step) {
  const double power = std::pow(10, std::floor(std::log10(step)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= step) return factor * power;
  }
  return 10 * power;
}

/// 1, 2 and 5 in each decade, as a list.
std::string one_two_five(const DrawnAxis& axis) {
  std::string list;
  for (int power = static_cast<int>(std::floor(std::log10(axis.lower))); std::pow(10, power) <= axis.upper; ++power) {
    for (const int factor : {1, 2, 5}) {
      const double at = factor * std::pow(10, power);
      if (at >= axis.lower && at <= axis.upper) list += (list.empty() ? "" : ", ") + rounded_text(at, 2);
    }
  }
  return "(" + list + ")";
}

}  // namespace

DrawnAxis axis_around(std::span<const double> values, bool log) {
  constexpr double air = 0.04;            // [1] of the length of the axis
  constexpr double least_drawn = 1e-300;  // gnuplot divides an axis, and must not come upon subnormal numbers
  std::vector<double> shown;
  for (const double value : values) {
    const bool drawable = value == 0 || std::abs(value) >= least_drawn;
    if (std::isfinite(value) && drawable && (!log || value > 0)) shown.push_back(log ? std::log10(value) : value);
  }
  double lower = 0, upper = 1;
  if (!shown.empty()) {
    const auto [least, most] = std::ranges::minmax(shown);
    const double length = most - least;
    const bool flat = rounded_text(least, axis_digits) == rounded_text(most, axis_digits);  // but for rounding
    const double pad = !flat ? air * length : (log || least == 0 ? 0.5 : std::abs(least) / 2);
    lower = least - pad;
    upper = most + pad;
  }
  if (log) return {true, std::pow(10, lower), std::pow(10, upper)};
  return {false, lower, upper};
}

std::string tics(const DrawnAxis& axis, double pixels, double spacing) {
  const double most = std::max(2.0, pixels / spacing);
  if (!axis.log) return rounded_text(round_step((axis.upper - axis.lower) / most), 3);
  const double decades = std::log10(axis.upper / axis.lower);
  if (decades < 2) return one_two_five(axis);
  // Powers of ten. Without a start gnuplot counts from the end of the axis, and labels 4, 40 and 400.
  const int first = static_cast<int>(std::floor(std::log10(axis.lower)));
  return fmt::format("1e{}, 1e{}", first, std::max(1, static_cast<int>(std::ceil(decades / most))));
}

namespace {

// [pixel], for text of 15 pixels
constexpr double letter_width = 7.6, widest_letter = 9.4;  // of Arial; of what stands in for it
constexpr double legend_sample = 60, legend_row = 23;
constexpr std::size_t most_above = 6;            // entries of a legend above the panels; more stand beside them
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
  return longest == 0 ? 0 : 56 + widest_letter * static_cast<double>(longest);
}

double letters_of_longest(const std::vector<SeriesStyle>& styles) {
  std::size_t longest = 0;
  for (const SeriesStyle& style : styles) longest = std::max(longest, style.label.size());
  return static_cast<double>(longest);
}

/// The last column needs room for its text alone; those before it are as wide as gnuplot makes them.
std::size_t columns_that_fit(const std::vector<SeriesStyle>& styles, double width) {
  const double letters = letters_of_longest(styles);
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
  out.legend_x = out.left;
  double top = out.legend_y;
  const bool beside = styles.size() > most_above;
  if (beside) {
    out.legend_x = out.right + 20;
    out.legend_rows = styles.size();
    out.width = out.legend_x + legend_sample + widest_letter * letters_of_longest(styles);
    top += 10;
  } else {
    const std::size_t columns = columns_that_fit(styles, out.right - out.left);
    out.legend_rows = (styles.size() + columns - 1) / columns;
    top += legend_row * static_cast<double>(out.legend_rows) + 16;
  }
  for (const Panel& panel : figure.panels) {
    if (!panel.x_groups.empty()) top += group_row;
    const double bottom = top + panel_height * panel.height;
    out.panels.push_back({top, bottom});
    top = bottom + (out.shared_x ? shared_gap : own_gap + (named ? named_x : 0));
  }
  out.height = out.panels.back().bottom + bottom_margin + (named ? named_x : 0);
  if (beside) out.height = std::max(out.height, out.legend_y + legend_row * static_cast<double>(out.legend_rows) + 16);
  return out;
}

namespace {

// The palette of Okabe and Ito, which the color-blind can tell apart, without its yellow (too pale on white); black is
// for the first line, which is the theory.
constexpr std::array palette = {"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"};
constexpr std::array line_grays = {"#000000", "#767676"};

// Circle, square, triangle up, diamond, triangle down: open, because measurements lie on each other, then filled. Then a cross, a
// plus and a star: more shapes than colors, so that entries differ in gray too.
constexpr std::array point_types = {6, 4, 8, 12, 10, 7, 5, 9, 13, 11, 2, 1, 3};

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

}  // namespace thinwall
