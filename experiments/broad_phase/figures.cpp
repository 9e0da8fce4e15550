#include <algorithm>

#include <fmt/format.h>

#include <thinwall/experiments/broad_phase/report.hpp>

namespace thinwall {

namespace {

/// Names of the broad phases of all lines, in the order of their first appearance.
std::vector<std::string> finders_in(const std::vector<SurveyLine>& lines) {
  std::vector<std::string> names;
  for (const SurveyLine& line : lines) {
    for (const Finding& f : line.survey.findings) {
      if (std::find(names.begin(), names.end(), f.finder) == names.end()) names.push_back(f.finder);
    }
  }
  return names;
}

std::vector<SurveyLine> lines_like(const std::vector<SurveyLine>& lines, const CrowdFactors& f) {
  std::vector<SurveyLine> some;
  for (const SurveyLine& line : lines) {
    if (line.factors.clustered == f.clustered && line.factors.speed == f.speed) some.push_back(line);
  }
  std::sort(some.begin(), some.end(),
            [](const SurveyLine& a, const SurveyLine& b) { return a.factors.count < b.factors.count; });
  return some;
}

void add_series(Panel& panel, const std::vector<SurveyLine>& some, const std::string& finder, bool memory) {
  Series points{.label = finder, .mark = Mark::points, .x = {}, .y = {}, .lower = {}, .upper = {}};
  for (const SurveyLine& line : some) {
    const Finding* f = finding_of(line.survey, finder);
    if (f == nullptr || (memory && f->bytes.value_or(0) == 0)) continue;
    const TimeEstimate time = time_of(*f);
    const auto count = static_cast<double>(line.factors.count);
    points.x.push_back(count);
    if (memory) {
      points.y.push_back(1e-6 * static_cast<double>(*f->bytes));
      continue;
    }
    points.y.push_back(1e6 * time.median / count);
    points.lower.push_back(1e6 * time.interval.lower / count);
    points.upper.push_back(1e6 * time.interval.upper / count);
  }
  if (points.x.empty()) return;
  panel.series.push_back({.label = finder, .mark = Mark::line, .x = points.x, .y = points.y, .lower = {}, .upper = {}});
  panel.series.push_back(std::move(points));
}

Figure figure(const std::vector<SurveyLine>& lines, bool memory) {
  Figure figure;
  figure.name = memory ? "memory" : "times";
  figure.title = memory ? "Memory of finding all pairs" : "Time to find all pairs";
  figure.caption =
      memory
          ? "Working memory and pairs, beside the boxes themselves. Bullet's cannot be told."
          : "Nanoseconds a ball against the number of balls at constant density: level is linear growth. Medians over "
            "interleaved rounds, mostly wider than their 95 % bootstrap intervals.";
  figure.is_timing = true;
  std::vector<CrowdFactors> seen;
  for (const SurveyLine& line : lines) {
    const auto same = [&](const CrowdFactors& f) {
      return f.clustered == line.factors.clustered && f.speed == line.factors.speed;
    };
    if (std::any_of(seen.begin(), seen.end(), same)) continue;
    seen.push_back(line.factors);
    Panel panel;
    panel.x_label = "balls";
    panel.y_label = fmt::format("{}; {}, {:g} m a step", memory ? "MB" : "ns a ball", placement_name(line.factors),
                                line.factors.speed);
    panel.log_x = panel.log_y = true;
    const std::vector<SurveyLine> some = lines_like(lines, line.factors);
    for (const std::string& finder : finders_in(lines)) add_series(panel, some, finder, memory);
    if (!panel.series.empty()) figure.panels.push_back(std::move(panel));
  }
  return figure;
}

}  // namespace

std::vector<Figure> broad_phase_figures(const std::vector<SurveyLine>& lines) {
  std::vector<Figure> figures = {figure(lines, false), figure(lines, true)};
  std::erase_if(figures, [](const Figure& f) { return f.panels.empty(); });
  return figures;
}

}  // namespace thinwall
