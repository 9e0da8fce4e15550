#include <thinwall/experiments/hitscan/theory.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <boost/math/tools/toms748_solve.hpp>

#include <thinwall/experiments/hitscan/shadow.hpp>

namespace thinwall {

namespace {

constexpr int count_phases = 32;

std::vector<PathPiece> pieces_of(FlightPath path, const HitscanCell& c, double phase) {
  if (path == FlightPath::line) return {{0, 0, 2 * c.range, 0}};
  const auto arc = arc_of<double>(c);
  const std::vector<double> frames = frames_near_target(c, phase);
  std::vector<PathPiece> pieces;
  for (std::size_t i = 0; i + 1 < frames.size(); ++i) {
    const auto a = after(arc, frames[i]), b = after(arc, frames[i + 1]);
    const double step = frames[i + 1] - frames[i];
    const bool chord = path == FlightPath::chords;
    pieces.push_back({a.x, a.s, chord ? b.x : a.x + a.vx * step, chord ? b.s : a.s + a.vs * step});
  }
  return pieces;
}

/// The arc itself, as chords far finer than any rule's.
std::vector<PathPiece> pieces_of_arc(const HitscanCell& c) {
  const HitscanWindow window = contact_window(c);
  const auto arc = arc_of<double>(c);
  const int slices = 64 * (1 + static_cast<int>((window.until - window.from) / c.step));
  std::vector<PathPiece> pieces;
  auto here = after(arc, window.from);
  for (int i = 1; i <= slices; ++i) {
    const auto next = after(arc, window.from + (window.until - window.from) * i / slices);
    pieces.push_back({here.x, here.s, next.x, next.s});
    here = next;
  }
  return pieces;
}

struct Areas {
  double arc = 0, rule = 0, both = 0;  ///< [m^2]
};

/// Slice by slice of how far beside the arc's plane the target's center is. Two pieces, as the shadow of a center ends
/// at the target's radius and that of a ball at the reach; q = middle + half cos(turn) takes the roots at the ends
/// away.
Areas areas_of(const HitscanRule& rule, const HitscanCell& c) {
  const double outer = reach(c), inner = c.target, rule_reach = rule.has_radius ? outer : inner;
  const int phases = rule.path == FlightPath::line ? 1 : count_phases;
  std::vector<std::vector<PathPiece>> paths;
  for (int i = 0; i < phases; ++i) paths.push_back(pieces_of(rule.path, c, phase_of(rule, c, i, phases)));
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
        sum.both += length(common(arc_places, rule_places)) * width / phases;
      }
    }
  };
  add_piece(0, inner);
  add_piece(inner, outer);
  return sum;
}

/// [m^2] Of the two discs together.
double drawn_area(const HitscanCell& c) {
  const double disc = disc_radius(c);
  return 2 * std::numbers::pi * disc * disc - lens_area(disc, disc, deflection(c));
}

}  // namespace

HitscanExpected expected_of(const HitscanRule& rule, const HitscanCell& c) {
  const Areas areas = areas_of(rule, c);
  const double drawn = drawn_area(c);
  HitscanExpected e = {areas.arc / drawn,
                       areas.rule / drawn,
                       std::max(0.0, areas.arc - areas.both) / drawn,
                       std::max(0.0, areas.rule - areas.both) / drawn,
                       path_errors(rule, c),
                       path_error_bound(rule, c),
                       std::nullopt};
  if (rule.report == ReportTime::end_of_step) e.lateness = next_frame_lateness(c);
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
    return flat_missed(c.target, 0, at_distance(arc_of<double>(c), range).s) - share;
  };
  const auto arc = arc_of<double>(c);
  if (arc.pull == 0) return std::nullopt;
  // Without drag the deflection is 2 targets, and everything is missed, at this range; drag only makes the fall longer.
  double farthest = 2 * c.speed * std::sqrt(c.target / arc.pull);
  if (arc.drag > 0) farthest = std::min(farthest, 0.9 * c.speed / arc.drag);
  if (too_many(farthest) < 0) return std::nullopt;
  const boost::math::tools::eps_tolerance<double> tolerance(40);
  std::uintmax_t most = 200;
  const auto bracket = boost::math::tools::toms748_solve(too_many, 0.0, farthest, tolerance, most);
  return bracket.first + (bracket.second - bracket.first) / 2;
}

}  // namespace thinwall
