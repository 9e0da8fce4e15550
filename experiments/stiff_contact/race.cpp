#include <thinwall/experiments/stiff_contact/race.hpp>

#include <algorithm>
#include <chrono>
#include <sstream>

#include <fmt/format.h>

namespace thinwall {

namespace {

/// Keeps an answer from being optimized away.
template <class T> void keep(const T& value) { asm volatile("" : : "m"(value) : "memory"); }

std::vector<StiffRacer> entrants(const StiffPlan& plan, double ratio) {
  std::vector<StiffRacer> racers;
  for (const Scheme scheme : all_schemes) {
    for (const Detection detection : all_detections) {
      for (const double step : plan.race_steps) {
        racers.push_back({{scheme, detection, plan.stiffest(), ratio, step}, {}});
      }
    }
  }
  return racers;
}

/// Bounces that are timed at once: about 8000 steps, 0.2 ms, so that few of them are interrupted.
std::int64_t slice_of(const StiffPlan& plan, const StiffRacer& racer) {
  constexpr std::int64_t steps = 8000;
  const std::int64_t all = std::max<std::int64_t>(1, racer.tally.contact_steps);
  return std::clamp<std::int64_t>(steps * plan.race_bounces / all, 1, plan.race_bounces);
}

/// Of the slice of the bounces that is next in this round.
double nanoseconds_a_bounce(const StiffPlan& plan, const StiffRacer& racer, std::int64_t round) {
  using Clock = std::chrono::steady_clock;
  const std::int64_t slice = slice_of(plan, racer);
  const auto start = Clock::now();
  for (std::int64_t i = 0; i < slice; ++i) {
    const std::int64_t which = (round * slice + i) % plan.race_bounces;
    keep(bounce(plan.approach, racer.contact,
                (static_cast<double>(which) + 0.5) / static_cast<double>(plan.race_bounces)));
  }
  const std::chrono::duration<double, std::nano> spent = Clock::now() - start;
  return spent.count() / static_cast<double>(slice);
}

}  // namespace

std::vector<StiffRacer> stiff_race(const StiffPlan& plan, double ratio) {
  std::vector<StiffRacer> racers = entrants(plan, ratio);
  for (StiffRacer& racer : racers) {  // warms up, too
    racer.tally = bounce_all(plan.approach, racer.contact, plan.seed, plan.race_bounces);
  }
  // A round takes every racer once, each round from another start, so that what else the machine does befalls all alike.
  for (std::int64_t round = 0; round < plan.rounds; ++round) {
    const std::size_t first = static_cast<std::size_t>(round) * 7 % racers.size();
    for (std::size_t i = 0; i < racers.size(); ++i) {
      StiffRacer& racer = racers[(first + i) % racers.size()];
      racer.nanoseconds.push_back(nanoseconds_a_bounce(plan, racer, round));
    }
  }
  return racers;
}

std::string to_line(const std::vector<StiffRacer>& racers) {
  std::string line;
  for (const StiffRacer& racer : racers) {
    line += to_line(racer.tally) + " ";
    for (const double ns : racer.nanoseconds) line += fmt::format("{:a} ", ns);
  }
  return line;
}

std::vector<StiffRacer> racers_from(const StiffPlan& plan, double ratio, const std::string& line) {
  std::istringstream in(line);
  std::vector<StiffRacer> racers = entrants(plan, ratio);
  for (StiffRacer& racer : racers) {
    racer.tally = bounce_tally_from(in);
    for (std::int64_t i = 0; i < plan.rounds; ++i) racer.nanoseconds.push_back(read_number(in));
  }
  return racers;
}

}  // namespace thinwall
