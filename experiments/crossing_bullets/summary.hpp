#pragma once
/// The crossing bullets' results in words: the answer, the table on the terminal, and the report's sections.

#include <string>
#include <vector>

#include <thinwall/experiments/crossing_bullets/totals.hpp>
#include <thinwall/experiments/experiment.hpp>

namespace thinwall {

struct CrossingVerdicts {
  std::vector<SelfTest> counts;
  std::vector<TimingTest> times;
  bool passed() const;
};

std::string crossing_answer(const std::vector<CrossingLine>& lines, const std::vector<CrossingTotal>& totals);
std::string crossing_summary(const std::vector<CrossingLine>& lines, const std::vector<CrossingTotal>& totals,
                             const CrossingVerdicts& verdicts);
std::vector<Section> crossing_sections(const CrossingVerdicts& verdicts);

}  // namespace thinwall
