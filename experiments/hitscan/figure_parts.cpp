#include <thinwall/experiments/hitscan/figure_parts.hpp>

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include <fmt/format.h>

namespace thinwall {

HitscanLines chosen(const HitscanLines& lines, const std::function<bool(const HitscanLine&)>& choice) {
  HitscanLines result;
  std::copy_if(lines.begin(), lines.end(), std::back_inserter(result), choice);
  return result;
}

HitscanLines of_rule(const HitscanLines& lines, const HitscanRule& rule) {
  return chosen(lines, [&](const HitscanLine& l) { return l.rule.name == rule.name; });
}

std::set<double> radii_of(const HitscanLines& lines) {
  std::set<double> radii;
  for (const HitscanLine& l : lines) radii.insert(l.cell.radius);
  return radii;
}

Series empty_series(std::string label, Mark mark) { return {std::move(label), mark, {}, {}, {}, {}}; }

void add_point(Series& series, double x, double y) {
  series.x.push_back(x);
  series.y.push_back(y);
}

void add_points(Panel& panel, const HitscanLines& lines, const HitscanRead& x, const HitscanRead& y,
                const HitscanBars& bars) {
  for (const double radius : radii_of(lines)) {
    Series series = empty_series(fmt::format("bullet radius {:g} mm", 1e3 * radius), Mark::points);
    for (const HitscanLine& l : lines) {
      if (l.cell.radius != radius) continue;
      add_point(series, x(l), y(l));
      if (!bars) continue;
      series.lower.push_back(bars(l).lower);
      series.upper.push_back(bars(l).upper);
    }
    panel.series.push_back(series);
  }
}

Series theory_through(HitscanLines lines, const HitscanRead& x, const HitscanRead& y) {
  Series series = empty_series("theory", Mark::line);
  std::stable_sort(lines.begin(), lines.end(), [&](const HitscanLine& a, const HitscanLine& b) { return x(a) < x(b); });
  for (const double radius : radii_of(lines)) {
    for (const HitscanLine& l : lines) {
      if (l.cell.radius == radius) add_point(series, x(l), y(l));
    }
    add_point(series, series.x.back(), std::numeric_limits<double>::quiet_NaN());
  }
  return series;
}

}  // namespace thinwall
