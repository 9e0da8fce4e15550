#pragma once
/// The thin wall's results as tables.

#include <vector>

#include <thinwall/experiments/table.hpp>
#include <thinwall/experiments/thin_wall/line.hpp>

namespace thinwall {

Table cells_table(const std::vector<Line>& lines, Response response);  ///< every line
Table bullet_table(const std::vector<Line>& lines);                    ///< the lines of the textbook's bullet
Table timings_table(const std::vector<Line>& lines);                   ///< the one that differs from run to run

}  // namespace thinwall
