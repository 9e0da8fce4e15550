#pragma once
/// What `thinwall run` and `thinwall compare` do: compute what is missing and leave a result folder.

#include <string>

#include <thinwall/experiments/program/command.hpp>
#include <thinwall/experiments/program/configured_run.hpp>

namespace thinwall {

/// What the user asked for.
struct RunWish {
  std::string target;  ///< an experiment's name or a TOML file
  RunRequest request;
  std::string out;  ///< the result folder; empty for the default
  bool dry_run = false, list_cells = false, json = false;
};

/// Returns the exit code. Results go to `call.out`, all else to `call.err`. Throws UsageError for what the user must mend.
int perform_run(const RunWish& given, const Call& call);

}  // namespace thinwall
