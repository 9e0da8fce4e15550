#pragma once
/// The tables, pictures and words of the experiment broad_phase.

#include <string>
#include <vector>

#include <thinwall/experiments/broad_phase/lines.hpp>
#include <thinwall/experiments/experiment.hpp>

namespace thinwall {

/// What each world holds, the same in every run.
Table crowds_table(const std::vector<SurveyLine>& lines);
/// Time and memory of each broad phase on each world.
Table finders_table(const std::vector<SurveyLine>& lines);
/// How their times grow.
Table growth_table(const std::vector<SurveyLine>& lines);

std::vector<Figure> broad_phase_figures(const std::vector<SurveyLine>& lines);

std::string broad_phase_answer(const std::vector<SurveyLine>& lines);
std::string broad_phase_summary(const std::vector<SurveyLine>& lines);
std::vector<Section> broad_phase_sections(const std::vector<SurveyLine>& lines);

}  // namespace thinwall
