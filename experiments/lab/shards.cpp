#include <thinwall/experiments/lab/shards.hpp>

#include <algorithm>
#include <cstdint>
#include <utility>

#include <fmt/format.h>

#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/files.hpp>
#include <thinwall/experiments/lab/json_reader.hpp>
#include <thinwall/experiments/lab/random.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/lab/text.hpp>

namespace thinwall {

namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr int seal_version = 1;

/// The index of the shard that each unit belongs to.
std::vector<int> deal(std::size_t units, int shards) {
  // Without the shuffle a number of shards that divides the number of methods would give a shard one method alone.
  std::vector<std::pair<std::uint64_t, std::size_t>> cards(units);
  for (std::size_t i = 0; i < units; ++i) cards[i] = {random_words({.seed = 0, .stream = 0}, i, 0)[0], i};
  std::ranges::sort(cards);
  std::vector<int> owners(units);
  for (std::size_t k = 0; k < units; ++k) {
    owners[cards[k].second] = 1 + static_cast<int>(k % static_cast<std::size_t>(shards));
  }
  return owners;
}

constexpr const char* mend = "; run the shard again, it computes what is missing";

struct SealedFolder {
  fs::path path;
  ShardSeal seal;

  std::string name() const { return one_line(path.string()); }
  int index() const { return seal.shard.index; }
};

SealedFolder read_seal(const fs::path& path) try {
  if (!fs::exists(path)) refuse_place(path, "there is no such folder");
  if (!fs::is_directory(path)) refuse_place(path, "is not a folder; a finished shard is needed");
  if (!fs::exists(path / seal_name)) {
    const auto begun = parse_identity(read_journal(path / journal_name).identity);
    if (begun && !begun->shard.empty()) refuse_place(path, fmt::format("shard {} is unfinished{}", begun->shard, mend));
    if (fs::exists(path / manifest_name)) refuse_place(path, "holds a whole result, not a shard");
    refuse_place(path, "is not a shard of a run: it has no shard.json");
  }
  const auto seal = parse_seal(file_text(path / seal_name));
  if (!seal) refuse_place(path, std::string("its shard.json is damaged, or not ours") + mend);
  return {path, *seal};
} catch (const std::system_error& error) {
  refuse_place(path, "cannot be read: " + error.code().message());
}

Journal::Rows read_rows(const SealedFolder& folder) try {
  const fs::path file = folder.path / journal_name;
  if (!Journal::is_one(file))
    refuse_place(folder.path, "its journal.tsv is lost, or none; delete the folder and run the shard again");
  JournalText text = read_journal(file);
  if (text.identity.empty())
    refuse_place(folder.path, fmt::format("the first row of its journal.tsv is damaged{}", mend));
  if (!text.damage.empty()) refuse_place(folder.path, one_line(text.damage.front()) + mend);
  if (text.identity != identity_text(folder.seal.identity) || sha256_of_file(file) != folder.seal.journal_sha256) {
    refuse_place(folder.path, fmt::format("its journal.tsv was changed since the shard was finished{}", mend));
  }
  return std::move(text.rows);
} catch (const std::system_error& error) {
  refuse_place(folder.path, "cannot be read: " + error.code().message());
}

/// The identity of the run that a shard is a part of.
RunIdentity whole(RunIdentity identity) {
  identity.shard.clear();
  return identity;
}

void check_together(const SealedFolder& first, const SealedFolder& other) {
  const RunIdentity ours = whole(first.seal.identity), theirs = whole(other.seal.identity);
  if (const std::string difference = identity_difference(theirs, ours); !difference.empty()) {
    refuse_place(other.path, fmt::format("is a shard of another run than {} ({})", first.name(), difference));
  }
  if (theirs.program != ours.program) {
    refuse_place(other.path, fmt::format("was computed by another build of the program than {}", first.name()));
  }
  if (other.seal.shard.count != first.seal.shard.count) {
    refuse_place(other.path, fmt::format("is shard {}, but {} is shard {}: one run is cut one way",
                                         to_text(other.seal.shard), first.name(), to_text(first.seal.shard)));
  }
}

/// `found` are in the order of their index, and each is there once.
void check_missing(const std::vector<SealedFolder>& found) {
  const int count = found.front().seal.shard.count;
  const auto missing = count - std::ssize(found);
  if (missing == 0) return;
  std::vector<std::string> first;
  for (int index = 1; index <= count && first.size() < 5; ++index) {
    if (!std::ranges::binary_search(found, index, {}, &SealedFolder::index)) first.push_back(to_text({index, count}));
  }
  throw UsageError(fmt::format("missing: shard{} {}{}; {} of {} were given", missing == 1 ? "" : "s",
                               fmt::join(first, ", "), missing > 5 ? fmt::format(" and {} more", missing - 5) : "",
                               found.size(), count));
}

}  // namespace

