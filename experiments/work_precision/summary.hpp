#pragma once
/// The result in words: who is cheapest at each error, where that changes, and by how much the others trail.

#include <string>
#include <vector>

#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/work_precision/heat.hpp>

namespace thinwall {

/// The closed form keeps its contract on every query of a heat: no wrong verdict, and no time off by more than 4 u kappa t.
/// True, too, if it does not take part.
bool keeps_contract(const Heat& heat);

std::string work_precision_answer(const std::vector<Heat>& heats);
std::string work_precision_summary(const std::vector<Heat>& heats);
std::vector<Section> work_precision_sections(const std::vector<Heat>& heats);

/// One set and scalar, hits: the sentence that the report computes. Empty for another class.
std::string heat_text(const Heat& heat);

}  // namespace thinwall
