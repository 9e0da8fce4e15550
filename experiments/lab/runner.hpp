#pragma once
/// Runs the units of an experiment on threads, and says beforehand how long it will take.

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include <boost/core/noncopyable.hpp>

#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/lab/journal.hpp>

namespace thinwall {

// ---- Ctrl-C and SIGTERM as a question that a long loop asks.

/// From now on SIGINT and SIGTERM only set a flag. A second one ends the program at once.
void watch_for_stop();

/// True once one of them has come.
bool stop_requested();

/// Ends the program if a stop is requested while this lives and it still lives `patience` later: for work that asks too
/// seldom, and that loses nothing it has counted by such an end.
class StopGuard : boost::noncopyable {
 public:
  /// `end` is called on a thread of its own, and should not return.
  StopGuard(std::chrono::milliseconds patience, std::function<void()> end);
  ~StopGuard();

 private:
  void watch(std::chrono::milliseconds patience, const std::function<void()>& end);

  std::mutex mutex_;
  std::condition_variable changed_;
  bool done_ = false;
  std::thread thread_;
};

// ---- The processes that `mpirun` started together, of which this is one. A process that was started alone is rank 0 of 1.

/// What mpirun says in the environment, with MPI built in or not.
struct Launch {
  int rank = 0;
  int count = 1;
  int neighbors = 1;  ///< ranks on this machine, this one included
};
Launch launch_of_this_process();

/// Takes part in MPI from construction to destruction, at most once in a process; does nothing where the launch is of
/// one rank. Throws UsageError if this program was built without MPI and has company.
class Ranks : boost::noncopyable {
 public:
  explicit Ranks(const Launch& launch);
  ~Ranks();  // NOLINT(performance-trivially-destructible): not where it has MPI to leave

  int rank() const { return launch_.rank; }
  int count() const { return launch_.count; }

  // All ranks must call these, in the same order.
  int worst(int status) const;                         ///< the largest that any rank calls it with
  void share(std::vector<std::uint8_t>& bytes) const;  ///< gives every rank those of rank 0

 private:
  Launch launch_;
  bool joined_ = false;
};

// ---- Computes the units of a run on every core, and keeps each in the journal as it ends.

/// How far a run has come.
struct Progress {
  std::size_t units_done = 0, units = 0;
  std::int64_t trials_done = 0, trials = 0;
  std::int64_t trials_resumed = 0;  ///< of `trials_done`: read from the journal
};

struct UnitResults {
  std::vector<std::string> results;  ///< by the order of the units, whichever ended first
  std::vector<double> seconds;       ///< of computing each
  bool complete = false;             ///< false if the run was stopped
};

struct RunnerOptions {
  int threads = 1;             ///< >= 1
  std::function<bool()> stop;  ///< asked between units; may be empty
  /// Called once before the first unit and after each, one at a time.
  std::function<void(const Progress&)> on_progress;
};

/// The cores that this process may use; its share of them where it is one of several ranks.
int default_threads();

/// Throws std::runtime_error, naming the unit, if one fails; what was finished stays in the journal.
UnitResults compute_units(std::span<const Unit> units, Journal& journal, const RunnerOptions& options);

// ---- How long a run takes, told from the beginnings of a smaller one within a bounded time.

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

/// Units that fewer trials shorten are timed with 1 and then more of them, a power of 4, and time is taken to be in proportion;
/// of the others one of each number of trials is timed whole, then a second, and so on, and those of a number are taken to be alike. Both
/// is done by processes of their own, which the system ends after half of `budget` [s] each, whatever they are at: no unit
/// is too long. `again` configures the same run with other trials, and may throw UsageError where they are too few.
RunEstimate estimate(std::span<const Unit> units, const ConfigureTrials& again, double budget = 1.5);

}  // namespace thinwall
