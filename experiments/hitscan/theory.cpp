/// What geometry expects of a cell, derived in docs/hitscan.md, and whether what was counted and measured agrees with it.
#include <thinwall/experiments/hitscan/model.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace thinwall {

namespace {

/// The i-th of evenly spaced phases, such that none of them is near where one step takes over from another at the
/// target: there everything jumps. A ray along the velocity gets a little farther than the bullet, as that slows down.
double phase_of(const HitscanRule& rule, const HitscanCell& c, int i, int phases) {
  const double beyond = rule.path == FlightPath::tangents ? dragged_time(c.drag, c.step) / c.step - 1 : 0;
  const double phase = (i + 0.5) / phases + beyond - flight_time(c) / c.step;
  const double part = phase - std::floor(phase);
  return part < 1 ? part : 0;
}

/// Mean and deviation over the phase, uniform over a step.
HitscanMoments over_phases(const HitscanRule& rule, const HitscanCell& c, const std::function<double(double)>& f) {
  constexpr int phases = 2000;
  double sum = 0, squares = 0;
  for (int i = 0; i < phases; ++i) {
    const double x = f(phase_of(rule, c, i, phases));
    sum += x;
    squares += x * x;
  }
  const double mean = sum / phases;
  return {mean, std::sqrt(std::max(0.0, squares / phases - mean * mean))};
}

/// [m] From the rule's path to the arc at the range.
HitscanMoments path_errors(const HitscanRule& rule, const HitscanCell& c) {
  if (rule.path == FlightPath::line) return {deflection(c), 0};  // the same in every shot
  const auto arc = arc_of<double>(c);
  const double there = flight_time(c);
  const bool is_tangent = rule.path == FlightPath::tangents;  // which gets as far as a bullet without drag
  const auto covers = [&](const Interval& step) {
    const double since = there - step.lower;
    return since <= 0 || (is_tangent ? undragged_time(arc.drag, since) : since) <= step.upper - step.lower;
  };
  // Seen from the start of a step the arc begins anew, so it is off the tangent by the pull's own factor.
  return over_phases(rule, c, [&](double phase) {
    const Interval step = steps_from(there, c, phase, covers).back();
    const double since = there - step.lower, length = step.upper - step.lower;
    if (is_tangent) return arc.after(since).s;
    const double part = undragged_time(arc.drag, since) / undragged_time(arc.drag, length);
    return part * arc.after(length).s - arc.after(since).s;
  });
}

/// [m] No path error is beyond.
Interval possible_path_error(const HitscanRule& rule, const HitscanCell& c) {
  if (rule.path == FlightPath::line) return {deflection(c), deflection(c)};
  const auto arc = arc_of<double>(c);
  if (rule.path == FlightPath::tangents) return {0, arc.pull * pull_factor(arc.drag, c.step)};  // by its own speed
  const double tau = undragged_time(arc.drag, c.step), longest = tau / (1 - arc.drag * tau);
  return {0, arc.pull * longest * longest / 8};  // the arc's curvature over tau is at most pull / (1 - drag * tau)^2
}

/// [s] What is left of the step in which the center gets to the target, and how much earlier the ball touches.
HitscanMoments next_frame_lateness(const HitscanCell& c) {
  const auto arc = arc_of<double>(c);
  const auto there = arc.at_distance(c.range);
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
  const auto covers = [&](const Interval& step) {
    if (step.lower >= arrival) return true;
    const auto start = arc.after(step.lower);
    const double tau = undragged_time(arc.drag, arrival - step.lower),
                 square = start.vx * start.vx + start.vs * start.vs;
    return tau + arc.pull * start.vs / square * pull_factor(arc.drag, tau) <= step.upper - step.lower;  // along the ray
  };
  const HitscanMoments rest = over_phases(
      next_frame, c, [&](double phase) { return steps_from(arrival, c, phase, covers).back().upper - arrival; });
  const double variance = std::max(0.0, ahead_squared - ahead * ahead) / (speed * speed);
  return {rest.mean + ahead / speed, std::hypot(rest.sigma, std::sqrt(variance))};
}

/// The chords of the steps, or the tangents at their starts, as far as the bullet would get; or the line of fire.
std::vector<PathPiece> pieces_of(FlightPath path, const HitscanCell& c, const std::vector<Interval>& steps) {
  if (path == FlightPath::line) return {{0, 0, 2 * c.range, 0}};
  std::vector<PathPiece> pieces;
  for (const auto& [from, until] : steps) {
    const auto a = arc_of<double>(c).after(from), b = arc_of<double>(c).after(until);
    const bool chord = path == FlightPath::chords;
    pieces.push_back({a.x, a.s, chord ? b.x : a.x + a.vx * (until - from), chord ? b.s : a.s + a.vs * (until - from)});
  }
  return pieces;
}

/// The arc itself, as chords far finer than any rule's.
std::vector<PathPiece> pieces_of_arc(const HitscanCell& c) {
  const Interval window = contact_window(c);
  const double across = window.upper - window.lower;
  const int slices = 64 * (1 + static_cast<int>(across / c.step));
  std::vector<Interval> steps;
  for (int i = 0; i < slices; ++i)
    steps.push_back({window.lower + across * i / slices, window.lower + across * (i + 1) / slices});
  return pieces_of(FlightPath::chords, c, steps);
}

struct Areas {
  double arc = 0, rule = 0, both = 0;  ///< [m^2]
};

/// Slice by slice of how far beside the arc's plane the target's center is. Two pieces, as the shadow of a center ends
/// at the target's radius and that of a ball at the reach; q = middle + half cos(turn) takes the roots at the ends
/// away.
Areas areas_of(const HitscanRule& rule, const HitscanCell& c) {
  const double outer = reach(c), inner = c.target, rule_reach = rule.has_radius ? outer : inner;
  const int phases = rule.path == FlightPath::line ? 1 : 32;
  std::vector<std::vector<PathPiece>> paths;
  for (int i = 0; i < phases; ++i)
    paths.push_back(pieces_of(rule.path, c, steps_near_target(c, phase_of(rule, c, i, phases))));
  const std::vector<PathPiece> arc = pieces_of_arc(c);
  constexpr int turns = 96;
  Areas sum;
  const auto add_piece = [&](double from, double to) {
    for (int j = 0; j < turns && from < to; ++j) {
      const double turn = (j + 0.5) / turns * std::numbers::pi, half = (to - from) / 2;
      const double beside = from + half * (1 - std::cos(turn));
      const double width = 2 * half * std::sin(turn) * std::numbers::pi / turns;  // on both sides of the plane
      const auto at = [&](double radius) { return std::sqrt(std::max(0.0, radius * radius - beside * beside)); };
      const Places arc_places = shadow(arc, c.range, at(outer));
      sum.arc += length(arc_places) * width;
      if (beside >= rule_reach) continue;
      for (const std::vector<PathPiece>& path : paths) {
        const Places rule_places = shadow(path, c.range, at(rule_reach));
        sum.rule += length(rule_places) * width / phases;
        sum.both += length(arc_places & rule_places) * width / phases;
      }
    }
  };
  add_piece(0, inner);
  add_piece(inner, outer);
  return sum;
}

void judge(HitscanMomentTest& test, const HitscanSpread& spread, const std::optional<HitscanMoments>& theory,
           const Interval& allowed) {
  if (spread.count == 0) return;
  ++test.cells;
  if (!allowed.contains(spread.least) || !allowed.contains(spread.most)) ++test.out_of_bounds;
  constexpr std::int64_t enough = 50;  // for a mean to be normal
  if (!theory || theory->sigma <= 0 || spread.count < enough) return;
  const double error = theory->sigma / std::sqrt(static_cast<double>(spread.count));
  test.means.add((spread.mean() - theory->mean) / error);
}

/// [s] What the moment of a report can be after first contact, which is within the window.
Interval possible_lateness(const HitscanRule& rule, const HitscanCell& c) {
  const Interval window = contact_window(c);
  const double across = window.upper - window.lower;
  if (rule.path == FlightPath::line) return {-window.upper, -window.lower};
  if (rule.path == FlightPath::chords) return {-across, across};
  // A ray of a step may be some of the next step long, as the bullet slows down.
  return {c.step - dragged_time(c.drag, c.step) - across, c.step + across};
}

}  // namespace

