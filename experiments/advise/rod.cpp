/// A rod that tumbles, in the place of the ball: what may be asked about it, what theory expects, and its steps.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <thinwall/experiments/advise/advice.hpp>
#include <thinwall/experiments/lab/race.hpp>
#include <thinwall/experiments/models/rods.hpp>
#include <thinwall/swept/certified/turning_certified.hpp>

namespace thinwall {

namespace {

/// The flight along the wall's normal: what goes along the wall changes nothing.
RodFlight flight_of(const Wish& wish, const Cell& cell, double spin) {
  RodFlight flight = {.half_length = wish.rod->length / 2 - cell.radius,
                      .radius = cell.radius,
                      .thickness = cell.thickness,
                      .tilt_deg = 90,
                      .spin_deg = spin * cell.step,
                      .step_ratio = 1};
  flight.step_ratio = step_length(cell) * cosine(cell) / widest(flight);
  return flight;
}

/// How late a pose sees the rod at most [m]. A rod whose ends are no faster than it flies touches over one stretch, which poses miss or hit
/// within one spacing. Another touches, parts and touches again: only where its middle is within the wall's reach is it sure to.
void bound_lateness(Theory& theory, const RodFlight& flight, const Cell& cell, int poses, bool touches_once) {
  const double spacing = step_length(cell) / poses, whole = widest(flight) / cosine(cell);
  const bool once = poses == 1;
  if (touches_once) {
    theory.latest = std::min(spacing, whole);
    theory.why_late = once ? "min(v h, (b + c) / cos a)" : "min(v h / n, (b + c) / cos a)";
  } else if (spacing * cosine(cell) <= clearance(flight)) {
    theory.latest = std::min(whole, reach(flight) / cosine(cell) + spacing);
    theory.why_late =
        once ? "min(c / (2 cos a) + v h, (b + c) / cos a)" : "min(c / (2 cos a) + v h / n, (b + c) / cos a)";
  } else {
    theory.latest = whole;
    theory.why_late = "(b + c) / cos a";
  }
}

/// The chance at a spin [deg/s], and the lateness at the rod's own and any slower one.
Theory pose_theory_at(const Wish& wish, const Cell& cell, double spin, int poses) {
  const RodFlight flight = flight_of(wish, cell, spin);
  Theory theory = {
      .probability = rod_miss_probability(clearance(flight), reach(flight), step_length(flight) / poses,
                                          radians(flight.spin_deg) / poses),
      .why = poses == 1 ? "E max(0, 1 - (b + c m) / (v h cos a))" : "E max(0, 1 - n (b + c m) / (v h cos a))"};
  const bool touches_once = radians(wish.rod->spin * cell.step) * reach(flight) <= step_length(flight);
  bound_lateness(theory, flight, cell, poses, touches_once);
  return theory;
}

Theory never_late(const char* why) { return {.probability = 0, .latest = 0, .why = why, .why_late = "0"}; }

// What theory says of a method that turns, at its spin and at no more than that, as a candidate without a name; nothing of one that is not named
// here.

Candidate same(const Theory& theory, bool hits_falsely = false) {
  const auto always = [theory](const Cell&) { return theory; };
  return {.theory = always, .up_to_its_spin = always, .hits_falsely = hits_falsely};
}
Candidate of_poses(const Wish& wish, int poses) {
  return {.theory = [=](const Cell& cell) { return pose_theory_at(wish, cell, wish.rod->spin, poses); },
          .up_to_its_spin = [=](const Cell& cell) { return pose_theory_at(wish, cell, 0, poses); }};
}

template <class Method> Candidate rod_theories(const Method&, const Wish&) { return same({}); }
Candidate rod_theories(const EndOfStep<double>&, const Wish& wish) { return of_poses(wish, 1); }
Candidate rod_theories(const Substeps<double>& method, const Wish& wish) { return of_poses(wish, method.n); }
Candidate rod_theories(const LinearSweep<double>&, const Wish& wish) {
  Theory theory = never_late("0: the sweeps join at the wall's middle");
  const bool spins = wish.rod->spin > 0;
  if (spins) {
    theory.latest.reset();
    theory.why_late = "no formula";
  }
  return same(theory, spins);
}
Candidate rod_theories(const Speculative<double>&, const Wish& wish) {
  return same(never_late("0: it looks a whole step ahead"), wish.rod->spin > 0);
}
Candidate rod_theories(const ConservativeAdvancement<double>&, const Wish&) {
  return same(never_late("0: free up to its answer, proven"));
}

template <class Ask> Candidate rod_candidate(std::string name, int poses, Candidate candidate, const Ask& ask) {
  candidate.name = std::move(name);
  candidate.poses = poses;
  candidate.ask_rod = [ask](std::span<const RodStep> steps) {
    for (const RodStep& step : steps) keep(ask(step));
  };
  return candidate;
}

}  // namespace

std::vector<Candidate> rod_candidates(const Wish& wish) {
  std::vector<Candidate> all;
  const auto add = [&](const auto& method, std::string name, int poses) {
    all.push_back(rod_candidate(std::move(name), poses, rod_theories(method, wish),
                                [method](const RodStep& step) { return time_of_impact(method, step.rod, step.wall); }));
  };
  const auto of_n = [&](int poses) { return pose_theory_at(wish, wish.cell, wish.rod->spin, poses); };
  for_each_type(TurningMethods<double>{}, [&]<class Method>(TypeTag<Method>) {
    if constexpr (std::is_same_v<Method, Substeps<double>>) {
      for (const std::int64_t n : offered_poses(wish, of_n))
        add(Method{.n = static_cast<int>(n)}, fmt::format("{}_{}", Method::name, n), static_cast<int>(n));
    } else {
      add(Method{}, std::string(Method::name), std::is_same_v<Method, EndOfStep<double>> ? 1 : 0);
    }
  });
  all.push_back(rod_candidate("certified", 0, same(never_late("0: the verdict is proven")),
                              [](const RodStep& step) { return certified_time_of_impact(step.rod, step.wall); }));
  return all;
}

std::vector<RodStep> rod_steps(const Wish& wish, std::int64_t count, std::int64_t back) {
  RodFlight flight = flight_of(wish, wish.cell, wish.rod->spin);
  flight.step_ratio = std::max(flight.step_ratio, 1e-4);  // a shorter step is timed as this one, as a ball's is
  const RandomStream stream = random_stream(flight, 0);
  const Moving<Obb<double>> before = wall(flight);
  std::vector<RodStep> steps;
  for (std::int64_t i = 0; i < count; ++i) {
    const RodMotion motion = random_motion(flight, stream, static_cast<std::uint64_t>(i));
    const auto touching = static_cast<std::int64_t>(std::floor(motion.contact));
    steps.push_back({step_of(motion, std::max<std::int64_t>(0, touching - back)), before});
  }
  return steps;
}

}  // namespace thinwall
