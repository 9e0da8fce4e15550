#pragma once
/// The configuration of the thin wall that puts the advice to the test.

#include <span>
#include <string>

#include <thinwall/experiments/advise/candidates.hpp>
#include <thinwall/experiments/advise/wish.hpp>

namespace thinwall {

/// The first line of it.
inline constexpr const char* check_config_title = "# Puts an advice of `thinwall advise` to the test.";

/// TOML with the wish's very cell and every candidate that the experiment can fire; what theory expects of each is a
/// comment. Throws UsageError if the experiment refuses the cell.
std::string check_config(const Wish& wish, std::span<const Candidate> candidates);

}  // namespace thinwall
