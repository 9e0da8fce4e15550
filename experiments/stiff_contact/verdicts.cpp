#include <thinwall/experiments/stiff_contact/verdicts.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <thinwall/experiments/stiff_contact/theory.hpp>

namespace thinwall {

namespace {

/// A bracket wider than this shows nothing.
constexpr double wide = 1e-3;

void judge(StiffTest& test, bool right) {
  ++test.judged;
  if (!right) ++test.wrong;
}

double width(const LimitLine& line) {
  const bool closed = line.bracket.stable > 0 && std::isfinite(line.bracket.unstable);
  return closed ? line.bracket.unstable / line.bracket.stable - 1 : 0;
}

void judge_limits(const StiffPlan& plan, const std::vector<LimitLine>& lines, std::vector<StiffTest>& tests) {
  StiffTest inside = {"the limit lies in the measured bracket"};
  StiffTest narrow = {"the bracket is at most 0.1 % wide"};
  StiffTest map = {"a step is stable below the limit and unstable above"};
  for (const LimitLine& line : lines) {
    judge(inside, line.holds_theory());
    judge(narrow, width(line) <= wide);
    for (std::size_t i = 0; i < plan.steps.size(); ++i) {
      const Verdict verdict = verdict_of(plan, line, i);
      if (verdict == Verdict::undecided) continue;
      judge(map, (verdict == Verdict::stable) == (!line.theory || plan.steps[i] < *line.theory));
    }
  }
  tests.insert(tests.end(), {inside, narrow, map});
}

void judge_energy(const StiffPlan& plan, const std::vector<ContactLine>& lines, std::vector<StiffTest>& tests) {
  StiffTest bounds = {"semi-implicit, undamped: the speed ratio keeps its bounds"};
  StiffTest gains = {"explicit, undamped: never slower after than before"};
  StiffTest loses = {"implicit, undamped: never faster after than before"};
  for (const ContactLine& line : lines) {
    const PenaltyContact& c = line.contact;
    if (c.damping_ratio != 0 || !is_clean(plan, line)) continue;
    const double slack = rounding(plan, c);
    const auto range = bounce_bounds(c.step);
    if (c.scheme == Scheme::semi_implicit && range) {
      judge(bounds, line.tally.slowest >= range->lower - slack && line.tally.fastest <= range->upper + slack);
    }
    if (c.scheme == Scheme::explicit_euler) judge(gains, line.tally.slowest >= 1 - slack);
    if (c.scheme == Scheme::implicit_euler) judge(loses, line.tally.fastest <= 1 + slack);
  }
  tests.insert(tests.end(), {bounds, gains, loses});
}

/// A spring that is relaxed at first touch does not push there: the rest of the split step goes where the whole one went.
void judge_splits(const StiffPlan& plan, const std::vector<ContactLine>& lines, std::vector<StiffTest>& tests) {
  StiffTest same = {"explicit and semi-implicit, undamped: splitting the step changes no bounce"};
  for (const ContactLine& line : lines) {
    const PenaltyContact& c = line.contact;
    if (c.detection != Detection::discrete || c.scheme == Scheme::implicit_euler || c.damping_ratio != 0) continue;
    const ContactLine* split = twin_of(lines, line);
    if (split == nullptr || !is_clean(plan, line)) continue;
    const double slack = rounding(plan, c) * std::max(1.0, line.tally.fastest);
    judge(same, is_clean(plan, *split) && std::abs(line.tally.slowest - split->tally.slowest) <= slack &&
                    std::abs(line.tally.fastest - split->tally.fastest) <= slack);
  }
  tests.push_back(same);
}

void judge_escapes(const StiffPlan& plan, const std::vector<ContactLine>& lines, std::vector<StiffTest>& tests) {
  StiffTest late = {"discrete: as many escape as are first seen past the middle, or more"};
  StiffTest held = {"implicit, split, stiff enough for continuous time: none escapes"};
  for (const ContactLine& line : lines) {
    const PenaltyContact& c = line.contact;
    const double bounces = static_cast<double>(line.tally.bounces());
    if (c.detection == Detection::discrete) {
      judge(late, static_cast<double>(line.tally.escaped) >= std::floor(bounces * late_share(plan, c)) - 1);
    } else if (c.scheme == Scheme::implicit_euler) {
      const double depth = plan.approach.speed / frequency(spring_of(plan.approach, c));
      if (depth < reach(plan.approach)) judge(held, line.tally.escaped == 0);
    }
  }
  tests.insert(tests.end(), {late, held});
}

}  // namespace

bool is_clean(const StiffPlan& plan, const ContactLine& line) {
  return line.tally.returned == line.tally.bounces() && line.tally.deepest < reach(plan.approach);
}

double rounding(const StiffPlan& plan, const PenaltyContact& c) {
  // Each of pi / step + 2 poses is off by half an ulp of the reach, a share of the path of a step, which the spring turns
  // into step^2 of it in speed; near a step of 2 the bounce passes that on up to 1 / sqrt(1 - step^2 / 4) times.
  const double path = plan.approach.speed * seconds(plan.approach, c);
  const double pose = std::numeric_limits<double>::epsilon() * (1 + reach(plan.approach) / path);
  const double passed_on = bounce_bounds(c.step).value_or(Interval{1, 1}).upper;
  return pose * (std::numbers::pi + 2 * c.step) * (1 + c.step) * passed_on;
}

double late_share(const StiffPlan& plan, const PenaltyContact& c) {
  const double path = plan.approach.speed * seconds(plan.approach, c);
  return std::max(0.0, 1 - reach(plan.approach) / path);
}

std::vector<StiffTest> stiff_tests(const StiffPlan& plan, const std::vector<LimitLine>& limits,
                                   const std::vector<ContactLine>& bounces) {
  std::vector<StiffTest> tests;
  judge_limits(plan, limits, tests);
  judge_energy(plan, bounces, tests);
  judge_splits(plan, bounces, tests);
  judge_escapes(plan, bounces, tests);
  return tests;
}

bool all_passed(const std::vector<StiffTest>& tests) {
  return std::all_of(tests.begin(), tests.end(), [](const StiffTest& t) { return t.passed(); });
}

double widest_bracket(const std::vector<LimitLine>& limits) {
  double widest = 0;
  for (const LimitLine& line : limits) widest = std::max(widest, width(line));
  return widest;
}

}  // namespace thinwall
