#pragma once
/// Shards: a run in parts, on machines that do not know of each other.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/lab/journal.hpp>
#include <thinwall/experiments/lab/manifest.hpp>
#include <thinwall/experiments/lab/result_folder.hpp>

namespace thinwall {

// ---- A run cut into parts for machines that know nothing of each other.

/// Part `index` of `count`, counted from 1.
struct Shard {
  int index = 1;  ///< 1 to count
  int count = 1;  ///< >= 1
  bool operator==(const Shard&) const = default;
};

/// From `2/4`. Throws UsageError.
Shard parse_shard(std::string_view text);

std::string to_text(const Shard& shard);  ///< `2/4`

/// Which of `units` units belong to the shard, in their own order. They are shuffled, always the same way, and dealt out like
/// cards: each shard gets as many, give or take one, and a fair mix of the cheap and the dear.
std::vector<std::size_t> units_of(const Shard& shard, std::size_t units);

// ---- shard.json: the last file that a shard writes. It says which part of which run lies beside it in journal.tsv, and
// where and when that was computed.

struct ShardSeal {
  RunIdentity identity;
  Shard shard;
  ShardRecord record;
  std::string journal_sha256;
};

/// Nothing if `text` is no seal of ours.
std::optional<ShardSeal> parse_seal(const std::string& text);

/// What declares a shard finished. `run` is the shard's: its units and trials are those of the shard alone.
std::string seal_text(const RunRecord& run, const std::string& journal_sha256);

/// True if `folder` was sealed and its journal has not changed since.
bool is_sealed(const ResultFolder& folder, const RunIdentity& identity);

// ---- Finished shards, read back and checked against each other before they become one result.

/// All the shards of one run.
struct ShardSet {
  RunIdentity identity;                        ///< of the whole run
  std::vector<std::filesystem::path> folders;  ///< by the shard's index
  std::vector<ShardRecord> records;
  std::vector<Journal::Rows> rows;
};

/// Reads the shards that `folders` hold, in any order. Throws UsageError, naming the folder, if one is no shard, unfinished,
/// damaged, of another run or by another program than `program`; if one is there twice, or missing.
ShardSet read_shards(std::span<const std::string> folders, const std::string& program);

/// The rows of all `units` of the run. Throws UsageError if a shard lacks one of its units or has one that is not its own.
Journal::Rows all_rows(const ShardSet& shards, std::span<const Unit> units);

}  // namespace thinwall
