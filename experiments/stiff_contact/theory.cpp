#include <thinwall/experiments/stiff_contact/theory.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace thinwall {

namespace {

/// acos(z) / sqrt(1 - z^2), which is acosh(z) / sqrt(z^2 - 1) beyond 1, and 1 at 1.
double arc_over_sine(double z) {
  const double sine = std::sqrt(std::abs((1 - z) * (1 + z)));
  if (sine == 0) return 1;
  return (z < 1 ? std::atan2(sine, z) : std::asinh(sine)) / sine;
}

}  // namespace

std::optional<double> step_limit(Scheme scheme, double damping_ratio) {
  const double z = damping_ratio;
  switch (scheme) {
    case Scheme::explicit_euler: return z < 1 ? 2 * z : 2 / (z + std::sqrt((z - 1) * (z + 1)));
    case Scheme::semi_implicit: return 2 / (std::hypot(1.0, z) + z);
    case Scheme::implicit_euler: break;
  }
  return std::nullopt;
}

double restitution(double damping_ratio) { return std::exp(-2 * damping_ratio * arc_over_sine(damping_ratio)); }

double deepest(double damping_ratio) { return std::exp(-damping_ratio * arc_over_sine(damping_ratio)); }

std::optional<Interval> bounce_bounds(double step) {
  if (!(step < 2)) return std::nullopt;
  const double least = std::sqrt(1 - step * step / 4);
  return Interval{least, 1 / least};
}

namespace {

/// A bracket wider than this shows nothing.
constexpr double wide = 1e-3;

void judge(StiffClaim& claim, bool right) {
  ++claim.judged;
  if (!right) ++claim.wrong;
}

/// [1] Of the incoming speed: what rounding may do to a bounce.
double slack_of(const StiffPlan& plan, const PenaltyContact& c) {
  // Each of pi / step + 2 poses is off by half an ulp of the reach, a share of the path of a step, which the spring turns
  // into step^2 of it in speed; near a step of 2 the bounce passes that on up to 1 / sqrt(1 - step^2 / 4) times.
  const double pose = std::numeric_limits<double>::epsilon() * (1 + reach(plan.approach) / step_path(plan.approach, c));
  const double passed_on = bounce_bounds(c.step).value_or(Interval{1, 1}).upper;
  return pose * (std::numbers::pi + 2 * c.step) * (1 + c.step) * passed_on;
}

/// [1] The share of bounces whose first pose in contact, if there is one, is past the middle of the wall.
double late_share(const StiffPlan& plan, const PenaltyContact& c) {
  return std::max(0.0, 1 - reach(plan.approach) / step_path(plan.approach, c));
}

void judge_limits(const StiffPlan& plan, const std::vector<LimitRow>& rows, std::vector<StiffClaim>& claims) {
  StiffClaim inside = {"the limit lies in the measured bracket"};
  StiffClaim narrow = {"the bracket is at most 0.1 % wide"};
  StiffClaim map = {"a step is stable below the limit and unstable above"};
  for (const LimitRow& row : rows) {
    judge(inside, holds_theory(row));
    judge(narrow, bracket_width(row) <= wide);
    for (std::size_t i = 0; i < plan.steps.size(); ++i) {
      const std::string_view verdict = verdict_of(plan, row, i);
      if (verdict == "undecided") continue;
      judge(map, (verdict == "stable") == (!row.theory || plan.steps[i] < *row.theory));
    }
  }
  claims.insert(claims.end(), {inside, narrow, map});
}

void judge_energy(const StiffPlan& plan, const std::vector<ContactRow>& rows, std::vector<StiffClaim>& claims) {
  StiffClaim bounds = {"semi-implicit, undamped: the speed ratio keeps its bounds"};
  StiffClaim gains = {"explicit, undamped: never slower after than before"};
  StiffClaim loses = {"implicit, undamped: never faster after than before"};
  for (const ContactRow& row : rows) {
    const PenaltyContact& c = row.contact;
    if (c.damping_ratio != 0 || !is_clean(plan, row)) continue;
    const double slack = slack_of(plan, c);
    const auto range = bounce_bounds(c.step);
    if (c.scheme == Scheme::semi_implicit && range) {
      judge(bounds, row.tally.slowest >= range->lower - slack && row.tally.fastest <= range->upper + slack);
    }
    if (c.scheme == Scheme::explicit_euler) judge(gains, row.tally.slowest >= 1 - slack);
    if (c.scheme == Scheme::implicit_euler) judge(loses, row.tally.fastest <= 1 + slack);
  }
  claims.insert(claims.end(), {bounds, gains, loses});
}

/// A spring that is relaxed at first touch does not push there: the rest of the split step goes where the whole one went.
void judge_splits(const StiffPlan& plan, const std::vector<ContactRow>& rows, std::vector<StiffClaim>& claims) {
  StiffClaim same = {"explicit and semi-implicit, undamped: splitting the step changes no bounce"};
  for (const ContactRow& row : rows) {
    const PenaltyContact& c = row.contact;
    if (c.detection != Detection::discrete || c.scheme == Scheme::implicit_euler || c.damping_ratio != 0) continue;
    const ContactRow* split = twin_of(rows, row);
    if (split == nullptr || !is_clean(plan, row)) continue;
    const double slack = slack_of(plan, c) * std::max(1.0, row.tally.fastest);
    judge(same, is_clean(plan, *split) && std::abs(row.tally.slowest - split->tally.slowest) <= slack &&
                    std::abs(row.tally.fastest - split->tally.fastest) <= slack);
  }
  claims.push_back(same);
}

void judge_escapes(const StiffPlan& plan, const std::vector<ContactRow>& rows, std::vector<StiffClaim>& claims) {
  StiffClaim late = {"discrete: as many escape as are first seen past the middle, or more"};
  StiffClaim held = {"implicit, split, stiff enough for continuous time: none escapes"};
  for (const ContactRow& row : rows) {
    const PenaltyContact& c = row.contact;
    const double bounces = static_cast<double>(row.tally.bounces());
    if (c.detection == Detection::discrete) {
      judge(late, static_cast<double>(row.tally.escaped) >= std::floor(bounces * late_share(plan, c)) - 1);
    } else if (c.scheme == Scheme::implicit_euler) {
      const double depth = plan.approach.speed / frequency(spring_of(plan.approach, c));
      if (depth < reach(plan.approach)) judge(held, row.tally.escaped == 0);
    }
  }
  claims.insert(claims.end(), {late, held});
}

}  // namespace

