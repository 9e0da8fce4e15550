#include <thinwall/experiments/work_precision/figures.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <thinwall/swept/methods.hpp>

namespace thinwall {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double least_error = 0x1p-60;  // drawn in place of an error that is less, down to 0

double shown(double error) { return std::isfinite(error) ? std::max(error, least_error) : nan; }

/// Points of one method, from rough to fine, and the line that joins them.
void add_method(const Heat& heat, std::string_view method, bool by_time, std::vector<Series>& panel) {
  Series points = {.label = std::string(method), .mark = Mark::points, .x = {}, .y = {}, .lower = {}, .upper = {}};
  for (const Racer& r : heat.racers) {
    if (r.method != method || !std::isfinite(r.time.median)) continue;
    const Estimate time = by_time ? nanoseconds(r) : Estimate{r.evaluations, {r.evaluations, r.evaluations}};
    points.x.push_back(shown(r.time.median));
    points.x_lower.push_back(shown(r.time.median));
    points.x_upper.push_back(shown(std::isfinite(r.time.p99) ? r.time.p99 : 1));
    points.y.push_back(time.median);
    points.lower.push_back(time.interval.lower);
    points.upper.push_back(time.interval.upper);
  }
  if (points.x.empty()) return;
  Series line = {.label = points.label, .mark = Mark::line, .x = points.x, .y = points.y, .lower = {}, .upper = {}};
  panel.push_back(std::move(line));
  panel.push_back(std::move(points));
}

/// Corners at the 99th percentile errors of those nobody beats: below and left of it there is nobody.
Series front_line(const Heat& heat) {
  Series line = {.label = "Pareto front", .mark = Mark::dashes, .x = {}, .y = {}, .lower = {}, .upper = {}};
  double above = nan;
  for (const Racer* r : pareto_front(heat)) {
    const double x = shown(r->time.p99), y = median(r->nanoseconds);
    if (!line.x.empty()) {
      line.x.push_back(x);
      line.y.push_back(above);
    }
    line.x.push_back(x);
    line.y.push_back(y);
    above = y;
  }
  if (!line.x.empty()) {
    line.x.push_back(1);
    line.y.push_back(above);
  }
  return line;
}

/// One panel for each set of a class and scalar.
std::vector<Panel> panels_of(const std::vector<Heat>& heats, QueryClass kind, std::string_view scalar, bool by_time) {
  std::vector<Panel> panels;
  for (const Heat& heat : heats) {
    if (heat.kind != kind || heat.scalar != scalar) continue;
    Panel panel;
    panel.x_label = "error of the time of impact [step]: median, with a bar to the 99th percentile";
    panel.y_label = fmt::format("{}, {}", heat.set->name, by_time ? "ns a query" : "evaluations");
    panel.log_x = panel.log_y = true;
    panel.height = 0.9;
    if (by_time) panel.series.push_back(front_line(heat));
    for_each_type(Methods<double>{},
                  [&]<class Method>(TypeTag<Method>) { add_method(heat, Method::name, by_time, panel.series); });
    const auto has_points = [](const Series& s) { return s.mark == Mark::points; };
    if (std::any_of(panel.series.begin(), panel.series.end(), has_points)) panels.push_back(std::move(panel));
  }
  return panels;
}

Figure figure(const std::vector<Heat>& heats, QueryClass kind, std::string_view scalar, bool by_time) {
  const char* what = kind == QueryClass::hit ? "hits" : "grazes";
  Figure figure;
  figure.name = fmt::format("{}_{}_{}", what, scalar, by_time ? "time" : "evaluations");
  figure.title = fmt::format("Error against {}: {} in {}", by_time ? "run time" : "evaluations", what, scalar);
  figure.caption = fmt::format(
      "Each method along its option, from rough (right) to fine (left). {}A method that misses half of the contacts has no point; "
      "a bar that ends at 1 stands for one that misses more than 1 %. Errors below 1e-18 are drawn there.",
      by_time
          ? "Vertical bars, mostly hidden by their points: 95 % bootstrap intervals of the median time over interleaved "
            "rounds. The front joins the 99th percentile errors of those that nobody beats in both. "
          : "Evaluations are separations, overlap tests, rays or closed forms: a cost that no machine changes. ");
  figure.panels = panels_of(heats, kind, scalar, by_time);
  figure.is_timing = by_time;
  return figure;
}

}  // namespace

std::vector<Figure> work_precision_figures(const std::vector<Heat>& heats) {
  std::vector<Figure> figures = {
      figure(heats, QueryClass::hit, "double", true), figure(heats, QueryClass::graze, "double", true),
      figure(heats, QueryClass::hit, "float", true), figure(heats, QueryClass::hit, "double", false)};
  std::erase_if(figures, [](const Figure& f) { return f.panels.empty(); });
  return figures;
}

}  // namespace thinwall
