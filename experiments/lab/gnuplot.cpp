#include <thinwall/experiments/lab/draw.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/method_looks.hpp>
#include <thinwall/experiments/lab/text.hpp>

namespace thinwall {

namespace {

constexpr int axis_digits = 6;  // significant, of the ends of an axis in a script

/// The least of 1, 2 and 5 times a power of ten that is not below `step`.
double round_step(double step) {
  const double power = std::pow(10, std::floor(std::log10(step)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= step) return factor * power;
  }
  return 10 * power;
}

/// 1, 2 and 5 in each decade, as a list; of a logarithmic axis so short that it holds less than two of them, places evenly apart.
std::string short_log_tics(const DrawnAxis& axis) {
  std::vector<std::string> places;
  for (int power = static_cast<int>(std::floor(std::log10(axis.lower))); std::pow(10, power) <= axis.upper; ++power) {
    for (const int factor : {1, 2, 5}) {
      const double at = factor * std::pow(10, power);
      if (at >= axis.lower && at <= axis.upper) places.push_back(rounded_text(at, 2));
    }
  }
  if (places.size() < 2) {
    places.clear();
    const double step = round_step((axis.upper - axis.lower) / 5);
    for (double k = std::ceil(axis.lower / step); k * step <= axis.upper; ++k)
      places.push_back(rounded_text(k * step, axis_digits));
  }
  return fmt::format("({})", fmt::join(places, ", "));
}

// Where the parts of a figure stand on its page, in pixels from the top left.

struct PanelBox {
  double top = 0, bottom = 0;
};

struct PlotLayout {
  double width = 760, height = 0;
  double left = 104, right = 736;        ///< of every panel: stacked panels are aligned
  double title_y = 24;                   ///< middle of the title
  double legend_x = 104, legend_y = 44;  ///< left and top of the legend: above the panels, or beside them if it is long
  std::size_t legend_rows = 1;
  double below = 50;     ///< from the panel's lower edge to the middle of its x label
  bool shared_x = true;  ///< one x axis for all panels, labeled once
  std::vector<PanelBox> panels;

  bool beside() const { return legend_x > right; }
};

// [pixel], for text of 15 pixels
constexpr double letter_width = 7.6, widest_letter = 9.4;  // of Arial; of what stands in for it
constexpr double legend_sample = 60, legend_row = 23;
constexpr std::size_t most_above = 6;            // entries of a legend above the panels; more stand beside them
constexpr double reserved_letter = 10.5;         // what gnuplot sets apart for a letter of the legend
constexpr double panel_height = 360;             // of a panel of height 1
constexpr double shared_gap = 16, own_gap = 74;  // between panels that share their x axis, and others
constexpr double bottom_margin = 66;
constexpr double named_x = 26, group_row = 20;  // more below a panel with short named tics, above one with named groups
constexpr double upright_letter = 6;            // of a name below a panel
constexpr double panel_width = 780;             // of a panel with names beside it

/// Of whatever has a label.
double letters_of_longest(const auto& labeled) {
  std::size_t longest = 0;
  for (const auto& one : labeled) longest = std::max(longest, one.label.size());
  return static_cast<double>(longest);
}

/// Room for the longest name beside the panels; 0 if there is none.
double room_for_names(const std::vector<Panel>& panels) {
  double longest = 0;
  for (const Panel& panel : panels) longest = std::max(longest, letters_of_longest(panel.y_tics));
  return longest == 0 ? 0 : 56 + widest_letter * longest;
}

/// The last column needs room for its text alone; those before it are as wide as gnuplot makes them.
std::size_t columns_that_fit(const std::vector<SeriesStyle>& styles, double width) {
  const double letters = letters_of_longest(styles);
  const double last = legend_sample + letter_width * letters, column = legend_sample + reserved_letter * letters;
  const auto fit = width < last ? std::size_t{1} : static_cast<std::size_t>(1 + (width - last) / column);
  return std::clamp<std::size_t>(fit, 1, std::max<std::size_t>(styles.size(), 1));
}

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
  double named = 0;
  for (const Panel& panel : figure.panels) {
    if (!panel.x_tics.empty())
      named = std::max({named, named_x, upright_letter * letters_of_longest(panel.x_tics) - 18});
  }
  out.below += named;
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
    top = bottom + (out.shared_x ? shared_gap : own_gap + named);
  }
  out.height = out.panels.back().bottom + bottom_margin + named;
  if (beside) out.height = std::max(out.height, out.legend_y + legend_row * static_cast<double>(out.legend_rows) + 16);
  return out;
}

