#pragma once
/// Whether a folder is whole: its data, its pages, its figures.

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/result_folder.hpp>

namespace thinwall {

// ---- Whether a result folder is what its manifest says, and what a result owes its reader.

/// What is wrong, a line each, beginning with the file; empty if nothing is. Reads every file of the folder.
std::vector<std::string> check_result(const std::filesystem::path& folder);

// ---- The parts of a check. Each adds what it finds wrong to `faults`, a line each, beginning with the file.

inline constexpr const char* page_file = "report.html";

using Faults = std::vector<std::string>;

/// `add_fault(faults, "cite.bib", "{} braces", 3)`: the file and what is wrong with it.
template <class... Parts>
void add_fault(Faults& faults, std::string_view file, fmt::format_string<Parts...> form, Parts&&... parts) {
  faults.push_back(fmt::format("{}: {}", one_line(file), fmt::format(form, std::forward<Parts>(parts)...)));
}

/// The script, the data and the SVG of each figure.
void check_figures(const std::filesystem::path& folder, Faults& faults);

/// The title of the figure that a script draws; empty if it has none.
std::string title_of_script(const std::string& script);

/// report.html: whole, it shows what the folder holds, and it stands alone.
void check_page(const KeptResult& result, Faults& faults);

/// What `thinwall explore` may put beside a report, which links to it.
inline constexpr std::string_view played_page = "explore.html";

/// resolved.toml and cite.bib.
void check_texts(const KeptResult& result, Faults& faults);

// ---- Readers that trust nothing.

/// What is ill-formed in an XML document, with line and column; empty if every reader takes it. Nothing outside of it is read.
std::string xml_fault(std::string_view text);

/// The text that `html_escaped` made so.
std::string html_unescaped(std::string_view text);

}  // namespace thinwall
