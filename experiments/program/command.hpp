#pragma once
/// What a command of the program is: a name, a word on what it is for, and the options it declares.
/// A new command is a file of its own and a line in command_list.cpp.

#include <functional>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include <thinwall/experiments/experiment.hpp>

namespace CLI {
class App;
}

namespace thinwall {

/// What a command is given when it runs.
struct Call {
  std::span<const Experiment> experiments;
  const std::vector<std::string>& argv;  ///< as the program was called
  std::ostream& out;                     ///< results
  std::ostream& err;                     ///< notes and progress
};

/// Does what the user asked for and returns the exit code. Throws UsageError for what the user must mend.
using Action = std::function<int(const Call&)>;

struct Command {
  const char* name;
  const char* summary;                ///< a line of `thinwall --help`
  const char* examples;               ///< whole lines, shown before the options; may be empty
  Action (*declare)(CLI::App& self);  ///< adds its options to `self`; the action reads them after parsing
  bool by_all_ranks = false;          ///< under mpirun, every rank does it; if not, rank 0 alone
};

/// Every command, in the order of `thinwall --help`.
std::span<const Command> commands();

}  // namespace thinwall
