#include <algorithm>
#include <cmath>
#include <limits>

#include <thinwall/experiments/scenes/bodies.hpp>
#include <thinwall/experiments/scenes/scene_results.hpp>

namespace thinwall {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t most_outlines = 400;
constexpr std::size_t most_marks = 1500;  // more would be a blot: then lines
constexpr std::size_t most_named = 8;     // tracks in the legend; the others share one entry

Series lines(const std::string& label, Mark mark) {
  return {.label = label, .mark = mark, .x = {}, .y = {}, .lower = {}, .upper = {}};
}

void append_gap(Series& series) {
  if (series.x.empty()) return;
  series.x.push_back(series.x.back());
  series.y.push_back(nan);
}

/// A rectangle of the picture.
struct Window {
  double left = 0, right = 1, bottom = 0, top = 1;  ///< [m]
};

/// Where anything moved, with room for the bodies themselves and a fifth more on each side.
Window window_of(const Scene& scene, const Playback& playback) {
  constexpr double far = std::numeric_limits<double>::infinity();
  Window w{far, -far, far, -far};
  for (const Track& track : playback.tracks) {
    const auto body = std::find_if(scene.bodies.begin(), scene.bodies.end(),
                                   [&track](const Body& candidate) { return candidate.id == track.id; });
    const Vec3<double> half = body == scene.bodies.end() ? Vec3<double>::Zero().eval() : box_of(*body).half_extents;
    for (std::size_t i = 0; i < track.x.size(); ++i) {
      w.left = std::min(w.left, track.x[i] - half[scene.across]);
      w.right = std::max(w.right, track.x[i] + half[scene.across]);
      w.bottom = std::min(w.bottom, track.y[i] - half[scene.up]);
      w.top = std::max(w.top, track.y[i] + half[scene.up]);
    }
  }
  const double wide = 0.2 * (w.right - w.left), high = 0.2 * (w.top - w.bottom);
  return {w.left - wide, w.right + wide, w.bottom - high, w.top + high};
}

/// The part of a segment within the window, appended with a gap before it. Source: Liang and Barsky, 1984.
void append_clipped(Series& series, const Window& w, double x0, double y0, double x1, double y1) {
  double from = 0, to = 1;
  const auto cut = [&](double start, double change, double low, double high) {
    if (change == 0) return low <= start && start <= high;
    const double enter = ((change > 0 ? low : high) - start) / change;
    const double leave = ((change > 0 ? high : low) - start) / change;
    from = std::max(from, enter);
    to = std::min(to, leave);
    return from <= to;
  };
  if (!cut(x0, x1 - x0, w.left, w.right) || !cut(y0, y1 - y0, w.bottom, w.top)) return;
  append_gap(series);
  for (const double t : {from, to}) {
    series.x.push_back(x0 + t * (x1 - x0));
    series.y.push_back(y0 + t * (y1 - y0));
  }
}

/// The twelve edges of a box: its corners differ along one axis.
void append_edges(Series& series, const Window& w, const Scene& scene, const Vec3<double>& center,
                  const Mat3<double>& axes, const Vec3<double>& half) {
  const auto corner = [&](unsigned which) {
    Vec3<double> at = center;
    for (unsigned i = 0; i < 3; ++i) {
      const double side = (which >> i & 1U) != 0 ? 1 : -1;
      at += side * half[static_cast<int>(i)] * axes.col(static_cast<int>(i));
    }
    return at;
  };
  for (unsigned from = 0; from < 8; ++from) {
    for (unsigned axis = 0; axis < 3; ++axis) {
      if ((from >> axis & 1U) != 0) continue;
      const Vec3<double> a = corner(from), b = corner(from | 1U << axis);
      append_clipped(series, w, a[scene.across], a[scene.up], b[scene.across], b[scene.up]);
    }
  }
}

/// The edges of what stays, where they are in the window; of what is round, those of the box that holds it.
Series outlines(const Scene& scene, const Window& window) {
  Series series = lines("at rest", Mark::line);
  series.color = "#888888";
  std::size_t drawn = 0;
  for (const Body& body : scene.bodies) {
    if (!body.is_static || std::holds_alternative<std::monostate>(body.shape) || ++drawn > most_outlines) continue;
    if (const auto* const turned = std::get_if<Obb<double>>(&body.shape)) {
      append_edges(series, window, scene, turned->center, turned->axes, turned->half_extents);
    } else {
      const Aabb<double> box = box_of(body);
      append_edges(series, window, scene, box.center, Mat3<double>::Identity(), box.half_extents);
    }
  }
  return series;
}

}  // namespace

Figure tracks_figure(const Scene& scene, const Playback& playback) {
  Panel panel;
  panel.x_label = std::string(1, static_cast<char>('x' + scene.across)) + " [m]";
  panel.y_label = std::string(1, static_cast<char>('x' + scene.up)) + " [m]";
  panel.series.push_back(outlines(scene, window_of(scene, playback)));
  if (panel.series.back().x.empty()) panel.series.clear();
  const bool few = playback.tracks.size() <= most_named;
  std::size_t points = 0;
  for (const Track& track : playback.tracks) points += track.x.size();
  const Mark mark = points <= most_marks ? Mark::points : Mark::line;
  for (const Track& track : playback.tracks) {
    if (few || &track == &playback.tracks.front())
      panel.series.push_back(lines(few ? name_in(scene, track.id) : "bodies that move", mark));
    Series& series = panel.series.back();
    append_gap(series);
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
