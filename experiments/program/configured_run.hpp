#pragma once
/// From what the user named to a run that is ready to go.

#include <memory>
#include <span>
#include <string>

#include <thinwall/experiments/experiment.hpp>

namespace thinwall {

struct ConfiguredRun {
  const Experiment* experiment = nullptr;
  std::unique_ptr<Run> run;
  std::string config;           ///< resolved, canonical JSON
  bool default_config = false;  ///< true if that is the experiment's own
};

/// `target` is an experiment's name or a TOML file whose key `experiment` names one. Throws UsageError.
ConfiguredRun configure_run(const std::string& target, const RunOptions& options,
                            std::span<const Experiment> experiments);

}  // namespace thinwall
