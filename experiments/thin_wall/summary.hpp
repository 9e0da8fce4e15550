#pragma once
/// The thin wall's results in words: the answer, the table on the terminal, and the report's sections.

#include <string>
#include <vector>

#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/self_test.hpp>
#include <thinwall/experiments/thin_wall/lateness_test.hpp>
#include <thinwall/experiments/thin_wall/line.hpp>
#include <thinwall/experiments/thin_wall/stratified.hpp>
#include <thinwall/experiments/thin_wall/totals.hpp>

namespace thinwall {

/// The three tests of measurement against theory.
struct Verdicts {
  std::vector<SelfTest> counts;
  std::vector<StratifiedTest> stratified;
  std::vector<LatenessTest> lateness;
  bool passed() const;
};

std::string answer_text(const std::vector<Total>& totals);
std::string summary_text(const std::vector<Line>& lines, const std::vector<Total>& totals, const Verdicts& verdicts);
std::vector<Section> report_sections(const std::vector<Total>& totals, const Verdicts& verdicts);

}  // namespace thinwall
