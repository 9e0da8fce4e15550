#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <thinwall/experiments/speed/report.hpp>
#include <thinwall/experiments/text/numbers.hpp>

namespace thinwall {

namespace {

constexpr double least_length = 1e-17;  // [m] drawn in place of an error that is less, down to 0

std::vector<std::string> names_of(const std::vector<const TimedWay*>& drawn) {
  std::vector<std::string> names;
  for (const TimedWay* c : drawn) {
    if (std::find(names.begin(), names.end(), name_of(*c)) == names.end()) names.push_back(name_of(*c));
  }
  return names;
}

std::vector<std::string> subjects_of(const std::vector<const TimedWay*>& drawn) {
  std::vector<std::string> subjects;
  for (const TimedWay* c : drawn) {
    if (std::find(subjects.begin(), subjects.end(), c->subject) == subjects.end()) subjects.push_back(c->subject);
  }
  return subjects;
}

void add_point(Series& series, const TimedWay& c) {
  const double p99 = std::max(least_length, error_of(c, "p99_length").value_or(0));
  const WayTime time = time_of(c);
  series.x.push_back(p99);
  series.x_lower.push_back(p99);
  series.x_upper.push_back(std::max(p99, error_of(c, "max_length").value_or(0)));
  series.y.push_back(time.median);
  series.lower.push_back(time.interval.lower);
  series.upper.push_back(time.interval.upper);
}

Panel race_panel(const std::vector<const TimedWay*>& drawn, const std::string& subject) {
  Panel panel;
  panel.x_label = "error of the time of impact, as a length [m]: 99th percentile, with a bar to the largest";
  panel.y_label = subject.empty() ? "ns a query" : subject + ", ns";
  panel.log_x = panel.log_y = true;
  panel.height = subject.empty() ? 1.6 : 0.8;
  for (const std::string& name : names_of(drawn)) {
    Series series{.label = name, .mark = Mark::points, .x = {}, .y = {}, .lower = {}, .upper = {}};
    for (const TimedWay* c : drawn) {
      if (name_of(*c) == name && (subject.empty() || c->subject == subject)) add_point(series, *c);
    }
    if (!series.x.empty()) panel.series.push_back(std::move(series));
  }
  return panel;
}

/// Who gives a wrong verdict, most of them first, in words.
std::string wrong_text(const std::vector<const TimedWay*>& drawn) {
  std::string text;
  for (const std::string& name : names_of(drawn)) {
    double missed = 0, false_hits = 0;
    for (const TimedWay* c : drawn) {
      if (name_of(*c) != name) continue;
      missed += error_of(*c, "missed").value_or(0);
      false_hits += error_of(*c, "false").value_or(0);
    }
    if (missed + false_hits == 0) continue;
    text += fmt::format("{}{} misses {} and invents {}", text.empty() ? "" : "; ", name,
                        grouped_text(static_cast<std::int64_t>(missed)),
                        grouped_text(static_cast<std::int64_t>(false_hits)));
  }
  return text.empty() ? "No verdict is wrong." : "Wrong verdicts, over all pairs: " + text + ".";
}

Figure race_figure(const std::vector<const TimedWay*>& drawn, bool a_panel_a_pair) {
  Figure figure;
  figure.name = a_panel_a_pair ? "error_against_time_by_pair" : "error_against_time";
  figure.title = a_panel_a_pair ? "Error against run time, pair by pair" : "Error against run time: a point a pair";
  figure.caption =
      "Left is finer, lower is faster. The error of hits that are found; what is missed has none. " +
      wrong_text(drawn) +
      " Vertical bars, mostly hidden by their points: 95 % bootstrap intervals of the median time. Errors below 1e-17 are drawn there.";
  figure.is_timing = true;
  if (!a_panel_a_pair) {
    figure.panels.push_back(race_panel(drawn, ""));
    return figure;
  }
  const bool any_peer = std::any_of(drawn.begin(), drawn.end(), [](const TimedWay* c) { return is_peer(*c); });
  for (const std::string& subject : subjects_of(drawn)) {
    const auto rival = [&](const TimedWay* c) { return c->subject == subject && is_peer(*c); };
    if (!any_peer || std::any_of(drawn.begin(), drawn.end(), rival))
      figure.panels.push_back(race_panel(drawn, subject));
  }
  return figure;
}

/// Wrong verdicts of each, by pair; who has none is not there.
Figure verdict_figure(const std::vector<const TimedWay*>& drawn) {
  const std::vector<std::string> subjects = subjects_of(drawn);
  Figure figure;
  figure.name = "wrong_verdicts";
  figure.title = "Wrong verdicts";
  figure.caption = "Who is not there has none. " + wrong_text(drawn);
  for (const char* counter : {"missed", "false"}) {
    Panel panel;
    panel.x_label = "of 100 000 queries, half of them hits";
    panel.y_label = std::string(counter) == "missed" ? "hits missed" : "hits invented";
    panel.log_x = true;
    for (const std::string& name : names_of(drawn)) {
      Series series{.label = name, .mark = Mark::points, .x = {}, .y = {}, .lower = {}, .upper = {}};
      for (const TimedWay* c : drawn) {
        const double wrong = error_of(*c, counter).value_or(0);
        if (name_of(*c) != name || wrong == 0) continue;
        const auto at = std::find(subjects.begin(), subjects.end(), c->subject);
        series.x.push_back(wrong);
        series.y.push_back(static_cast<double>(subjects.end() - at));  // the first on top
      }
      if (!series.x.empty()) panel.series.push_back(std::move(series));
    }
    for (std::size_t i = 0; i < subjects.size(); ++i)
      panel.y_tics.push_back({static_cast<double>(i + 1), subjects[subjects.size() - 1 - i]});
    if (!panel.series.empty()) figure.panels.push_back(std::move(panel));
  }
  return figure;
}

}  // namespace

std::vector<Figure> speed_figures(const SpeedResult& result) {
  const std::vector<const TimedWay*> drawn = drawn_ways(result.ways);
  std::vector<Figure> figures;
  if (!drawn.empty()) figures = {race_figure(drawn, false), verdict_figure(drawn), race_figure(drawn, true)};
  figures.push_back(batch_figure(result.ways));
  std::erase_if(figures, [](const Figure& f) { return f.panels.empty(); });
  return figures;
}

}  // namespace thinwall
