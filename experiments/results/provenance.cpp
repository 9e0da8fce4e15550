#include <thinwall/experiments/results/provenance.hpp>

#include <algorithm>

#include <nlohmann/json.hpp>

#include <thinwall/experiments/results/manifest.hpp>

namespace thinwall {
namespace {

using nlohmann::json;

std::string plain(const json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

std::string fact_of(const Provenance& provenance, const std::string& name) {
  const auto found = std::ranges::find(provenance.facts, name, &std::pair<std::string, std::string>::first);
  return found == provenance.facts.end() ? "none" : found->second;
}

}  // namespace

std::optional<Provenance> parse_provenance(const std::string& text) {
  const json manifest = json::parse(text, nullptr, false);
  if (!manifest.is_object() || !manifest.contains("thinwall_manifest")) return std::nullopt;
  try {
    const json &program = manifest.at("program"), &machine = manifest.at("machine");
    Provenance out;
    manifest.at("experiment").get_to(out.run.experiment);
    out.run.config = manifest.at("config").dump();
    manifest.at("seed").get_to(out.run.seed);
    program.at("sha256").get_to(out.run.program);
    manifest.at("files").get_to(out.hashes);
    for (const auto& [file, hash] : out.hashes) {
      if (!stays_within(file)) return std::nullopt;
    }
    if (!manifest.at("seed").is_number_unsigned()) return std::nullopt;
    if (!manifest.at("trials").is_null()) out.run.trials = manifest.at("trials").get<std::int64_t>();
    const bool dirty = program.at("dirty");
    out.facts = {{"version", plain(program.at("version"))},
                 {"commit", plain(program.at("commit")) + (dirty ? " with uncommitted changes" : "")},
                 {"compiler", plain(program.at("compiler"))},
                 {"flags", plain(program.at("flags"))},
                 {"build type", plain(program.at("build_type"))}};
    for (const auto& [library, version] : program.at("libraries").items())
      out.facts.emplace_back(library, plain(version));
    out.facts.emplace_back("program (SHA-256)", out.run.program);
    out.facts.emplace_back("CPU", plain(machine.at("cpu")));
    out.facts.emplace_back("system", plain(machine.at("system")));
    return out;
  } catch (const json::exception&) {
    return std::nullopt;
  }
}

std::vector<FactChange> changed_facts(const Provenance& recorded, const Provenance& rerun) {
  std::vector<FactChange> out;
  const auto add = [&](const std::string& name) {
    const FactChange change{name, fact_of(recorded, name), fact_of(rerun, name)};
    if (change.recorded != change.rerun) out.push_back(change);
  };
  for (const auto& [name, value] : recorded.facts) add(name);
  for (const auto& [name, value] : rerun.facts) {
    if (fact_of(recorded, name) == "none") add(name);
  }
  return out;
}

}  // namespace thinwall