Places shadow(const std::vector<PathPiece>& pieces, double range, double radius) {
  Places all;
  for (const PathPiece& piece : pieces) {
    const double from = std::max(piece.x0 - range, -radius), to = std::min(piece.x1 - range, radius);
    if (from > to) continue;  // it does not get there
    const double slope = (piece.s1 - piece.s0) / (piece.x1 - piece.x0);
    const auto path = [&](double x) { return piece.s0 + slope * (x + range - piece.x0); };
    const auto rise = [&](double x) { return std::sqrt(std::max(0.0, radius * radius - x * x)); };
    // Where a line of this slope touches the ball, or at the end nearest to that: rise is concave.
    const double touch = slope * radius / std::hypot(1.0, slope);
    const double low = std::clamp(-touch, from, to), high = std::clamp(touch, from, to);
    all += Places::interval_type::closed(path(low) - rise(low), path(high) + rise(high));
  }
  return all;
}

double lens_area(double radius_a, double radius_b, double apart) {
  const double least = std::min(radius_a, radius_b), most = std::max(radius_a, radius_b);
  if (apart >= least + most) return 0;
  if (apart <= most - least) return std::numbers::pi * least * least;
  // The common chord is `x` from the one center and `apart - x` from the other: two segments.
  const auto segment = [](double radius, double x) {
    return radius * radius * std::acos(std::clamp(x / radius, -1.0, 1.0)) -
           x * std::sqrt(std::max(0.0, radius * radius - x * x));
  };
  const double x = (apart * apart + (radius_a - radius_b) * (radius_a + radius_b)) / (2 * apart);
  return segment(radius_a, x) + segment(radius_b, apart - x);
}

