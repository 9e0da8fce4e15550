#pragma once
/// Text made safe for where it goes.

#include <string>
#include <string_view>
#include <vector>

namespace thinwall {

/// One line for a terminal: control characters, which could also drive it, become `\x1b` and the like.
std::string one_line(std::string_view text);

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

/// A command line that a shell splits into the same words.
std::string shell_line(const std::vector<std::string>& words);

/// Without tabs and newlines, for a field of a tab-separated file; `tsv_unescaped` gives the text back.
std::string tsv_escaped(std::string_view text);
std::string tsv_unescaped(std::string_view text);

}  // namespace thinwall
