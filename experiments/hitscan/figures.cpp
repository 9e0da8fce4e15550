#include <thinwall/experiments/hitscan/figures.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <thinwall/experiments/hitscan/figure_parts.hpp>

namespace thinwall {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double off(const HitscanLine& l) { return deflection(l.cell) / l.cell.target; }

/// The lens of flat fire over the deflection, for each radius.
Series flat_curves(const HitscanLines& lines, double (*share)(double, double, double)) {
  Series series = empty_series("theory, flat fire", Mark::line);
  const auto [least, most] =
      std::minmax_element(lines.begin(), lines.end(), [](const auto& a, const auto& b) { return off(a) < off(b); });
  const double from = off(*least), to = off(*most), target = lines.front().cell.target;
  constexpr int points = 400;
  for (const double radius : radii_of(lines)) {
    for (int i = 0; i <= points; ++i) {
      const double x = from * std::pow(to / from, static_cast<double>(i) / points);
      add_point(series, x, share(target, radius, x * target));
    }
    add_point(series, to, nan);
  }
  return series;
}

Panel over_deflection(std::string y_label, double height) {
  return {.x_label = "deflection at the range / radius of the target [1]",
          .y_label = std::move(y_label),
          .log_x = true,
          .height = height,
          .series = {}};
}

}  // namespace

Figure missed_figure(const HitscanLines& rays) {
  Panel missed = over_deflection("true hits missed [1]", 1.3);
  add_points(
      missed, rays, off, [](const HitscanLine& l) { return missed_share(l).value_or(nan); },
      [](const HitscanLine& l) {
        return l.tally.touching > 0 ? wilson(l.tally.missed, l.tally.touching) : Interval{nan, nan};
      });
  missed.series.push_back(flat_curves(rays, flat_missed));
  Panel wrong = over_deflection("hits that are false [1]", 1.3);
  add_points(
      wrong, rays, off, [](const HitscanLine& l) { return false_share(l).value_or(nan); },
      [](const HitscanLine& l) {
        return l.tally.reported() > 0 ? wilson(l.tally.false_hits, l.tally.reported()) : Interval{nan, nan};
      });
  wrong.series.push_back(flat_curves(rays, flat_false));
  Panel residuals = over_deflection("residual of the misses [standard errors]", 1);
  const auto residual = [](const HitscanLine& l) {
    if (!can_be_judged(l.tally.shots, l.expected.missed)) return nan;
    return standard_residual(l.tally.missed, l.tally.shots, l.expected.missed);
  };
  add_points(residuals, rays, off, residual, {});
  return {.name = "missed",
          .title = "What the ray of an instant bullet misses, and hits falsely",
          .caption =
              "Above, the share of true hits that hitscan does not see, in the middle, the share of its hits that "
              "are false, with 95 % Wilson intervals, against how far gravity and wind take the bullet from the "
              "line of fire. The curves are the lens that two discs share. Below, the residuals against the full "
              "theory.",
          .panels = {missed, wrong, residuals}};
}

std::vector<Figure> hitscan_figures(const std::vector<HitscanLine>& lines) {
  const auto first = std::find_if(lines.begin(), lines.end(), [](const HitscanLine& l) { return !is_known(l.cell); });
  if (first == lines.end()) return {};
  const HitscanCell& one = first->cell;
  const HitscanLines drawn = chosen(lines, [&](const HitscanLine& l) {
    return !is_known(l.cell) && l.cell.target == one.target && l.cell.step == one.step;
  });
  const HitscanLines rays =
      chosen(of_rule(drawn, hitscan_ray), [](const HitscanLine& l) { return deflection(l.cell) > 0; });
  const HitscanLines of_one_kind = chosen(drawn, [&](const HitscanLine& l) {
    return deflection(l.cell) > 0 && l.cell.drag == one.drag && l.cell.wind == one.wind && l.cell.radius == one.radius;
  });
  std::vector<Figure> figures;
  if (!rays.empty()) figures.push_back(missed_figure(rays));
  if (!of_one_kind.empty()) figures.push_back(path_error_figure(of_one_kind));
  if (Figure lateness = lateness_figure(drawn); !lateness.panels.empty()) figures.push_back(lateness);
  return figures;
}

}  // namespace thinwall
