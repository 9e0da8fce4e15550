#include <thinwall/experiments/program/plan_command.hpp>

#include <ostream>

#include <nlohmann/json.hpp>

#include <thinwall/experiments/program/configured_run.hpp>
#include <thinwall/experiments/program/exit_codes.hpp>
#include <thinwall/experiments/scene.hpp>
#include <thinwall/experiments/scenes/scene.hpp>
#include <thinwall/experiments/settings.hpp>
#include <thinwall/experiments/world/plan.hpp>

namespace thinwall {
namespace {

std::string json_reply(const Scene& scene, const Plan& plan) {
  using nlohmann::ordered_json;
  ordered_json reply = {{"scene", scene.name},
                        {"bodies", scene.bodies.size()},
                        {"full", plan.full},
                        {"broad_phase", plan.broad_phase},
                        {"lines", ordered_json::array()}};
  for (const PlanLine& line : plan.lines)
    reply["lines"].push_back({{"what", line.what}, {"omitted", line.omitted}, {"why", line.why}});
  return reply.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace

int plan_command(const CommandLine& line, std::ostream& out) {
  Settings settings(read_config(line.target), line.target, scene_experiment().default_toml);
  settings.reject_unknown_keys();
  settings.require("scene", "its name; without one the file is not a scene");
  if (!line.plan_kind.empty()) settings.assign("plan", line.plan_kind);
  const Scene scene = read_scene(settings, {.seed = line.seed, .trials = {}});
  const Plan made = plan(scene.bodies, scene.options);
  out << (line.json ? json_reply(scene, made) : to_text(made));
  return exit_done;
}

}  // namespace thinwall
