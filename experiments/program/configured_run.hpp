#pragma once
/// From what the user named to a run that is ready to go.

#include <memory>
#include <optional>
#include <span>
#include <string>

#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/run/identity.hpp>

namespace thinwall {

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

/// The text of a TOML file. Throws UsageError.
std::string read_config(const std::string& file);

/// `target` is an experiment's name, or a TOML file: its key `experiment` names one, or its key `scene` says that it is a
/// scene. Throws UsageError.
ConfiguredRun configure_run(const std::string& target, const RunRequest& request,
                            std::span<const Experiment> experiments);

}  // namespace thinwall
