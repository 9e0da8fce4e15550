#pragma once
/// How long a run takes, told from the beginnings of a smaller one within a bounded time.

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include <thinwall/experiments/experiment.hpp>

namespace thinwall {

struct RunEstimate {
  double seconds = 0;            ///< of all units but the unknown ones, one after the other
  std::int64_t cut_tried = 0;    ///< units that fewer trials shorten, timed with
  std::int64_t trials = 0;       ///< in the place of the run's own
  std::int64_t whole_tried = 0;  ///< units that fewer trials do not shorten, timed as they are,
  std::int64_t whole = 0;        ///< of so many
  std::int64_t unknown = 0;      ///< units of which none that is like them ended in time

  std::int64_t tried() const { return cut_tried + whole_tried; }
};

/// What the estimate rests on, and what it leaves out.
std::string basis_text(const RunEstimate& estimate);

using ConfigureTrials = std::function<std::unique_ptr<Run>(std::int64_t trials)>;

/// Units that fewer trials shorten are timed with 1, 4, 16, ... of them, and time is taken to be in proportion; of the others
/// one of each number of trials is timed whole, then a second, and so on, and those of a number are taken to be alike. Both
/// is done by processes of their own, which the system ends after half of `budget` [s] each, whatever they are at: no unit
/// is too long. `again` configures the same run with other trials, and may throw UsageError where they are too few.
RunEstimate estimate(std::span<const Unit> units, const ConfigureTrials& again, double budget = 1.5);

}  // namespace thinwall
