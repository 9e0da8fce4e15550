#include <thinwall/experiments/swept_bounds/figures.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include <fmt/format.h>

namespace thinwall {

namespace {

/// What varies along x.
struct Factor {
  std::string label;
  bool log;
  double Sweep::*member;
  std::function<double(const Sweep&)> x;
};

/// Nothing but the factor, and the form, sets the cell apart from the view. Along x, the turn does not count.
bool belongs(Sweep s, const Factor& factor, const Sweep& view) {
  if (s.angle_deg == 0) s.turn_deg = view.turn_deg;
  s.*factor.member = view.*factor.member;
  s.form = view.form;
  return s == view;
}

bool drawable(const Sweep& s, const Factor& factor) { return !factor.log || factor.x(s) > 0; }

std::vector<SweepLine> chosen(const std::vector<SweepLine>& lines, const Factor& factor, const Sweep& view) {
  std::vector<SweepLine> result;
  std::copy_if(lines.begin(), lines.end(), std::back_inserter(result),
               [&](const SweepLine& l) { return drawable(l.sweep, factor) && belongs(l.sweep, factor, view); });
  std::stable_sort(result.begin(), result.end(), [&](const SweepLine& a, const SweepLine& b) {
    return a.sweep.*factor.member < b.sweep.*factor.member;
  });
  return result;
}

Series counted(const std::vector<SweepLine>& lines, const std::string& bound, const Factor& factor) {
  Series series = {.label = bound, .mark = Mark::points, .x = {}, .y = {}, .lower = {}, .upper = {}};
  for (const SweepLine& l : lines) {
    if (l.bound != bound || l.tally.reported == 0) continue;
    const Interval bar = wilson(l.tally.false_hits, l.tally.reported);
    series.x.push_back(factor.x(l.sweep));
    series.y.push_back(*false_fraction(l.tally));
    series.lower.push_back(bar.lower);
    series.upper.push_back(bar.upper);
  }
  return series;
}

/// From the least to the greatest value of the factor. All lines are of one bound's form.
Series expected(const std::vector<SweepLine>& lines, const SweptBound& bound, const Factor& factor) {
  Series series = {.label = bound.name, .mark = Mark::line, .x = {}, .y = {}, .lower = {}, .upper = {}};
  const double from = lines.front().sweep.*factor.member, to = lines.back().sweep.*factor.member;
  constexpr int steps = 90;  // a degree, where the factor is an angle
  Sweep s = lines.back().sweep;
  for (int i = 0; i <= steps; ++i) {
    const double part = static_cast<double>(i) / steps;
    s.*factor.member = factor.log ? from * std::pow(to / from, part) : from + (to - from) * part;
    series.x.push_back(factor.x(s));
    series.y.push_back(sweep_theory(bound.body(s), s).false_fraction);
  }
  return series;
}

/// A panel for each shape.
std::vector<Panel> panels(const std::vector<SweepLine>& lines, const std::vector<SweptBound>& bounds,
                          const Factor& factor) {
  std::vector<Panel> all;
  for (const SweptForm form : all_swept_forms) {
    std::vector<SweepLine> shown;
    std::copy_if(lines.begin(), lines.end(), std::back_inserter(shown),
                 [&](const SweepLine& l) { return l.sweep.form == form; });
    if (shown.empty()) continue;
    Panel panel = {.x_label = factor.label,
                   .y_label = fmt::format("false share [1], {}", name(form)),
                   .log_x = factor.log,
                   .log_y = false,
                   .height = 0.6,
                   .series = {}};
    for (const SweptBound& bound : bounds) {
      if (!bound.makes_volume || !bound.serves(form)) continue;
      panel.series.push_back(expected(shown, bound, factor));
      panel.series.push_back(counted(shown, bound.name, factor));
    }
    if (!panel.series.empty()) all.push_back(std::move(panel));
  }
  return all;
}

std::string motion_text(const Sweep& s) {
  return fmt::format("{:g} degrees from x and turned by {:g}", s.angle_deg, s.turn_deg);
}

constexpr const char* how =
    "Share of the balls reported that the shape does not touch, with 95 % Wilson intervals; the lines "
    "are Steiner's formula. ";

/// The view, turned as near to 45 degrees as there are cells: on the way to the space diagonal.
Sweep turned(Sweep view, const std::vector<SweepLine>& lines) {
  double turn = view.turn_deg;
  for (const SweepLine& l : lines) {
    const Sweep& s = l.sweep;
    if (s.angle_deg > 0 && std::abs(s.turn_deg - 45) < std::abs(turn - 45)) turn = s.turn_deg;
  }
  view.turn_deg = turn;
  return view;
}

}  // namespace

std::vector<Figure> sweep_figures(const std::vector<SweepLine>& lines, const std::vector<SweptBound>& bounds,
                                  const Sweep& view) {
  const Factor path = {"path in a step [widths]", true, &Sweep::speed, path_in_widths};
  const Factor angle = {"angle between motion and x [deg]", false, &Sweep::angle_deg,
                        [](const Sweep& s) { return s.angle_deg; }};
  const Factor obstacle = {"diameter of the balls hit [widths]", true, &Sweep::obstacle,
                           [](const Sweep& s) { return s.obstacle; }};
  const Sweep turned_view = turned(view, lines);
  const std::string balls = fmt::format("among balls of {:g} widths", view.obstacle);
  const std::string moves = fmt::format("a path of {:.3g} widths", path_in_widths(view));
  std::vector<Figure> figures = {
      {"false_hits", "False hits against the path: points counted, lines by Steiner's formula",
       fmt::format("{}Motion {}, {}.", how, motion_text(view), balls), panels(chosen(lines, path, view), bounds, path)},
      {"direction", "False hits against the direction: points counted, lines by theory",
       fmt::format("{}Motion turned by {:g} degrees: 54.7 is then the space diagonal if that is 45. At {}, {}.", how,
                   turned_view.turn_deg, moves, balls),
       panels(chosen(lines, angle, turned_view), bounds, angle)},
      {"obstacle", "False hits against the size of what is hit: points counted, lines by theory",
       fmt::format("{}Motion {}, {}.", how, motion_text(view), moves),
       panels(chosen(lines, obstacle, view), bounds, obstacle)}};
  std::erase_if(figures, [](const Figure& figure) { return figure.panels.empty(); });
  return figures;
}

}  // namespace thinwall
