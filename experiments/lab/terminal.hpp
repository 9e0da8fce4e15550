#pragma once
/// A table as plain text for a terminal: rounded, each column as wide as it needs, at most 100 columns in all.

#include <initializer_list>
#include <string>
#include <string_view>

#include <thinwall/experiments/lab/table.hpp>

namespace thinwall {

inline constexpr std::size_t terminal_width = 100;

/// The columns of these names, or all: a value is rounded to what its interval supports, which is not shown; what is the same in
/// every row stands in the line above. The last columns are left to the file where the terminal has no room for them. Ends in a
/// newline. Throws std::logic_error if a name is not a column's.
std::string terminal(const Table& table, std::initializer_list<std::string_view> names = {});

/// `text` broken between words into lines of at most `terminal_width`; its own line breaks stay.
std::string wrapped(std::string_view text);

}  // namespace thinwall
