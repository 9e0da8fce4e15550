#include <thinwall/experiments/tables/without_columns.hpp>

#include <algorithm>
#include <stdexcept>

namespace thinwall {

Table without_columns(const Table& table, std::span<const std::string_view> names) {
  for (const std::string_view name : names) {
    if (std::ranges::find(table.columns, name, &Column::name) == table.columns.end())
      throw std::logic_error("table '" + table.name + "' has no column '" + std::string(name) + "'");
  }
  Table out = table;
  out.columns.clear();
  for (auto& row : out.rows) row.clear();
  for (std::size_t j = 0; j < table.columns.size(); ++j) {
    if (std::ranges::find(names, table.columns[j].name) != names.end()) continue;
    out.columns.push_back(table.columns[j]);
    for (std::size_t i = 0; i < table.rows.size(); ++i) out.rows[i].push_back(table.rows[i][j]);
  }
  return out;
}

}  // namespace thinwall
