#pragma once
/// One scene under many time policies and steps, each held against the finest exact run.
///
/// The exact run is stepped by events, with steps `finer` times shorter than the shortest compared. What it is exact about
/// is the motion within a step; under gravity its path is still that of the integrator, which errs by g t dt / 2. Of each
/// pair of bodies the first meeting is compared, and no later one: after a bounce at another time two runs part, in a scene
/// of many bodies for good.

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <thinwall/experiments/scenes/scene.hpp>

namespace thinwall {

/// One way to step the scene.
struct Contender {
  TimePolicy policy = TimePolicy::discrete;
  int substeps = 1;
  double dt = 0;  ///< [s]
  std::string label() const;
};

struct Comparison {
  Scene scene;
  std::vector<Contender> contenders;  ///< policy by policy, from the shortest step to the longest
  Contender exact;
  int repeats = 1;
};

/// What [compare] says.
struct CompareKeys {
  std::vector<std::string> policies;
  std::vector<double> steps;  ///< [s] ascending
  int finer = 1, repeats = 1;
};

/// Throws UsageError: a key that is in no scene's range.
CompareKeys read_compare_keys(const Settings& settings);

/// Throws UsageError.
Comparison read_comparison(const Settings& settings, const RunOptions& options);

/// The scene, stepped that way.
Scene scene_for(const Comparison& comparison, const Contender& contender);

/// When each pair of bodies met first [s], by id.
using FirstMeetings = std::map<std::pair<std::uint32_t, std::uint32_t>, double>;

/// What a run of a contender leaves.
struct Trial {
  FirstMeetings meetings;
  std::int64_t tunneled = 0, hits = 0, sweeps = 0;
  double energy = 0, energy_end = 0;  ///< [J]
  std::uint64_t hash = 0;
  double seconds = 0;  ///< of stepping, the referee not included

  bool same_outcome(const Trial& other) const;  ///< all but the seconds
};

Trial run_trial(const Scene& scene);
std::string to_line(const Trial& trial);
Trial trial_from_line(const std::string& line);  ///< throws std::runtime_error if it is not one

/// A contender against the exact run.
struct Contest {
  const Contender* contender = nullptr;
  Trial trial;                  ///< of the first repeat
  std::vector<double> seconds;  ///< of each
  bool repeated_alike = true;   ///< every repeat gave the same bits
  std::int64_t met = 0;         ///< pairs that met in both runs
  std::int64_t unmet = 0;       ///< pairs that met in the exact run alone, in time for this one to see it
  std::int64_t extra = 0;       ///< pairs that met in this run alone
  std::vector<double> errors;   ///< [s] between the two first meetings, sorted; of the pairs that met in both
};

Contest contest(const Contender& contender, const std::vector<Trial>& repeats, const Trial& exact, double duration);

}  // namespace thinwall
