#include <thinwall/experiments/run/identity.hpp>

#include <nlohmann/json.hpp>

#include <thinwall/experiments/text/escape.hpp>

namespace thinwall {
namespace {

using nlohmann::json;

json to_json(const RunIdentity& identity) {
  json out = {{"experiment", identity.experiment},
              {"config", json::parse(identity.config)},
              {"seed", identity.seed},
              {"trials", identity.trials ? json(*identity.trials) : json()},
              {"program", identity.program}};
  if (!identity.shard.empty()) out["shard"] = identity.shard;
  return out;
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
  for (const char* name : {"experiment", "seed", "trials", "shard"}) {
    const json left = a.value(name, json()), right = b.value(name, json());
    if (left != right) return difference(name, left, right);
  }
  const json config = a.value("config", json::object());
  for (const auto& [key, value] : b.at("config").items()) {
    if (config.value(key, json()) != value) return difference(key, config.value(key, json()), value);
  }
  return config == b.at("config") ? "" : "keys that are unknown here";
}

std::optional<RunIdentity> parse_identity(std::string_view text) {
  const json a = json::parse(text, nullptr, false);
  if (!a.is_object()) return std::nullopt;
  try {
    RunIdentity identity{.experiment = a.at("experiment"),
                         .config = a.at("config").dump(),
                         .seed = a.at("seed"),
                         .trials = std::nullopt,
                         .program = a.at("program"),
                         .shard = a.value("shard", "")};
    if (!a.at("trials").is_null()) identity.trials = a.at("trials").get<std::int64_t>();
    return identity;
  } catch (const json::exception&) {
    return std::nullopt;
  }
}

bool same_program(std::string_view theirs, const RunIdentity& ours) {
  const json a = json::parse(theirs, nullptr, false);
  return a.is_object() && a.value("program", "") == ours.program;
}

}  // namespace thinwall
