#include <thinwall/experiments/lab/json_reader.hpp>

#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/lab/text.hpp>

namespace thinwall {
namespace {

using nlohmann::json;

constexpr int most_depth = 64;

}  // namespace

json bounded_json(std::string_view text) {
  bool deep = false;
  const auto is_shallow = [&](int depth, json::parse_event_t, json&) {
    deep = deep || depth > most_depth;
    return !deep;
  };
  json out = json::parse(text, is_shallow, false);
  return deep ? json(json::value_t::discarded) : out;
}

std::string json_line(const nlohmann::ordered_json& value) {
  return value.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
}

std::string json_page(const nlohmann::ordered_json& value) {
  return value.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

std::string exact_text(const nlohmann::ordered_json& value, std::string_view comma, std::string_view is) {
  if (value.is_string()) return json_string(value.get<std::string>());
  if (value.is_number_float()) return exact_text(value.get<double>());
  if (!value.is_structured()) return value.dump();
  std::vector<std::string> items;
  for (const auto& [key, item] : value.items()) {
    const std::string name = value.is_object() ? fmt::format("{}{}", json_string(key), is) : "";
    items.push_back(name + exact_text(item, comma, is));
  }
  const std::string inner = fmt::format("{}", fmt::join(items, comma));
  return value.is_object() ? "{" + inner + "}" : "[" + inner + "]";
}

JsonReader::JsonReader(std::string_view text, const std::string& file)
    : file_(one_line(file)), value_(std::make_shared<const json>(bounded_json(text))) {
  if (!value_->is_object())
    throw UsageError(fmt::format("{}: is not one JSON object, nested at most {} deep", file_, most_depth));
}

JsonReader::JsonReader(std::string file, std::string path, std::shared_ptr<const json> value)
    : file_(std::move(file)), path_(std::move(path)), value_(std::move(value)) {}

bool JsonReader::has(std::string_view key) const { return value_->contains(key); }

const json& JsonReader::value(std::string_view key) const {
  const auto found = value_->find(key);
  if (found == value_->end())
    throw UsageError(fmt::format("{}: key '{}': missing", file_, one_line(path_ + std::string(key))));
  return *found;
}

void JsonReader::complain(std::string_view key, std::string_view allowed) const {
  const std::string found = value(key).dump(-1, ' ', true, json::error_handler_t::replace);
  throw UsageError(fmt::format("{}: key '{}': {} is not allowed; {}", file_, one_line(path_ + std::string(key)),
                               clipped(found, 60), allowed));
}

std::string JsonReader::text(std::string_view key) const {
  if (!value(key).is_string()) complain(key, "a text");
  return value(key).get<std::string>();
}

std::string JsonReader::text(std::string_view key, bool (*fits)(std::string_view), std::string_view allowed) const {
  if (!value(key).is_string() || !fits(value(key).get_ref<const std::string&>())) complain(key, allowed);
  return value(key).get<std::string>();
}

bool JsonReader::flag(std::string_view key) const {
  if (!value(key).is_boolean()) complain(key, "true or false");
  return value(key).get<bool>();
}

std::uint64_t JsonReader::whole(std::string_view key, std::uint64_t lower, std::uint64_t upper) const {
  const json& found = value(key);
  if (!found.is_number_unsigned() || found.get<std::uint64_t>() < lower || found.get<std::uint64_t>() > upper)
    complain(key, fmt::format("a whole number from {} to {}", lower, upper));
  return found.get<std::uint64_t>();
}

double JsonReader::number(std::string_view key) const {
  if (!value(key).is_number()) complain(key, "a number");
  return value(key).get<double>();
}

std::vector<double> JsonReader::numbers(std::string_view key) const {
  std::vector<double> out;
  if (!value(key).is_array()) complain(key, "a list of numbers");
  for (const json& item : value(key)) {
    if (!item.is_number() && !item.is_null()) complain(key, "a list of numbers");
    out.push_back(item.is_null() ? std::numeric_limits<double>::quiet_NaN() : item.get<double>());
  }
  return out;
}

std::vector<std::string> JsonReader::texts(std::string_view key) const {
  const json& found = value(key);
  if (!found.is_array() || !std::ranges::all_of(found, &json::is_string)) complain(key, "a list of texts");
  return found.get<std::vector<std::string>>();
}

std::map<std::string, std::string> JsonReader::named_texts(std::string_view key) const {
  const json& found = value(key);
  if (!found.is_object() || !std::ranges::all_of(found, &json::is_string)) complain(key, "an object of texts");
  return found.get<std::map<std::string, std::string>>();
}

JsonReader JsonReader::object(std::string_view key) const {
  if (!value(key).is_object()) complain(key, "an object");
  return {file_, fmt::format("{}{}.", path_, key), {value_, &value(key)}};
}

std::vector<JsonReader> JsonReader::objects(std::string_view key) const {
  const json& found = value(key);
  if (!found.is_array() || !std::ranges::all_of(found, &json::is_object)) complain(key, "a list of objects");
  std::vector<JsonReader> out;
  for (const json& item : found)
    out.push_back(JsonReader(file_, fmt::format("{}{}[{}].", path_, key, out.size()), {value_, &item}));
  return out;
}

}  // namespace thinwall
