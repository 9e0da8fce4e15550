#pragma once
/// Computes the units of a run on every core, and keeps each in the journal as it ends.

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/run/journal.hpp>

namespace thinwall {

/// How far a run has come.
struct Progress {
  std::size_t units_done = 0, units = 0;
  std::int64_t trials_done = 0, trials = 0;
  std::int64_t trials_resumed = 0;  ///< of `trials_done`: read from the journal
};

struct UnitResults {
  std::vector<std::string> results;  ///< by the order of the units, whichever ended first
  std::vector<double> seconds;       ///< of computing each
  std::size_t resumed = 0;           ///< units read from the journal
  bool complete = false;             ///< false if the run was stopped
};

struct RunnerOptions {
  int threads = 1;             ///< >= 1
  std::function<bool()> stop;  ///< asked between units; may be empty
  std::function<void(const Progress&)>
      on_progress;  ///< called once before the first unit and after each, one at a time
};

/// The cores that this process may use; its share of them where it is one of several ranks.
int default_threads();

/// Throws std::runtime_error, naming the unit, if one fails; what was finished stays in the journal.
UnitResults compute_units(std::span<const Unit> units, Journal& journal, const RunnerOptions& options);

/// How long `compute_units` would take [s], from trying a few of the units for about `budget` seconds. No unit that says itself
/// how long it takes is tried.
double estimate_seconds(std::span<const Unit> units, int threads, double budget = 0.5);

}  // namespace thinwall
