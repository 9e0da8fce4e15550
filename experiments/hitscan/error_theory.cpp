#include <thinwall/experiments/hitscan/error_theory.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

namespace thinwall {

double phase_of(const HitscanRule& rule, const HitscanCell& c, int i, int phases) {
  const double beyond = rule.path == FlightPath::tangents ? dragged_time(c.drag, c.step) / c.step - 1 : 0;
  const double phase = (i + 0.5) / phases + beyond - flight_time(c) / c.step;
  const double part = phase - std::floor(phase);
  return part < 1 ? part : 0;
}

namespace {

constexpr int moment_phases = 2000;

/// Mean and deviation over the phase, uniform over a step.
HitscanMoments over_phases(const HitscanRule& rule, const HitscanCell& c, const std::function<double(double)>& f) {
  double sum = 0, squares = 0;
  for (int i = 0; i < moment_phases; ++i) {
    const double x = f(phase_of(rule, c, i, moment_phases));
    sum += x;
    squares += x * x;
  }
  const double mean = sum / moment_phases;
  return {mean, std::sqrt(std::max(0.0, squares / moment_phases - mean * mean))};
}

struct FrameAt {
  double begins, ends;  ///< [s] since firing
};
/// The first frame that covers(its start, time since then, its length) where the bullet is at `t`, or begins there.
template <class Covers> FrameAt first_frame(const HitscanCell& c, double phase, double t, const Covers& covers) {
  double frame = std::max(0.0, std::floor(t / c.step + phase) - 1);
  for (;; frame += 1) {
    const double begins = frame > 0 ? (frame - phase) * c.step : 0, ends = (frame + 1 - phase) * c.step;
    if (begins >= t || covers(begins, t - begins, ends - begins)) return {begins, ends};
  }
}

/// [m] At the range, of a rule that goes step by step: seen from the start of a step the arc begins anew, so it is off
/// the tangent by the pull's own factor.
double path_error(const HitscanRule& rule, const HitscanCell& c, double phase) {
  const auto arc = arc_of<double>(c);
  const double there = flight_time(c);
  const auto fallen = [&](double t) { return arc.pull * pull_factor(arc.drag, undragged_time(arc.drag, t)); };
  if (rule.path == FlightPath::tangents) {
    const FrameAt frame = first_frame(c, phase, there, [&](double, double since, double length) {
      return undragged_time(arc.drag, since) <= length;
    });
    return fallen(there - frame.begins);
  }
  const FrameAt frame =
      first_frame(c, phase, there, [](double, double since, double length) { return since <= length; });
  const double since = there - frame.begins, length = frame.ends - frame.begins;
  const double part = undragged_time(arc.drag, since) / undragged_time(arc.drag, length);
  return part * fallen(length) - fallen(since);
}

}  // namespace

HitscanMoments path_errors(const HitscanRule& rule, const HitscanCell& c) {
  if (rule.path == FlightPath::line) return {deflection(c), 0};  // the same in every shot
  return over_phases(rule, c, [&](double phase) { return path_error(rule, c, phase); });
}

double path_error_bound(const HitscanRule& rule, const HitscanCell& c) {
  const auto arc = arc_of<double>(c);
  switch (rule.path) {
    case FlightPath::line: return deflection(c);
    case FlightPath::tangents: return arc.pull * pull_factor(arc.drag, c.step);  // its own speed takes the ray that far
    case FlightPath::chords: break;
  }
  const double tau = undragged_time(arc.drag, c.step), longest = tau / (1 - arc.drag * tau);
  return arc.pull * longest * longest / 8;  // the arc's curvature over tau is at most pull / (1 - drag * tau)^2
}

HitscanMoments next_frame_lateness(const HitscanCell& c) {
  const auto arc = arc_of<double>(c);
  const auto there = at_distance(arc, c.range);
  const double speed = std::hypot(there.vx, there.vs), outer = reach(c);
  double ahead = 0, ahead_squared = 0, depth = 0;  // means over a disc, in rings of equal area
  constexpr int rings = 2000;
  for (int i = 0; i < rings; ++i) {
    const double squared = c.target * c.target * (i + 0.5) / rings;
    const double inner = std::sqrt(c.target * c.target - squared), lead = std::sqrt(outer * outer - squared) - inner;
    ahead += lead / rings;
    ahead_squared += lead * lead / rings;
    depth += inner / rings;
  }
  const double arrival = flight_time(c) - depth / speed;
  const HitscanMoments rest = over_phases(next_frame, c, [&](double phase) {
    const FrameAt frame = first_frame(c, phase, arrival, [&](double begins, double since, double length) {
      const auto start = after(arc, begins);
      const double tau = undragged_time(arc.drag, since), square = start.vx * start.vx + start.vs * start.vs;
      return tau + arc.pull * start.vs / square * pull_factor(arc.drag, tau) <= length;  // along the ray
    });
    return frame.ends - arrival;
  });
  const double variance = std::max(0.0, ahead_squared - ahead * ahead) / (speed * speed);
  return {rest.mean + ahead / speed, std::hypot(rest.sigma, std::sqrt(variance))};
}

}  // namespace thinwall
