#pragma once
/// A run of an experiment: its configuration, whoever works on it, what is told meanwhile.

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/lab/journal.hpp>
#include <thinwall/experiments/lab/result_folder.hpp>
#include <thinwall/experiments/lab/runner.hpp>
#include <thinwall/experiments/lab/shards.hpp>
#include <thinwall/experiments/program/command.hpp>

namespace thinwall {

// ---- From what the user named to a run that is ready to go.

/// What the command line says of a run beside its target.
struct RunRequest {
  RunOptions options;
  bool compare = false;                  ///< the target is a scene, to be compared
  bool trace = false;                    ///< of a scene
  std::string plan_kind;                 ///< of a scene; empty: as it says itself
  std::string benchmarks = {};           ///< the folder of the programs that speed starts; empty: beside this one
  std::optional<std::string> text = {};  ///< in place of the target's content, for which the target is then only a name
};

struct ConfiguredRun {
  Experiment experiment;
  std::string name;      ///< of its result folder: the experiment's, or the scene's
  std::string question;  ///< the experiment's, or the scene's
  std::unique_ptr<Run> run;
  std::string config;           ///< resolved, canonical JSON
  bool default_config = false;  ///< true if that is the experiment's own
};

/// The run that has this identity, on `threads` threads. Throws UsageError if no experiment here has it.
ConfiguredRun configure_again(const RunIdentity& identity, int threads, std::span<const Experiment> experiments);

/// True for what `run` takes for a file whether or not it is there: no experiment's name looks like it.
bool looks_like_a_file(std::string_view target);

/// `target` is an experiment's name, or a TOML file: its key `experiment` names one, or its key `scene` says that it is a
/// scene. Throws UsageError.
ConfiguredRun configure_run(const std::string& target, const RunRequest& request,
                            std::span<const Experiment> experiments);

// ---- The ranks that compute one run together. Rank 0 holds the folder, tells the others what is left to do, gathers what
// they did into its journal, and goes on alone. Each keeps what it has finished in a journal of its own until then, so that
// a killed run loses no more than any other.

class Crew {
 public:
  /// A crew of one needs no MPI. Throws UsageError as Ranks does.
  Crew(const Launch& launch, std::span<const Unit> units);
  ~Crew();  ///< sends home ranks that still wait for rank 0
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  bool leads() const { return ranks_.rank() == 0; }
  int count() const { return ranks_.count(); }

  /// Of the leader: what `compute_units` returns, by all ranks.
  UnitResults compute(ResultFolder& folder, const std::string& identity, const RunnerOptions& options);

  /// Of the others: computes what the leader says, into a journal in `folder`. Returns the exit code.
  int assist(const std::filesystem::path& folder, const std::string& identity, const RunnerOptions& options);

 private:
  std::vector<Unit> share_of(const std::vector<std::uint8_t>& open) const;  // this rank's

  Ranks ranks_;
  std::span<const Unit> units_;
  bool told_ = false;  // the others know what to do
};

// ---- How far a run has come, on a terminal; nothing is printed where stderr is none.

/// True if stderr is a terminal that can redraw a line (TERM is not `dumb`).
bool stderr_is_terminal();

/// One line of at most 79 letters: bar, share, trials, rate and time left.
std::string progress_line(const Progress& progress, double seconds);

class ProgressBar {
 public:
  explicit ProgressBar(bool enabled) : enabled_(enabled) {}
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(const Progress& progress);
  static void erase();

 private:
  using Clock = std::chrono::steady_clock;
  bool enabled_, drawn_ = false;
  Clock::time_point start_ = Clock::now(), last_;
};

// ---- What `thinwall run`, `compare` and `merge` do: compute what is missing and leave a result folder.

/// Whoever watches a run in the place of signals and a terminal: a process that goes on after it.
struct RunWatch {
  std::function<bool()> stop;                        ///< asked between units, from any thread
  std::function<void(const Progress&)> on_progress;  ///< as RunnerOptions has it
};

/// What the user asked for.
struct RunWish {
  std::string target;  ///< an experiment's name or a TOML file
  RunRequest request;
  std::string out;  ///< the result folder; empty for the default
  bool dry_run = false, list_cells = false, json = false;
  std::vector<std::string> figures;  ///< formats to draw beside SVG
  std::optional<Shard> shard;        ///< compute this part alone, and leave it for `merge`
  std::optional<ShardSet> merged;    ///< the finished parts of the run, in place of `target` and what chooses it
  Launch launch = launch_of_this_process();  ///< `Launch{}`: by this process alone, whoever mpirun started beside it
  std::optional<RunWatch> watch = {};        ///< then no signal is handled, and nothing ends the process
};

/// Returns the exit code. Results go to `call.out`, all else to `call.err`. Throws UsageError for what the user must mend.
int perform_run(RunWish wish, const Call& call);

}  // namespace thinwall
