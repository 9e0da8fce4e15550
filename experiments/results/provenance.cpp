#include <thinwall/experiments/results/provenance.hpp>

#include <algorithm>

namespace thinwall {
namespace {

std::string fact_of(const Manifest& manifest, const std::string& name) {
  const auto found = std::ranges::find(manifest.facts, name, &std::pair<std::string, std::string>::first);
  return found == manifest.facts.end() ? "none" : found->second;
}

}  // namespace

std::vector<FactChange> changed_facts(const Manifest& recorded, const Manifest& rerun) {
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