bool holds_theory(const LimitRow& row) {
  const LimitBracket& bracket = row.bracket;
  if (!row.theory) return std::isinf(bracket.unstable);
  return bracket.stable <= *row.theory && *row.theory <= bracket.unstable;
}

double bracket_width(const LimitRow& row) {
  const LimitBracket& bracket = row.bracket;
  return bracket.stable > 0 && std::isfinite(bracket.unstable) ? bracket.unstable / bracket.stable - 1 : 0;
}

std::string_view verdict_of(const StiffPlan& plan, const LimitRow& row, std::size_t i) {
  const double step = plan.steps[i];
  if (row.bracket.stable < step && step < row.bracket.unstable) return "undecided";
  return row.blow_ups[i] > 0 ? "unstable" : "stable";
}

bool is_clean(const StiffPlan& plan, const ContactRow& row) {
  return row.tally.returned == row.tally.bounces() && row.tally.deepest < reach(plan.approach);
}

bool is_stiff_enough(const StiffPlan& plan, const PenaltyContact& c) {
  const double depth = plan.approach.speed * deepest(c.damping_ratio) / frequency(spring_of(plan.approach, c));
  return depth < reach(plan.approach);
}

const ContactRow* twin_of(const std::vector<ContactRow>& rows, const ContactRow& row) {
  PenaltyContact other = row.contact;
  other.detection = other.detection == Detection::discrete ? Detection::toi_split : Detection::discrete;
  const auto found = std::ranges::find(rows, other, &ContactRow::contact);
  return found == rows.end() ? nullptr : &*found;
}

std::vector<StiffClaim> stiff_claims(const StiffResults& results) {
  std::vector<StiffClaim> claims;
  judge_limits(results.plan, results.limits, claims);
  judge_energy(results.plan, results.bounces, claims);
  judge_splits(results.plan, results.bounces, claims);
  judge_escapes(results.plan, results.bounces, claims);
  return claims;
}

bool all_passed(const std::vector<StiffClaim>& claims) { return std::ranges::all_of(claims, &StiffClaim::passed); }

}  // namespace thinwall
