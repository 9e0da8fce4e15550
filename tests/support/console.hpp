#pragma once
/// The commands of a document and what they print, as a reader would type and see them.
///
///     ```console
///     $ build/release/thinwall list
///     thin_wall  How often ...
///     ```
///
/// A line of output that is `...` stands for any lines, and `...` within a line for any text. A fenced TOML block whose first line
/// is `# NAME.toml` is a file that the commands find.

#include <cstddef>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace thinwall {

struct ConsoleCommand {
  std::string line;                 ///< without the prompt
  std::vector<std::string> output;  ///< what the document shows of it
};

struct Document {
  std::vector<ConsoleCommand> commands;
  std::map<std::string, std::string> files;  ///< text by name
};

inline Document read_document(const std::string& markdown) {
  Document out;
  std::string fence, file;
  std::istringstream in(markdown);
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("```")) {
      fence = fence.empty() ? line.substr(3) : "";
      file.clear();
    } else if (fence == "console") {
      if (line.starts_with("$ ")) {
        out.commands.push_back({line.substr(2), {}});
      } else if (!out.commands.empty()) {
        out.commands.back().output.push_back(line);
      }
    } else if (fence == "toml") {
      if (file.empty() && line.starts_with("# ") && line.ends_with(".toml")) file = line.substr(2);
      if (!file.empty()) out.files[file] += line + "\n";
    }
  }
  return out;
}

/// True if `line` is `pattern`, in which `...` stands for any text.
inline bool line_matches(std::string_view pattern, std::string_view line) {
  const auto gap = pattern.find("...");
  if (gap == std::string_view::npos) return pattern == line;
  if (!line.starts_with(pattern.substr(0, gap))) return false;
  const std::string_view rest = pattern.substr(gap + 3);
  for (std::size_t at = gap; at <= line.size(); ++at) {
    if (line_matches(rest, line.substr(at))) return true;
  }
  return false;
}

/// True if `lines` from the `i`-th are `pattern` from its `j`-th.
inline bool lines_match(const std::vector<std::string>& pattern, const std::vector<std::string>& lines,
                        std::size_t j = 0, std::size_t i = 0) {
  if (j == pattern.size()) return i == lines.size();
  if (pattern[j] == "...") {
    for (std::size_t k = i; k <= lines.size(); ++k) {
      if (lines_match(pattern, lines, j + 1, k)) return true;
    }
    return false;
  }
  return i < lines.size() && line_matches(pattern[j], lines[i]) && lines_match(pattern, lines, j + 1, i + 1);
}

}  // namespace thinwall
