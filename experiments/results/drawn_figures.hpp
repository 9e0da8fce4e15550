#pragma once
/// The figures of a complete result in formats for print, drawn from the scripts and data in its folder. They are no part of
/// the result: gnuplot's PDF differs from run to run, so the manifest does not name them.

#include <filesystem>
#include <string>
#include <vector>

namespace thinwall {

struct DrawnFigures {
  std::vector<std::string> files;     ///< paths in the result folder
  std::vector<std::string> troubles;  ///< a line each
};

/// `formats`: of pdf and tex. Writes plots/NAME.pdf, plots/NAME-latex.tex and NAME-latex.pdf. Throws std::system_error if the
/// folder cannot be written.
DrawnFigures draw_figures(const std::filesystem::path& folder, const std::vector<std::string>& formats);

/// Removes what a `draw_figures` that was killed left.
void remove_half_drawn_figures(const std::filesystem::path& folder);

/// Removes what `draw_figures` drew: it is older than what is about to be drawn.
void remove_drawn_figures(const std::filesystem::path& folder);

}  // namespace thinwall
