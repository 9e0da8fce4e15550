#include <thinwall/experiments/program/list_command.hpp>

#include <algorithm>
#include <memory>
#include <ostream>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <thinwall/experiments/program/exit_codes.hpp>
#include <thinwall/experiments/program/json_reply.hpp>
#include <thinwall/experiments/program/options.hpp>

namespace thinwall {
namespace {

std::string list_text(std::span<const Experiment> experiments) {
  std::size_t longest = 0;
  for (const Experiment& experiment : experiments) longest = std::max(longest, experiment.name.size());
  std::string out;
  for (const Experiment& experiment : experiments) {
    out += fmt::format("{:<{}}  {}\n", experiment.name, longest, experiment.question);
  }
  return out;
}

Action declare_list(CLI::App& self) {
  const auto json = std::make_shared<bool>(false);
  add_json(self, *json);
  return [json](const Call& call) {
    call.out << (*json ? list_reply(call.experiments) : list_text(call.experiments));
    return exit_done;
  };
}

constexpr const char* list_examples = R"(  thinwall list
  thinwall list --json
)";

}  // namespace

Command list_command() { return {"list", "Print every experiment and its question", list_examples, declare_list}; }

}  // namespace thinwall
