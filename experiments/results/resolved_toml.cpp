#include <thinwall/experiments/results/resolved_toml.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <thinwall/experiments/text/escape.hpp>
#include <thinwall/experiments/text/numbers.hpp>

namespace thinwall {
namespace {

using nlohmann::json;

/// A value on one line; a table within a list becomes an inline one.
std::string value_text(const json& value) {
  std::string out;
  switch (value.type()) {
    case json::value_t::string: return json_string(value.get<std::string>());
    case json::value_t::number_float: return exact_text(value.get<double>());
    case json::value_t::array:
      for (const json& item : value) out += (out.empty() ? "" : ", ") + value_text(item);
      return "[" + out + "]";
    case json::value_t::object:
      for (const auto& [key, item] : value.items()) {
        out += fmt::format("{}{} = {}", out.empty() ? "" : ", ", json_string(key), value_text(item));
      }
      return "{" + out + "}";
    default: return value.dump();  // integers and booleans look the same in both
  }
}

std::string key_text(const std::string& key) {
  constexpr std::string_view plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-";
  return !key.empty() && key.find_first_not_of(plain) == std::string::npos ? key : json_string(key);
}

std::string table_text(const json& table, const std::string& path) {
  std::string values, tables;
  for (const auto& [key, value] : table.items()) {
    if (value.is_object()) {
      const std::string inner = path + (path.empty() ? "" : ".") + key_text(key);
      tables += fmt::format("\n[{}]\n{}", inner, table_text(value, inner));
    } else {
      values += fmt::format("{} = {}\n", key_text(key), value_text(value));
    }
  }
  return values + tables;
}

}  // namespace

std::string resolved_toml(const RunRecord& run) {
  json config = json::parse(run.config);
  config.erase("experiment");
  return fmt::format("# To run it again from inside this folder:\n# {}\nexperiment = {}\n{}", reproduce_line(run),
                     json_string(run.experiment), table_text(config, ""));
}

}  // namespace thinwall
