#pragma once
/// Hitscan's pictures.

#include <vector>

#include <thinwall/experiments/figure.hpp>
#include <thinwall/experiments/hitscan/line.hpp>

namespace thinwall {

/// What the ray misses and hits falsely, how far off each rule is, how late and early they are: those whose rule was
/// asked. Of the known shots none, of several targets and steps the first.
std::vector<Figure> hitscan_figures(const std::vector<HitscanLine>& lines);

}  // namespace thinwall
