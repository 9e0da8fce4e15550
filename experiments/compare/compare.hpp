#pragma once
/// One scene under many time policies and steps, each held against the finest exact run.
///
/// The exact run is stepped by events, with steps `finer` times shorter than the shortest compared. What it is exact about
/// is the motion within a step; under gravity its path is still that of the integrator, which errs by g t dt / 2. Of each
/// pair of bodies the first meeting is compared, and no later one: after a bounce at another time two runs part, in a scene
/// of many bodies for good.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <thinwall/experiments/scenes/scene.hpp>

namespace thinwall {

/// One way to step the scene.
struct Contender {
  TimePolicy policy = TimePolicy::discrete;
  int substeps = 1;
  double dt = 0;  ///< [s]
  std::string label() const { return name_of(policy, substeps); }
};

struct Comparison {
  Scene scene;
  std::vector<Contender> contenders;  ///< policy by policy, from the shortest step to the longest
  Contender exact;
  int repeats = 1;
};

/// Throws UsageError.
Comparison read_comparison(const Settings& settings, const RunOptions& options);

/// The scene, stepped that way for the same time: where steps of that length do not divide it, the last one is shorter.
Scene scene_for(const Comparison& comparison, const Contender& contender);

/// What a run of a contender leaves.
struct Trial {
  std::vector<Meeting> meetings;  ///< the first of each pair, by id
  std::int64_t tunneled = 0;
  StepCounts counts = {};             ///< over all steps
  double energy = 0, energy_end = 0;  ///< [J]
  std::uint64_t hash = 0;
  double seconds = 0;  ///< of stepping, the referee not included

  static constexpr auto fields() {
    using T = Trial;
    return record(kept("meetings", &T::meetings),
                  kept("tunneled", &T::tunneled, "1", "Contacts that went unseen, counted step by step."),
                  part(&T::counts), kept("energy", &T::energy), kept("energy_end", &T::energy_end),
                  kept("hash", &T::hash), kept("seconds", &T::seconds));
  }
  std::optional<double> met(std::uint32_t first, std::uint32_t second) const;  ///< [s] when these met first

  std::int64_t went_through() const { return tunneled + counts.pushed_through; }
  bool same_outcome(const Trial& other) const;  ///< all but the seconds
};

Trial run_trial(const Scene& scene);

/// A contender against the exact run.
struct Contest {
  Contender contender;
  Trial trial;                  ///< of the first repeat
  std::vector<double> seconds;  ///< of each
  bool repeated_alike = true;   ///< every repeat gave the same bits
  std::int64_t met = 0;         ///< pairs that met in both runs
  std::int64_t unmet = 0;       ///< pairs that met in the exact run alone, in time for this one to see it
  std::int64_t extra = 0;       ///< pairs that met in this run alone
  std::vector<double> errors;   ///< [s] between the two first meetings, sorted; of the pairs that met in both
};

/// `last_step` [s]: when its last step begins.
Contest contest(const Contender& contender, const std::vector<Trial>& repeats, const Trial& exact, double last_step);

/// `thinwall compare FILE`: steps it under every time policy and step, and holds each against the finest exact run.
Experiment compare_experiment();

}  // namespace thinwall
