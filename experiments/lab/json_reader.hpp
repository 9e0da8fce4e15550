#pragma once
/// JSON as text, and typed, checked access to JSON that anybody may have written, such as the manifest of a result from elsewhere.
/// Every complaint is a `UsageError` of one line: file, key, what was found, what is allowed.

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include <thinwall/experiments/lab/record.hpp>

namespace thinwall {

/// `is_discarded()` if `text` is no JSON, or is nested more than 64 deep: what copies, compares or prints a value recurses.
nlohmann::json bounded_json(std::string_view text);

/// On one line, which it ends; what is not UTF-8 becomes U+FFFD.
std::string json_line(const nlohmann::ordered_json& value);

/// The same on many lines, for a file.
std::string json_page(const nlohmann::ordered_json& value);

/// The fields of a record, by their names.
template <Record T> nlohmann::ordered_json json_of(const T& record) {
  nlohmann::ordered_json out;
  for_each_field<T>([&](const auto& field) { out[std::string(field.name)] = record.*field.member; });
  return out;
}

/// A value whose real numbers are as `exact_text` of lab/text.hpp has them. `comma` and `is` stand between items, and between a key
/// and its value: `,` and `:` of canonical JSON, `, ` and ` = ` of TOML.
std::string exact_text(const nlohmann::ordered_json& value, std::string_view comma, std::string_view is);

class JsonReader {
 public:
  /// `text` is what `file` holds, which must be one object.
  JsonReader(std::string_view text, const std::string& file);

  bool has(std::string_view key) const;

  /// Any value, of any type.
  const nlohmann::json& value(std::string_view key) const;

  /// Any text; or one for which `fits`, of which `allowed` says what that is.
  std::string text(std::string_view key) const;
  std::string text(std::string_view key, bool (*fits)(std::string_view), std::string_view allowed) const;
  bool flag(std::string_view key) const;
  std::uint64_t whole(std::string_view key, std::uint64_t lower, std::uint64_t upper) const;
  double number(std::string_view key) const;
  std::vector<double> numbers(std::string_view key) const;  ///< null is NaN
  std::vector<std::string> texts(std::string_view key) const;
  std::map<std::string, std::string> named_texts(std::string_view key) const;  ///< of an object
  JsonReader object(std::string_view key) const;
  std::vector<JsonReader> objects(std::string_view key) const;  ///< of a list

  /// The key a complaint should name, for a check that only the caller can make.
  [[noreturn]] void complain(std::string_view key, std::string_view allowed) const;

 private:
  JsonReader(std::string file, std::string path, std::shared_ptr<const nlohmann::json> value);

  std::string file_, path_;
  std::shared_ptr<const nlohmann::json> value_;
};

}  // namespace thinwall
