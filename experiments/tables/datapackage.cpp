#include <nlohmann/json.hpp>

#include <thinwall/experiments/tables/csv.hpp>
#include <thinwall/experiments/text/sha256.hpp>

namespace thinwall {
namespace {

using nlohmann::ordered_json;

const char* type_name(ColumnType type) {
  switch (type) {
    case ColumnType::text: return "string";
    case ColumnType::integer: return "integer";
    case ColumnType::number: return "number";
    case ColumnType::boolean: return "boolean";
  }
  return "any";
}

ordered_json field(const Column& column) {
  ordered_json out = {{"name", column.name}, {"type", type_name(column.type)}};
  if (!column.unit.empty()) out["unit"] = column.unit;
  out["description"] = column.description;
  return out;
}

ordered_json resource(const Table& table) {
  ordered_json out = {
      {"name", table.name},
      {"path", "data/" + table.name + ".csv"},
      {"profile", "tabular-data-resource"},
      {"description", table.description},
      {"format", "csv"},
      {"mediatype", "text/csv"},
      {"encoding", "utf-8"},
      {"dialect", {{"delimiter", ","}, {"lineTerminator", "\n"}, {"doubleQuote", true}, {"header", true}}}};
  if (!table.is_timing) {  // timings differ from run to run, and this file should not
    const std::string text = csv_text(table);
    out["bytes"] = text.size();
    out["hash"] = "sha256:" + sha256(text);
  }
  ordered_json fields = ordered_json::array();
  for (const Column& column : table.columns) fields.push_back(field(column));
  out["schema"] = {{"fields", fields}, {"missingValues", {""}}};
  return out;
}

}  // namespace

std::string datapackage_text(const PackageInfo& info, std::span<const Table> tables) {
  ordered_json out = {
      {"profile", "tabular-data-package"}, {"name", info.name},       {"title", info.title},
      {"description", info.description},   {"version", info.version}, {"resources", ordered_json::array()}};
  for (const Table& table : tables) out["resources"].push_back(resource(table));
  return out.dump(2) + "\n";
}

}  // namespace thinwall
