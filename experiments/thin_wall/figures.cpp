#include <thinwall/experiments/thin_wall/figures.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <string>

#include <thinwall/experiments/thin_wall/bounce_results.hpp>

namespace thinwall {

using namespace std::string_literals;

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double left = 0.1, right = 1000;  // of the pictures' axis; more to the right is all 1
constexpr const char* step_ratio_label = "step ratio  v h cos(angle) / (w + 2 r)  [1]";

using Number = std::function<double(const Line&)>;

std::vector<Line> drawn(const std::vector<Line>& lines, Wall wall, const Number& x) {
  const bool has_double =
      std::any_of(lines.begin(), lines.end(), [](const Line& line) { return line.detector->scalar == "double"; });
  std::vector<Line> chosen;
  for (const Line& line : lines) {
    const bool scalar = line.detector->scalar == (has_double ? "double" : "float");
    if (scalar && line.cell->wall == wall && left <= x(line) && x(line) <= right) chosen.push_back(line);
  }
  return chosen;
}

/// Of the cells that would be drawn into the same sixth of a decade, the first: enough to see, few enough to see through.
/// From left to right.
std::vector<Line> thinned(const std::vector<Line>& lines, const Number& x) {
  std::map<double, const Cell*> first;
  std::set<const Cell*> kept;
  for (const Line& line : lines) first.try_emplace(std::floor(6 * std::log10(x(line))), line.cell);
  for (const auto& [bin, cell] : first) kept.insert(cell);
  std::vector<Line> chosen;
  for (const Line& line : lines) {
    if (kept.count(line.cell) > 0) chosen.push_back(line);
  }
  std::stable_sort(chosen.begin(), chosen.end(), [&x](const Line& a, const Line& b) { return x(a) < x(b); });
  return chosen;
}

/// One series a method. No bars where `bars` is empty.
std::vector<Series> by_method(const std::vector<Line>& lines, const Number& x, const Number& y,
                              const std::function<Interval(const Line&)>& bars = {}) {
  std::vector<Series> all;
  for (const Line& line : lines) {
    auto found = std::find_if(all.begin(), all.end(),
                              [&](const Series& series) { return series.label == line.detector->method; });
    if (found == all.end()) {
      all.emplace_back().label = line.detector->method;
      found = all.end() - 1;
    }
    found->x.push_back(x(line));
    found->y.push_back(y(line));
    if (!bars) continue;
    found->lower.push_back(bars(line).lower);
    found->upper.push_back(bars(line).upper);
  }
  return all;
}

/// Methods that never tunnel would hide each other on the zero line: they take turns on it.
std::vector<Series> taking_turns(std::vector<Series> all) {
  const auto is_zero = [](const Series& series) {
    return std::all_of(series.y.begin(), series.y.end(), [](double y) { return y == 0; });
  };
  const auto sharing = static_cast<std::size_t>(std::count_if(all.begin(), all.end(), is_zero));
  std::size_t turn = 0;
  for (Series& series : all) {
    if (!is_zero(series)) continue;
    for (std::vector<double>* column : {&series.x, &series.y, &series.lower, &series.upper}) {
      std::vector<double> kept;
      for (std::size_t i = turn; i < column->size(); i += sharing) kept.push_back((*column)[i]);
      *column = kept;
    }
    ++turn;
  }
  return all;
}

/// y = curve(x / n) for every number of poses n that was fired, as one series with gaps.
Series theory_curves(const std::vector<Line>& lines, const std::function<double(double)>& curve) {
  std::set<int> poses;
  for (const Line& line : lines) {
    if (line.detector->poses_per_step > 0) poses.insert(line.detector->poses_per_step);
  }
  Series series = {.label = "theory", .mark = Mark::line, .x = {}, .y = {}, .lower = {}, .upper = {}};
  constexpr int samples = 400;
  for (const int n : poses) {
    for (int i = 0; i <= samples; ++i) {
      series.x.push_back(left * std::pow(right / left, static_cast<double>(i) / samples));
      series.y.push_back(curve(series.x.back() / n));
    }
    series.x.push_back(right);
    series.y.push_back(nan);
  }
  return series;
}

Series level(const char* label, double y) {
  return {.label = label, .mark = Mark::dashes, .x = {left, right}, .y = {y, y}, .lower = {}, .upper = {}};
}

double step_ratio(const Line& line) { return line.step_ratio; }

/// The mean chord of a finite wall thickened by the ball is its volume over its shadow.
double finite_step_ratio(const Line& line) {
  const RoundedBox box = rounded_box(*line.cell);
  return step_length(*line.cell) * shadow(box, direction(*line.cell)) / volume(box);
}

/// The methods' points first, so that they take the first colors; the theory over them.
Panel panel(std::string x_label, std::string y_label, std::vector<Series> points, Series theory) {
  Panel p;
  p.x_label = std::move(x_label);
  p.y_label = std::move(y_label);
  p.log_x = true;
  p.series = std::move(points);
  p.series.push_back(std::move(theory));
  return p;
}

}  // namespace

