#pragma once
/// The tables, pictures and words of the experiment engines.

#include <string>
#include <vector>

#include <thinwall/experiments/engines/line.hpp>
#include <thinwall/experiments/experiment.hpp>

namespace thinwall {

Table told_engines_table(const std::vector<EngineLine>& lines);    ///< at one path, for the report
Table engine_cells_table(const std::vector<EngineLine>& lines);    ///< every line
Table engine_timings_table(const std::vector<EngineLine>& lines);  ///< the one that differs from run to run

/// How many go through, how late they turn, and with what energy; and the picture of times, which differs from run to run.
std::vector<Figure> engine_figures(const std::vector<EngineLine>& lines);

std::string engines_answer(const std::vector<EngineLine>& lines);
std::string engines_summary(const EnginePlan& plan, const std::vector<EngineLine>& lines);
std::vector<Section> engines_sections(const EnginePlan& plan, const std::vector<EngineLine>& lines);

}  // namespace thinwall
