#pragma once
/// shard.json: the last file that a shard writes. It says which part of which run lies beside it in journal.tsv, and
/// where and when that was computed.

#include <optional>
#include <string>

#include <thinwall/experiments/results/record.hpp>
#include <thinwall/experiments/results/result_folder.hpp>
#include <thinwall/experiments/run/identity.hpp>
#include <thinwall/experiments/run/shard.hpp>

namespace thinwall {

struct ShardSeal {
  RunIdentity identity;
  Shard shard;
  ShardRecord record;
  std::string journal_sha256;
};

/// Nothing if `text` is no seal of ours.
std::optional<ShardSeal> parse_seal(const std::string& text);

/// Declares the shard in `folder` finished. `run` is the shard's: its units and trials are those of the shard alone.
void seal_shard(ResultFolder& folder, const RunIdentity& identity, const RunRecord& run);

/// True if `folder` was sealed and its journal has not changed since.
bool is_sealed(const ResultFolder& folder, const RunIdentity& identity);

}  // namespace thinwall
