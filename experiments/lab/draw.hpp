#pragma once
/// The figures of a result folder, drawn by gnuplot from its data.

#include <filesystem>
#include <string>
#include <vector>

#include <thinwall/experiments/lab/figure.hpp>
#include <thinwall/experiments/lab/manifest.hpp>

namespace thinwall {

// ---- A figure as JSON, from which it can be drawn again by scripts that are made anew.

std::string figure_json(const Figure& figure);

// ---- Another program as a function: what it said, and how it ended.

struct ProcessResult {
  bool found = false;  ///< false: there is no such program
  int status = -1;     ///< its exit code; -1 if a signal ended it
  std::string output;  ///< what it wrote to its stdout and stderr
};

/// Runs `words[0]`, looked up in PATH, from inside `folder` and waits for it. It reads nothing from our stdin.
ProcessResult run_process(const std::vector<std::string>& words, const std::filesystem::path& folder);

// ---- What gnuplot makes of the script of a figure and its data, which lab/gnuplot.hpp writes.

/// The files that NAME.gp writes in a format: svg, pdf or tex.
std::vector<std::string> drawn_files(const std::string& name, const std::string& format);

/// Runs `folder`/NAME.gp through gnuplot, which writes `drawn_files` there. Returns what went wrong, in one line; empty if
/// nothing did.
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

/// `formats`: of pdf and tex; every figure that the manifest names. Writes plots/NAME.pdf, plots/NAME-latex.tex and NAME-latex.pdf. Throws std::system_error if the
/// folder cannot be written, UsageError if its manifest cannot be read.
DrawnFigures draw_figures(const std::filesystem::path& folder, const std::vector<std::string>& formats);

/// Removes what `draw_figures` drew of a result: it is older than what is about to be drawn.
void remove_drawn_figures(const std::filesystem::path& folder, const Manifest& manifest);

}  // namespace thinwall
