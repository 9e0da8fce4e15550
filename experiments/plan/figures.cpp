#include <algorithm>

#include <fmt/format.h>

#include <thinwall/experiments/plan/report.hpp>

namespace thinwall {

namespace {

/// The ways of all races, in the order of their first appearance; the plan itself left out.
std::vector<std::string> ways_in(const std::vector<PlanRace>& races) {
  std::vector<std::string> names;
  for (const PlanRace& race : races) {
    for (const Way& way : race.ways) {
      if (way.name != lean_way && std::find(names.begin(), names.end(), way.name) == names.end())
        names.push_back(way.name);
    }
  }
  return names;
}

Figure savings_figure(const std::vector<PlanRace>& races) {
  Panel panel;
  panel.x_label = "scene";
  panel.y_label = "time of a step over that of the plan [1]";
  panel.log_y = true;
  panel.height = 1.4;
  const std::vector<std::string> names = ways_in(races);
  for (std::size_t k = 0; k < races.size(); ++k) panel.x_tics.push_back({static_cast<double>(k), races[k].scene});
  for (std::size_t i = 0; i < names.size(); ++i) {
    Series series{.label = names[i], .mark = Mark::points, .x = {}, .y = {}, .lower = {}, .upper = {}};
    for (std::size_t k = 0; k < races.size(); ++k) {
      const Way* const way = way_named(races[k], names[i]);
      if (way == nullptr) continue;
      const Saved saved = saved_by(races[k], *way);
      const double lean = median(races[k].ways.front().milliseconds);
      const double aside = (static_cast<double>(i) + 0.5) / static_cast<double>(names.size()) - 0.5;
      series.x.push_back(static_cast<double>(k) + 0.7 * aside);
      series.y.push_back(1 + saved.milliseconds / lean);
      series.lower.push_back(1 + saved.interval.lower / lean);
      series.upper.push_back(1 + saved.interval.upper / lean);
    }
    panel.series.push_back(std::move(series));
  }
  return {
      .name = "savings",
      .title = "What a step costs with one omission taken back",
      .caption =
          "Above 1 is what the omission saves; the full plan takes back all of them. Same bits in each case, but for "
          "the gate, which is no omission. Medians over interleaved rounds, 95 % bootstrap intervals.",
      .panels = {std::move(panel)},
      .is_timing = true};
}

Figure gate_figure(const std::vector<GateLine>& shots) {
  Figure figure;
  figure.name = "gate";
  figure.title = "Shots that the motion gate never sees";
  figure.caption =
      "Points: share of the shots, 95 % Wilson intervals; lines: theory. A ball that moves more than the gate's part of its radius is "
      "swept, and never missed: each series falls to 0 beyond its gate.";
  for (const GateTarget target : {GateTarget::wall, GateTarget::ball}) {
    Panel panel;
    panel.x_label = "path of a step [radii]";
    panel.y_label = "missed, of shots at a " + gate_target_name(target) + " [1]";
    panel.log_x = true;
    for (const GateLine& line : shots) {
      if (line.cell.target != target) continue;
      const std::string label = fmt::format("gate {:g}", line.cell.gate);
      auto found = std::find_if(panel.series.begin(), panel.series.end(),
                                [&](const Series& s) { return s.label == label && s.mark == Mark::points; });
      if (found == panel.series.end()) {
        panel.series.push_back({.label = label, .mark = Mark::line, .x = {}, .y = {}, .lower = {}, .upper = {}});
        panel.series.push_back({.label = label, .mark = Mark::points, .x = {}, .y = {}, .lower = {}, .upper = {}});
        found = panel.series.end() - 1;
      }
      const Interval interval = wilson(line.tally.missed, line.cell.shots);
      found->x.push_back(line.cell.path);
      found->y.push_back(static_cast<double>(line.tally.missed) / static_cast<double>(line.cell.shots));
      found->lower.push_back(interval.lower);
      found->upper.push_back(interval.upper);
      Series& theory = *(found - 1);
      theory.x.push_back(line.cell.path);
      theory.y.push_back(missed_by_gate(line.cell));
    }
    figure.panels.push_back(std::move(panel));
  }
  return figure;
}

}  // namespace

std::vector<Figure> plan_figures(const PlanResults& results) {
  return {savings_figure(results.races), gate_figure(results.shots)};
}

}  // namespace thinwall
