#pragma once
/// A narrower table, for a report: what a reader looks at, in the order in which it stood.

#include <span>
#include <string_view>

#include <thinwall/experiments/table.hpp>

namespace thinwall {

/// Removes the columns of these names, each of which must be there.
Table without_columns(const Table& table, std::span<const std::string_view> names);

}  // namespace thinwall
