#pragma once
/// A figure as JSON, from which it can be drawn again by scripts that are made anew.

#include <string>

#include <thinwall/experiments/figure.hpp>

namespace thinwall {

std::string figure_json(const Figure& figure);

/// The figure that `figure_json` wrote, but for its caption. Throws UsageError in one line, which names `file`.
Figure parse_figure(const std::string& text, const std::string& file);

}  // namespace thinwall