// The palette of Okabe and Ito, which the color-blind can tell apart, without its yellow (too pale on white); black is
// for the first line, which is the theory.
constexpr std::array palette = {"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"};
constexpr std::array line_grays = {"#000000", "#767676"};

// Circle, square, triangle up, diamond, triangle down: open, because measurements lie on each other, then filled. Then a cross, a
// plus and a star: more shapes than colors, so that entries differ in gray too.
constexpr std::array point_types = {6, 4, 8, 12, 10, 7, 5, 9, 13, 11, 2, 1, 3};

void set_look(std::vector<SeriesStyle>& styles) {
  std::size_t steps = 0;
  for (SeriesStyle& style : styles) {
    const MethodLook* const look = style.color.empty() ? look_of(style.label) : nullptr;
    if (look == nullptr) continue;
    style.color = look->color;
    style.point_type = style.label.ends_with(" float") ? look->filled : look->point_type;
    if (look->name == "substeps") style.point_type = substeps_mark(steps++);
  }
  std::size_t lines = 0, colors = 0;
  for (SeriesStyle& style : styles) {
    if (!style.color.empty()) continue;
    const bool gray = !style.has_points && lines < line_grays.size();
    for (std::size_t tries = 0;; ++tries, ++colors) {
      style.color = gray ? line_grays[lines] : palette[colors % palette.size()];
      style.point_type = point_types[colors % point_types.size()];
      const auto is_taken = [&](const SeriesStyle& other) {  // by a method's own look: the mark, while there are others
        return &other != &style && other.has_points && other.point_type == style.point_type &&
               (tries < point_types.size() ? !other.color.empty() : other.color == style.color);
      };
      if (tries > (palette.size() + 1) * point_types.size() || !style.has_points ||
          std::ranges::none_of(styles, is_taken))
        break;
    }
    if (!style.has_points) ++lines;
    if (!gray) ++colors;
  }
}

constexpr double print_width = 6.3;  // [inch] A4 with margins of an inch

/// Words as a string of the script; LaTeX may have to spell them another way, and to gnuplot's SVG `]]>` would be an end.
std::string spelled(const std::string& text) {
  std::string plain = one_line(text);
  const std::string latex = latex_escaped(plain);
  const bool alike = latex == plain;
  replace_all(plain, "]]>", "]] >");
  return alike ? gnuplot_quoted(plain) : fmt::format("text_of({}, {})", gnuplot_quoted(plain), gnuplot_quoted(latex));
}

void require_drawable(const Figure& figure) {
  const std::string figure_name = "figure '" + figure.name + "'";
  constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyz0123456789_-";
  if (figure.name.empty() || figure.name.find_first_not_of(plain) != std::string::npos) {
    throw std::logic_error(figure_name + ": a name is of a-z, 0-9, _ and -");
  }
  if (figure.panels.empty()) throw std::logic_error(figure_name + " has no panel");
  for (const Panel& panel : figure.panels) {
    for (const Series& series : panel.series) {
      const std::size_t n = series.x.size(), bars = series.lower.size(), x_bars = series.x_lower.size();
      if (series.y.size() != n || series.upper.size() != bars || (bars != 0 && bars != n) ||
          series.x_upper.size() != x_bars || (x_bars != 0 && x_bars != bars)) {
        throw std::logic_error(figure_name + ", series '" + series.label + "': lists of different length");
      }
    }
  }
}

/// That shows all of these lists of every series, and every name on it.
DrawnAxis drawn_axis(std::span<const Panel> panels, const std::array<std::vector<double> Series::*, 3>& lists,
                     std::vector<Tic> Panel::*names, bool log) {
  std::vector<double> values;
  for (const Panel& panel : panels) {
    for (const Series& series : panel.series) {
      for (const auto list : lists) values.insert(values.end(), (series.*list).begin(), (series.*list).end());
    }
  }
  if ((panels[0].*names).empty()) return axis_around(values, log);
  for (const Panel& panel : panels) {
    for (const Tic& tic : panel.*names) values.push_back(tic.at);
  }
  const auto [least, most] = std::ranges::minmax(values);
  return {false, least - 0.6, most + 0.6};  // half a unit beyond all values: cells side by side
}

