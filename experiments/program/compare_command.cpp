#include <thinwall/experiments/program/compare_command.hpp>

#include <CLI/CLI.hpp>

#include <thinwall/experiments/program/plan_command.hpp>
#include <thinwall/experiments/program/run_command.hpp>

namespace thinwall {
namespace {

constexpr const char* compare_examples = R"(  thinwall compare experiments/scenes/bullet_against_bullet.toml
  thinwall compare my_scene.toml --out results/mine --threads 1
)";

constexpr const char* compare_footer =
    R"(The scene is stepped under every time policy and step that its [compare] names, and once more by events, with steps
finer than the finest: the exact run that the others are held against. A folder is continued as by `run`.
)";

Action declare_compare(CLI::App& self) {
  const auto text = std::make_shared<RunText>();
  text->wish.request.compare = true;
  self.footer(compare_footer);
  add_scene_target(self, text->wish.target);
  add_run_options(self, *text);
  return [text](const Call& call) {
    require_scene_target("compare", text->wish.target);
    return perform_run(parse_run(*text), call);
  };
}

}  // namespace

Command compare_command() {
  return {"compare", "Step a scene under every time policy, and hold each against the exact run", compare_examples,
          declare_compare, true};
}

}  // namespace thinwall
