#include <thinwall/experiments/lab/plot.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <thinwall/experiments/lab/table_text.hpp>
#include <thinwall/experiments/lab/text.hpp>

namespace thinwall {
namespace {

constexpr int curve_points = 400;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A word stands for itself; a number says what it is of: `radius 0.1 m`.
std::string legend_entry(const Column& column, const Value& value) {
  if (column.type == ColumnType::text) return exact_text(value);
  const bool has_unit = !column.unit.empty() && column.unit != "1";
  return fmt::format("{} {}{}", spaced(column.name), exact_text(value), has_unit ? " " + column.unit : "");
}

}  // namespace

void add_curve(Series& series, double from, double to, Axis axis, const std::function<double(double)>& f, int steps) {
  for (int i = 0; i <= steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    const double at = axis == Axis::log ? from * std::pow(to / from, share) : from + (to - from) * share;
    series.add(at, f(at));
  }
}

Plot& Plot::where(std::string_view column, const Value& value) {
  const std::size_t at = place_of(table_, column);
  std::erase_if(table_.rows, [&](const auto& row) { return exact_text(row[at]) != exact_text(value); });
  return *this;
}

Plot& Plot::where(std::string_view column, const std::function<bool(double)>& is_it) {
  const std::size_t at = place_of(table_, column);
  std::erase_if(table_.rows, [&](const auto& row) {
    const auto x = finite_number(row[at]);
    return !x || !is_it(*x);
  });
  return *this;
}

Plot& Plot::x(std::string_view column, Axis axis, std::string label) {
  x_ = column;
  panel_.log_x = axis == Axis::log;
  panel_.x_label = label.empty() ? header_of(table_.columns[place_of(table_, column)]) : std::move(label);
  return *this;
}

Plot& Plot::y(std::string_view column, Axis axis, std::string label) {
  y_ = column;
  panel_.log_y = axis == Axis::log;
  panel_.y_label = label.empty() ? header_of(table_.columns[place_of(table_, column)]) : std::move(label);
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
  return curve(std::move(label), f, nan, nan, mark);
}

Plot& Plot::curve(std::string label, const std::function<double(double)>& f, double from, double to, Mark mark) {
  curves_.push_back({std::move(label), f, from, to, mark});
  return *this;
}

Plot& Plot::line(std::string label, std::vector<double> xs, std::vector<double> ys, Mark mark) {
  panel_.series.push_back({.label = std::move(label), .mark = mark, .x = std::move(xs), .y = std::move(ys)});
  return *this;
}

Plot& Plot::through(std::string_view column, const std::string& label) {
  Plot lines = Plot(table_).x(x_).y(column).by(by_).mark(Mark::line);
  const auto at = [x = place_of(table_, x_)](const auto& row) { return finite_number(row[x]); };
  std::ranges::stable_sort(lines.table_.rows, {}, at);
  const std::vector<Series> drawn = Panel(lines).series;
  const bool is_seen = std::ranges::any_of(drawn, [](const Series& series) { return series.x.size() > 1; });
  for (Series series : drawn) {
    series.label = label;
    if (!is_seen) series.mark = Mark::points;  // a line of one point
    panel_.series.push_back(std::move(series));
  }
  return *this;
}

Plot::operator Panel() const {
  Panel panel = panel_;
  panel.series.clear();
  const std::size_t x = place_of(table_, x_), y = place_of(table_, y_);
  const Column &across = table_.columns[x], &measured = table_.columns[y];
  const auto has_bars = [](const Column& column) { return !column.lower.empty() && !column.upper.empty(); };
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const auto& row : table_.rows) {
    const auto at = finite_number(row[x]), value = finite_number(row[y]);
    if (!at || !value) continue;
    least = std::min(least, *at);
    most = std::max(most, *at);
    const std::string label =
        by_.empty() ? label_ : legend_entry(table_.columns[place_of(table_, by_)], row[place_of(table_, by_)]);
    auto series = std::ranges::find(panel.series, label, &Series::label);
    if (series == panel.series.end()) {
      series = panel.series.insert(panel.series.end(), {.label = label, .mark = mark_});
    }
    series->add(*at, *value);
    const auto add_bar = [&](const Column& column, double middle, auto& lower, auto& upper) {
      lower.push_back(has_bars(column) ? finite_number(row[place_of(table_, column.lower)]).value_or(middle) : middle);
      upper.push_back(has_bars(column) ? finite_number(row[place_of(table_, column.upper)]).value_or(middle) : middle);
    };
    if (has_bars(across)) add_bar(across, *at, series->x_lower, series->x_upper);
    if (has_bars(across) || has_bars(measured)) add_bar(measured, *value, series->lower, series->upper);
  }
  for (Series& series : panel.series) {  // bars only where one of its points has an interval
    if (series.x_lower == series.x && series.x_upper == series.x) series.x_lower = series.x_upper = {};
    if (series.x_lower.empty() && series.lower == series.y && series.upper == series.y)
      series.lower = series.upper = {};
  }
  panel.series.insert(panel.series.end(), panel_.series.begin(), panel_.series.end());
  for (const Curve& curve : curves_) {
    const double from = std::isnan(curve.from) ? least : curve.from, to = std::isnan(curve.to) ? most : curve.to;
    if (!(from < to)) continue;
    const auto is_its = [&](const Series& s) { return s.label == curve.label && s.mark == curve.mark; };
    auto series = std::ranges::find_if(panel.series, is_its);
    if (series == panel.series.end()) {
      series = panel.series.insert(panel.series.end(), {.label = curve.label, .mark = curve.mark});
    } else {
      series->end_line();
    }
    add_curve(*series, from, to, panel.log_x ? Axis::log : Axis::linear, curve.f, curve_points);
  }
  return panel;
}

std::vector<Figure> only_measured(std::vector<Figure> figures) {
  const auto is_measured = [](const Series& series) {
    return (series.mark == Mark::points || series.mark == Mark::cells) && !series.y.empty();
  };
  for (Figure& figure : figures)
    std::erase_if(figure.panels, [&](const Panel& panel) { return std::ranges::none_of(panel.series, is_measured); });
  std::erase_if(figures, [](const Figure& figure) { return figure.panels.empty(); });
  return figures;
}

Panel joined(Panel panel) {
  std::vector<Series> both;
  for (Series& series : panel.series) {
    if (series.mark == Mark::points)
      both.push_back({.label = series.label, .mark = Mark::line, .x = series.x, .y = series.y});
    both.push_back(std::move(series));
  }
  panel.series = std::move(both);
  return panel;
}

Panel taking_turns(Panel panel) {
  std::vector<Series*> sharing;
  for (Series& series : panel.series) {
    const bool is_zero = std::ranges::all_of(series.y, [](double y) { return y == 0; });
    if (series.mark == Mark::points && is_zero) sharing.push_back(&series);
  }
  const auto has_turn = [&](const Series* series) { return series->x.size() >= sharing.size(); };
  if (!std::ranges::all_of(sharing, has_turn)) return panel;  // one would vanish
  for (std::size_t turn = 0; turn < sharing.size(); ++turn) {
    Series& series = *sharing[turn];
    for (std::vector<double>* column :
         {&series.x, &series.y, &series.lower, &series.upper, &series.x_lower, &series.x_upper}) {
      std::vector<double> kept;
      for (std::size_t i = turn; i < column->size(); i += sharing.size()) kept.push_back((*column)[i]);
      *column = kept;
    }
  }
  return panel;
}

}  // namespace thinwall
