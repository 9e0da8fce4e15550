#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <fmt/format.h>

#include <thinwall/experiments/stiff_contact/figures.hpp>
#include <thinwall/experiments/stiff_contact/pareto.hpp>
#include <thinwall/experiments/stiff_contact/series.hpp>
#include <thinwall/experiments/stiff_contact/theory.hpp>
#include <thinwall/experiments/stiff_contact/verdicts.hpp>

namespace thinwall {

namespace {

constexpr double least_spread = 1e-5;  // drawn in place of one that is less, down to 0

std::string label_of(Scheme scheme, Detection detection) {
  return fmt::format("{}, {}", name(scheme), name(detection));
}

/// Points and the line that joins them.
void add_joined(Panel& panel, Series points) {
  if (points.x.empty()) return;
  Series line = series_of(points.label, Mark::line);
  line.x = points.x;
  line.y = points.y;
  panel.series.push_back(std::move(line));
  panel.series.push_back(std::move(points));
}

Panel detection_panel(const StiffPlan& plan, const std::vector<ContactLine>& lines, std::string y_label,
                      const std::function<double(const ContactLine&)>& read) {
  const double ratio = plan.bounce_ratios[plan.bounce_ratios.size() / 2];
  Panel panel;
  panel.x_label = "h omega [1]";
  panel.y_label = std::move(y_label);
  panel.log_x = panel.log_y = true;
  panel.height = 0.9;
  for (const Scheme scheme : all_schemes) {
    for (const Detection detection : all_detections) {
      Series points = series_of(label_of(scheme, detection), Mark::points);
      for (const ContactLine& l : lines) {
        const PenaltyContact& c = l.contact;
        const bool drawn = c.scheme == scheme && c.detection == detection && c.damping_ratio == ratio &&
                           c.stiffness == plan.stiffest() && c.step <= last_step_of_bounces && is_clean(plan, l);
        if (!drawn || !(read(l) > 0)) continue;
        points.x.push_back(c.step);
        points.y.push_back(read(l));
      }
      add_joined(panel, std::move(points));
    }
  }
  return panel;
}

Panel race_panel(const StiffPlan& plan, const std::vector<StiffRacer>& racers, double ratio) {
  Panel panel;
  panel.x_label = "root mean square error of speed out over speed in [1]";
  panel.y_label = fmt::format("ns a bounce, damping ratio {:g}", ratio);
  panel.log_x = panel.log_y = true;
  panel.height = 0.9;
  for (const Scheme scheme : all_schemes) {
    for (const Detection detection : all_detections) {
      Series points = series_of(label_of(scheme, detection), Mark::points);
      for (const StiffRacer& r : racers) {
        const PenaltyContact& c = r.contact;
        if (c.scheme != scheme || c.detection != detection || c.damping_ratio != ratio) continue;
        if (r.tally.returned != plan.race_bounces || !(r.tally.square_error > 0)) continue;
        const BounceTime time = bounce_time(r);
        points.x.push_back(r.tally.rms_error());
        points.y.push_back(time.median);
        points.lower.push_back(time.interval.lower);
        points.upper.push_back(time.interval.upper);
      }
      add_joined(panel, std::move(points));
    }
  }
  return panel;
}

}  // namespace

Figure detection_figure(const StiffPlan& plan, const std::vector<ContactLine>& bounces) {
  const auto spread = [](const ContactLine& l) { return std::max(least_spread, l.tally.fastest - l.tally.slowest); };
  const auto error = [](const ContactLine& l) { return l.tally.rms_error(); };
  const auto depth = [&](const ContactLine& l) {
    return l.tally.deepest * frequency(spring_of(plan.approach, l.contact)) /
           (plan.approach.speed * deepest(l.contact.damping_ratio));
  };
  Figure figure;
  figure.name = "detection";
  figure.title = "Contact found at the poses, and steps split at the time of impact";
  figure.caption = fmt::format(
      "Damping ratio {:g}, {:g} N/m. Splitting the step takes away most of what depends on the phase (above), not the error of the "
      "scheme itself (middle: root mean square, against continuous time). Below: the greatest depth over that in continuous "
      "time.",
      plan.bounce_ratios[plan.bounce_ratios.size() / 2], plan.stiffest());
  figure.panels = {detection_panel(plan, bounces, "speed ratio, greatest - least [1]", spread),
                   detection_panel(plan, bounces, "speed ratio, error [1]", error),
                   detection_panel(plan, bounces, "depth / depth in continuous time [1]", depth)};
  std::erase_if(figure.panels, [](const Panel& p) { return p.series.empty(); });
  return figure;
}

Figure race_figure(const StiffPlan& plan, const std::vector<StiffRacer>& racers) {
  Figure figure;
  figure.name = "race";
  figure.title = "Error of a bounce against run time";
  figure.caption = fmt::format(
      "Every scheme and detection from the roughest step (right or below) to the finest, {:g} N/m, the same bounces. Bars, mostly "
      "hidden by their points: 95 % bootstrap intervals of the median time over interleaved rounds. A setting at which a bounce "
      "does not come back has no point.",
      plan.stiffest());
  figure.is_timing = true;
  for (const double ratio : plan.bounce_ratios) {
    Panel panel = race_panel(plan, racers, ratio);
    if (!panel.series.empty()) figure.panels.push_back(std::move(panel));
  }
  return figure;
}

}  // namespace thinwall
