#include <thinwall/experiments/program/completion_command.hpp>

#include <memory>
#include <ostream>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <thinwall/experiments/program/completion.hpp>
#include <thinwall/experiments/program/exit_codes.hpp>
#include <thinwall/experiments/program/options.hpp>
#include <thinwall/experiments/settings.hpp>

namespace thinwall {
namespace {

constexpr const char* completion_examples =
    R"(  source <(thinwall completion bash)      for this shell; in ~/.bashrc for every one
  source <(thinwall completion zsh)
  thinwall completion fish | source
)";

struct CompletionText {
  std::string shell;
  bool json = false;
};

int print_completion(const CompletionText& text, const Call& call) {
  if (text.shell.empty()) throw UsageError("completion: a shell is missing; bash, zsh or fish");
  const std::string shell = parse_choice("completion", text.shell, completion_shells);
  const std::string script = completion_script(shell, completed_commands(call.experiments));
  if (text.json) {
    call.out << nlohmann::ordered_json{{"shell", shell}, {"script", script}}.dump() << "\n";
  } else {
    call.out << script;
  }
  return exit_done;
}

Action declare_completion(CLI::App& self) {
  const auto text = std::make_shared<CompletionText>();
  add_target(self, "shell", text->shell, "The shell that is to complete", "bash|zsh|fish");
  add_json(self, text->json);
  return [text](const Call& call) { return print_completion(*text, call); };
}

}  // namespace

Command completion_command() {
  return {"completion", "Print a script that completes commands, options and experiments in a shell",
          completion_examples, declare_completion};
}

}  // namespace thinwall
