#include <thinwall/experiments/stiff_contact/theory.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

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

/// `holds` says whether it does in a row, or nothing where the claim does not speak of that.
template <class Row, class Holds> StiffClaim claim(std::string text, const std::vector<Row>& rows, const Holds& holds) {
  StiffClaim claim = {std::move(text)};
  for (const Row& row : rows) {
    const std::optional<bool> right = holds(row);
    if (!right) continue;
    ++claim.judged;
    if (!*right) ++claim.wrong;
  }
  return claim;
}

/// Steps of the map outside of the brackets.
StiffClaim map_claim(const StiffPlan& plan, const std::vector<LimitRow>& rows) {
  StiffClaim sum = {"a step is stable below the limit and unstable above"};
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    const StiffClaim at_step = claim("", rows, [&](const LimitRow& row) -> std::optional<bool> {
      const std::string_view verdict = verdict_of(plan, row, i);
      if (verdict == "undecided") return std::nullopt;
      return (verdict == "stable") == (!row.theory || plan.steps[i] < *row.theory);
    });
    sum.judged += at_step.judged;
    sum.wrong += at_step.wrong;
  }
  return sum;
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
  constexpr double wide = 1e-3;  // a bracket wider than this shows nothing
  using Maybe = std::optional<bool>;
  const StiffPlan& plan = results.plan;
  const std::vector<ContactRow>& bounces = results.bounces;
  const auto undamped = [&](const ContactRow& row, Scheme scheme) {
    return row.contact.scheme == scheme && row.contact.damping_ratio == 0 && is_clean(plan, row);
  };
  return {
      claim("the limit lies in the measured bracket", results.limits,
            [](const LimitRow& row) -> Maybe { return holds_theory(row); }),
      claim("the bracket is at most 0.1 % wide", results.limits,
            [](const LimitRow& row) -> Maybe { return bracket_width(row) <= wide; }),
      map_claim(plan, results.limits),
      claim("semi-implicit, undamped: the speed ratio keeps its bounds", bounces,
            [&](const ContactRow& row) -> Maybe {
              const auto range = bounce_bounds(row.contact.step);
              if (!range || !undamped(row, Scheme::semi_implicit)) return {};
              const double slack = slack_of(plan, row.contact);
              return row.tally.slowest >= range->lower - slack && row.tally.fastest <= range->upper + slack;
            }),
      claim("explicit, undamped: never slower after than before", bounces,
            [&](const ContactRow& row) -> Maybe {
              if (!undamped(row, Scheme::explicit_euler)) return {};
              return row.tally.slowest >= 1 - slack_of(plan, row.contact);
            }),
      claim("implicit, undamped: never faster after than before", bounces,
            [&](const ContactRow& row) -> Maybe {
              if (!undamped(row, Scheme::implicit_euler)) return {};
              return row.tally.fastest <= 1 + slack_of(plan, row.contact);
            }),
      // A spring that is relaxed at first touch does not push there: the rest of the split step goes where the whole one went.
      claim("explicit and semi-implicit, undamped: splitting the step changes no bounce", bounces,
            [&](const ContactRow& row) -> Maybe {
              const bool is_told = undamped(row, Scheme::explicit_euler) || undamped(row, Scheme::semi_implicit);
              if (!is_told || row.contact.detection != Detection::discrete) return {};
              const ContactRow& split = *twin_of(bounces, row);
              const double slack = slack_of(plan, row.contact) * std::max(1.0, row.tally.fastest);
              return is_clean(plan, split) && std::abs(row.tally.slowest - split.tally.slowest) <= slack &&
                     std::abs(row.tally.fastest - split.tally.fastest) <= slack;
            }),
      claim("discrete: as many escape as are first seen past the middle, or more", bounces,
            [&](const ContactRow& row) -> Maybe {
              if (row.contact.detection != Detection::discrete) return {};
              const double late = static_cast<double>(row.tally.bounces()) * late_share(plan, row.contact);
              return static_cast<double>(row.tally.escaped) >= std::floor(late) - 1;
            }),
      claim("implicit, split, stiff enough for continuous time: none escapes", bounces,
            [&](const ContactRow& row) -> Maybe {
              const PenaltyContact& c = row.contact;
              const double depth = plan.approach.speed / frequency(spring_of(plan.approach, c));
              const bool holds = depth < reach(plan.approach);
              if (c.scheme != Scheme::implicit_euler || c.detection == Detection::discrete || !holds) return {};
              return row.tally.escaped == 0;
            })};
}

bool all_passed(const std::vector<StiffClaim>& claims) { return std::ranges::all_of(claims, &StiffClaim::passed); }

}  // namespace thinwall
