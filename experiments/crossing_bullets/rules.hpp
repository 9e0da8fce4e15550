#pragma once
/// The rules that the encounters are put to: sweeping both, and the methods of finding the time of impact.

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/crossing_bullets/encounter.hpp>
#include <thinwall/experiments/crossing_bullets/tally.hpp>
#include <thinwall/experiments/crossing_bullets/theory.hpp>

namespace thinwall {

struct CrossingRule {
  std::string name;
  std::function<void(const Encounter&, CrossingTally&)> ask;  ///< puts one encounter and counts the answer
  std::function<Expected(const CrossingTheory&)> expects;
};

std::vector<std::string_view> crossing_rule_names();
std::vector<CrossingRule> crossing_rules(std::span<const std::string> names);  ///< those named, in the list's own order

/// All encounters of a cell, put to one rule.
CrossingTally ask_all(const CrossingRule& rule, const Crossing& c, std::uint64_t seed, std::int64_t shots);

}  // namespace thinwall
