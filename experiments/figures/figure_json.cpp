#include <thinwall/experiments/figures/figure_json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <nlohmann/json.hpp>

#include <thinwall/experiments/json_reader.hpp>

namespace thinwall {
namespace {

using nlohmann::ordered_json;

constexpr std::array<std::pair<Mark, std::string_view>, 4> marks = {
    {{Mark::points, "points"}, {Mark::line, "line"}, {Mark::dashes, "dashes"}, {Mark::cells, "cells"}}};

/// The lists of a series, by name.
constexpr std::array<std::pair<const char*, std::vector<double> Series::*>, 6> lists = {
    {{"x", &Series::x},
     {"y", &Series::y},
     {"lower", &Series::lower},
     {"upper", &Series::upper},
     {"x_lower", &Series::x_lower},
     {"x_upper", &Series::x_upper}}};

/// The named tics of a panel, by name.
constexpr std::array<std::pair<const char*, std::vector<Tic> Panel::*>, 3> named_tics = {
    {{"x_tics", &Panel::x_tics}, {"y_tics", &Panel::y_tics}, {"x_groups", &Panel::x_groups}}};

ordered_json json_of(const Series& series) {
  const auto mark = std::ranges::find(marks, series.mark, &std::pair<Mark, std::string_view>::first);
  ordered_json out = {{"label", series.label}, {"mark", mark->second}, {"color", series.color}};
  for (const auto& [name, list] : lists) {
    out[name] = ordered_json::array();
    for (const double value : series.*list) out[name].push_back(std::isfinite(value) ? ordered_json(value) : nullptr);
  }
  return out;
}

ordered_json json_of(const Panel& panel) {
  ordered_json out = {{"x_label", panel.x_label}, {"y_label", panel.y_label}, {"log_x", panel.log_x},
                      {"log_y", panel.log_y},     {"height", panel.height},   {"series", ordered_json::array()}};
  for (const Series& series : panel.series) out["series"].push_back(json_of(series));
  for (const auto& [name, list] : named_tics) {
    out[name] = ordered_json::array();
    for (const Tic& tic : panel.*list) out[name].push_back({{"at", tic.at}, {"label", tic.label}});
  }
  return out;
}

bool is_mark(std::string_view text) {
  return std::ranges::find(marks, text, &std::pair<Mark, std::string_view>::second) != marks.end();
}

/// Also the letters that gnuplot is told without quotes of its own: none of them may end the quotes.
bool is_color(std::string_view text) {
  return text.empty() || (text.size() == 7 && text[0] == '#' &&
                          text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string_view::npos);
}

Series series_of(const JsonReader& in) {
  Series out;
  out.label = in.text("label");
  const std::string mark = in.text("mark", is_mark, "points, line, dashes or cells");
  out.mark = std::ranges::find(marks, mark, &std::pair<Mark, std::string_view>::second)->first;
  out.color = in.text("color", is_color, "#rrggbb, or nothing");
  for (const auto& [name, list] : lists) out.*list = in.numbers(name);
  return out;
}

Panel panel_of(const JsonReader& in) {
  Panel out;
  out.x_label = in.text("x_label");
  out.y_label = in.text("y_label");
  out.log_x = in.flag("log_x");
  out.log_y = in.flag("log_y");
  out.height = in.number("height");
  if (!(out.height > 0 && out.height <= 100)) in.complain("height", "a number > 0 and <= 100");
  for (const JsonReader& series : in.objects("series")) out.series.push_back(series_of(series));
  for (const auto& [name, list] : named_tics) {
    for (const JsonReader& tic : in.objects(name)) (out.*list).push_back({tic.number("at"), tic.text("label")});
  }
  return out;
}

}  // namespace

std::string figure_json(const Figure& figure) {
  ordered_json out = {{"name", figure.name}, {"title", figure.title}, {"panels", ordered_json::array()}};
  for (const Panel& panel : figure.panels) out["panels"].push_back(json_of(panel));
  return out.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

Figure parse_figure(const std::string& text, const std::string& file) {
  const JsonReader in(text, file);
  Figure out;
  out.name = in.text("name");
  out.title = in.text("title");
  for (const JsonReader& panel : in.objects("panels")) out.panels.push_back(panel_of(panel));
  return out;
}

}  // namespace thinwall