DrawnAxis x_axis(std::span<const Panel> panels) {
  return drawn_axis(panels, {&Series::x, &Series::x_lower, &Series::x_upper}, &Panel::x_tics, panels[0].log_x);
}

DrawnAxis y_axis(const Panel& panel) {
  return drawn_axis({&panel, 1}, {&Series::y, &Series::lower, &Series::upper}, &Panel::y_tics, panel.log_y);
}

std::string axis_lines(char name, const DrawnAxis& axis, double pixels, double spacing, bool labeled) {
  const bool powers = axis.log && axis.upper / axis.lower >= 1e4;
  const std::string steps = tics(axis, pixels, spacing);
  return fmt::format(
      "set {0}range [{1}:{2}]\n{3} logscale {0}\nset format {0} {4}\nset {0}tics autofreq\nset {0}tics {5}\n{6} m{0}tics\n",
      name, rounded_text(axis.lower, axis_digits), rounded_text(axis.upper, axis_digits), axis.log ? "set" : "unset",
      !labeled ? "''"
      : powers ? "text_of('10^{%T}', '$10^{%T}$')"
               : "text_of('%g', '$%g$')",
      steps, steps.ends_with(", 1e1") ? "set" : "unset");
}

/// The same for an axis whose tics have names, or are named on the other side, as x2.
std::string named_axis_lines(std::string_view name, const DrawnAxis& axis, const std::vector<Tic>& named,
                             bool labeled) {
  std::vector<std::string> list;
  for (const Tic& tic : named) {
    list.push_back(fmt::format("{} {}", spelled(labeled ? tic.label : ""), rounded_text(tic.at, 9)));
  }
  const char* look = name == "x" ? " rotate by 90 right font @small" : name == "x2" ? " scale 0 font @middling" : "";
  return fmt::format(
             "set {0}range [{1}:{2}]\nunset logscale {0}\nset {0}tics autofreq\nset {0}tics{3} noenhanced ({4})\n",
             name, rounded_text(axis.lower, axis_digits), rounded_text(axis.upper, axis_digits), look,
             fmt::join(list, ", ")) +
         (name == "x2" ? "" : fmt::format("unset m{}tics\n", name));
}

std::size_t point_count(const Panel& panel) {
  std::size_t count = 0;
  for (const Series& series : panel.series) count += series.mark == Mark::points ? series.x.size() : 0;
  return count;
}

/// What plots one series: its bars first, so that its points lie on them.
std::vector<std::string> plot_items(const std::string& file, const Series& series, std::size_t block,
                                    std::ptrdiff_t style, bool crowded) {
  const std::string from = fmt::format("'{}' index {}", file, block);
  if (series.mark == Mark::cells) {
    return {fmt::format("{} using 1:2:(0.46):(0.46) with boxxyerror linestyle {} fillstyle solid noborder notitle",
                        from, style)};
  }
  const bool points = series.mark == Mark::points;
  const char* with = points ? "points" : "lines";
  const char* size = points && crowded ? " pointsize 0.5" : "";
  std::vector<std::string> items;
  if (!series.lower.empty()) {
    items.push_back(fmt::format("{0} using 1:3:(0):($4-$3) with vectors nohead linestyle {1} notitle", from, style));
  }
  if (!series.x_lower.empty()) {
    items.push_back(fmt::format("{0} using 5:2:($6-$5):(0) with vectors nohead linestyle {1} notitle", from, style));
  }
  items.push_back(fmt::format("{} using 1:2 with {} linestyle {}{} notitle", from, with, style, size));
  return items;
}

std::string legend_item(const SeriesStyle& style, std::size_t number) {
  const char* with = style.has_cells                      ? "boxes"
                     : style.has_points && style.has_line ? "linespoints"
                     : style.has_points                   ? "points"
                                                          : "lines";
  return fmt::format("keyentry with {} linestyle {}{} title {}", with, number,
                     style.has_cells ? " fillstyle solid noborder" : "", spelled(style.label));
}

std::vector<std::string> legend_items(const std::vector<SeriesStyle>& styles) {
  std::vector<std::string> items;
  for (const SeriesStyle& style : styles) items.push_back(legend_item(style, items.size() + 1));
  return items;
}

