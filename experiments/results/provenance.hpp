#pragma once
/// What a manifest says of where a result came from: enough to run it again, and to explain why a rerun differs.

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <thinwall/experiments/run/identity.hpp>

namespace thinwall {

struct Provenance {
  RunIdentity run;
  std::vector<std::pair<std::string, std::string>> facts;  ///< commit, compiler, libraries, machine: name and value
  std::map<std::string, std::string> hashes;               ///< SHA-256 of each file that must not differ, by path
};

/// Nothing if `text` is no manifest of ours.
std::optional<Provenance> parse_provenance(const std::string& text);

/// A fact of which two results differ.
struct FactChange {
  std::string fact, recorded, rerun;
};

/// In the order of the facts. A change of the program alone, with the same commit and build, is one of uncommitted sources.
std::vector<FactChange> changed_facts(const Provenance& recorded, const Provenance& rerun);

}  // namespace thinwall
