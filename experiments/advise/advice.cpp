#include <thinwall/experiments/advise/advice.hpp>

#include <algorithm>
#include <bit>
#include <limits>
#include <tuple>

#include <thinwall/experiments/lab/race.hpp>
#include <thinwall/experiments/models/shots.hpp>
#include <thinwall/swept/certified.hpp>

namespace thinwall {

namespace {

double lateness(const AdviceRow& row) {
  return row.theory.largest_lateness().value_or(std::numeric_limits<double>::infinity());
}

/// Of the first `meeting` rows, which are sorted by cost, the advised one comes first.
void put_advised_first(std::vector<AdviceRow>& rows, std::ptrdiff_t meeting) {
  if (meeting == 0) return;
  const double noise = rows.front().cost.dearer().interval.upper;
  const auto tied = std::find_if(rows.begin(), rows.begin() + meeting,
                                 [&](const AdviceRow& row) { return row.cost.dearer().interval.lower > noise; });
  const auto least_late = std::min_element(
      rows.begin(), tied, [](const AdviceRow& a, const AdviceRow& b) { return lateness(a) < lateness(b); });
  std::rotate(rows.begin(), least_late, least_late + 1);
}

/// Steps of the shots that the thin wall fires, `back` steps before the one in which the ball touches.
std::vector<ShotStep> steps_before(const Cell& cell, std::int64_t count, double back) {
  const Target aimed = target(cell);
  std::vector<ShotStep> steps;
  for (std::int64_t i = 0; i < count; ++i)
    steps.push_back(random_step(aimed, random_stream(cell, 0), static_cast<std::uint64_t>(i), back));
  return steps;
}

/// What a candidate is asked of such a step.
template <class Step> using AskMember = std::function<void(std::span<const Step>)> Candidate::*;

template <class Step>
std::vector<Measured> timed(std::span<const Candidate> candidates, AskMember<Step> ask, const std::vector<Step>& steps,
                            const TimingEffort& effort, const RandomStream& stream) {
  std::vector<TimedLoop<Step>> loops;
  for (const Candidate& candidate : candidates) {
    loops.push_back({[&asked = candidate.*ask, &effort](std::span<const Step> some) {
      for (std::int64_t i = 0; i < effort.repeats; ++i) asked(some);
    }});
  }
  run_rounds(loops, std::span<const Step>(steps), effort.rounds, effort.round_ns, stream);
  std::vector<Measured> times;
  for (TimedLoop<Step>& loop : loops) {
    for (double& time : loop.nanoseconds) time /= static_cast<double>(effort.repeats);
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

/// What a certified answer promises, lower end first: no contact before it, and contact within 2^-26 of it.
Theory certified_theory(const Cell& cell) {
  Theory theory = early_theory(cell, 0x1p-26);
  theory.why = "0: the verdict is proven";
  return theory;
}

void ask_certified(std::span<const ShotStep> steps) {
  for (const ShotStep& step : steps) keep(certified_time_of_impact(step.ball, step.wall));
}

}  // namespace

bool meets_wish(const Wish& wish, const Theory& theory) {
  if (!theory.probability || *theory.probability > wish.miss + no_chance) return false;
  const std::optional<double> latest = theory.largest_lateness();
  return !wish.late || (latest && *latest <= *wish.late * (1 + no_chance));
}

std::optional<double> longest_step(const Wish& wish, const std::function<Theory(const Cell&)>& theory) {
  const auto met = [&](double step) {
    Cell cell = wish.cell;
    cell.step = step;
    return meets_wish(wish, theory(cell));
  };
  constexpr double shortest = 1e-30;
  if (met(allowed_step.upper)) return allowed_step.upper;
  if (!met(shortest)) return std::nullopt;
  auto good = std::bit_cast<std::uint64_t>(shortest), bad = std::bit_cast<std::uint64_t>(allowed_step.upper);
  while (bad - good > 1) {  // positive doubles are in the order of their bits
    const std::uint64_t middle = good + (bad - good) / 2;
    (met(std::bit_cast<double>(middle)) ? good : bad) = middle;
  }
  return std::bit_cast<double>(good);
}

Advice advise(const Wish& wish, std::span<const Candidate> candidates, std::span<const StepCost> costs) {
  Advice advice = {wish, {}};
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Candidate& candidate = candidates[i];
    const Theory theory = candidate.theory(wish.cell);
    advice.rows.push_back({candidate, theory, costs[i], meets_wish(wish, theory),
                           longest_step(wish, candidate.up_to_its_spin ? candidate.up_to_its_spin : candidate.theory)});
  }
  const auto rank = [](const AdviceRow& row) {
    return std::tuple(!row.meets, row.meets && row.method.hits_falsely, row.cost.dearer().value);
  };
  std::ranges::stable_sort(advice.rows, {}, rank);
  put_advised_first(advice.rows, std::ranges::count_if(advice.rows, &AdviceRow::may_be_advised));
  return advice;
}

// ---- What a step costs on this machine, method by method.

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

// ---- Whom the advice chooses from.

std::vector<std::int64_t> offered_poses(const Wish& wish, const std::function<Theory(int poses)>& theory) {
  std::vector<std::int64_t> poses = {2, 8};
  const auto meets = [&](int n) { return meets_wish(wish, theory(n)); };
  if (meets(1) || !meets(most_substeps)) return poses;  // nobody needs them, or they are of no use
  int fewer = 1, enough = most_substeps;
  while (enough - fewer > 1) {
    const int middle = (fewer + enough) / 2;
    (meets(middle) ? enough : fewer) = middle;
  }
  if (std::find(poses.begin(), poses.end(), enough) == poses.end()) poses.push_back(enough);
  std::sort(poses.begin(), poses.end());
  return poses;
}

std::vector<std::int64_t> offered_poses(const Wish& wish) {
  return offered_poses(wish, [&](int poses) { return pose_theory(wish.cell, poses); });
}

std::vector<Candidate> candidates(const Wish& wish) { return candidates_of(thin_wall_methods(offered_poses(wish))); }

std::vector<Candidate> candidates_of(std::span<const ThinWallMethod> methods) {
  std::vector<Candidate> all;
  for (const ThinWallMethod& m : methods) all.push_back({m.name, m.poses_per_step, true, m.theory, m.ask});
  all.push_back({"certified", 0, false, certified_theory, ask_certified});
  return all;
}

Advice advise(const Wish& wish) {
  if (!wish.rod) {
    const std::vector<Candidate> balls = candidates(wish);
    return advise(wish, balls, measure_costs(wish.cell, balls));
  }
  constexpr std::int64_t queries = TimingEffort{}.queries;
  const std::vector<Candidate> rods = rod_candidates(wish);
  return advise(wish, rods, measure_costs(rod_steps(wish, queries, 1), rod_steps(wish, queries, 0), rods));
}

}  // namespace thinwall
