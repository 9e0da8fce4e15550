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

/// [1] How wide the bracket is, over its stable end; 0 if it has not two ends.
double width(const LimitBracket& bracket) {
  return bracket.stable > 0 && std::isfinite(bracket.unstable) ? bracket.unstable / bracket.stable - 1 : 0;
}

/// `rows` are those that it speaks of.
template <class Row, class Holds> StiffClaim claim(std::string text, const std::vector<Row>& rows, const Holds& holds) {
  const std::int64_t right = std::ranges::count_if(rows, holds);
  return {std::move(text), std::ssize(rows), std::ssize(rows) - right};
}

}  // namespace

bool holds_theory(const LimitRow& row) {
  const LimitBracket& bracket = row.bracket;
  if (!row.theory) return std::isinf(bracket.unstable);
  return bracket.stable <= *row.theory && *row.theory <= bracket.unstable;
}

std::vector<MapStep> map_of(const StiffPlan& plan, const std::vector<LimitRow>& rows) {
  std::vector<MapStep> map;
  for (const LimitRow& row : rows) {
    for (std::size_t i = 0; i < plan.steps.size(); ++i) {
      const double step = plan.steps[i];
      const bool undecided = row.bracket.stable < step && step < row.bracket.unstable;
      const char* decided = row.blow_ups[i] > 0 ? "unstable" : "stable";
      map.push_back({&row, step, row.blow_ups[i], undecided ? "undecided" : decided});
    }
  }
  return map;
}

bool is_clean(const StiffPlan& plan, const ContactRow& row) {
  return row.tally.returned == row.tally.bounces() && row.tally.deepest < reach(plan.approach);
}

bool is_stiff_enough(const StiffPlan& plan, const PenaltyContact& c) {
  const double depth = plan.approach.speed * deepest(c.damping_ratio) / frequency(spring_of(plan.approach, c));
  return depth < reach(plan.approach);
}

const ContactRow& twin_of(const std::vector<ContactRow>& rows, const ContactRow& row) {
  PenaltyContact other = row.contact;
  other.detection = other.detection == Detection::discrete ? Detection::toi_split : Detection::discrete;
  return *std::ranges::find(rows, other, &ContactRow::contact);
}

std::vector<StiffClaim> stiff_claims(const StiffResults& results) {
  constexpr double wide = 1e-3;  // a bracket wider than this shows nothing
  const StiffPlan& plan = results.plan;
  const auto decided = only(map_of(plan, results.limits), [](const MapStep& s) { return s.verdict != "undecided"; });
  const auto undamped =
      only(results.bounces, [&](const ContactRow& r) { return r.contact.damping_ratio == 0 && is_clean(plan, r); });
  const auto undamped_by = [&](Scheme scheme) {
    return only(undamped, [scheme](const ContactRow& r) { return r.contact.scheme == scheme; });
  };
  const auto discrete = [](const ContactRow& r) { return r.contact.detection == Detection::discrete; };
  const auto slack = [&](const ContactRow& r) { return slack_of(plan, r.contact); };
  return {
      claim("the limit lies in the measured bracket", results.limits, holds_theory),
      claim("the bracket is at most 0.1 % wide", results.limits,
            [](const LimitRow& row) { return width(row.bracket) <= wide; }),
      claim("a step is stable below the limit and unstable above", decided,
            [](const MapStep& s) {
              return (s.verdict == "stable") == (!s.spring->theory || s.step < *s.spring->theory);
            }),
      claim("semi-implicit, undamped: the speed ratio keeps its bounds",
            only(undamped_by(Scheme::semi_implicit),
                 [](const ContactRow& r) { return bounce_bounds(r.contact.step).has_value(); }),
            [&](const ContactRow& r) {
              const Interval range = *bounce_bounds(r.contact.step);
              return r.tally.slowest >= range.lower - slack(r) && r.tally.fastest <= range.upper + slack(r);
            }),
      claim("explicit, undamped: never slower after than before", undamped_by(Scheme::explicit_euler),
            [&](const ContactRow& r) { return r.tally.slowest >= 1 - slack(r); }),
      claim("implicit, undamped: never faster after than before", undamped_by(Scheme::implicit_euler),
            [&](const ContactRow& r) { return r.tally.fastest <= 1 + slack(r); }),
      // A spring that is relaxed at first touch does not push there: the rest of the split step goes where the whole one went.
      claim("explicit and semi-implicit, undamped: splitting the step changes no bounce",
            only(undamped,
                 [&](const ContactRow& r) { return discrete(r) && r.contact.scheme != Scheme::implicit_euler; }),
            [&](const ContactRow& r) {
              const ContactRow& split = twin_of(results.bounces, r);
              const double most = slack(r) * std::max(1.0, r.tally.fastest);
              return is_clean(plan, split) && std::abs(r.tally.slowest - split.tally.slowest) <= most &&
                     std::abs(r.tally.fastest - split.tally.fastest) <= most;
            }),
      claim("discrete: as many escape as are first seen past the middle, or more", only(results.bounces, discrete),
            [&](const ContactRow& r) {
              const double late_share = std::max(0.0, 1 - reach(plan.approach) / step_path(plan.approach, r.contact));
              const double least = std::floor(static_cast<double>(r.tally.bounces()) * late_share) - 1;
              return static_cast<double>(r.tally.escaped) >= least;
            }),
      claim("implicit, split, stiff enough for continuous time: none escapes",
            only(results.bounces,
                 [&](const ContactRow& r) {
                   const double depth = plan.approach.speed / frequency(spring_of(plan.approach, r.contact));
                   return r.contact.scheme == Scheme::implicit_euler && !discrete(r) && depth < reach(plan.approach);
                 }),
            [](const ContactRow& r) { return r.tally.escaped == 0; })};
}

}  // namespace thinwall
