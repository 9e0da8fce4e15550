#pragma once
/// The tables of the result: errors, which are the same in every run, and times, which are not.

#include <vector>

#include <thinwall/experiments/table.hpp>
#include <thinwall/experiments/work_precision/heat.hpp>

namespace thinwall {

Table errors_table(const std::vector<Heat>& heats);
Table times_table(const std::vector<Heat>& heats);

/// Of every race one racer a method: what fine answers cost, against the closed form.
Table trailing_table(const std::vector<Heat>& heats);

}  // namespace thinwall
