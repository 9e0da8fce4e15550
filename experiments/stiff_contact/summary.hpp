#pragma once
/// The stiff contact in words: the answer, the table on the terminal, and the report's sections.

#include <string>
#include <vector>

#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/stiff_contact/race.hpp>
#include <thinwall/experiments/stiff_contact/verdicts.hpp>

namespace thinwall {

/// All that a run found.
struct StiffResults {
  std::vector<LimitLine> limits;
  std::vector<ContactLine> bounces;
  std::vector<StiffRacer> racers;
  std::vector<StiffTest> tests;
};

std::string stiff_answer(const StiffPlan& plan, const StiffResults& results);
std::string stiff_summary(const StiffPlan& plan, const StiffResults& results);
std::vector<Section> stiff_sections(const StiffPlan& plan, const StiffResults& results);

}  // namespace thinwall
