#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <thinwall/experiments/stiff_contact/figures.hpp>
#include <thinwall/experiments/stiff_contact/series.hpp>
#include <thinwall/experiments/stiff_contact/theory.hpp>
#include <thinwall/experiments/stiff_contact/verdicts.hpp>

namespace thinwall {

namespace {

constexpr double least_drawn = 1e-3;  // drawn in place of a speed ratio that is less, down to 0
constexpr double sparse = 1.25;       // the map leaves out steps that are less than this factor apart
constexpr const char* step_label = "h omega [1]";

void add(Series& series, double x, double y) {
  series.x.push_back(x);
  series.y.push_back(y);
}

std::string label_of(double ratio) { return fmt::format("damping ratio {:g}", ratio); }

/// Both bounds of the undamped semi-implicit bounce, as one series with a gap.
Series bounds_curve(const StiffPlan& plan) {
  constexpr int count = 100;
  constexpr double last = 1.99;  // they end at 0 and infinity
  const double first = std::min(plan.bounce_steps.front(), last);
  Series series = series_of("bounds, undamped", Mark::line);
  for (const bool upper : {false, true}) {
    for (int i = 0; i <= count; ++i) {
      const double step = first * std::pow(last / first, static_cast<double>(i) / count);
      const auto bounds = bounce_bounds(std::min(step, last));
      add(series, step, upper ? bounds->upper : bounds->lower);
    }
    add(series, last, series_gap);
  }
  return series;
}

Panel bounce_panel(const StiffPlan& plan, const std::vector<ContactLine>& lines, Scheme scheme) {
  Panel p;
  p.x_label = step_label;
  p.y_label = fmt::format("speed out / in [1], {}", name(scheme));
  p.log_x = p.log_y = true;
  p.height = 0.9;
  if (scheme == Scheme::semi_implicit && plan.bounce_ratios.front() == 0) p.series.push_back(bounds_curve(plan));
  Series exact = series_of("continuous time", Mark::dashes);
  for (std::size_t i = plan.bounce_ratios.size(); i-- > 0;) {  // the least damped on top
    const double ratio = plan.bounce_ratios[i];
    Series points = series_of(label_of(ratio), Mark::points);
    for (const ContactLine& l : lines) {
      const PenaltyContact& c = l.contact;
      const bool drawn = c.scheme == scheme && c.damping_ratio == ratio && c.stiffness == plan.stiffest() &&
                         c.detection == Detection::discrete;
      if (!drawn || !is_clean(plan, l) || c.step > last_step_of_bounces) continue;
      add(points, c.step, std::max(least_drawn, l.tally.mean_speed()));
      points.lower.push_back(std::max(least_drawn, l.tally.slowest));
      points.upper.push_back(std::max(least_drawn, l.tally.fastest));
    }
    if (points.x.empty()) continue;
    add(exact, points.x.front(), restitution(ratio));
    add(exact, points.x.back(), restitution(ratio));
    add(exact, points.x.back(), series_gap);
    p.series.push_back(std::move(points));
  }
  p.series.push_back(std::move(exact));
  return p;
}

}  // namespace

Figure bounce_figure(const StiffPlan& plan, const std::vector<ContactLine>& bounces) {
  Figure figure;
  figure.name = "bounce";
  figure.title = "What one bounce off a wall that only pushes does to the speed";
  figure.caption = fmt::format(
      "Contact found at the poses, {:g} N/m. Points: the mean over the phases; bars: from the least to the greatest. The bounds "
      "of the undamped semi-implicit bounce are 1 / sqrt(1 - (h omega)^2 / 4) and its inverse.",
      plan.stiffest());
  for (const Scheme scheme : all_schemes) {
    Panel p = bounce_panel(plan, bounces, scheme);
    if (p.series.size() > 1) figure.panels.push_back(std::move(p));
  }
  return figure;
}

namespace {

Panel escape_panel(const StiffPlan& plan, const std::vector<ContactLine>& lines, Scheme scheme, Detection detection) {
  const Approach& e = plan.approach;
  const double ratio = plan.bounce_ratios.front();
  std::vector<double> steps;
  for (const double step : plan.bounce_steps) {
    if (steps.empty() || step >= sparse * steps.back()) steps.push_back(step);
  }
  Series returns = series_of("all return", Mark::points), fast = series_of("all return, some too fast", Mark::points);
  Series some = series_of("some get through", Mark::points), all = series_of("all get through", Mark::points);
  for (const ContactLine& l : lines) {
    const PenaltyContact& c = l.contact;
    if (c.scheme != scheme || c.detection != detection || c.damping_ratio != ratio) continue;
    if (std::find(steps.begin(), steps.end(), c.step) == steps.end()) continue;
    const ContactTally& t = l.tally;
    Series& series = t.escaped == t.bounces() ? all : t.escaped > 0 ? some : t.blown_up > 0 ? fast : returns;
    add(series, c.step, c.stiffness);
  }
  Panel p;
  p.x_label = step_label;
  p.y_label = fmt::format("stiffness [N/m], {} {}", scheme == Scheme::implicit_euler ? "implicit" : "semi-impl.",
                          detection == Detection::discrete ? "discrete" : "split");
  p.log_x = p.log_y = true;
  p.height = 0.75;
  // Where the path of a step is the way from first contact to the middle: step = omega reach / speed.
  Series path = series_of("a step goes to the wall's middle", Mark::line);
  Series soft = series_of("too soft in continuous time", Mark::dashes);
  const double limit = e.speed * deepest(ratio) / reach(e);
  for (const double step : {plan.bounce_steps.front(), plan.bounce_steps.back()}) {
    add(path, step, e.mass * (step * e.speed / reach(e)) * (step * e.speed / reach(e)));
    add(soft, step, e.mass * limit * limit);
  }
  // Only as far as the stiffnesses go.
  for (std::size_t i = 0; i < path.x.size(); ++i) {
    const double edge = std::clamp(path.y[i], plan.stiffness.front(), plan.stiffest());
    path.x[i] = std::sqrt(edge / e.mass) * reach(e) / e.speed;
    path.y[i] = edge;
  }
  p.series = {path, soft, returns, fast, some, all};
  std::erase_if(p.series, [](const Series& s) { return s.x.empty(); });
  return p;
}

}  // namespace

Figure escape_figure(const StiffPlan& plan, const std::vector<ContactLine>& bounces) {
  Figure figure;
  figure.name = "escape";
  figure.title = "Who gets through the wall";
  figure.caption = fmt::format(
      "{:g} m/s, {:g} kg, radius {:g} m, a wall of {:g} m, damping ratio {:g}. Too fast: more than {:g} times the incoming speed. "
      "Right of the line a step can place the ball past the middle of the wall, which then pushes it on. Splitting the step at the "
      "time of impact helps only the scheme that pushes at first touch.",
      plan.approach.speed, plan.approach.mass, plan.approach.radius, plan.approach.thickness,
      plan.bounce_ratios.front(), plan.approach.blow_up);
  for (const Scheme scheme : {Scheme::semi_implicit, Scheme::implicit_euler}) {
    for (const Detection detection : all_detections) {
      figure.panels.push_back(escape_panel(plan, bounces, scheme, detection));
    }
  }
  return figure;
}

}  // namespace thinwall
