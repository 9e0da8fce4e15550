/// What a step costs on this machine, method by method.

#include <algorithm>

#include <thinwall/experiments/advise/advice.hpp>
#include <thinwall/experiments/lab/race.hpp>
#include <thinwall/experiments/thin_wall/model.hpp>

namespace thinwall {

namespace {

/// Steps of the shots that the thin wall fires, `back` steps before the one in which the ball touches.
std::vector<ShotStep> steps_before(const Cell& cell, std::int64_t count, double back) {
  const Target aimed = target(cell);
  const RandomStream stream = random_stream(cell, 0);
  std::vector<ShotStep> steps;
  for (std::int64_t i = 0; i < count; ++i) {
    const Vec3<double> start = random_start(aimed, stream, static_cast<std::uint64_t>(i)) - back * aimed.displacement;
    steps.push_back({{Sphere<double>{start, aimed.radius}, aimed.displacement},
                     at_rest(Aabb<double>{Vec3<double>::Zero(), aimed.half_extents})});
  }
  return steps;
}

/// What a candidate is asked of such a step.
template <class Step> using AskMember = std::function<void(std::span<const Step>)> Candidate::*;

template <class Step>
std::vector<Measured> timed(std::span<const Candidate> candidates, AskMember<Step> ask, const std::vector<Step>& steps,
                            const TimingEffort& effort, const RandomStream& stream) {
  std::vector<TimedLoop<Step>> loops;
  for (const Candidate& candidate : candidates) loops.push_back({candidate.*ask});
  run_rounds(loops, std::span<const Step>(steps), effort.rounds, effort.round_ns, stream);
  std::vector<Measured> times;
  for (const TimedLoop<Step>& loop : loops) {
    times.push_back({median(loop.nanoseconds), bootstrap_median(loop.nanoseconds, stream)});
  }
  return times;
}

template <class Step>
std::vector<StepCost> costs_of(std::span<const Candidate> candidates, AskMember<Step> ask,
                               const std::vector<Step>& clear_steps, const std::vector<Step>& contact_steps,
                               const TimingEffort& effort) {
  const auto clear = timed(candidates, ask, clear_steps, effort, {0, 1});
  const auto contact = timed(candidates, ask, contact_steps, effort, {0, 2});
  std::vector<StepCost> costs;
  for (std::size_t i = 0; i < candidates.size(); ++i) costs.push_back({clear[i], contact[i]});
  return costs;
}

}  // namespace

std::vector<StepCost> measure_costs(const Cell& cell, std::span<const Candidate> candidates,
                                    const TimingEffort& effort) {
  // The same geometry, a step a second; a step too short for the grid of the poses is timed as a longer one.
  Cell even = cell;
  even.speed = 1;
  even.step = std::max(step_length(cell), 1e-4 * slab_chord(cell));
  return costs_of(candidates, &Candidate::ask, steps_before(even, effort.queries, 1),
                  steps_before(even, effort.queries, 0), effort);
}

std::vector<StepCost> measure_costs(const std::vector<RodStep>& clear, const std::vector<RodStep>& contact,
                                    std::span<const Candidate> candidates, const TimingEffort& effort) {
  return costs_of(candidates, &Candidate::ask_rod, clear, contact, effort);
}

}  // namespace thinwall
