#pragma once
/// A figure as a gnuplot script with its data, and as the SVG that gnuplot makes of them.

#include <filesystem>
#include <string>

#include <thinwall/experiments/figure.hpp>

namespace thinwall {

/// The script NAME.gp: run from inside its folder it reads NAME.dat and writes NAME.svg. Throws std::logic_error if the
/// figure's name cannot be a file's, or a series' lists differ in length.
std::string plot_script(const Figure& figure);

/// The data NAME.dat: one block a series, in the order of the panels; columns x, y and, where
/// there are bars, lower, upper and x_lower, x_upper.
std::string plot_data(const Figure& figure);

/// Runs `folder`/NAME.gp through gnuplot. Returns what went wrong, in one line; empty if nothing did.
std::string draw(const std::filesystem::path& folder, const std::string& name);

/// An SVG to stand inside an HTML page: without its prolog, its ids made unique by `name`, and described by `label`.
std::string inline_svg(std::string svg, const std::string& name, const std::string& label);

}  // namespace thinwall
