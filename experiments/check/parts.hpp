#pragma once
/// The parts of a check. Each adds what it finds wrong to `faults`, a line each, beginning with the file.

#include <filesystem>
#include <string>
#include <vector>

#include <thinwall/experiments/results/kept_result.hpp>

namespace thinwall {

using Faults = std::vector<std::string>;

/// The whole of a file; empty if it cannot be read.
std::string file_text(const std::filesystem::path& file);

/// datapackage.json against the rules of a Tabular Data Package, and each of its tables against it. Returns the paths of the
/// tables.
std::vector<std::string> check_data(const std::filesystem::path& folder, Faults& faults);

/// The script, the data and the SVG of each figure.
void check_figures(const std::filesystem::path& folder, Faults& faults);

/// report.html: whole, and it stands alone.
void check_page(const KeptResult& result, Faults& faults);

/// resolved.toml and cite.bib.
void check_texts(const KeptResult& result, Faults& faults);

}  // namespace thinwall