std::string preamble(const Figure& figure, const std::vector<SeriesStyle>& styles, const PlotLayout& layout) {
  std::string out = fmt::format(
      "# {0}\n# Change what you like, then draw it again from inside this folder:\n"
      "#   gnuplot {1}.gp                      {1}.svg\n"
      "#   gnuplot -e \"format='pdf'\" {1}.gp    {1}.pdf\n"
      "#   gnuplot -e \"format='tex'\" {1}.gp    {1}-latex.tex and {1}-latex.pdf, to \\input in LaTeX (graphicx, color)\n"
      "reset\nset encoding utf8\nif (!exists('format')) format = 'svg'\nif (!exists('width')) width = {4}  # [inch] in print\n"
      "unit = format eq 'svg' ? 1 : 72 * width / {2:.0f}  # of the sizes below: a pixel, or [point] in print\n"
      "sized(units) = sprintf(',%.4g', units * unit)\n"
      "small = \"'\".sized(11).\"'\"; middling = \"'\".sized(13).\"'\"  # macros: the font of tics takes no expression\n"
      "text_of(plain, latex) = format eq 'tex' ? latex : plain\n"
      "if (format eq 'svg') set terminal svg size {2:.0f},{3:.0f} dynamic enhanced rounded background '#ffffff' name '{1}' "
      "font 'Arial,Helvetica,sans-serif,15'\n"
      "if (format eq 'pdf') set terminal pdfcairo size width,width*{3:.0f}/{2:.0f} enhanced rounded font 'Sans'.sized(15) "
      "fontscale 0.75 linewidth unit pointscale unit\n"
      "if (format eq 'tex') set terminal cairolatex pdf input size width,width*{3:.0f}/{2:.0f} colortext rounded font sized(15) "
      "linewidth unit pointscale unit\n"
      "set output format eq 'tex' ? '{1}-latex.tex' : '{1}.'.format\n\n# A style for each entry of the legend.\n",
      one_line(figure.title), figure.name, layout.width, layout.height, print_width);
  for (std::size_t i = 0; i < styles.size(); ++i) {
    out += fmt::format("set style line {} linecolor rgb '{}' linewidth {} dashtype {} pointtype {} pointsize 0.75\n",
                       i + 1, styles[i].color, styles[i].has_points ? "1.3" : "2", styles[i].dash_type,
                       styles[i].point_type);
  }
  const double left = layout.left / layout.width;
  out += fmt::format(
      "\nset style line 100 linecolor rgb '#e4e4e4' linewidth 0.7\nset style line 101 linecolor rgb '#404040' linewidth 1\n"
      "set errorbars 0\n"
      "set key at screen {6:.5f}, screen {1:.5f} left top vertical maxrows {2} Left reverse noenhanced samplen 2 "
      "spacing 1 width 1 textcolor rgb '#202020'\n"
      "set label 1 {3} at screen {0:.5f}, screen {4:.5f} left noenhanced font sized(18)\n"
      "set lmargin at screen {0:.5f}; set rmargin at screen {5:.5f}\nset multiplot\n",
      left, 1 - layout.legend_y / layout.height, layout.legend_rows, spelled(figure.title),
      1 - layout.title_y / layout.height, layout.right / layout.width, layout.legend_x / layout.width);
  if (layout.beside()) {  // a legend takes more columns than asked where its plot is not as high as it is
    out += fmt::format(
        "\n# The legend\nset tmargin at screen 1; set bmargin at screen 0\nset border 0; set tics nomirror scale 0; "
        "set format ''; set xrange [0:1]; set yrange [0:1]\nplot NaN notitle, \\\n     {}\nunset key\nunset label\n",
        fmt::join(legend_items(styles), ", \\\n     "));
  }
  return out +
         "\nset grid back linestyle 100\nset border 3 back linestyle 101\nset xzeroaxis linecolor rgb '#909090' linewidth 0.8\n"
         "set tics nomirror out scale 0.6 textcolor rgb '#202020'\n";
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
  if (decades < 2) return short_log_tics(axis);
  // Powers of ten. Without a start gnuplot counts from the end of the axis, and labels 4, 40 and 400.
  const int first = static_cast<int>(std::floor(std::log10(axis.lower)));
  return fmt::format("1e{}, 1e{}", first, std::max(1, static_cast<int>(std::ceil(decades / most))));
}

