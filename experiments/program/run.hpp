#pragma once
/// A run of an experiment: its configuration, whoever works on it, what is told meanwhile.

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/lab/journal.hpp>
#include <thinwall/experiments/lab/manifest.hpp>
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
  std::string name;  ///< of its result folder: the experiment's, or the scene's
  std::unique_ptr<Run> run;
  RunRecord record;  ///< what is asked, by how many threads
};

/// The run that has this identity, on `threads` threads. Throws UsageError if no experiment here has it.
ConfiguredRun configure_again(const RunIdentity& identity, int threads, std::span<const Experiment> experiments);

/// True for what `run` takes for a file whether or not it is there: no experiment's name looks like it.
bool looks_like_a_file(std::string_view target);

/// `target` is an experiment's name, or a TOML file: its key `experiment` names one, or its key `scene` says that it is a
/// scene. Throws UsageError.
ConfiguredRun configure_run(const std::string& target, const RunRequest& request,
                            std::span<const Experiment> experiments);

/// How far a run has come, on one line of at most 79 letters: bar, share, trials, rate and time left.
std::string progress_line(const Progress& progress, double seconds);

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
