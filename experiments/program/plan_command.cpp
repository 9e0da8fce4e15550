#include <thinwall/experiments/program/plan_command.hpp>

#include <array>
#include <memory>
#include <ostream>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
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

struct PlanText {
  std::string target;
  OptionText seed, plan;
  bool json = false;
};

int print_plan(const PlanText& text, std::ostream& out) {
  require_scene_target("plan", text.target);
  const std::string kind = parse_plan_kind(text.plan);
  const std::uint64_t seed = parse_seed(text.seed);
  Settings settings(read_config(text.target), text.target, scene_experiment().default_toml);
  settings.reject_unknown_keys();
  settings.require("scene", "its name; without one the file is not a scene");
  if (!kind.empty()) settings.assign("plan", kind);
  const Scene scene = read_scene(settings, {.seed = seed, .trials = {}});
  const Plan made = plan(scene.bodies, scene.options);
  out << (text.json ? json_reply(scene, made) : to_text(made));
  return exit_done;
}

constexpr const char* plan_examples = R"(  thinwall plan experiments/scenes/rain.toml
  thinwall plan my_scene.toml --json
)";

Action declare_plan(CLI::App& self) {
  const auto text = std::make_shared<PlanText>();
  add_scene_target(self, text->target);
  add_seed(self, text->seed);
  add_plan_kind(self, text->plan);
  add_json(self, text->json);
  return [text](const Call& call) { return print_plan(*text, call.out); };
}

}  // namespace

void add_scene_target(CLI::App& self, std::string& target) {
  add_target(self, "scene", target, "The TOML file of a scene", "FILE.toml");
}

void add_plan_kind(CLI::App& self, OptionText& plan) {
  add_text(self, "--plan", plan, "Of a scene: full omits nothing; the outcome is the same to the bit", "lean|full");
}

void require_scene_target(const char* command, const std::string& target) {
  if (!target.empty()) return;
  throw UsageError(fmt::format("{0}: the TOML file of a scene is missing; see thinwall {0} --help", command));
}

std::string parse_plan_kind(const OptionText& plan) {
  constexpr std::array<std::string_view, 2> kinds = {"lean", "full"};
  return parse_choice("--plan", plan, kinds);
}

Command plan_command() { return {"plan", "Print what a scene does not need, and why", plan_examples, declare_plan}; }

}  // namespace thinwall
