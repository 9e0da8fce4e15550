#pragma once
/// The results in words and as text for the terminal.

#include <string>
#include <vector>

#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/extremes/line.hpp>
#include <thinwall/experiments/extremes/theory.hpp>

namespace thinwall {

std::string extreme_answer(const std::vector<ExtremeLine>& lines, const std::vector<LadderTest>& tests);
std::string extreme_summary(const std::vector<ExtremeLine>& lines, const std::vector<LadderTest>& tests);
std::vector<Section> extreme_sections(const std::vector<LadderTest>& tests);

}  // namespace thinwall
