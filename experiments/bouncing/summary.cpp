#include <thinwall/experiments/bouncing/summary.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <thinwall/experiments/text/escape.hpp>
#include <thinwall/experiments/text/numbers.hpp>

namespace thinwall {

namespace {

/// The policies, in the order of their first line.
std::vector<std::string> policies_of(const std::vector<BounceLine>& lines) {
  std::vector<std::string> names;
  for (const BounceLine& l : lines) {
    if (std::find(names.begin(), names.end(), l.policy) == names.end()) names.push_back(l.policy);
  }
  return names;
}

const BounceLine& line_at(const std::vector<BounceLine>& lines, const std::string& policy, double step) {
  return *std::find_if(lines.begin(), lines.end(),
                       [&](const BounceLine& l) { return l.policy == policy && l.cell.step == step; });
}

/// Of a policy, from the coarsest step to the finest.
std::vector<BounceWork> work_of(const BouncingResults& results, const std::string& policy) {
  std::vector<BounceWork> work;
  std::copy_if(results.work.begin(), results.work.end(), std::back_inserter(work),
               [&](const BounceWork& w) { return w.policy == policy; });
  return work;
}

/// Who is good at the least cost: rms error and time of the exact arc at its coarsest step beside the best of the others.
std::string cost_sentence(const BouncingResults& results) {
  const std::vector<BounceWork> arc = work_of(results, "parabola_toi");
  const BounceWork* best = nullptr;
  for (const BounceWork& w : results.work) {
    if (w.policy == "parabola_toi") continue;
    if (best == nullptr || w.rms_error() < best->rms_error()) best = &w;
  }
  if (arc.empty() || best == nullptr) return "";
  return fmt::format(
      "The exact arc is off by {:.1e} (rms) at its coarsest step, in {:.0f} ns a bounce; the nearest of the others, {} at {:.3g} s, by "
      "{:.1e} in {:.0f} ns. ",
      arc.front().rms_error(), arc.front().nanoseconds, best->policy, best->cell.step, best->rms_error(),
      best->nanoseconds);
}

std::string long_sentence(const BouncingResults& results) {
  std::string text;
  for (const LongRun& run : results.long_runs) {
    if (run.points.empty()) continue;
    const LongRunPoint& last = run.points.back();
    text += fmt::format("{}{} {:.3g} after {} bounces", text.empty() ? "" : ", ", run.policy, last.mean, last.bounces);
  }
  return text.empty() ? "" : fmt::format("Of its energy a ball that bounces on without loss keeps: {}. ", text);
}

std::string means_rows(const BouncingResults& results) {
  const std::vector<BounceLine> lines = liveliest(results.lines);
  const double coarse = lines.front().cell.step, fine = lines.back().cell.step;
  std::string text = fmt::format(
      "Energy a bounce at random phase, restitution {:g}, in g h / V of it: mean (theory), deviation (theory).\n",
      lines.front().cell.restitution);
  text += fmt::format("{:<14}{:>31}{:>31}{:>11}{:>11}\n", "policy", fmt::format("step {:.3g} s", coarse),
                      fmt::format("step {:.3g} s", fine), "ns a step", "rms error");
  for (const std::string& policy : policies_of(lines)) {
    text += fmt::format("{:<14}", policy);
    for (const double step : {coarse, fine}) {
      const BounceLine& l = line_at(lines, policy, step);
      const auto small = [](double x) { return std::abs(x) < 5e-4 ? 0.0 : x; };  // no -0.000
      text += fmt::format("{:>31}", fmt::format("{:.3f} ({:.3f}), {:.3f} ({:.3f})", small(l.tally.mean),
                                                small(l.theory.mean()), l.tally.sigma(), l.theory.sigma()));
    }
    const std::vector<BounceWork> work = work_of(results, policy);
    const BounceWork& middle = work[work.size() / 2];
    text += fmt::format("{:>11.1f}{:>11.1e}\n", middle.nanoseconds * delta(middle.cell) / 2, middle.rms_error());
  }
  return text;
}

std::string long_rows(const BouncingResults& results) {
  std::string text =
      fmt::format("\nOn and on without loss, step {:.3g} s: energy over the first (at random phases), deviation.\n",
                  results.long_runs.front().cell.step);
  for (const LongRun& run : results.long_runs) {
    if (run.points.empty()) continue;
    const LongRunPoint& p = run.points.back();
    const auto n = static_cast<double>(p.bounces);
    text += fmt::format("{:<14}{:>5} bounces: {:.4f} ({:.4f}), {:.1e} ({:.1e}); dropped at rest {:.4f} after {}\n",
                        run.policy, p.bounces, p.mean, random_phase_mean(run, n), p.sigma, random_phase_sigma(run, n),
                        run.dropped_at_rest, run.rest_count);
  }
  return text;
}

std::string scenario_rows(const BouncingResults& results) {
  std::string text = fmt::format("\nImpacts in crowds: {} of {} as they must. The last of each kind:\n",
                                 results.scenarios_passed(), results.scenario_count());
  for (const ScenarioGroup& group : results.groups) {
    const auto wrong =
        std::find_if(group.scenarios.begin(), group.scenarios.end(), [](const BounceScenario& s) { return !s.passed; });
    const BounceScenario& shown = wrong != group.scenarios.end() ? *wrong : group.scenarios.back();
    text +=
        clipped(fmt::format("  {} {}: {}", shown.passed ? "ok    " : "FAILED", shown.name, shown.happened), 97) + "\n";
  }
  return text;
}

std::string tests_text(const std::vector<BounceTest>& tests) {
  std::string text;
  for (const BounceTest& t : tests) {
    text += fmt::format("{}: {} cells certain, {} wrong", t.policy, t.certain_cells, t.certain_wrong);
    if (t.judged_cells > 0) {
      text += fmt::format(
          "; {} of {} intervals hold the mean (allowed {} to {}), chi-square {:.1f} (allowed {:.1f} to {:.1f})",
          t.covered, t.judged_cells, t.covered_allowed.lower, t.covered_allowed.upper, t.mean_chi_square,
          t.mean_allowed.lower, t.mean_allowed.upper);
    }
    if (t.spread_cells > 0) {
      text += fmt::format(", of the variances {:.1f} (allowed {:.1f} to {:.1f})", t.spread_chi_square,
                          t.spread_allowed.lower, t.spread_allowed.upper);
    }
    text += t.passed() ? ".\n\n" : ": FAILED.\n\n";
  }
  return text;
}

}  // namespace

std::string bouncing_answer(const BouncingResults& results) {
  const std::vector<BounceLine> lines = liveliest(results.lines);
  std::string means;
  for (const std::string& policy : policies_of(lines)) {
    const BounceLine& l = line_at(lines, policy, lines.back().cell.step);
    const double mean = std::abs(l.tally.mean) < 5e-3 ? 0 : l.tally.mean;
    means += fmt::format("{}{} {:+.2f}", means.empty() ? "" : ", ", policy, mean);
  }
  return fmt::format(
      "At random phase a bounce at restitution {:g} changes the energy by, in units of g h / V: {} ({:.3g} s steps; theory {}). {}{}{} "
      "of {} crowds of impacts end as they must.",
      lines.front().cell.restitution, means, lines.back().cell.step, all_passed(results.tests) ? "agrees" : "DISAGREES",
      cost_sentence(results), long_sentence(results), results.scenarios_passed(), results.scenario_count());
}

std::string bouncing_summary(const BouncingResults& results) {
  return means_rows(results) + long_rows(results) + scenario_rows(results) +
         fmt::format("\nSelf-test: energies {}, crowds {}.\n", all_passed(results.tests) ? "passed" : "FAILED",
                     results.scenarios_passed() == results.scenario_count() ? "passed" : "FAILED");
}

std::vector<Section> bouncing_sections(const BouncingResults& results) {
  return {
      {"What is asked",
       "A ball is dropped and bounces. Each bounce is a flight of its own from apex to apex; how much of the step has passed when "
       "the true flight meets the floor, the phase, is uniform, and the same for every policy. What is measured is the energy of "
       "the flight, that is how high the ball will rise, after the bounce against before.\n\nproject_flip is semi-implicit Euler with "
       "the ball pushed out of the floor and its speed turned. flip_only only turns it. linear_toi splits the straight path of the step "
       "where the library finds first contact. exact_project flies the exact arc and pushes out its end. parabola_toi splits the arc "
       "where it meets the floor."},
      {"Theory",
       "The positions of semi-implicit Euler lie on an exact parabola, whose speed is half a step later than Euler's. So the true flight is "
       "the same for every policy, and what each does at the floor changes its energy by a polynomial of the phase, exactly. "
       "docs/bouncing.md derives its mean and deviation."},
      {"On and on",
       "In a long run phases are not random: each follows from the one before. Runs that begin at random in the first step, and one "
       "that begins with the drop itself, show what that does to the means above."},
      {"Impacts in crowds",
       "Bounces that pile up, rest, walls and balls hit at one instant, a gap that holds a million bounces, masses far apart, and the "
       "billiard that counts the digits of pi. Impacts come one after the other, at times of impact that the library finds, which may "
       "be 0 again and again until all bodies part. Each has an answer that follows without simulation."},
      {"Self-test",
       "The mean of each cell is held against theory by its 95 % interval and by chi-square, the variance by chi-square, over all "
       "cells of a policy: each must lie in the central 99.9 % of its distribution. Where the phase does not matter, every bounce must "
       "give what theory says, to rounding. Every crowd of impacts must end as it must.\n\n" +
           tests_text(results.tests)},
      {"Limits",
       "A ball that moves up and down, a flat floor, gravity alone; no friction, no spin. Times are of this small scene, which lies in "
       "the cache."},
  };
}

}  // namespace thinwall
