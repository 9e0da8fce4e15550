#include <thinwall/experiments/crossing_bullets/figures.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <string>

#include <fmt/format.h>

#include <thinwall/swept/methods.hpp>

namespace thinwall {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double curve_step = 5, end_step = 2;  // [deg], finer within 10 degrees of the ends
constexpr const char* angle_label = "angle between the motions [deg], 180 is head-on";

/// What a panel shows of a line, and of the theory.
struct Quantity {
  std::function<double(const CrossingLine&)> measured;
  std::function<Interval(const CrossingLine&)> bars;
  std::function<double(const Crossing&)> theory;
};

/// Two pictures draw from the same integrals.
using Confirmed = std::function<ConfirmedTheory(const Crossing&)>;
Confirmed remembered() {
  return [known = std::map<std::string, ConfirmedTheory>()](const Crossing& c) mutable {
    const auto found = known.find(key(c));
    return found != known.end() ? found->second : known.emplace(key(c), confirmed_theory(c)).first->second;
  };
}

std::set<double> ratios_of(const std::vector<CrossingLine>& lines) {
  std::set<double> ratios;
  for (const CrossingLine& l : lines) ratios.insert(l.crossing.ratio);
  return ratios;
}

/// One curve a ratio over the angle, as one series with gaps.
Series theory_curves(const std::vector<CrossingLine>& lines, const Quantity& quantity) {
  Series series = {.label = "theory", .mark = Mark::line, .x = {}, .y = {}, .lower = {}, .upper = {}};
  for (const double ratio : ratios_of(lines)) {
    Crossing c = lines.front().crossing;
    c.ratio = ratio;
    double angle = ratio == 1 ? end_step : 0;
    while (angle <= 180) {
      c.angle_deg = ratio == 0 ? 0 : angle;
      series.x.push_back(angle);
      series.y.push_back(quantity.theory(c));
      angle += angle < 10 || angle >= 170 ? end_step : curve_step;
    }
    series.x.push_back(180);
    series.y.push_back(nan);
  }
  return series;
}

/// Lines of one speed and offset.
Panel panel(const std::vector<CrossingLine>& lines, std::string y_label, const Quantity& quantity) {
  Panel p;
  p.x_label = angle_label;
  p.y_label = std::move(y_label);
  for (const double ratio : ratios_of(lines)) {
    Series& series = p.series.emplace_back();
    series.label = ratio == 0 ? "slower ball at rest" : fmt::format("speed ratio {}", ratio);
    for (const CrossingLine& l : lines) {
      if (l.crossing.ratio != ratio) continue;
      series.x.push_back(l.crossing.angle_deg);
      series.y.push_back(quantity.measured(l));
      series.lower.push_back(quantity.bars(l).lower);
      series.upper.push_back(quantity.bars(l).upper);
    }
  }
  p.series.push_back(theory_curves(lines, quantity));
  return p;
}

using Choice = std::function<bool(const CrossingLine&)>;

std::vector<CrossingLine> chosen(const std::vector<CrossingLine>& lines, const Choice& choice) {
  std::vector<CrossingLine> result;
  std::copy_if(lines.begin(), lines.end(), std::back_inserter(result), choice);
  return result;
}

/// The least and the greatest, or the only one.
std::vector<double> ends(const std::set<double>& values) {
  if (values.empty()) return {};
  if (values.size() == 1) return {*values.begin()};
  return {*values.begin(), *values.rbegin()};
}

std::set<double> speeds_of(const std::vector<CrossingLine>& lines) {
  std::set<double> speeds;
  for (const CrossingLine& l : lines) speeds.insert(l.crossing.speed);
  return speeds;
}

std::string path_label(const Crossing& c) {
  return fmt::format("path {:.3g} R", c.speed * c.step / contact_distance(c));
}

/// A panel for the slowest and the fastest speed, at the narrowest disc.
std::vector<Panel> by_speed(const std::vector<CrossingLine>& lines, const std::string& y_label,
                            const Quantity& quantity) {
  std::vector<Panel> panels;
  for (const double speed : ends(speeds_of(lines))) {
    double narrowest = std::numeric_limits<double>::infinity();
    for (const CrossingLine& l : lines) {
      if (l.crossing.speed == speed) narrowest = std::min(narrowest, l.crossing.offset);
    }
    const auto drawn = chosen(
        lines, [&](const CrossingLine& l) { return l.crossing.speed == speed && l.crossing.offset == narrowest; });
    panels.push_back(panel(drawn, fmt::format("{}, {}", y_label, path_label(drawn.front().crossing)), quantity));
  }
  return panels;
}

Figure missed_figure(const std::vector<CrossingLine>& lines, const Confirmed& confirmed) {
  return {
      .name = "missed",
      .title = "What the tutorial's rule for two bodies misses",
      .caption =
          "Share of true hits that sweep_then_confirm does not see, with 95 % Wilson intervals, and the theory. "
          "Above the slowest, below the fastest ball; R is the contact distance.",
      .panels = by_speed(lines, "missed [1]",
                         {[](const CrossingLine& l) { return missed_share(l).value_or(nan); },
                          [](const CrossingLine& l) {
                            return l.tally.touching > 0 ? wilson(l.tally.missed, l.tally.touching) : Interval{nan, nan};
                          },
                          [&](const Crossing& c) { return 1 - confirmed(c).share / touch_theory(c); }})};
}

Figure lateness_figure(const std::vector<CrossingLine>& lines, const Confirmed& confirmed) {
  const auto share = [](const CrossingLine& l) { return mean_lateness(l).value_or(nan) / longest_contact(l.crossing); };
  const auto bars = [share](const CrossingLine& l) {
    const double sigma = l.theory.confirmed.lateness_sigma / longest_contact(l.crossing);
    const double half = 1.96 * sigma / std::sqrt(static_cast<double>(l.tally.timed));
    return Interval{share(l) - half, share(l) + half};
  };
  return {.name = "lateness",
          .title = "How late the hits of the tutorial's rule are",
          .caption =
              "Mean time from first contact to the answer of sweep_then_confirm, of the true hits it sees, over the "
              "longest time in contact, with 95 % intervals, and the theory. R is the contact distance.",
          .panels = by_speed(lines, "mean lateness / longest contact [1]",
                             {share, bars, [&](const Crossing& c) {
                                const ConfirmedTheory t = confirmed(c);
                                return t.share > 0 ? t.lateness_mean / longest_contact(c) : nan;
                              }})};
}

/// A panel for the narrowest and the widest disc that leaves room to pass, at the fastest speed.
Figure false_hits_figure(const std::vector<CrossingLine>& lines) {
  const double fastest = *speeds_of(lines).rbegin();
  std::set<double> offsets;
  for (const CrossingLine& l : lines) {
    if (l.crossing.speed == fastest && l.crossing.offset > 1) offsets.insert(l.crossing.offset);
  }
  const auto apart = [](const CrossingLine& l) { return l.tally.shots - l.tally.touching; };
  const Quantity quantity = {
      [apart](const CrossingLine& l) {
        return apart(l) > 0 ? static_cast<double>(l.tally.false_hits) / static_cast<double>(apart(l)) : nan;
      },
      [apart](const CrossingLine& l) {
        return apart(l) > 0 ? wilson(l.tally.false_hits, apart(l)) : Interval{nan, nan};
      },
      [](const Crossing& c) { return false_overlap_theory(c) / (1 - touch_theory(c)); }};
  Figure figure = {.name = "false_hits",
                   .title = "False hits of sweeping both balls and testing what they sweep",
                   .caption = fmt::format(
                       "Share of the encounters that do not touch in which the two swept volumes overlap, at {:g} m/s, "
                       "with 95 % Wilson intervals, and the theory. The centers pass within a disc whose radius is in "
                       "contact distances R.",
                       fastest),
                   .panels = {}};
  for (const double offset : ends(offsets)) {
    const auto drawn = chosen(
        lines, [&](const CrossingLine& l) { return l.crossing.speed == fastest && l.crossing.offset == offset; });
    figure.panels.push_back(panel(drawn, fmt::format("false hits [1], passing within {:g} R", offset), quantity));
  }
  return figure;
}

}  // namespace

std::vector<Figure> crossing_figures(const std::vector<CrossingLine>& lines) {
  // The head-on bullets belong into the pictures only where the settings fire at their speed too.
  const bool with_head_on = std::any_of(lines.begin(), lines.end(), [](const CrossingLine& l) {
    const Crossing& c = l.crossing;
    return c != head_on && c.speed == head_on.speed && c.step == head_on.step && c.radius == head_on.radius;
  });
  const auto of_rule = [&](std::string_view rule) {
    return chosen(lines,
                  [&](const CrossingLine& l) { return l.rule == rule && (with_head_on || l.crossing != head_on); });
  };
  const Confirmed theory = remembered();
  std::vector<Figure> figures;
  const auto confirm = of_rule(SweepThenConfirm<double>::name), swept = of_rule("swept_overlap");
  if (!confirm.empty()) figures.push_back(missed_figure(confirm, theory));
  if (!swept.empty()) figures.push_back(false_hits_figure(swept));
  if (!confirm.empty()) figures.push_back(lateness_figure(confirm, theory));
  std::erase_if(figures, [](const Figure& figure) { return figure.panels.empty(); });
  return figures;
}

}  // namespace thinwall
