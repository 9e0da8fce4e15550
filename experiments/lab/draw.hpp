#pragma once
/// The figures of a result folder: as scripts of gnuplot and their data, with axes, marks and legends, and drawn from those.

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <thinwall/experiments/lab/figure.hpp>
#include <thinwall/experiments/lab/manifest.hpp>

namespace thinwall {

// ---- A figure as JSON, from which it can be drawn again by scripts that are made anew.

std::string figure_json(const Figure& figure);

// ---- The range of an axis, and where its tics stand.

struct DrawnAxis {
  bool log = false;
  double lower = 0, upper = 1;
};

/// An axis that shows every finite value (on a logarithmic one: every positive value) with a little air around them.
DrawnAxis axis_around(std::span<const double> values, bool log);

/// What follows `set xtics` in gnuplot, for an axis of so many pixels that `spacing` of them are enough between two tics.
std::string tics(const DrawnAxis& axis, double pixels, double spacing);

// ---- How the series of a figure look: apart in color, for the color-blind, and in grayscale.

/// The look of all series that share a label.
struct SeriesStyle {
  std::string label;
  std::string color = {};  ///< #rrggbb
  int point_type = 7;      ///< gnuplot's number
  int dash_type = 1;       ///< gnuplot's number
  bool has_points = false, has_line = false, has_cells = false;
};

/// One style for each label that is drawn: those of the roster first, the others in the order in which they appear.
std::vector<SeriesStyle> series_styles(const Figure& figure);

// ---- The script and the data.

/// The script NAME.gp: run from inside its folder it reads NAME.dat and writes NAME.svg; with the variable `format` set to
/// 'pdf', NAME.pdf; to 'tex', NAME-latex.tex and NAME-latex.pdf. Throws std::logic_error if the figure's name cannot be a
/// file's, or a series' lists differ in length.
std::string plot_script(const Figure& figure);

/// The data NAME.dat: one block a series, in the order of the panels; columns x, y and, where
/// there are bars, lower, upper and x_lower, x_upper.
std::string plot_data(const Figure& figure);

// ---- Another program as a function: what it said, and how it ended.

struct ProcessResult {
  bool found = false;  ///< false: there is no such program
  int status = -1;     ///< its exit code; -1 if a signal ended it
  std::string output;  ///< what it wrote to its stdout and stderr
};

/// Runs `words[0]`, looked up in PATH, from inside `folder` and waits for it. It reads nothing from our stdin.
ProcessResult run_process(const std::vector<std::string>& words, const std::filesystem::path& folder);

// ---- What gnuplot makes of the script of a figure and its data, written as above.

/// Runs `folder`/NAME.gp through gnuplot, which writes its files of that format there: svg, pdf or tex. Returns what went wrong,
/// in one line; empty if nothing did.
std::string draw(const std::filesystem::path& folder, const std::string& name, const std::string& format = "svg");

/// An SVG to stand inside an HTML page: without its prolog, its ids made unique by `name`, and described by `label`.
std::string inline_svg(std::string svg, const std::string& name, const std::string& label);

// ---- The figures of a complete result in formats for print, drawn from what its plots/NAME.json say. The scripts in the folder
// are not run: gnuplot does what a script says, whoever wrote it. The files are no part of the result: gnuplot's PDF differs
// from run to run, so the manifest does not name them.

struct DrawnFigures {
  std::vector<std::string> files;     ///< paths in the result folder
  std::vector<std::string> troubles;  ///< a line each
};

/// `formats`: of pdf and tex; every figure that the manifest names. Writes plots/NAME.pdf, plots/NAME-latex.tex and
/// NAME-latex.pdf. Throws std::system_error if the folder cannot be written, UsageError if its manifest cannot be read.
DrawnFigures draw_figures(const std::filesystem::path& folder, const std::vector<std::string>& formats);

/// Removes what `draw_figures` drew of a result: it is older than what is about to be drawn.
void remove_drawn_figures(const std::filesystem::path& folder, const Manifest& manifest);

}  // namespace thinwall
