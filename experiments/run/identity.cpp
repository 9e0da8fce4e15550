#include <thinwall/experiments/run/identity.hpp>

#include <nlohmann/json.hpp>

#include <thinwall/experiments/text/escape.hpp>

namespace thinwall {
namespace {

using nlohmann::json;

json to_json(const RunIdentity& identity) {
  return {{"experiment", identity.experiment},
          {"config", json::parse(identity.config)},
          {"seed", identity.seed},
          {"trials", identity.trials ? json(*identity.trials) : json()},
          {"program", identity.program}};
}

std::string difference(const std::string& name, const json& theirs, const json& ours) {
  const auto shown = [](const json& value) { return value.is_null() ? "none" : clipped(value.dump(), 40); };
  return name + " = " + shown(theirs) + ", not " + shown(ours);
}

}  // namespace

std::string identity_text(const RunIdentity& identity) { return to_json(identity).dump(); }

std::string identity_difference(std::string_view theirs, const RunIdentity& ours) {
  const json a = json::parse(theirs, nullptr, false), b = to_json(ours);
  if (!a.is_object()) return "something that cannot be read";
  for (const char* name : {"experiment", "seed", "trials"}) {
    if (a.value(name, json()) != b.at(name)) return difference(name, a.value(name, json()), b.at(name));
  }
  const json config = a.value("config", json::object());
  for (const auto& [key, value] : b.at("config").items()) {
    if (config.value(key, json()) != value) return difference(key, config.value(key, json()), value);
  }
  return config == b.at("config") ? "" : "keys that are unknown here";
}

bool same_program(std::string_view theirs, const RunIdentity& ours) {
  const json a = json::parse(theirs, nullptr, false);
  return a.is_object() && a.value("program", "") == ours.program;
}

}  // namespace thinwall
