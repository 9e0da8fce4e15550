#include <thinwall/experiments/hitscan/rules.hpp>

#include <algorithm>
#include <array>
#include <optional>

#include <thinwall/discrete/queries.hpp>
#include <thinwall/swept/time_of_impact.hpp>

namespace thinwall {

namespace {

constexpr std::array all_rules = {hitscan_ray, hitscan_ball, next_frame, swept_steps};

struct PieceHit {
  double part;  ///< [1] of the piece
  Vec3<double> point;
};

std::optional<PieceHit> hit_on(const FlightPiece& piece, const HitscanRule& rule, const HitscanCell& c,
                               const Sphere<double>& target) {
  if (rule.has_radius) {
    const auto toi = time_of_impact(Moving{Sphere{piece.start, c.radius}, piece.displacement}, at_rest(target));
    if (toi.status != ToiStatus::hit && toi.status != ToiStatus::overlapping) return std::nullopt;
    return PieceHit{toi.time, toi.point};
  }
  const auto hit = raycast(Ray<double>{piece.start, piece.displacement, 1}, target);
  if (!hit) return std::nullopt;
  return PieceHit{hit->t, hit->point};
}

double report_time(ReportTime report, const FlightPiece& piece, double part) {
  switch (report) {
    case ReportTime::firing: return 0;
    case ReportTime::end_of_step: return piece.until;
    case ReportTime::in_step: break;
  }
  return piece.from + part * (piece.until - piece.from);
}

void note(const HitscanAnswer& answer, const TrueImpact& truth, const HitscanCell& c, const Vec3<double>& center,
          const Vec3<double>& arc_at_range, HitscanTally& tally) {
  ++tally.shots;
  tally.touching += truth.touches ? 1 : 0;
  tally.missed += truth.touches && !answer.hit ? 1 : 0;
  tally.false_hits += !truth.touches && answer.hit ? 1 : 0;
  add(tally.path_error, (answer.at_range - arc_at_range).norm(), length_unit(c));
  if (!truth.touches || !answer.hit) return;
  add(tally.lateness, answer.time - truth.time, time_unit(c));
  add(tally.point_error, (answer.point - contact_point(c, truth, center)).norm(), length_unit(c));
}

}  // namespace

std::vector<std::string_view> hitscan_rule_names() {
  std::vector<std::string_view> names;
  for (const HitscanRule& rule : all_rules) names.push_back(rule.name);
  return names;
}

std::vector<HitscanRule> hitscan_rules(std::span<const std::string> names) {
  std::vector<HitscanRule> chosen;
  std::copy_if(all_rules.begin(), all_rules.end(), std::back_inserter(chosen), [&](const HitscanRule& rule) {
    return std::find(names.begin(), names.end(), rule.name) != names.end();
  });
  return chosen;
}

std::vector<FlightPiece> flight_pieces(FlightPath path, const HitscanCell& c, double phase) {
  if (path == FlightPath::line) return {{{0, 0, 0}, {2 * c.range, 0, 0}, 0, 0}};  // past the target, wherever it is hit
  const Arc<double> arc = arc_of<double>(c);
  const Vec3<double> ahead(1, 0, 0), pull = pull_direction(c);
  const std::vector<double> frames = frames_near_target(c, phase);
  std::vector<FlightPiece> pieces;
  for (std::size_t i = 0; i + 1 < frames.size(); ++i) {
    const double from = frames[i], until = frames[i + 1];
    const auto here = after(arc, from);
    const Vec3<double> start = ahead * here.x + pull * here.s;
    if (path == FlightPath::tangents) {
      const Vec3<double> velocity = ahead * here.vx + pull * here.vs;
      pieces.push_back({start, velocity * (until - from), from, until});
    } else {
      const auto next = after(arc, until);
      const Vec3<double> end = ahead * next.x + pull * next.s;
      pieces.push_back({start, end - start, from, until});
    }
  }
  return pieces;
}

HitscanAnswer answer_of(const HitscanRule& rule, const HitscanCell& c, const Placement& placement) {
  HitscanAnswer answer;
  bool crossed = false;
  for (const FlightPiece& piece : flight_pieces(rule.path, c, placement.phase)) {
    if (!crossed && piece.start[0] + piece.displacement[0] >= c.range) {
      crossed = true;
      answer.at_range = piece.start + piece.displacement * ((c.range - piece.start[0]) / piece.displacement[0]);
    }
    if (answer.hit) continue;
    const auto hit = hit_on(piece, rule, c, placement.target);
    if (!hit) continue;
    answer.hit = true;
    answer.time = report_time(rule.report, piece, hit->part);
    answer.point = hit->point;
  }
  return answer;
}

double time_unit(const HitscanCell& c) { return contact_window(c).until + c.step; }
double length_unit(const HitscanCell& c) { return deflection(c) + reach(c); }

std::vector<HitscanTally> shoot(std::span<const HitscanRule> rules, const HitscanCell& c, std::uint64_t seed,
                                std::int64_t shots) {
  const RandomStream stream = random_stream(c, seed);
  const Vec3<double> arc_at_range = Vec3<double>(c.range, 0, 0) + pull_direction(c) * deflection(c);
  std::vector<HitscanTally> tallies(rules.size());
  for (std::int64_t i = 0; i < shots; ++i) {
    const Placement placement = random_placement(c, stream, static_cast<std::uint64_t>(i));
    const TrueImpact truth = true_impact(c, placement.target.center);
    for (std::size_t k = 0; k < rules.size(); ++k) {
      note(answer_of(rules[k], c, placement), truth, c, placement.target.center, arc_at_range, tallies[k]);
    }
  }
  return tallies;
}

}  // namespace thinwall