std::vector<SeriesStyle> series_styles(const Figure& figure) {
  std::vector<SeriesStyle> styles;
  for (const std::string& label : figure.roster) styles.push_back({.label = label, .has_points = true});
  std::vector<std::string> drawn;
  for (const Panel& panel : figure.panels) {
    for (const Series& series : panel.series) {
      drawn.push_back(series.label);
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
  std::erase_if(styles, [&](const SeriesStyle& s) { return std::ranges::find(drawn, s.label) == drawn.end(); });
  return styles;
}

std::string plot_script(const Figure& figure) {
  require_drawable(figure);
  const auto styles = series_styles(figure);
  const PlotLayout layout = plot_layout(figure, styles);
  const DrawnAxis shared_x = x_axis(figure.panels);
  std::string out = preamble(figure, styles, layout);
  std::size_t block = 0;
  for (std::size_t p = 0; p < figure.panels.size(); ++p) {
    const Panel& panel = figure.panels[p];
    const PanelBox& box = layout.panels[p];
    const bool x_labeled = !layout.shared_x || p + 1 == figure.panels.size();
    const auto up = [&](double y) { return 1 - y / layout.height; };
    out += fmt::format("\n# Panel {}\nset tmargin at screen {:.5f}; set bmargin at screen {:.5f}\n", p + 1, up(box.top),
                       up(box.bottom));
    const DrawnAxis x = layout.shared_x ? shared_x : x_axis({&panel, 1});
    out += panel.x_tics.empty() ? axis_lines('x', x, layout.right - layout.left, 80, x_labeled)
                                : named_axis_lines("x", x, panel.x_tics, x_labeled);
    out += panel.y_tics.empty() ? axis_lines('y', y_axis(panel), box.bottom - box.top, 44, true)
                                : named_axis_lines("y", y_axis(panel), panel.y_tics, true);
    out += panel.x_groups.empty() ? "unset x2tics\n" : named_axis_lines("x2", x, panel.x_groups, true);
    out += fmt::format("set label 2 {} at screen {:.5f}, graph 0.5 center rotate by 90 noenhanced\n",
                       spelled(panel.y_label), 20 / layout.width);
    out += fmt::format("set label 3 {} at graph 0.5, screen {:.5f} center noenhanced\n",
                       spelled(x_labeled ? panel.x_label : ""), up(box.bottom + layout.below));
    std::vector<std::string> items;
    const bool crowded = point_count(panel) > 400;
    for (const Series& series : panel.series) {
      const auto style = std::ranges::find(styles, series.label, &SeriesStyle::label);
      if (style == styles.end()) throw std::logic_error("no style for '" + series.label + "'");
      for (std::string& item : plot_items(figure.name + ".dat", series, block, style - styles.begin() + 1, crowded))
        items.push_back(std::move(item));
      ++block;
    }
    if (p == 0 && !layout.beside()) std::ranges::copy(legend_items(styles), std::back_inserter(items));
    if (items.empty()) items.emplace_back("NaN notitle");
    out += fmt::format("plot {}\nunset key\nunset label\n", fmt::join(items, ", \\\n     "));
  }
  return out + "\nunset multiplot\n";
}

std::string plot_data(const Figure& figure) {
  const auto number = [](double value) { return std::isfinite(value) ? exact_text(value) : "NaN"; };
  std::string out;
  for (std::size_t p = 0; p < figure.panels.size(); ++p) {
    for (const Series& series : figure.panels[p].series) {
      const bool bars = !series.lower.empty(), x_bars = !series.x_lower.empty();
      out += fmt::format("# panel {}, {}: x y{}{}\n", p + 1, one_line(series.label), bars ? " lower upper" : "",
                         x_bars ? " x_lower x_upper" : "");
      if (series.x.empty()) out += "NaN NaN NaN NaN NaN NaN\n";  // a block must not be empty
      for (std::size_t i = 0; i < series.x.size(); ++i) {
        out += number(series.x[i]) + " " + number(series.y[i]);
        if (bars) out += " " + number(series.lower[i]) + " " + number(series.upper[i]);
        if (x_bars) out += " " + number(series.x_lower[i]) + " " + number(series.x_upper[i]);
        out += "\n";
      }
      out += "\n\n";
    }
  }
  return out;
}

}  // namespace thinwall
