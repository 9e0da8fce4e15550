#include <thinwall/experiments/program/program.hpp>

#include <algorithm>
#include <ostream>

#include <fmt/format.h>

#include <thinwall/experiments/program/command_line.hpp>
#include <thinwall/experiments/program/exit_codes.hpp>
#include <thinwall/experiments/program/json_reply.hpp>
#include <thinwall/experiments/program/plan_command.hpp>
#include <thinwall/experiments/program/run_command.hpp>
#include <thinwall/experiments/program/validate_command.hpp>
#include <thinwall/experiments/settings.hpp>
#include <thinwall/experiments/text/escape.hpp>

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

}  // namespace

int run_program(const std::vector<std::string>& argv, std::span<const Experiment> experiments, std::ostream& out,
                std::ostream& err) {
  try {
    const CommandLine line = parse_command_line(argv);
    switch (line.command) {
      case Command::help: out << line.text; return exit_done;
      case Command::list: out << (line.json ? list_reply(experiments) : list_text(experiments)); return exit_done;
      case Command::run:
      case Command::compare: return run_command(line, experiments, out, err);
      case Command::plan: return plan_command(line, out);
      case Command::validate: return validate_command(line, out, err);
    }
    return exit_failed;
  } catch (const UsageError& error) {
    err << error.what() << std::endl;
    return exit_bad_input;
  } catch (const std::exception& error) {
    err << "failed: " << one_line(error.what()) << std::endl;
    return exit_failed;
  }
}

}  // namespace thinwall
