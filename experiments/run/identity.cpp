#include <thinwall/experiments/run/identity.hpp>

#include <algorithm>
#include <limits>

#include <nlohmann/json.hpp>

#include <thinwall/experiments/json_reader.hpp>
#include <thinwall/experiments/settings.hpp>
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

/// Of a configuration: what a TOML file can hold.
bool is_toml(const json& value) {
  if (value.is_structured()) return std::ranges::all_of(value, is_toml);
  if (value.is_number_unsigned()) return value.get<std::uint64_t>() <= std::numeric_limits<std::int64_t>::max();
  return !value.is_null();
}

bool is_name(std::string_view text) {
  return !text.empty() && text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string_view::npos;
}

std::string difference(const std::string& name, const json& theirs, const json& ours) {
  const auto shown = [](const json& value) { return value.is_null() ? "none" : clipped(value.dump(), 40); };
  return name + " = " + shown(theirs) + ", not " + shown(ours);
}

}  // namespace

std::string identity_text(const RunIdentity& identity) { return to_json(identity).dump(); }

RunIdentity read_identity(const JsonReader& object) {
  const json& config = object.value("config");
  if (!config.is_object() || !is_toml(config))
    object.complain("config", "an object of what TOML can hold: no null, no whole number above 2^63 - 1");
  constexpr std::uint64_t most_trials = std::numeric_limits<std::int64_t>::max();
  const bool has_trials = !object.value("trials").is_null();
  return {.experiment = object.text("experiment", is_name, "a name of a-z, 0-9 and _"),
          .config = config.dump(),
          .seed = object.whole("seed", 0, std::numeric_limits<std::uint64_t>::max()),
          .trials = has_trials ? std::optional(static_cast<std::int64_t>(object.whole("trials", 1, most_trials)))
                               : std::nullopt,
          .program = {}};
}

std::optional<RunIdentity> parse_identity(std::string_view text) {
  try {
    const JsonReader object(text, "identity");
    RunIdentity identity = read_identity(object);
    identity.program = object.text("program");
    if (object.has("shard")) identity.shard = object.text("shard");
    return identity;
  } catch (const UsageError&) {
    return std::nullopt;
  }
}

std::string identity_difference(std::string_view theirs, const RunIdentity& ours) {
  const auto parsed = parse_identity(theirs);
  if (!parsed) return "something that cannot be read";
  const json a = to_json(*parsed), b = to_json(ours);
  for (const char* name : {"experiment", "seed", "trials", "shard"}) {
    const json left = a.value(name, json()), right = b.value(name, json());
    if (left != right) return difference(name, left, right);
  }
  const json& config = a.at("config");
  for (const auto& [key, value] : b.at("config").items()) {
    if (config.value(key, json()) != value) return difference(key, config.value(key, json()), value);
  }
  return config == b.at("config") ? "" : "keys that are unknown here";
}

bool same_program(std::string_view theirs, const RunIdentity& ours) {
  const auto parsed = parse_identity(theirs);
  return parsed && parsed->program == ours.program;
}

}  // namespace thinwall
