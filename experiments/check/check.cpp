#include <thinwall/experiments/check/check.hpp>

#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/files.hpp>
#include <thinwall/experiments/lab/json_reader.hpp>
#include <thinwall/experiments/lab/manifest.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/lab/table_text.hpp>
#include <thinwall/experiments/lab/text.hpp>

namespace thinwall {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Every file, link and empty folder below the folder, by its path from there.
std::set<std::string> files_below(const fs::path& folder) {
  std::set<std::string> out;
  for (const auto& entry : fs::recursive_directory_iterator(folder, fs::directory_options::skip_permission_denied)) {
    std::error_code unreadable;
    const bool holds_files = !entry.is_symlink() && entry.is_directory() &&
                             fs::directory_iterator(entry.path(), unreadable) != fs::directory_iterator();
    if (!holds_files) out.insert(entry.path().lexically_relative(folder).generic_string());
  }
  return out;
}

/// What lies there, in words.
const char* kind_of(const fs::path& path) {
  if (fs::is_symlink(path)) return "a link that the manifest does not name";
  return fs::is_directory(path) ? "an empty folder that the manifest does not name" : "the manifest does not name it";
}

/// Each file that the manifest names is there, and unchanged if it has a hash.
void check_named_files(const KeptResult& result, Faults& faults) {
  const auto is_there = [&](const std::string& file) {
    const fs::path path = result.folder / file;
    if (fs::is_regular_file(path)) return true;
    add_fault(faults, file, "{}; the manifest names it", fs::exists(path) ? "is not a file" : "missing");
    return false;
  };
  for (const auto& [file, hash] : result.hashes) {
    if (is_there(file) && sha256_of_file(result.folder / file) != hash) {
      add_fault(faults, file, "was changed since the run wrote it: its SHA-256 is not the manifest's");
    }
  }
  for (const std::string& file : result.unhashed) is_there(file);
}

/// A figure drawn again from its script, which is there.
bool is_drawn_again(const std::string& file, const std::set<std::string>& found) {
  if (!file.starts_with("plots/")) return false;
  for (const char* ending : {".svg", ".pdf", "-latex.pdf", "-latex.tex"}) {
    if (file.ends_with(ending) && found.contains(file.substr(0, file.size() - std::string_view(ending).size()) + ".gp"))
      return true;
  }
  return false;
}

void check_unknown_files(const KeptResult& result, const std::set<std::string>& found, Faults& faults) {
  std::set<std::string> known = {"manifest.json", "report.html", std::string(played_page)};
  for (const std::string& file : result.files()) known.insert(file);
  for (const std::string& file : found) {
    const bool is_known = known.contains(file) || is_drawn_again(file, found);
    if (is_known && fs::is_symlink(result.folder / file)) {
      add_fault(faults, file, "is a link, not the file that the run wrote");
      continue;
    }
    if (is_known) continue;
    add_fault(faults, file, "{}",
              is_journal_name(file) ? "a run is at work here, or was interrupted" : kind_of(result.folder / file));
  }
}

void check_tables_are_known(const KeptResult& result, const std::vector<std::string>& tables, Faults& faults) {
  const std::set<std::string> described(tables.begin(), tables.end());
  for (const std::string& file : result.files()) {
    if (file.starts_with("data/") && file.ends_with(".csv") && !described.contains(file))
      add_fault(faults, file, "datapackage.json does not describe it");
  }
}

/// The run id is a hash of what was asked, so a change of that shows.
void check_run_id(const KeptResult& result, Faults& faults) {
  if (const std::string id = run_id(result.run); id != result.citation.run_id) {
    faults.push_back(fmt::format("manifest.json: run_id is '{}', but its experiment, config, seed and trials give '{}'",
                                 one_line(result.citation.run_id), id));
  }
}

constexpr const char* package_file = "datapackage.json";

/// The member as text; empty, with a complaint, if it is no text or is empty.
std::string required_text(const json& object, const char* key, const std::string& where, Faults& faults) {
  const auto found = object.find(key);
  if (found != object.end() && found->is_string() && !found->get<std::string>().empty()) return *found;
  add_fault(faults, package_file, "{}: '{}' is missing, empty or no text", where, key);
  return {};
}

void require_value(const json& object, const char* key, const std::string& value, const std::string& where,
                   Faults& faults) {
  const std::string given = required_text(object, key, where, faults);
  if (!given.empty() && given != value)
    add_fault(faults, package_file, "{}: '{}' is '{}', not '{}'", where, key, one_line(given), value);
}

/// The `name` of a package or a resource: lower case, to stand in an address.
std::string required_name(const json& object, const std::string& where, Faults& faults) {
  const std::string name = required_text(object, "name", where, faults);
  if (name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-._/") != std::string::npos)
    add_fault(faults, package_file, "{}: the name '{}' has a letter beyond a-z 0-9 - . _ /", where, one_line(name));
  return name;
}

/// An empty field is a missing value, which every type allows.
bool has_type(const std::string& field, const std::string& type) {
  if (field.empty() || type == "string") return true;
  if (type == "integer") return parsed<std::int64_t>(field).has_value();
  if (type != "number") return field == "true" || field == "false";
  if (field == "INF" || field == "-INF") return true;  // as Table Schema spells them
  return std::isfinite(parsed<double>(field).value_or(std::numeric_limits<double>::quiet_NaN()));
}

struct TableField {
  std::string name, type;
};

std::vector<TableField> check_fields(const json& resource, const std::string& where, Faults& faults) {
  const json schema = resource.value("schema", json());
  const json fields = schema.is_object() ? schema.value("fields", json()) : json();
  if (!fields.is_array() || fields.empty()) {
    add_fault(faults, package_file, "{}: no schema with a list of fields", where);
    return {};
  }
  if (schema.value("missingValues", json()) != json::array({""}))
    add_fault(faults, package_file, "{}: 'missingValues' is not [\"\"]", where);
  std::vector<TableField> out;
  std::set<std::string> names;
  for (const json& field : fields) {
    const std::string here = fmt::format("{}, field {}", where, out.size() + 1);
    if (!field.is_object()) {
      add_fault(faults, package_file, "{}: not an object", here);
      return {};
    }
    out.push_back({required_text(field, "name", here, faults), required_text(field, "type", here, faults)});
    const auto& [name, type] = out.back();
    const std::string named = fmt::format("{}, field '{}'", where, one_line(name));
    if (!names.insert(name).second) add_fault(faults, package_file, "{}: a second one of that name", named);
    static const std::set<std::string> types = {"string", "integer", "number", "boolean"};
    if (!types.contains(type)) add_fault(faults, package_file, "{}: the type '{}' is unknown", named, one_line(type));
    required_text(field, "description", named, faults);
    if (type == "integer" || type == "number") required_text(field, "unit", named, faults);
  }
  return out;
}

void check_rows(const std::string& path, const std::string& text, const std::vector<TableField>& fields,
                Faults& faults) {
  constexpr std::size_t most = 5;  // a file of other columns would name every row
  std::vector<CsvRow> rows;
  try {
    rows = read_csv(text);
  } catch (const CsvError& error) {
    add_fault(faults, fmt::format("{}:{}", path, error.line), "{}", error.what());
    return;
  }
  std::vector<std::string> names;
  for (const TableField& field : fields) names.push_back(field.name);
  if (rows.empty() || rows.front().fields != names) {
    faults.push_back(fmt::format("{}:1: its columns are not those of {}", path, package_file));
    return;
  }
  std::size_t found = 0;
  for (std::size_t i = 1; i < rows.size() && found < most; ++i) {
    if (rows[i].fields.size() != fields.size()) {
      add_fault(faults, fmt::format("{}:{}", path, rows[i].line), "{} fields, not {}", rows[i].fields.size(),
                fields.size());
      ++found;
      continue;
    }
    for (std::size_t j = 0; j < fields.size() && found < most; ++j) {
      if (has_type(rows[i].fields[j], fields[j].type)) continue;
      add_fault(faults, fmt::format("{}:{}", path, rows[i].line), "column '{}': '{}' is no {}",
                one_line(fields[j].name), one_line(clipped(rows[i].fields[j], 40)), fields[j].type);
      ++found;
    }
  }
}

/// Returns the path of its file.
std::string check_resource(const json& resource, std::size_t number, const fs::path& folder, Faults& faults) {
  std::string where = fmt::format("resource {}", number);
  if (!resource.is_object()) {
    add_fault(faults, package_file, "{}: not an object", where);
    return {};
  }
  where = fmt::format("resource '{}'", one_line(required_name(resource, where, faults)));
  require_value(resource, "profile", "tabular-data-resource", where, faults);
  require_value(resource, "format", "csv", where, faults);
  require_value(resource, "encoding", "utf-8", where, faults);
  required_text(resource, "description", where, faults);
  const std::vector<TableField> fields = check_fields(resource, where, faults);
  const std::string path = required_text(resource, "path", where, faults);
  if (path.starts_with('/') || path.find("..") != std::string::npos) {  // the specification forbids both
    add_fault(faults, package_file, "{}: the path '{}' leaves the folder", where, one_line(path));
    return path;
  }
  if (path.empty() || !fs::is_regular_file(folder / path)) {
    const char* const why = fs::exists(folder / path) ? "is not a file" : "missing";
    if (!path.empty()) add_fault(faults, path, "{}; {} describes it", why, package_file);
    return path;
  }
  const std::string text = file_text(folder / path);
  if (resource.contains("bytes") && resource["bytes"] != text.size())
    add_fault(faults, path, "{} bytes, not the {} of {}", text.size(), resource["bytes"].dump(), package_file);
  if (resource.contains("hash") && resource["hash"] != "sha256:" + sha256(text))
    add_fault(faults, path, "its SHA-256 is not that of {}", package_file);
  if (!fields.empty()) check_rows(path, text, fields, faults);
  return path;
}

/// datapackage.json against the rules of a Tabular Data Package, and each of its tables against it. Returns the paths of the
/// tables.
std::vector<std::string> check_data(const fs::path& folder, Faults& faults) {
  std::vector<std::string> paths;
  if (!fs::exists(folder / package_file)) {
    add_fault(faults, package_file, "missing");
    return paths;
  }
  if (!fs::is_regular_file(folder / package_file)) {
    add_fault(faults, package_file, "is not a file");
    return paths;
  }
  const json package = bounded_json(file_text(folder / package_file));
  if (!package.is_object()) {
    add_fault(faults, package_file, "not JSON, or no object, or nested too deep");
    return paths;
  }
  require_value(package, "profile", "tabular-data-package", "the package", faults);
  required_name(package, "the package", faults);
  for (const char* key : {"title", "description", "version"}) required_text(package, key, "the package", faults);
  const json resources = package.value("resources", json());
  if (!resources.is_array() || resources.empty()) {
    add_fault(faults, package_file, "no list of resources");
    return paths;
  }
  std::set<std::string> names;
  for (const json& resource : resources) {
    paths.push_back(check_resource(resource, paths.size() + 1, folder, faults));
    if (!paths.back().empty() && !names.insert(paths.back()).second)
      add_fault(faults, package_file, "'{}' is described twice", one_line(paths.back()));
  }
  return paths;
}

}  // namespace

std::vector<std::string> check_result(const fs::path& folder) {
  const bool complete = fs::exists(folder / "manifest.json");
  if (const std::string part = complete ? "" : part_of_run(folder); !part.empty())
    return {"manifest.json: missing; the folder " + part};
  Faults faults;
  const std::vector<std::string> tables = check_data(folder, faults);
  check_figures(folder, faults);
  if (!complete) {
    faults.insert(faults.begin(), "manifest.json: missing; without one a folder is not complete");
    return faults;
  }
  if (!fs::is_regular_file(folder / "manifest.json")) {
    faults.insert(faults.begin(), "manifest.json: is not a file");
    return faults;
  }
  std::optional<KeptResult> result;
  try {
    result = kept_result(folder, "manifest.json");
  } catch (const UsageError& error) {
    faults.insert(faults.begin(), error.what());
    return faults;
  }
  const std::set<std::string> found = files_below(folder);
  check_named_files(*result, faults);
  check_run_id(*result, faults);
  check_unknown_files(*result, found, faults);
  check_tables_are_known(*result, tables, faults);
  check_page(*result, faults);
  check_texts(*result, faults);
  return faults;
}

}  // namespace thinwall