Shard parse_shard(std::string_view text) {
  constexpr std::int64_t most = 1'000'000;
  const auto slash = text.find('/');
  if (slash != std::string_view::npos) {
    const auto index = parse_count(text.substr(0, slash)), count = parse_count(text.substr(slash + 1));
    if (index && count && *index >= 1 && *index <= *count && *count <= most) {
      return {static_cast<int>(*index), static_cast<int>(*count)};
    }
  }
  throw UsageError(
      fmt::format("--shard: '{}' is not allowed; i/N, the i-th of N shards: whole numbers with 1 <= i <= N <= {}",
                  one_line(text), most));
}

std::string to_text(const Shard& shard) { return fmt::format("{}/{}", shard.index, shard.count); }

std::vector<std::size_t> units_of(const Shard& shard, std::size_t units) {
  const std::vector<int> owners = deal(units, shard.count);
  std::vector<std::size_t> hand;
  for (std::size_t i = 0; i < units; ++i) {
    if (owners[i] == shard.index) hand.push_back(i);
  }
  return hand;
}

std::optional<ShardSeal> parse_seal(const std::string& text) {
  try {
    const JsonReader seal(text, seal_name), machine = seal.object("machine");
    seal.whole("thinwall_shard", seal_version, seal_version);
    const auto identity = parse_identity(seal.value("run").dump());
    if (!identity) return std::nullopt;
    return ShardSeal{.identity = *identity,
                     .shard = parse_shard(identity->shard),
                     .record = {.shard = identity->shard,
                                .cpu = machine.text("cpu"),
                                .system = machine.text("system"),
                                .started = seal.text("started"),
                                .finished = seal.text("finished")},
                     .journal_sha256 = seal.text("journal")};
  } catch (const UsageError&) {
    return std::nullopt;
  }
}

std::string seal_text(const RunRecord& run, const std::string& journal_sha256) {
  return json_page(ordered_json{
      {"thinwall_shard", seal_version},
      {"run", ordered_json::parse(identity_text(run))},
      {"units", run.units},
      {"total_trials", run.total_trials},
      {"argv", run.argv},
      {"threads", run.threads},
      {"started", utc_text(run.started)},
      {"finished", utc_text(run.finished)},
      {"machine", {{"cpu", run.machine.cpu}, {"hardware_threads", run.machine.cores}, {"system", run.machine.system}}},
      {"journal", journal_sha256}});
}

bool is_sealed(const ResultFolder& folder, const RunIdentity& identity) {
  const auto seal = parse_seal(file_text(folder.path() / seal_name));
  return seal && identity_text(seal->identity) == identity_text(identity) &&
         seal->journal_sha256 == sha256_of_file(folder.path() / journal_name);
}

ShardSet read_shards(std::span<const std::string> folders, const std::string& program) {
  std::vector<SealedFolder> found;
  for (const std::string& folder : folders) found.push_back(read_seal(folder));
  for (const SealedFolder& other : found) check_together(found.front(), other);
  std::ranges::stable_sort(found, {}, &SealedFolder::index);
  const auto twice = std::ranges::adjacent_find(found, {}, &SealedFolder::index);
  if (twice != found.end()) {
    refuse_place(std::next(twice)->path,
                 fmt::format("is shard {}, and so is {}", to_text(twice->seal.shard), twice->name()));
  }
  check_missing(found);
  if (found.front().seal.identity.program != program) {
    refuse_place(found.front().path, "was computed by another build of the program than this one; merge with that one");
  }
  ShardSet set{.identity = whole(found.front().seal.identity), .folders = {}, .records = {}, .rows = {}};
  for (const SealedFolder& folder : found) {
    set.rows.push_back(read_rows(folder));
    set.records.push_back(folder.seal.record);
    set.folders.push_back(folder.path);
  }
  return set;
}

Journal::Rows all_rows(const ShardSet& shards, std::span<const Unit> units) {
  Journal::Rows all;
  std::vector<std::size_t> taken(shards.rows.size());
  const std::vector<int> owners = deal(units.size(), static_cast<int>(shards.rows.size()));
  for (std::size_t i = 0; i < units.size(); ++i) {
    const auto owner = static_cast<std::size_t>(owners[i] - 1);
    const auto row = shards.rows[owner].find(units[i].key);
    if (row == shards.rows[owner].end()) {
      refuse_place(shards.folders[owner], fmt::format("lacks the unit '{}'{}", one_line(units[i].key), mend));
    }
    all.insert(*row);
    ++taken[owner];
  }
  for (std::size_t k = 0; k < taken.size(); ++k) {
    if (taken[k] != shards.rows[k].size()) refuse_place(shards.folders[k], "has units that are not its own");
  }
  return all;
}

}  // namespace thinwall
