#pragma once
/// What `thinwall run`, `compare` and `merge` do: compute what is missing and leave a result folder.

#include <optional>
#include <string>
#include <vector>

#include <thinwall/experiments/program/command.hpp>
#include <thinwall/experiments/program/configured_run.hpp>
#include <thinwall/experiments/results/shards.hpp>
#include <thinwall/experiments/run/ranks.hpp>
#include <thinwall/experiments/run/shard.hpp>

namespace thinwall {

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
};

/// Returns the exit code. Results go to `call.out`, all else to `call.err`. Throws UsageError for what the user must mend.
int perform_run(const RunWish& given, const Call& call);

}  // namespace thinwall
