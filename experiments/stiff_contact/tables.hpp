#pragma once
/// The tables of the stiff contact.

#include <vector>

#include <thinwall/experiments/stiff_contact/race.hpp>
#include <thinwall/experiments/stiff_contact/verdicts.hpp>
#include <thinwall/experiments/table.hpp>

namespace thinwall {

Table stiff_tests_table(const std::vector<StiffTest>& tests);
Table limits_table(const std::vector<LimitLine>& lines);
Table stability_table(const StiffPlan& plan, const std::vector<LimitLine>& lines);
Table bounces_table(const StiffPlan& plan, const std::vector<ContactLine>& lines);
/// Discrete detection beside split steps, at the greatest stiffness, where every bounce came back.
Table detection_table(const StiffPlan& plan, const std::vector<ContactLine>& lines);
Table race_table(const StiffPlan& plan, const std::vector<StiffRacer>& racers);
Table race_times_table(const std::vector<StiffRacer>& racers);  ///< the one that differs from run to run

}  // namespace thinwall
