#include <algorithm>
#include <cmath>
#include <limits>

#include <thinwall/experiments/scenes/bodies.hpp>
#include <thinwall/experiments/scenes/scene_results.hpp>

namespace thinwall {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t most_outlines = 400;
constexpr std::size_t most_named = 8;  // tracks in the legend; the others share one entry

Series lines(const std::string& label, Mark mark) {
  return {.label = label, .mark = mark, .x = {}, .y = {}, .lower = {}, .upper = {}};
}

void append_gap(Series& series) {
  if (series.x.empty()) return;
  series.x.push_back(series.x.back());
  series.y.push_back(nan);
}

/// The outlines of what stays, cut to the window where something moves and a margin around it.
Series outlines(const Scene& scene, const Aabb<double>& window) {
  Series series = lines("at rest", Mark::line);
  series.color = "#888888";
  const auto cut = [&](double value, int axis) {
    return std::clamp(value, window.center[axis] - window.half_extents[axis],
                      window.center[axis] + window.half_extents[axis]);
  };
  std::size_t drawn = 0;
  for (const Body& body : scene.bodies) {
    if (!body.is_static || std::holds_alternative<std::monostate>(body.shape) || ++drawn > most_outlines) continue;
    const Aabb<double> box = box_of(body);
    const int a = scene.across, u = scene.up;
    append_gap(series);
    for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}}) {
      series.x.push_back(cut(box.center[a] + x * box.half_extents[a], a));
      series.y.push_back(cut(box.center[u] + y * box.half_extents[u], u));
    }
  }
  return series;
}

/// Where anything moved, and a fifth more on each side.
Aabb<double> window_of(const Scene& scene, const Playback& playback) {
  Aabb<double> window{Vec3<double>::Zero(), Vec3<double>::Constant(std::numeric_limits<double>::infinity())};
  const auto set = [&](int axis, std::vector<double> Track::*values) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Track& track : playback.tracks) {
      for (const double value : track.*values) {
        low = std::min(low, value);
        high = std::max(high, value);
      }
    }
    if (!(low < high)) return;
    window.center[axis] = (low + high) / 2;
    window.half_extents[axis] = 0.7 * (high - low);
  };
  set(scene.across, &Track::x);
  set(scene.up, &Track::y);
  return window;
}

}  // namespace

Figure tracks_figure(const Scene& scene, const Playback& playback) {
  Panel panel;
  panel.x_label = std::string(1, static_cast<char>('x' + scene.across)) + " [m]";
  panel.y_label = std::string(1, static_cast<char>('x' + scene.up)) + " [m]";
  panel.series.push_back(outlines(scene, window_of(scene, playback)));
  if (panel.series.back().x.empty()) panel.series.clear();
  const bool few = playback.tracks.size() <= most_named;
  for (const Track& track : playback.tracks) {
    if (few || &track == &playback.tracks.front())
      panel.series.push_back(lines(few ? name_in(scene, track.id) : "bodies that move", Mark::points));
    Series& series = panel.series.back();
    series.x.insert(series.x.end(), track.x.begin(), track.x.end());
    series.y.insert(series.y.end(), track.y.begin(), track.y.end());
  }
  return {.name = "tracks",
          .title = "Where the bodies were at the end of each step",
          .caption =
              "The center of each body that moves, of the first 40, at the end of every step; what stays, as the "
              "box that holds it, cut off at the edge.",
          .panels = {std::move(panel)}};
}

Figure course_figure(const Playback& playback) {
  Series energy = lines("energy", Mark::line), begun = lines("contacts begun", Mark::line);
  Series through = lines("tunneled", Mark::dashes);
  std::int64_t begins = 0, tunneled = 0;
  energy.x.push_back(0);
  energy.y.push_back(playback.energy);
  for (const StepRow& row : playback.rows) {
    energy.x.push_back(row.time);
    energy.y.push_back(row.energy);
    begun.x.push_back(row.time);
    begun.y.push_back(static_cast<double>(begins += row.begins));
    through.x.push_back(row.time);
    through.y.push_back(static_cast<double>(tunneled += row.tunneled));
  }
  Panel top, bottom;
  top.x_label = bottom.x_label = "time [s]";
  top.y_label = "energy [J]";
  bottom.y_label = "counted so far [1]";
  top.series = {std::move(energy)};
  bottom.series = {std::move(begun), std::move(through)};
  return {.name = "course",
          .title = "Energy and contacts over time",
          .caption =
              "Above: kinetic energy and energy of height at the end of each step. Below: contacts that have begun, "
              "and pairs that have gone through each other unseen.",
          .panels = {std::move(top), std::move(bottom)}};
}

}  // namespace thinwall
