#include <thinwall/experiments/hitscan/model.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

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
  const auto refuse = [&](std::string_view key, const std::string& allowed) {
    settings.complain(key, fmt::format("{}; not so at {}", allowed, hitscan_factors().key(c)));
  };
  if (!(c.range > 2 * reach(c))) refuse("range", "more than 2 * (target + radius)");
  if (reach(c) < least_reach * c.range)
    refuse("target", fmt::format("such that target + radius is at least {} of the range", least_reach));
  if (c.drag * c.step > most_drag_in_a_step) refuse("step", fmt::format("drag * step at most {}", most_drag_in_a_step));
  const auto arc = arc_of<double>(c);
  const auto there = arc.at_distance(c.range + reach(c));
  if (reach(c) * arc.pull > most_bend * there.vx * there.vx) {
    refuse("speed",
           fmt::format("fast enough to fly nearly straight past a target: (target + radius) * (gravity and wind) "
                       "at most {} of the squared speed there",
                       most_bend));
  }
  if (there.vx * c.step < least_path * reach(c))
    refuse("step", fmt::format("a path of at least {} of target + radius a step", least_path));
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
  const auto in_plane = [pull = pull_direction(c)](double x, double s) -> Vec3<double> {
    return Vec3<double>(1, 0, 0) * x + pull * s;
  };
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

const Factors<HitscanCell>& hitscan_factors() {
  using C = HitscanCell;
  static const Factors<C> all = factors<C>(
      numbers("range", &C::range, {.lower = 0, .upper = 1e6, .lower_open = true, .unit = "m"},
              "From the muzzle to the plane of the target's center."),
      numbers("speed", &C::speed, {.lower = 0, .upper = 1e6, .lower_open = true, .unit = "m/s"}, "At the muzzle."),
      numbers("radius", &C::radius, {.lower = 0, .upper = 1e3, .unit = "m"}, "Of the bullet."),
      numbers("wind", &C::wind, {.lower = 0, .upper = 1e3, .unit = "m/s"},
              "Across the line of fire; 0 where there is no drag."),
      numbers("drag", &C::drag, {.lower = 0, .upper = 1e3, .unit = "1/s"},
              "Share of its speed, as seen from the air, that the bullet loses a second."),
      numbers("step", &C::step, {.lower = 0, .upper = 1e3, .lower_open = true, .unit = "s"},
              "Time step of the frames."),
      numbers("target", &C::target, {.lower = 1e-9, .upper = 1e3, .unit = "m"}, "Radius of the target."),
      number("gravity", &C::gravity, {.lower = 0, .upper = 1e3, .unit = "m/s^2"}, "Downward."),
      number("aim", &C::aim, {.lower = 1.1, .upper = 100},
             "Size of the discs that the target's center is drawn from."));
  return all;
}

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

std::vector<Interval> steps_from(double time, const HitscanCell& c, double phase,
                                 const std::function<bool(const Interval&)>& is_last) {
  std::vector<Interval> steps;
  double frame = std::max(0.0, std::floor(time / c.step + phase) - 1);
  do {
    steps.push_back({frame > 0 ? (frame - phase) * c.step : 0, (frame + 1 - phase) * c.step});
    frame += 1;
  } while (!is_last(steps.back()));
  return steps;
}

std::vector<Interval> steps_near_target(const HitscanCell& c, double phase) {
  const Interval window = contact_window(c);
  return steps_from(window.lower, c, phase, [&](const Interval& step) { return step.upper >= window.upper; });
}

std::vector<HitscanCell> make_hitscan_cells(const Settings& settings) {
  bool any = false;
  const auto fired = hitscan_factors().first_fastest().cells(settings, 1, {}, [&](HitscanCell& c) {
    if (c.drag == 0) c.wind = 0;  // without drag a wind does nothing
    if (c.drag * (c.range + reach(c)) > (1 - least_speed_left) * c.speed) return false;
    any = true;
    if (is_known(c)) return false;
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
  const auto crosses = [&](const FlightPiece& piece) { return piece.start[0] + piece.displacement[0] >= c.range; };
  const FlightPiece& last = *std::ranges::find_if(pieces, crosses);
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

constexpr int sum_bits = 30;

void HitscanSpread::add(double x) {
  ++count;
  sum += std::llround(std::ldexp(x / unit, sum_bits));
  least = std::min(least, x);
  most = std::max(most, x);
}

double HitscanSpread::mean() const {
  return std::ldexp(static_cast<double>(sum), -sum_bits) * unit / static_cast<double>(count);
}

std::vector<HitscanTally> shoot(const std::vector<HitscanRule>& rules, const HitscanCell& c, std::uint64_t seed,
                                std::int64_t shots) {
  const RandomStream stream = hitscan_factors().stream(c, seed);
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

}  // namespace thinwall
