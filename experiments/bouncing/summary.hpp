#pragma once
/// The bouncing ball's results in words.

#include <string>
#include <vector>

#include <thinwall/experiments/bouncing/results.hpp>
#include <thinwall/experiments/experiment.hpp>

namespace thinwall {

std::string bouncing_answer(const BouncingResults& results);   ///< a few sentences
std::string bouncing_summary(const BouncingResults& results);  ///< a table for the terminal, at most 100 columns
std::vector<Section> bouncing_sections(const BouncingResults& results);

}  // namespace thinwall