HitscanExpected expected_of(const HitscanRule& rule, const HitscanCell& c) {
  const Areas areas = areas_of(rule, c);
  const double disc = disc_radius(c);
  const double drawn = 2 * std::numbers::pi * disc * disc - lens_area(disc, disc, deflection(c));  // [m^2] both discs
  const auto share = [&](double area) { return std::max(0.0, area) / drawn; };
  HitscanExpected e = {.touch = share(areas.arc),
                       .reported = share(areas.rule),
                       .missed = share(areas.arc - areas.both),
                       .false_hits = share(areas.rule - areas.both),
                       .path_error = path_errors(rule, c),
                       .path_error_possible = possible_path_error(rule, c),
                       .lateness = {},
                       .lateness_possible = possible_lateness(rule, c)};
  if (rule.path == FlightPath::tangents) e.lateness = next_frame_lateness(c);
  return e;
}

double flat_missed(double target, double radius, double deflection) {
  const double outer = target + radius;
  return 1 - lens_area(target, outer, deflection) / (std::numbers::pi * outer * outer);
}

double flat_false(double target, double radius, double deflection) {
  return 1 - lens_area(target, target + radius, deflection) / (std::numbers::pi * target * target);
}

std::optional<double> range_of_missed(const HitscanCell& c, double share) {
  const auto too_many = [&](double range) {
    return flat_missed(c.target, 0, arc_of<double>(c).at_distance(range).s) - share;
  };
  const auto arc = arc_of<double>(c);
  if (arc.pull == 0) return std::nullopt;
  // Without drag the deflection is 2 targets, and everything is missed, at this range; drag only makes the fall longer.
  double farthest = 2 * c.speed * std::sqrt(c.target / arc.pull);
  if (arc.drag > 0) farthest = std::min(farthest, 0.9 * c.speed / arc.drag);
  if (too_many(farthest) < 0) return std::nullopt;
  return root(too_many, 0.0, farthest, 40);
}

std::vector<CellCount> counts_of(const std::vector<HitscanRow>& rows) {
  std::vector<CellCount> counts;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const HitscanTally& t = rows[i].tally;
    const HitscanExpected& e = rows[i].expected;
    const std::string rule(rows[i].rule.name);
    if (i == 0 || rows[i - 1].cell != rows[i].cell)
      counts.push_back({"exact arc", "touching", t.shots, t.touching, e.touch});
    counts.push_back({rule, "reported", t.shots, t.reported(), e.reported});
    counts.push_back({rule, "missed", t.shots, t.missed, e.missed});
    counts.push_back({rule, "false", t.shots, t.false_hits, e.false_hits});
  }
  return counts;
}

std::vector<HitscanMomentTest> moment_tests(const std::vector<HitscanRow>& rows) {
  std::vector<HitscanMomentTest> tests;
  for (const Group<HitscanRow>& group : group_by(rows, rule_name)) {
    const std::string rule(rule_name(*group[0]));
    HitscanMomentTest path = {.rule = rule, .quantity = "path error"}, late = {.rule = rule, .quantity = "lateness"};
    for (const HitscanRow* row : group) {
      const auto& [c, rule_of, t, e] = *row;
      const double rounding = 64 * std::numeric_limits<double>::epsilon() * (c.range + t.path_error.unit);
      const Interval possible = {e.path_error_possible.lower - rounding, e.path_error_possible.upper + rounding};
      judge(path, t.path_error, e.path_error, possible);
      judge(late, t.lateness, e.lateness, e.lateness_possible);
    }
    tests.insert(tests.end(), {path, late});
  }
  return tests;
}

}  // namespace thinwall