Figure probability_figure(const std::vector<Line>& lines) {
  const std::vector<Line> infinite = drawn(lines, Wall::infinite, step_ratio);
  Panel top = panel(step_ratio_label, "tunneling probability [1]",
                    taking_turns(by_method(thinned(infinite, step_ratio), step_ratio, probability, interval)),
                    theory_curves(infinite, [](double x) { return miss_probability(1, x); }));
  std::vector<Line> judged;
  std::copy_if(infinite.begin(), infinite.end(), std::back_inserter(judged),
               [](const Line& l) { return can_be_judged(l); });
  Panel bottom = panel(step_ratio_label, "residual [std. errors]",
                       by_method(judged, step_ratio, [](const Line& line) { return *residual(line); }),
                       level("95 % of residuals", -1.96));
  bottom.series.push_back(level("95 % of residuals", 1.96));
  bottom.height = 0.45;
  return {
      .name = "probability",
      .title = "How often a ball passes a thin wall unseen",
      .caption =
          "Infinite walls, double. Points are measured, with 95 % Wilson intervals; the line is the theory "
          "max(0, 1 - n (w + 2 r) / (v h cos(angle))) for n poses a step. "s +
          (judged.empty() ? "O" : "Above: o") +
          "ne cell in each sixth of a decade, methods that never tunnel taking turns on the zero line." +
          (judged.empty() ? "" : " Below: every cell in which at least 5 shots are expected to tunnel and 5 not to."),
      .panels = {std::move(top), std::move(bottom)}};
}

Figure bounce_figure(const std::vector<Line>& lines) {
  const Number through = [](const Line& l) {
    return static_cast<double>(went_through(l.tally)) / static_cast<double>(l.tally.shots);
  };
  const auto bars = [](const Line& l) { return wilson(went_through(l.tally), l.tally.shots); };
  const std::vector<Line> infinite = drawn(lines, Wall::infinite, step_ratio);
  Series unseen = theory_curves(infinite, [](double x) { return miss_probability(1, x); });
  unseen.label = "theory, unseen alone";
  unseen.mark = Mark::dashes;
  Panel all = panel(step_ratio_label, "share that went through [1]",
                    taking_turns(by_method(thinned(infinite, step_ratio), step_ratio, through, bars)),
                    theory_curves(infinite, [](double x) { return miss_probability(0.5, x); }));
  all.series.push_back(std::move(unseen));
  return {
      .name = "bounce",
      .title = "How often a ball that should bounce goes through",
      .caption =
          "Infinite walls, double. Points are measured, with 95 % Wilson intervals: shots that went through unseen, "
          "or were pushed out on the wrong side. The line is max(0, 1 - n (r + w / 2) / (v h cos(angle))) for n "
          "poses a step; the dashes are those unseen alone. Seen is not saved: the step that is safe is half as long.",
      .panels = {std::move(all)}};
}

Figure lateness_figure(const std::vector<Line>& lines) {
  const std::vector<Line> infinite = drawn(lines, Wall::infinite, step_ratio);
  const Number share = [](const Line& line) { return lateness_mean(line).value_or(nan) / slab_chord(*line.cell); };
  const auto bars = [&share](const Line& line) {  // the 95 % of a normal mean
    const double spread = line.theory.lateness ? line.theory.lateness->deviation / slab_chord(*line.cell) : nan;
    const double half = 1.96 * spread / std::sqrt(static_cast<double>(line.tally.detected()));
    return Interval{share(line) - half, share(line) + half};
  };
  return {
      .name = "lateness",
      .title = "How late a hit is detected",
      .caption =
          "Mean path length from first contact to detection, over the path length (w + 2 r) / cos(angle) in "
          "contact, with 95 % intervals. Infinite walls, double. The line is min(x / n, 1) / 2 for n poses a step. A ray from the "
          "center is late by what the radius leads it, r / cos(angle), however short the wall.",
      .panels = {panel(step_ratio_label, "mean lateness / path in contact [1]",
                       by_method(thinned(infinite, step_ratio), step_ratio, share, bars),
                       theory_curves(infinite, [](double x) { return std::min(x, 1.0) / 2; }))}};
}

Figure finite_figure(const std::vector<Line>& lines) {
  const std::vector<Line> finite = drawn(lines, Wall::finite, finite_step_ratio);
  return {.name = "finite",
          .title = "The same for walls that end",
          .caption =
              "Finite walls, double; aim uniform over the wall's shadow, rim included. Points are measured, with "
              "95 % Wilson intervals; the line is 1 - n / x for n poses a step, which holds where the poses are "
              "farther apart than the longest chord. A ray from the center misses what only the rim would hit.",
          .panels = {panel(
              "step over mean chord  v h shadow / volume  [1]", "tunneling probability [1]",
              taking_turns(by_method(thinned(finite, finite_step_ratio), finite_step_ratio, probability, interval)),
              theory_curves(finite, [](double x) { return miss_probability(1, x); }))}};
}

std::vector<Figure> with_points(std::vector<Figure> figures) {
  const auto has_points = [](const Panel& panel) {
    return std::any_of(panel.series.begin(), panel.series.end(), [](const Series& series) {
      const auto is_drawn = [](double y) { return std::isfinite(y); };
      return series.mark == Mark::points && std::any_of(series.y.begin(), series.y.end(), is_drawn);
    });
  };
  for (Figure& figure : figures) std::erase_if(figure.panels, [&](const Panel& panel) { return !has_points(panel); });
  std::erase_if(figures, [](const Figure& figure) { return figure.panels.empty(); });
  return figures;
}

}  // namespace thinwall
