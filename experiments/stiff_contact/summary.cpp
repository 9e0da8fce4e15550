#include <thinwall/experiments/stiff_contact/summary.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include <fmt/format.h>

#include <thinwall/experiments/stiff_contact/pareto.hpp>
#include <thinwall/experiments/stiff_contact/theory.hpp>
#include <thinwall/experiments/text/numbers.hpp>

namespace thinwall {

namespace {

constexpr double one_percent = 0.01;

bool is_stiff_enough(const StiffPlan& plan, const PenaltyContact& c) {
  const double depth = plan.approach.speed * deepest(c.damping_ratio) / frequency(spring_of(plan.approach, c));
  return depth < reach(plan.approach);
}

/// Bounces off walls that would hold in continuous time.
struct Passage {
  std::int64_t bounces = 0, escaped = 0, unfinished = 0, too_fast = 0;
  double least_escape = std::numeric_limits<double>::infinity();  ///< [reaches] the shortest path of a step that did
};

Passage passage_of(const StiffPlan& plan, const std::vector<ContactLine>& lines, Scheme scheme, Detection detection,
                   const std::vector<double>& ratios) {
  Passage sum;
  for (const ContactLine& l : lines) {
    const PenaltyContact& c = l.contact;
    if (c.scheme != scheme || c.detection != detection || !is_stiff_enough(plan, c)) continue;
    if (std::find(ratios.begin(), ratios.end(), c.damping_ratio) == ratios.end()) continue;
    sum.bounces += l.tally.bounces();
    sum.escaped += l.tally.escaped;
    sum.unfinished += l.tally.unfinished;
    sum.too_fast += l.tally.blown_up;
    const double path = plan.approach.speed * seconds(plan.approach, c) / reach(plan.approach);
    if (l.tally.escaped > 0) sum.least_escape = std::min(sum.least_escape, path);
  }
  return sum;
}

std::string percent(std::int64_t part, std::int64_t whole) {
  return whole > 0 ? fmt::format("{:.1f} %", 100 * static_cast<double>(part) / static_cast<double>(whole)) : "-";
}

std::int64_t inside(const std::vector<LimitLine>& limits) {
  return std::count_if(limits.begin(), limits.end(), [](const LimitLine& l) { return l.holds_theory(); });
}

/// Undamped (or least damped), at the greatest stiffness, at the poses.
const ContactLine* bounce_at(const StiffPlan& plan, const std::vector<ContactLine>& lines, Scheme scheme, double step) {
  for (const ContactLine& l : lines) {
    const PenaltyContact& c = l.contact;
    if (c.scheme == scheme && c.step == step && c.stiffness == plan.stiffest() && c.detection == Detection::discrete &&
        c.damping_ratio == plan.bounce_ratios.front()) {
      return &l;
    }
  }
  return nullptr;
}

std::string speed_range(const ContactLine* line) {
  if (line == nullptr || line->tally.returned == 0) return "-";
  return fmt::format("{:.3g} to {:.3g}", line->tally.slowest, line->tally.fastest);
}

/// Up to four of the steps below 2, spread out, the last one always: what the summary shows.
std::vector<double> shown_steps(const StiffPlan& plan) {
  std::vector<double> all;
  for (const double step : plan.bounce_steps) {
    if (step < 2) all.push_back(step);
  }
  std::vector<double> shown;
  for (const double wanted : {0.1, 0.3, 1.5, 1.9}) {
    if (std::find(all.begin(), all.end(), wanted) != all.end()) shown.push_back(wanted);
  }
  if (shown.empty() && !all.empty()) shown.push_back(all.back());
  return shown;
}

std::string limits_part(const StiffPlan& plan, const std::vector<LimitLine>& limits) {
  std::string text = "A spring that holds both ways: the limit of h omega against its measured bracket.\n";
  text += fmt::format("{:<16}{:>9}{:>9}{:>12}   measured limit at {:g} N/m\n", "scheme", "springs", "inside", "widest",
                      plan.stiffness.front());
  for (const Scheme scheme : all_schemes) {
    std::vector<LimitLine> own;
    std::copy_if(limits.begin(), limits.end(), std::back_inserter(own),
                 [&](const LimitLine& l) { return l.cell.scheme == scheme; });
    std::string measured;
    for (const double ratio : {plan.ratios.front(), 0.1, 1.0, plan.ratios.back()}) {
      for (const LimitLine& l : own) {
        if (l.cell.ratio != ratio || l.cell.stiffness != plan.stiffness.front()) continue;
        const double stable = l.bracket.stable, unstable = l.bracket.unstable;
        measured += fmt::format("{}{} at {:g}", measured.empty() ? "" : ", ",
                                std::isinf(unstable) ? "none"
                                : stable == 0        ? std::string("0")
                                                     : fmt::format("{:.4g}", std::sqrt(stable * unstable)),
                                ratio);
        break;
      }
    }
    text += fmt::format("{:<16}{:>9}{:>9}{:>12}   {}\n", name(scheme), own.size(), inside(own),
                        fmt::format("{:.3f} %", 100 * widest_bracket(own)), measured);
  }
  return text;
}

std::string bounces_part(const StiffPlan& plan, const std::vector<ContactLine>& bounces) {
  const std::vector<double> steps = shown_steps(plan);
  std::string text =
      fmt::format("\nA wall that only pushes, {:g} N/m, damping ratio {:g}: speed out over speed in.\n{:<16}",
                  plan.stiffest(), plan.bounce_ratios.front(), "h omega");
  for (const double step : steps) text += fmt::format("{:>19}", fmt::format("{:g}", step));
  text += "\n";
  for (const Scheme scheme : all_schemes) {
    text += fmt::format("{:<16}", name(scheme));
    for (const double step : steps) text += fmt::format("{:>19}", speed_range(bounce_at(plan, bounces, scheme, step)));
    text += "\n";
  }
  text += "bounds, semi-imp";
  for (const double step : steps) {
    const Interval bounds = *bounce_bounds(step);
    text += fmt::format("{:>19}", fmt::format("{:.3g} to {:.3g}", bounds.lower, bounds.upper));
  }
  return text + "\n";
}

std::string passage_part(const StiffPlan& plan, const std::vector<ContactLine>& bounces) {
  std::string text = fmt::format(
      "\nWalls stiff enough for continuous time, all steps and dampings. Too fast: over {:g} x the speed in.\n"
      "Least path: the shortest step that let a ball through, over the way from touch to the middle.\n"
      "{:<16}{:<12}{:>12}{:>12}{:>13}{:>12}{:>14}\n",
      plan.approach.blow_up, "scheme", "detection", "bounces", "through", "still there", "too fast", "least path");
  for (const Scheme scheme : all_schemes) {
    for (const Detection detection : all_detections) {
      const Passage p = passage_of(plan, bounces, scheme, detection, plan.bounce_ratios);
      text += fmt::format("{:<16}{:<12}{:>12}{:>12}{:>13}{:>12}{:>14}\n", name(scheme), name(detection),
                          grouped_text(p.bounces), percent(p.escaped, p.bounces), percent(p.unfinished, p.bounces),
                          percent(p.too_fast, p.bounces), p.escaped > 0 ? fmt::format("{:.3g}", p.least_escape) : "-");
    }
  }
  return text;
}

std::string race_part(const StiffPlan& plan, const std::vector<StiffRacer>& racers) {
  std::string text =
      "\nTime a bounce [ns] at h omega, the cheapest with an error of speed out over in of at most 1 %.\n";
  text += fmt::format("{:<16}{:<12}", "scheme", "detection");
  for (const double ratio : plan.bounce_ratios) text += fmt::format("{:>23}", fmt::format("damping ratio {:g}", ratio));
  text += "\n";
  for (const Scheme scheme : all_schemes) {
    for (const Detection detection : all_detections) {
      text += fmt::format("{:<16}{:<12}", name(scheme), name(detection));
      for (const double ratio : plan.bounce_ratios) {
        const StiffRacer* best = cheapest(racers, ratio, scheme, detection, one_percent);
        text += fmt::format(
            "{:>23}",
            best == nullptr ? "-" : fmt::format("{:.0f} at {:g}", bounce_time(*best).median, best->contact.step));
      }
      text += "\n";
    }
  }
  return text;
}

}  // namespace

std::string stiff_answer(const StiffPlan& plan, const StiffResults& results) {
  std::string text = fmt::format(
      "A spring that holds both ways is stable below 2 (sqrt(1 + zeta^2) - zeta) / omega a step with semi-implicit Euler, below "
      "2 zeta / omega (2 (zeta - sqrt(zeta^2 - 1)) / omega if overdamped) with explicit Euler, and at every step with implicit "
      "Euler: that lies inside the measured bracket in {} of {} springs.",
      grouped_text(inside(results.limits)), grouped_text(static_cast<std::int64_t>(results.limits.size())));
  const std::vector<double> steps = shown_steps(plan);
  if (!steps.empty()) {
    const ContactLine* line = bounce_at(plan, results.bounces, Scheme::semi_implicit, steps.back());
    if (line != nullptr && line->tally.returned > 0) {
      text += fmt::format(
          " Stable is not enough for a wall that only pushes: at h omega = {:g} a semi-implicit bounce leaves with {:.2f} to {:.2f} "
          "of its speed, by phase.",
          steps.back(), line->tally.slowest, line->tally.fastest);
    }
  }
  const std::vector<double> ratio = {plan.bounce_ratios.front()};
  const auto share = [&](Scheme scheme, Detection detection) {
    const Passage p = passage_of(plan, results.bounces, scheme, detection, ratio);
    return percent(p.escaped, p.bounces);
  };
  const Passage held = passage_of(plan, results.bounces, Scheme::implicit_euler, Detection::toi_split, ratio);
  if (held.bounces > 0) {
    text += fmt::format(
        " At damping ratio {:g}, over all steps asked, {} of the semi-implicit bounces get through a wall that would hold in "
        "continuous time if contact is found at the poses, and {} if steps are split at the time of impact, because at first touch "
        "a spring does not push yet; with implicit Euler {} and {}.",
        ratio.front(), share(Scheme::semi_implicit, Detection::discrete),
        share(Scheme::semi_implicit, Detection::toi_split), share(Scheme::implicit_euler, Detection::discrete),
        share(Scheme::implicit_euler, Detection::toi_split));
  }
  return text;
}

std::string stiff_summary(const StiffPlan& plan, const StiffResults& results) {
  std::string text = limits_part(plan, results.limits) + bounces_part(plan, results.bounces) +
                     passage_part(plan, results.bounces) + race_part(plan, results.racers) + "\n";
  std::int64_t judged = 0;
  for (const StiffTest& test : results.tests) {
    judged += test.judged;
    if (!test.passed()) text += fmt::format("FAILED: {}: wrong in {} of {}.\n", test.claim, test.wrong, test.judged);
  }
  return text + fmt::format("Self-test: {}, {} claims on {} cells.\n", all_passed(results.tests) ? "passed" : "FAILED",
                            results.tests.size(), grouped_text(judged));
}

std::vector<Section> stiff_sections(const StiffPlan& plan, const StiffResults& results) {
  std::string fronts;
  for (const double ratio : plan.bounce_ratios) {
    fronts += fmt::format("Damping ratio {:g}, from the finest: ", ratio);
    const auto front = stiff_front(results.racers, ratio);
    for (std::size_t i = 0; i < front.size(); ++i) {
      const StiffRacer& r = *front[i];
      fronts +=
          fmt::format("{}{} {} at h omega {:g} (error {:.1e}, {:.0f} ns)", i == 0 ? "" : "; ", name(r.contact.scheme),
                      name(r.contact.detection), r.contact.step, r.tally.rms_error(), bounce_time(r).median);
    }
    fronts += ".\n\n";
  }
  std::string tests;
  for (const StiffTest& t : results.tests) {
    tests += fmt::format("{}: {} in {} of {} cells. ", t.claim, t.passed() ? "holds" : "FAILED", t.judged - t.wrong,
                         t.judged);
  }
  return {
      {"What is asked",
       "A ball and a wall with a spring and a damper between them, stepped by explicit, semi-implicit and implicit Euler. First the "
       "spring holds both ways, so that a step is linear: does the state grow? Then the wall only pushes: the ball flies at it, "
       "each time at another phase of the step, and is followed until it leaves. Contact is found at the poses, or the step is split "
       "at the time of impact and its rest pushes."},
      {"Oracle",
       "The limits are eigenvalues on the unit circle; the bounce is the damped oscillation in continuous time, up to when the wall "
       "would pull. docs/stiff_contact.md derives both. Growth is measured on the schemes' own steps: two unit states, stepped "
       "once, give the matrix of a step, and squaring it runs up to 2^50 steps."},
      {"Self-test", tests},
      {"Who is cheapest at which error", fronts},
      {"Limits",
       "One ball, one contact, no friction, no rotation, no gravity. A step in units of 1/omega says all about a single spring; in "
       "a stack the highest frequency of all springs together counts. Time a bounce is that of one body on one wall."},
  };
}

}  // namespace thinwall
