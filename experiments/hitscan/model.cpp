#include <thinwall/experiments/hitscan/model.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <fmt/format.h>

#include <thinwall/discrete/queries.hpp>
#include <thinwall/swept/time_of_impact.hpp>

namespace thinwall {

namespace {

constexpr double least_speed_left = 0.1;     // [1] of the muzzle's: with less the bullet does not arrive
constexpr double most_bend = 0.125;          // [1] the oracle asks for one closest approach: docs/hitscan.md
constexpr double least_path = 0.01;          // [reach] a step
constexpr double least_reach = 1e-6;         // [range] the oracle subtracts distances along the range
constexpr double most_drag_in_a_step = 0.5;  // [1] drag * step: a ray of a step is at most two steps long

void check(const Settings& settings, const HitscanCell& c) {
  const auto arc = arc_of<double>(c);
  const double speed = arc.at_distance(c.range + reach(c)).vx;  // past the target
  const auto demand = [&](bool is_met, std::string_view key, const std::string& allowed) {
    if (!is_met) settings.complain(key, fmt::format("{}; not so at {}", allowed, hitscan_factors.key(c)));
  };
  demand(c.range > 2 * reach(c), "range", "more than 2 * (target + radius)");
  demand(reach(c) >= least_reach * c.range, "target",
         fmt::format("such that target + radius is at least {} of the range", least_reach));
  demand(c.drag * c.step <= most_drag_in_a_step, "step", fmt::format("drag * step at most {}", most_drag_in_a_step));
  demand(reach(c) * arc.pull <= most_bend * speed * speed, "speed",
         fmt::format("fast enough to fly nearly straight past a target: (target + radius) * (gravity and wind) "
                     "at most {} of the squared speed there",
                     most_bend));
  demand(speed * c.step >= least_path * reach(c), "step",
         fmt::format("a path of at least {} of target + radius a step", least_path));
}

/// [s] Since firing: the steps in turn, from the last but one before `time` to the first that `is_last`. The gun goes off `phase` [1], in
/// [0, 1), of a step after a frame, so that the first step is shorter.
std::vector<Interval> steps_from(double time, const HitscanCell& c, double phase,
                                 const std::function<bool(const Interval&)>& is_last) {
  std::vector<Interval> steps;
  double frame = std::max(0.0, std::floor(time / c.step + phase) - 1);
  for (; steps.empty() || !is_last(steps.back()); ++frame)
    steps.push_back({frame > 0 ? (frame - phase) * c.step : 0, (frame + 1 - phase) * c.step});
  return steps;
}

/// To the one that ends the window of contact.
std::vector<Interval> steps_near_target(const HitscanCell& c, double phase) {
  const Interval window = contact_window(c);
  return steps_from(window.lower, c, phase, [&](const Interval& step) { return step.upper >= window.upper; });
}

/// A straight bit of the way a rule takes the bullet to fly. A line takes no time.
struct FlightPiece {
  Vec3<double> start, displacement;  ///< [m]
  double from, until;                ///< [s] since firing
};

/// Those that may come near the target.
std::vector<FlightPiece> flight_pieces(FlightPath path, const HitscanCell& c, double phase) {
  if (path == FlightPath::line) return {{{0, 0, 0}, {2 * c.range, 0, 0}, 0, 0}};  // past the target, wherever it is hit
  const Arc<double> arc = arc_of<double>(c);
  const Vec3<double> pull = pull_direction(c);
  const auto in_plane = [&](double x, double s) -> Vec3<double> { return Vec3<double>(x, 0, 0) + pull * s; };
  std::vector<FlightPiece> pieces;
  for (const auto& [from, until] : steps_near_target(c, phase)) {
    const auto here = arc.after(from), next = arc.after(until);
    const Vec3<double> start = in_plane(here.x, here.s);
    const Vec3<double> tangent = in_plane(here.vx, here.vs) * (until - from), chord = in_plane(next.x, next.s) - start;
    pieces.push_back({start, path == FlightPath::tangents ? tangent : chord, from, until});
  }
  return pieces;
}

std::optional<RayHit<double>> hit_on(const FlightPiece& piece, const HitscanRule& rule, const HitscanCell& c,
                                     const Sphere<double>& target) {
  if (!rule.has_radius) return raycast(Ray<double>{piece.start, piece.displacement, 1}, target);
  const auto toi = time_of_impact(Moving{Sphere{piece.start, c.radius}, piece.displacement}, at_rest(target));
  if (toi.status != ToiStatus::hit && toi.status != ToiStatus::overlapping) return std::nullopt;
  return RayHit<double>{toi.time, toi.point, toi.normal};
}

}  // namespace

std::string_view known_name(const HitscanCell& c) {
  const auto known = std::ranges::find(known_shots, c, &KnownShot::cell);
  return known == known_shots.end() ? std::string_view() : known->name;
}

const Factors<HitscanCell> hitscan_factors = factors<HitscanCell>(
    numbers("range", &HitscanCell::range, {.lower = 0, .upper = 1e6, .lower_open = true, .unit = "m"},
            "From the muzzle to the plane of the target's center."),
    numbers("speed", &HitscanCell::speed, {.lower = 0, .upper = 1e6, .lower_open = true, .unit = "m/s"},
            "At the muzzle."),
    numbers("radius", &HitscanCell::radius, {.lower = 0, .upper = 1e3, .unit = "m"}, "Of the bullet."),
    numbers("wind", &HitscanCell::wind, {.lower = 0, .upper = 1e3, .unit = "m/s"},
            "Across the line of fire; 0 where there is no drag."),
    numbers("drag", &HitscanCell::drag, {.lower = 0, .upper = 1e3, .unit = "1/s"},
            "Share of its speed, as seen from the air, that the bullet loses a second."),
    numbers("step", &HitscanCell::step, {.lower = 0, .upper = 1e3, .lower_open = true, .unit = "s"},
            "Time step of the frames."),
    numbers("target", &HitscanCell::target, {.lower = 1e-9, .upper = 1e3, .unit = "m"}, "Radius of the target."),
    number("gravity", &HitscanCell::gravity, {.lower = 0, .upper = 1e3, .unit = "m/s^2"}, "Downward."),
    number("aim", &HitscanCell::aim, {.lower = 1.1, .upper = 100},
           "Size of the discs that the target's center is drawn from."));

Vec3<double> pull_direction(const HitscanCell& c) {
  const double pull = arc_of<double>(c).pull;
  if (pull == 0) return {0, -1, 0};
  return {0, -c.gravity / pull, c.drag * c.wind / pull};
}

double disc_radius(const HitscanCell& c) {
  const auto there = arc_of<double>(c).at_distance(c.range);
  return c.aim * reach(c) * std::hypot(1.0, there.vs / there.vx);  // a ball's shadow along a steep arc is an ellipse
}

Interval contact_window(const HitscanCell& c) {
  const auto arc = arc_of<double>(c);
  return {arc.time_to(c.range - reach(c)), arc.time_to(c.range + reach(c))};
}

std::vector<HitscanCell> make_hitscan_cells(const Settings& settings) {
  bool any = false;
  const auto fired = hitscan_factors.first_fastest().cells(settings, 1, {}, [&](HitscanCell& c) {
    if (c.drag == 0) c.wind = 0;  // without drag a wind does nothing
    if (c.drag * (c.range + reach(c)) > (1 - least_speed_left) * c.speed) return false;
    any = true;
    if (!known_name(c).empty()) return false;
    check(settings, c);
    return true;
  });
  if (!any)
    settings.complain("range", "a range that some bullet reaches with a tenth of its speed: lower it, or the drag");
  std::vector<HitscanCell> all;
  for (const KnownShot& known : known_shots) all.push_back(known.cell);
  all.insert(all.end(), fired.begin(), fired.end());
  return all;
}

Placement random_placement(const HitscanCell& c, const RandomStream& stream, std::uint64_t trial) {
  const double disc = disc_radius(c);
  const Vec3<double> on_arc = pull_direction(c) * deflection(c);
  for (std::uint64_t draw = 0;; ++draw) {
    const RandomWords words = random_words(stream, trial, draw);
    const double y = (2 * uniform(words[1]) - 1) * disc, z = (2 * uniform(words[2]) - 1) * disc;
    if (y * y + z * z > disc * disc) continue;
    const bool around_arc = uniform(words[3]) < 0.5;
    const Vec3<double> across = Vec3<double>(0, y, z) + (around_arc ? on_arc : Vec3<double>(0, 0, 0));
    if (around_arc && across.squaredNorm() <= disc * disc) continue;  // what both discs hold comes from the first alone
    return {{across + Vec3<double>(c.range, 0, 0), c.target}, uniform(words[0])};
  }
}

std::optional<TrueImpact> true_impact(const HitscanCell& c, const Vec3<double>& target_center) {
  using Real = long double;
  const auto arc = arc_of<Real>(c);
  const Vec3<Real> pull = pull_direction(c).cast<Real>(), center(0, target_center[1], target_center[2]);
  const Real range = target_center[0], reach = Real(c.target) + Real(c.radius), first = range - reach,
             last = range + reach;
  const Real along = center.dot(pull),
             beside = (center - pull * along).squaredNorm();  // in the arc's plane; squared, off it
  if (beside > reach * reach || along < arc.at_distance(first).s - reach || along > arc.at_distance(last).s + reach)
    return std::nullopt;
  // Of the distance from the target's center: its square less that of contact, and the sign of its slope.
  const auto excess = [&](const Real& x) -> Real {
    const Real s = arc.at_distance(x).s - along, ahead = x - range;
    return ahead * ahead + s * s + beside - reach * reach;
  };
  const auto slope = [&](const Real& x) -> Real {
    const auto p = arc.at_distance(x);
    return (x - range) + (p.s - along) * p.vs / p.vx;
  };
  Real closest = slope(first) >= 0 ? first : last;
  if (slope(first) < 0 && slope(last) > 0) closest = root(slope, first, last);
  if (excess(closest) > 0) return std::nullopt;
  const Real entry = excess(first) <= 0 ? first : root(excess, first, closest);
  const Vec3<Real> bullet = Vec3<Real>(entry, 0, 0) + pull * arc.at_distance(entry).s;
  return TrueImpact{static_cast<double>(arc.time_to(entry)), bullet.cast<double>()};
}

HitscanAnswer answer_of(const HitscanRule& rule, const HitscanCell& c, const Placement& placement) {
  HitscanAnswer answer;
  const std::vector<FlightPiece> pieces = flight_pieces(rule.path, c, placement.phase);
  const auto ends = [&](const auto& p) { return &p == &pieces.back() || (p.start + p.displacement)[0] >= c.range; };
  const FlightPiece& last = *std::ranges::find_if(pieces, ends);
  answer.at_range = last.start + last.displacement * ((c.range - last.start[0]) / last.displacement[0]);
  for (const auto& piece : pieces) {
    const auto hit = hit_on(piece, rule, c, placement.target);
    if (!hit) continue;
    answer.hit = true;
    answer.time = rule.path == FlightPath::tangents ? piece.until : piece.from + hit->t * (piece.until - piece.from);
    answer.point = hit->point;
    break;
  }
  return answer;
}

void HitscanSpread::add(double x) {
  ++count;
  sum += std::llround(std::ldexp(x / unit, 30));
  least = std::min(least, x);
  most = std::max(most, x);
}

double HitscanSpread::mean() const {
  return std::ldexp(static_cast<double>(sum), -30) * unit / static_cast<double>(count);
}

std::vector<HitscanTally> shoot(const std::vector<HitscanRule>& rules, const HitscanCell& c, std::uint64_t seed,
                                std::int64_t shots) {
  const RandomStream stream = hitscan_factors.stream(c, seed);
  const Vec3<double> arc_at_range = Vec3<double>(c.range, 0, 0) + pull_direction(c) * deflection(c);
  HitscanTally none;
  none.lateness.unit = contact_window(c).upper + c.step;
  none.path_error.unit = none.point_error.unit = deflection(c) + reach(c);
  std::vector<HitscanTally> tallies(rules.size(), none);
  for (std::int64_t i = 0; i < shots; ++i) {
    const Placement placement = random_placement(c, stream, static_cast<std::uint64_t>(i));
    const Vec3<double>& center = placement.target.center;
    const std::optional<TrueImpact> truth = true_impact(c, center);
    for (std::size_t k = 0; k < rules.size(); ++k) {
      const HitscanAnswer answer = answer_of(rules[k], c, placement);
      HitscanTally& tally = tallies[k];
      ++tally.shots;
      tally.touching += truth ? 1 : 0;
      tally.missed += truth && !answer.hit ? 1 : 0;
      tally.false_hits += !truth && answer.hit ? 1 : 0;
      tally.path_error.add((answer.at_range - arc_at_range).norm());
      if (!truth || !answer.hit) continue;
      tally.lateness.add(answer.time - truth->time);
      const Vec3<double> touched = center + (truth->bullet - center) * (c.target / reach(c));
      tally.point_error.add((answer.point - touched).norm());
    }
  }
  return tallies;
}

// What geometry expects, and whether what was counted and measured agrees.

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
  for (const auto& [from, to] : {Interval{0, inner}, Interval{inner, outer}}) {
    for (int j = 0; j < turns && from < to; ++j) {
      const double turn = (j + 0.5) / turns * std::numbers::pi, half = (to - from) / 2;
      const double beside = from + half * (1 - std::cos(turn));
      const double width = 2 * half * std::sin(turn) * std::numbers::pi / turns;  // on both sides of the plane
      const auto at = [beside](double radius) { return std::sqrt(std::max(0.0, radius * radius - beside * beside)); };
      const Places arc_places = shadow(arc, c.range, at(outer));
      sum.arc += length(arc_places) * width;
      if (beside >= rule_reach) continue;
      for (const std::vector<PathPiece>& path : paths) {
        const Places rule_places = shadow(path, c.range, at(rule_reach));
        sum.rule += length(rule_places) * width / phases;
        sum.both += length(arc_places & rule_places) * width / phases;
      }
    }
  }
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
  return {.touch = share(areas.arc),
          .reported = share(areas.rule),
          .missed = share(areas.arc - areas.both),
          .false_hits = share(areas.rule - areas.both),
          .path_error = path_errors(rule, c),
          .path_error_possible = possible_path_error(rule, c),
          .lateness = rule.path == FlightPath::tangents ? std::optional(next_frame_lateness(c)) : std::nullopt,
          .lateness_possible = possible_lateness(rule, c)};
}

double flat_missed(double target, double radius, double deflection) {
  const double outer = target + radius;
  return 1 - lens_area(target, outer, deflection) / (std::numbers::pi * outer * outer);
}

double flat_false(double target, double radius, double deflection) {
  return 1 - lens_area(target, target + radius, deflection) / (std::numbers::pi * target * target);
}

std::optional<double> range_of_missed(const HitscanCell& c, double share) {
  const auto arc = arc_of<double>(c);
  const auto too_many = [&](double range) { return flat_missed(c.target, 0, arc.at_distance(range).s) - share; };
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
    const auto& [c, rule_of, t, e] = rows[i];
    const std::string rule(rule_of.name);
    if (i == 0 || rows[i - 1].cell != c) counts.push_back({"exact arc", "touching", t.shots, t.touching, e.touch});
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
