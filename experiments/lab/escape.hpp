#pragma once
/// Text made safe for where it goes.

#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace thinwall {

/// Each letter as the list spells it, or itself: `replaced("a<b", {{'<', "&lt;"}})`.
std::string replaced(std::string_view text, std::initializer_list<std::pair<char, std::string_view>> spelled);

/// One line for a terminal or a page: what is no letter, and could drive the one and break the other, becomes `\x1b` and the like.
std::string one_line(std::string_view text);

/// One line as a string of a gnuplot script. In single quotes gnuplot takes every letter as it is, but loses count of doubled
/// ones: a text with a quote stands in double quotes, and what is special there as an octal number.
std::string gnuplot_quoted(std::string_view text);

/// The text of the first string in a script; also where a quote in single quotes is doubled.
std::string gnuplot_unquoted(std::string_view script);

/// At most `letters` bytes of `text`, then dots if there was more; never half a UTF-8 letter.
std::string clipped(std::string_view text, std::size_t letters);

/// A JSON string with its quotes; also a TOML one.
std::string json_string(std::string_view text);

/// For HTML, in text and in quoted attributes.
std::string html_escaped(std::string_view text);

/// For LaTeX text.
std::string latex_escaped(std::string_view text);

/// For a cell of a Markdown table, or a line of text: no markup, no link.
std::string markdown_escaped(std::string_view text);

/// A word of a shell, whatever is in it.
std::string single_quoted(std::string_view text);

/// A command line that a shell splits into the same words.
std::string shell_line(const std::vector<std::string>& words);

/// Without tabs and newlines, for a field of a tab-separated file; `tsv_unescaped` gives the text back.
std::string tsv_escaped(std::string_view text);
std::string tsv_unescaped(std::string_view text);

}  // namespace thinwall
