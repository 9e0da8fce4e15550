#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <thinwall/experiments/stiff_contact/figures.hpp>
#include <thinwall/experiments/stiff_contact/series.hpp>
#include <thinwall/experiments/stiff_contact/theory.hpp>

namespace thinwall {

namespace {

std::string words(Scheme scheme) {
  switch (scheme) {
    case Scheme::explicit_euler: return "explicit Euler";
    case Scheme::semi_implicit: return "semi-implicit Euler";
    case Scheme::implicit_euler: return "implicit Euler";
  }
  return "";
}

/// Twenty points a decade between the least and the greatest damping ratio.
Series limit_curve(const StiffPlan& plan, Scheme scheme) {
  Series series = series_of("formula", Mark::line);
  const double first =
      std::log10(*std::find_if(plan.ratios.begin(), plan.ratios.end(), [](double r) { return r > 0; }));
  const double last = std::log10(plan.ratios.back());
  const int count = std::max(1, static_cast<int>(std::ceil(20 * (last - first))));
  for (int i = 0; i <= count; ++i) {
    const double ratio = std::pow(10, first + (last - first) * i / count);
    series.x.push_back(ratio);
    series.y.push_back(step_limit(scheme, ratio).value_or(series_gap));
  }
  return series;
}

Panel panel(const StiffPlan& plan, const std::vector<LimitLine>& limits, Scheme scheme) {
  Series stable = series_of("decays", Mark::points), unstable = series_of("grows", Mark::points),
         measured = series_of("measured limit, every stiffness", Mark::points);
  for (const LimitLine& line : limits) {
    if (line.cell.scheme != scheme || line.cell.ratio == 0) continue;
    if (line.theory) {
      measured.x.push_back(line.cell.ratio);
      measured.y.push_back(std::sqrt(line.bracket.stable * line.bracket.unstable));
      measured.lower.push_back(line.bracket.stable);
      measured.upper.push_back(line.bracket.unstable);
    }
    if (line.cell.stiffness != plan.stiffness.front()) continue;
    for (std::size_t i = 0; i < plan.steps.size(); ++i) {
      const Verdict verdict = verdict_of(plan, line, i);
      if (verdict == Verdict::undecided) continue;
      Series& series = verdict == Verdict::stable ? stable : unstable;
      series.x.push_back(line.cell.ratio);
      series.y.push_back(plan.steps[i]);
    }
  }
  Panel p;
  p.x_label = "damping ratio zeta [1]";
  p.y_label = fmt::format("h omega [1], {}", words(scheme));
  p.log_x = p.log_y = true;
  p.height = 0.9;
  p.series = {limit_curve(plan, scheme), stable, unstable, measured};
  return p;
}

}  // namespace

Figure stability_figure(const StiffPlan& plan, const std::vector<LimitLine>& limits) {
  Figure figure;
  figure.name = "stability";
  figure.title = "Which steps a spring and damper can take";
  figure.caption = fmt::format(
      "A ball on a spring that holds both ways: does its state grow? Points: the steps of the map, at {:g} N/m. Triangles: the "
      "measured limit at every stiffness from {:g} to {:g} N/m, which lie on each other; their bars, from a step that decays to "
      "one that grows, are thinner than the line. Implicit Euler has no limit. The undamped case has no place on the axis.",
      plan.stiffness.front(), plan.stiffness.front(), plan.stiffest());
  if (plan.ratios.back() == 0) return figure;
  for (const Scheme scheme : all_schemes) figure.panels.push_back(panel(plan, limits, scheme));
  return figure;
}

}  // namespace thinwall
