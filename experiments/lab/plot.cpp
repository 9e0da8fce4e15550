#include <thinwall/experiments/lab/plot.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include <thinwall/experiments/lab/table_text.hpp>

namespace thinwall {
namespace {

constexpr int curve_points = 400;

std::optional<double> number_in(const Value& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  const auto* real = std::get_if<double>(&value);
  return real != nullptr && std::isfinite(*real) ? std::optional(*real) : std::nullopt;
}

}  // namespace

std::size_t Plot::place_of(std::string_view column) const {
  const auto found = std::ranges::find(table_.columns, column, &Column::name);
  if (found == table_.columns.end())
    throw std::logic_error("table '" + table_.name + "' has no column '" + std::string(column) + "'");
  return static_cast<std::size_t>(found - table_.columns.begin());
}

Plot& Plot::where(std::string_view column, const Value& value) {
  const std::size_t at = place_of(column);
  std::erase_if(table_.rows, [&](const auto& row) { return exact_text(row[at]) != exact_text(value); });
  return *this;
}

Plot& Plot::where(std::string_view column, const std::function<bool(double)>& is_it) {
  const std::size_t at = place_of(column);
  std::erase_if(table_.rows, [&](const auto& row) {
    const auto x = number_in(row[at]);
    return !x || !is_it(*x);
  });
  return *this;
}

Plot& Plot::x(std::string_view column, Axis axis, std::string label) {
  x_ = column;
  panel_.log_x = axis == Axis::log;
  panel_.x_label = label.empty() ? header_of(table_.columns[place_of(column)]) : std::move(label);
  return *this;
}

Plot& Plot::y(std::string_view column, Axis axis, std::string label) {
  y_ = column;
  panel_.log_y = axis == Axis::log;
  panel_.y_label = label.empty() ? header_of(table_.columns[place_of(column)]) : std::move(label);
  return *this;
}

Plot& Plot::by(std::string_view column) {
  by_ = column;
  return *this;
}

Plot& Plot::label(std::string label) {
  label_ = std::move(label);
  return *this;
}

Plot& Plot::mark(Mark mark) {
  mark_ = mark;
  return *this;
}

Plot& Plot::height(double share) {
  panel_.height = share;
  return *this;
}

Plot& Plot::curve(std::string label, const std::function<double(double)>& f, Mark mark) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  return curve(std::move(label), f, nan, nan, mark);
}

Plot& Plot::curve(std::string label, const std::function<double(double)>& f, double from, double to, Mark mark) {
  curves_.push_back({std::move(label), f, from, to, mark});
  return *this;
}

Plot& Plot::line(std::string label, std::vector<double> xs, std::vector<double> ys, Mark mark) {
  panel_.series.push_back(
      {.label = std::move(label), .mark = mark, .x = std::move(xs), .y = std::move(ys), .lower = {}, .upper = {}});
  return *this;
}

Plot& Plot::through(std::string_view column, const std::string& label) {
  Plot lines = Plot(table_).x(x_).y(column).by(by_).mark(Mark::line);
  const auto at = [x = place_of(x_)](const auto& row) { return number_in(row[x]); };
  std::ranges::stable_sort(lines.table_.rows, {}, at);
  for (Series& series : Panel(lines).series) {
    series.label = label;
    panel_.series.push_back(std::move(series));
  }
  return *this;
}

Plot::operator Panel() const {
  Panel panel = panel_;
  panel.series.clear();
  const std::size_t x = place_of(x_), y = place_of(y_);
  const Column& measured = table_.columns[y];
  const bool has_bars = !measured.lower.empty() && !measured.upper.empty();
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const auto& row : table_.rows) {
    const auto at = number_in(row[x]), value = number_in(row[y]);
    if (!at || !value) continue;
    least = std::min(least, *at);
    most = std::max(most, *at);
    const std::string label = by_.empty() ? label_ : exact_text(row[place_of(by_)]);
    auto series = std::ranges::find(panel.series, label, &Series::label);
    if (series == panel.series.end()) {
      series = panel.series.insert(panel.series.end(),
                                   {.label = label, .mark = mark_, .x = {}, .y = {}, .lower = {}, .upper = {}});
    }
    series->x.push_back(*at);
    series->y.push_back(*value);
    if (!has_bars) continue;
    series->lower.push_back(number_in(row[place_of(measured.lower)]).value_or(*value));
    series->upper.push_back(number_in(row[place_of(measured.upper)]).value_or(*value));
  }
  for (Series& series : panel.series) {  // bars only where one of its points has an interval
    if (series.lower == series.y && series.upper == series.y) series.lower = series.upper = {};
  }
  panel.series.insert(panel.series.end(), panel_.series.begin(), panel_.series.end());
  for (const Curve& curve : curves_) {
    const double from = std::isnan(curve.from) ? least : curve.from, to = std::isnan(curve.to) ? most : curve.to;
    if (!(from < to)) continue;
    Series& series = panel.series.emplace_back();
    series.label = curve.label;
    series.mark = curve.mark;
    for (int i = 0; i <= curve_points; ++i) {
      const double share = static_cast<double>(i) / curve_points;
      const double at = panel.log_x ? from * std::pow(to / from, share) : from + (to - from) * share;
      series.x.push_back(at);
      series.y.push_back(curve.f(at));
    }
  }
  return panel;
}

std::vector<Figure> only_measured(std::vector<Figure> figures) {
  const auto is_measured = [](const Series& series) { return series.mark == Mark::points && !series.y.empty(); };
  for (Figure& figure : figures)
    std::erase_if(figure.panels, [&](const Panel& panel) { return std::ranges::none_of(panel.series, is_measured); });
  std::erase_if(figures, [](const Figure& figure) { return figure.panels.empty(); });
  return figures;
}

Panel joined(Panel panel) {
  std::vector<Series> both;
  for (Series& points : panel.series) {
    both.push_back({.label = points.label, .mark = Mark::line, .x = points.x, .y = points.y, .lower = {}, .upper = {}});
    both.push_back(std::move(points));
  }
  panel.series = std::move(both);
  return panel;
}

}  // namespace thinwall
