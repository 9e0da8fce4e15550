#include <thinwall/experiments/results/shard_seal.hpp>

#include <nlohmann/json.hpp>

#include <thinwall/experiments/json_reader.hpp>
#include <thinwall/experiments/settings.hpp>
#include <thinwall/experiments/text/file_text.hpp>
#include <thinwall/experiments/text/sha256.hpp>

namespace thinwall {
namespace {

using nlohmann::ordered_json;

constexpr int seal_version = 1;

}  // namespace

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

void seal_shard(ResultFolder& folder, const RunIdentity& identity, const RunRecord& run) {
  const ordered_json seal = {
      {"thinwall_shard", seal_version},
      {"run", ordered_json::parse(identity_text(identity))},
      {"units", run.units},
      {"total_trials", run.total_trials},
      {"argv", run.argv},
      {"threads", run.threads},
      {"started", utc_text(run.started)},
      {"finished", utc_text(run.finished)},
      {"machine", {{"cpu", run.machine.cpu}, {"hardware_threads", run.machine.cores}, {"system", run.machine.system}}},
      {"journal", sha256_of_file(folder.path() / journal_name)}};
  folder.seal(seal.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n");
}

bool is_sealed(const ResultFolder& folder, const RunIdentity& identity) {
  const auto seal = parse_seal(file_text(folder.path() / seal_name));
  return seal && identity_text(seal->identity) == identity_text(identity) &&
         seal->journal_sha256 == sha256_of_file(folder.path() / journal_name);
}

}  // namespace thinwall
