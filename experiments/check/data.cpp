#include <charconv>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <thinwall/experiments/check/csv_reader.hpp>
#include <thinwall/experiments/check/parts.hpp>
#include <thinwall/experiments/json_reader.hpp>
#include <thinwall/experiments/text/escape.hpp>
#include <thinwall/experiments/text/file_text.hpp>
#include <thinwall/experiments/text/sha256.hpp>

namespace thinwall {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr const char* package_file = "datapackage.json";

template <class... Parts>
void add(Faults& faults, std::string_view file, fmt::format_string<Parts...> form, Parts&&... parts) {
  faults.push_back(fmt::format("{}: {}", file, fmt::format(form, std::forward<Parts>(parts)...)));
}

/// The member as text; empty, with a complaint, if it is no text or is empty.
std::string required_text(const json& object, const char* key, const std::string& where, Faults& faults) {
  const auto found = object.find(key);
  if (found != object.end() && found->is_string() && !found->get<std::string>().empty()) return *found;
  add(faults, package_file, "{}: '{}' is missing, empty or no text", where, key);
  return {};
}

void require_value(const json& object, const char* key, const std::string& value, const std::string& where,
                   Faults& faults) {
  const std::string given = required_text(object, key, where, faults);
  if (!given.empty() && given != value)
    add(faults, package_file, "{}: '{}' is '{}', not '{}'", where, key, one_line(given), value);
}

/// The `name` of a package or a resource: lower case, to stand in an address.
std::string required_name(const json& object, const std::string& where, Faults& faults) {
  const std::string name = required_text(object, "name", where, faults);
  if (name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-._/") != std::string::npos)
    add(faults, package_file, "{}: the name '{}' has a letter beyond a-z 0-9 - . _ /", where, one_line(name));
  return name;
}

bool is_whole(const std::string& text) {
  std::int64_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc{} && stop == end;
}

bool is_number(const std::string& text) {
  if (text == "INF" || text == "-INF") return true;  // as Table Schema spells them
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc{} && stop == end && std::isfinite(value);
}

/// An empty field is a missing value, which every type allows.
bool has_type(const std::string& field, const std::string& type) {
  if (field.empty() || type == "string") return true;
  if (type == "integer") return is_whole(field);
  if (type == "number") return is_number(field);
  return field == "true" || field == "false";
}

struct Field {
  std::string name, type;
};

std::vector<Field> check_fields(const json& resource, const std::string& where, Faults& faults) {
  const json schema = resource.value("schema", json());
  const json fields = schema.is_object() ? schema.value("fields", json()) : json();
  if (!fields.is_array() || fields.empty()) {
    add(faults, package_file, "{}: no schema with a list of fields", where);
    return {};
  }
  if (schema.value("missingValues", json()) != json::array({""}))
    add(faults, package_file, "{}: 'missingValues' is not [\"\"]", where);
  std::vector<Field> out;
  std::set<std::string> names;
  for (const json& field : fields) {
    const std::string here = fmt::format("{}, field {}", where, out.size() + 1);
    if (!field.is_object()) {
      add(faults, package_file, "{}: not an object", here);
      return {};
    }
    out.push_back({required_text(field, "name", here, faults), required_text(field, "type", here, faults)});
    const auto& [name, type] = out.back();
    const std::string named = fmt::format("{}, field '{}'", where, one_line(name));
    if (!names.insert(name).second) add(faults, package_file, "{}: a second one of that name", named);
    static const std::set<std::string> types = {"string", "integer", "number", "boolean"};
    if (!types.contains(type)) add(faults, package_file, "{}: the type '{}' is unknown", named, one_line(type));
    required_text(field, "description", named, faults);
    if (type == "integer" || type == "number") required_text(field, "unit", named, faults);
  }
  return out;
}

void check_rows(const std::string& path, const std::string& text, const std::vector<Field>& fields, Faults& faults) {
  constexpr std::size_t most = 5;  // a file of other columns would name every row
  std::vector<CsvRow> rows;
  try {
    rows = read_csv(text);
  } catch (const CsvError& error) {
    faults.push_back(fmt::format("{}:{}: {}", path, error.line, error.what()));
    return;
  }
  std::vector<std::string> names;
  for (const Field& field : fields) names.push_back(field.name);
  if (rows.empty() || rows.front().fields != names) {
    faults.push_back(fmt::format("{}:1: its columns are not those of {}", path, package_file));
    return;
  }
  std::size_t found = 0;
  for (std::size_t i = 1; i < rows.size() && found < most; ++i) {
    if (rows[i].fields.size() != fields.size()) {
      faults.push_back(
          fmt::format("{}:{}: {} fields, not {}", path, rows[i].line, rows[i].fields.size(), fields.size()));
      ++found;
      continue;
    }
    for (std::size_t j = 0; j < fields.size() && found < most; ++j) {
      if (has_type(rows[i].fields[j], fields[j].type)) continue;
      faults.push_back(fmt::format("{}:{}: column '{}': '{}' is no {}", path, rows[i].line, one_line(fields[j].name),
                                   one_line(clipped(rows[i].fields[j], 40)), fields[j].type));
      ++found;
    }
  }
}

/// Returns the path of its file.
std::string check_resource(const json& resource, std::size_t number, const fs::path& folder, Faults& faults) {
  std::string where = fmt::format("resource {}", number);
  if (!resource.is_object()) {
    add(faults, package_file, "{}: not an object", where);
    return {};
  }
  where = fmt::format("resource '{}'", one_line(required_name(resource, where, faults)));
  require_value(resource, "profile", "tabular-data-resource", where, faults);
  require_value(resource, "format", "csv", where, faults);
  require_value(resource, "encoding", "utf-8", where, faults);
  required_text(resource, "description", where, faults);
  const std::vector<Field> fields = check_fields(resource, where, faults);
  const std::string path = required_text(resource, "path", where, faults);
  if (path.starts_with('/') || path.find("..") != std::string::npos) {  // the specification forbids both
    add(faults, package_file, "{}: the path '{}' leaves the folder", where, one_line(path));
    return path;
  }
  if (path.empty() || !fs::is_regular_file(folder / path)) {
    const char* const why = fs::exists(folder / path) ? "is not a file" : "missing";
    if (!path.empty()) faults.push_back(fmt::format("{}: {}; {} describes it", one_line(path), why, package_file));
    return path;
  }
  const std::string text = file_text(folder / path);
  if (resource.contains("bytes") && resource["bytes"] != text.size())
    add(faults, path, "{} bytes, not the {} of {}", text.size(), resource["bytes"].dump(), package_file);
  if (resource.contains("hash") && resource["hash"] != "sha256:" + sha256(text))
    add(faults, path, "its SHA-256 is not that of {}", package_file);
  if (!fields.empty()) check_rows(path, text, fields, faults);
  return path;
}

}  // namespace

std::vector<std::string> check_data(const fs::path& folder, Faults& faults) {
  std::vector<std::string> paths;
  if (!fs::exists(folder / package_file)) {
    add(faults, package_file, "missing");
    return paths;
  }
  if (!fs::is_regular_file(folder / package_file)) {
    add(faults, package_file, "is not a file");
    return paths;
  }
  const json package = bounded_json(file_text(folder / package_file));
  if (!package.is_object()) {
    add(faults, package_file, "not JSON, or no object, or nested too deep");
    return paths;
  }
  require_value(package, "profile", "tabular-data-package", "the package", faults);
  required_name(package, "the package", faults);
  for (const char* key : {"title", "description", "version"}) required_text(package, key, "the package", faults);
  const json resources = package.value("resources", json());
  if (!resources.is_array() || resources.empty()) {
    add(faults, package_file, "no list of resources");
    return paths;
  }
  std::set<std::string> names;
  for (const json& resource : resources) {
    paths.push_back(check_resource(resource, paths.size() + 1, folder, faults));
    if (!paths.back().empty() && !names.insert(paths.back()).second)
      add(faults, package_file, "'{}' is described twice", one_line(paths.back()));
  }
  return paths;
}

}  // namespace thinwall
