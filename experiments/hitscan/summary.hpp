#pragma once
/// Hitscan's results in words: the answer, the table on the terminal, and the report's sections.

#include <string>
#include <vector>

#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/hitscan/totals.hpp>

namespace thinwall {

struct HitscanVerdicts {
  std::vector<SelfTest> counts;
  std::vector<HitscanMomentTest> moments;
  bool passed() const;
};

std::string hitscan_answer(const std::vector<HitscanLine>& lines, const std::vector<HitscanTotal>& totals);
std::string hitscan_summary(const std::vector<HitscanLine>& lines, const std::vector<HitscanTotal>& totals,
                            const HitscanVerdicts& verdicts);
std::vector<Section> hitscan_sections(const HitscanVerdicts& verdicts);

}  // namespace thinwall
