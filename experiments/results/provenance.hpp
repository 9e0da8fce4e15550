#pragma once
/// Where two results came from, held against each other: it may explain why they differ.

#include <string>
#include <vector>

#include <thinwall/experiments/results/manifest.hpp>

namespace thinwall {

/// A fact of which two results differ.
struct FactChange {
  std::string fact, recorded, rerun;
};

/// In the order of the facts. A change of the program alone, with the same commit and build, is one of uncommitted sources.
std::vector<FactChange> changed_facts(const Manifest& recorded, const Manifest& rerun);

}  // namespace thinwall
