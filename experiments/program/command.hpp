#pragma once
/// What can be typed: the commands, their options, what they return, and how what they say is kept harmless.

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <memory>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/lab/result_folder.hpp>
#include <thinwall/experiments/lab/runner.hpp>

// ---- What the program says to the shell.

namespace CLI {
class App;
}

namespace thinwall {

inline constexpr int exit_done = 0;           ///< done, and nothing was found wrong
inline constexpr int exit_failed = 1;         ///< it ran and found something wrong, or the system failed it
inline constexpr int exit_bad_input = 2;      ///< the command line, a configuration or a file of the user's
inline constexpr int exit_interrupted = 130;  ///< Ctrl-C; what was done is kept

// ---- What a command of the program is: a name, a word on what it is for, and the options it declares.
// A new command is a row of its file's list, as run_commands(). A new file's list is declared below, and stands in commands().

/// What a command is given when it runs.
struct Call {
  std::span<const Experiment> experiments;
  const std::vector<std::string>& argv;  ///< as the program was called
  std::ostream& out;                     ///< results
  std::ostream& err;                     ///< notes and progress
};

/// Does what the user asked for and returns the exit code. Throws UsageError for what the user must mend.
using Action = std::function<int(const Call&)>;

/// Adds a command's options to `self`, and returns what reads them after parsing.
using Declare = std::function<Action(CLI::App& self)>;

struct Command {
  const char* name;
  const char* summary;   ///< a line of `thinwall --help`
  const char* examples;  ///< whole lines, shown before the options
  Declare declare;
  bool by_all_ranks = false;  ///< under mpirun, every rank does it; if not, rank 0 alone
};

/// Of a command whose options `add` has parsed into a `Text`, and which does `act`.
template <class Text> Declare options(void (*add)(CLI::App&, Text&), int (*act)(const Text&, const Call&)) {
  return [=](CLI::App& self) -> Action {
    const auto text = std::make_shared<Text>();
    add(self, *text);
    return [=](const Call& call) { return act(*text, call); };
  };
}

/// Every command, in the order of `thinwall --help`.
std::span<const Command> commands();

// ---- Options that several commands share: one spelling, one meaning, one complaint.

/// The text of an option, if it was given at all.
using OptionText = std::optional<std::string>;

void add_flag(CLI::App& command, const std::string& name, bool& flag, const std::string& meaning);
void add_text(CLI::App& command, const std::string& name, OptionText& text, const std::string& meaning,
              const std::string& form);

void add_json(CLI::App& command, bool& json);
void add_threads(CLI::App& command, OptionText& threads);
void add_out(CLI::App& command, OptionText& out);
void add_benchmarks(CLI::App& command, OptionText& folder);

/// The word after the command: the help calls it `name` and gives its `form`. Empty if it is missing.
void add_target(CLI::App& command, const std::string& name, std::string& target, const std::string& meaning,
                const std::string& form);

/// With an empty line behind it; nothing for nothing.
std::string summary_text(const std::string& summary);

// All throw UsageError, naming the option and what is allowed.
int parse_threads(const OptionText& text);         ///< every core if not given
std::string parse_folder(const OptionText& text);  ///< empty if not given
std::int64_t parse_positive(std::string_view option, const std::string& text, std::int64_t most);
std::string parse_choice(std::string_view option, const OptionText& text,
                         std::span<const std::string_view> allowed);  ///< empty if not given

// ---- From the words of the command line to the command that they name.

/// What to do: a command's action, or one that prints a help text or the version. Throws UsageError.
Action parse_command_line(const std::vector<std::string>& argv);

// ---- The commands.

std::vector<Command> run_commands();        ///< run, compare, plan
std::vector<Command> thin_wall_commands();  ///< advise, explore
std::vector<Command> result_commands();     ///< merge, report, reproduce, cite
Command validate_command();                 ///< its exit code is 1 if any verdict is wrong
Command completion_command();

// ---- `thinwall report`, and the option --figures that `thinwall run` shares with it.

void add_figures(CLI::App& self, OptionText& figures);

/// The formats in `pdf,tex`; none if it was not given. Throws UsageError.
std::vector<std::string> parse_figures(const OptionText& figures);

// ---- What a shell completes, taken from the commands themselves.

/// What may stand in a place: words, TOML files, folders.
struct CompletedValue {
  std::vector<std::string> words;
  bool toml = false, folder = false;
};

struct CompletedOption {
  std::string name, meaning;  ///< `--out`
  bool takes_value = false;
  CompletedValue value;
};

struct CompletedCommand {
  std::string name, summary;
  std::vector<CompletedOption> options;
  CompletedValue target;  ///< the words after the command that are no options
};

/// Every command, with the names of the `experiments` where one may stand.
std::vector<CompletedCommand> completed_commands(std::span<const Experiment> experiments);

}  // namespace thinwall
