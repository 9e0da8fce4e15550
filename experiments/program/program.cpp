#include <thinwall/experiments/program/program.hpp>

#include <ostream>

#include <thinwall/experiments/program/command_line.hpp>
#include <thinwall/experiments/program/exit_codes.hpp>
#include <thinwall/experiments/program/harmless_output.hpp>
#include <thinwall/experiments/run/ranks.hpp>
#include <thinwall/experiments/settings.hpp>
#include <thinwall/experiments/text/escape.hpp>

namespace thinwall {

int run_program(const std::vector<std::string>& argv, std::span<const Experiment> experiments, std::ostream& to_stdout,
                std::ostream& to_stderr) {
  HarmlessOutput out(to_stdout), err(to_stderr);
  std::ostream nowhere(nullptr);
  const bool quiet = launch_of_this_process().rank > 0;  // of the ranks that mpirun started, one speaks
  std::ostream& notes = quiet ? nowhere : err;
  try {
    const int status = parse_command_line(argv)({experiments, argv, quiet ? nowhere : out, notes});
    if (out.flush()) return status;
    notes << "failed: stdout cannot be written" << std::endl;  // a full disk, where it goes to a file
    return exit_failed;
  } catch (const UsageError& error) {
    notes << error.what() << std::endl;
    return exit_bad_input;
  } catch (const std::exception& error) {
    notes << "failed: " << one_line(error.what()) << std::endl;
    return exit_failed;
  }
}

}  // namespace thinwall
