#pragma once
/// Finished shards, read back and checked against each other before they become one result.

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/results/record.hpp>
#include <thinwall/experiments/run/identity.hpp>
#include <thinwall/experiments/run/journal.hpp>

namespace thinwall {

/// All the shards of one run.
struct ShardSet {
  RunIdentity identity;              ///< of the whole run
  std::vector<std::string> folders;  ///< by the shard's index
  std::vector<ShardRecord> records;
  std::vector<Journal::Rows> rows;
};

/// Reads the shards that `folders` hold, in any order. Throws UsageError, naming the folder, if one is no shard, unfinished,
/// damaged, of another run or by another program than `program`; if one is there twice, or missing.
ShardSet read_shards(std::span<const std::string> folders, const std::string& program);

/// The rows of all `units` of the run. Throws UsageError if a shard lacks one of its units or has one that is not its own.
Journal::Rows all_rows(const ShardSet& shards, std::span<const Unit> units);

}  // namespace thinwall
