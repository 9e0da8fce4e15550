#pragma once
/// The figures of a complete result in formats for print, drawn from what its plots/NAME.json say. The scripts in the folder
/// are not run: gnuplot does what a script says, whoever wrote it. The files are no part of the result: gnuplot's PDF differs
/// from run to run, so the manifest does not name them.

#include <filesystem>
#include <string>
#include <vector>

#include <thinwall/experiments/results/manifest.hpp>

namespace thinwall {

struct DrawnFigures {
  std::vector<std::string> files;     ///< paths in the result folder
  std::vector<std::string> troubles;  ///< a line each
};

/// `formats`: of pdf and tex; every figure that the manifest names. Writes plots/NAME.pdf, plots/NAME-latex.tex and NAME-latex.pdf. Throws std::system_error if the
/// folder cannot be written, UsageError if its manifest cannot be read.
DrawnFigures draw_figures(const std::filesystem::path& folder, const std::vector<std::string>& formats);

/// Removes what `draw_figures` drew of a result: it is older than what is about to be drawn.
void remove_drawn_figures(const std::filesystem::path& folder, const Manifest& manifest);

}  // namespace thinwall
