#pragma once
/// A table for readers: rounded, with units in its header, as Markdown, LaTeX and HTML.

#include <string>

#include <thinwall/experiments/table.hpp>

namespace thinwall {

/// A value as a reader sees it: four significant digits, thousands apart in counts, a dash where it is missing.
std::string shown_text(const Value& value);

std::string markdown_table(const Table& whole);

/// A `tabular` in the style of booktabs, to `\input` into a `table` environment.
std::string latex_table(const Table& whole);

std::string html_table(const Table& whole);

}  // namespace thinwall
