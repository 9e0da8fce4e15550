#pragma once
/// The allowed values of a number, checked and in words.

#include <string>
#include <string_view>

#include <thinwall/experiments/settings.hpp>

namespace thinwall {

/// False for NaN and infinity, whatever the range.
bool contains(const Range& range, double value);

/// As a complaint names them: `numbers > 0 and <= 10 [s]`, where `kind` is `numbers`.
std::string range_text(std::string_view kind, const Range& range);

}  // namespace thinwall
