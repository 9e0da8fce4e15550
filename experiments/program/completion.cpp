#include <thinwall/experiments/program/command.hpp>

#include <array>
#include <ostream>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/json_reader.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/lab/text.hpp>

namespace thinwall {

namespace {

bool is_word(std::string_view text) {
  return !text.empty() && text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-_") == std::string::npos;
}

/// `form` is what the help shows in the place of a value: `lean|full`, `NAME|FILE.toml`, `DIR`.
CompletedValue value_of_form(const std::string& form, std::span<const Experiment> experiments) {
  CompletedValue out;
  for (const std::string_view part : split(form, '|')) {
    if (part == "NAME") {
      for (const Experiment& experiment : experiments) out.words.emplace_back(experiment.name);
    } else if (part.ends_with(".toml")) {
      out.toml = true;
    } else if (part.starts_with("DIR") || part.starts_with("RESULT") || part.starts_with("SHARD...")) {
      out.folder = true;
    } else if (is_word(part)) {
      out.words.emplace_back(part);
    }
  }
  return out;
}

std::string joined(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, " ")); }

// bash -------------------------------------------------------------------------------------------------------------

/// Sets what `_thinwall` may offer: words, and whether files.
std::string bash_value(const CompletedValue& value) {
  return fmt::format("words={} toml={:d} folder={:d}", single_quoted(joined(value.words)), value.toml, value.folder);
}

constexpr const char* bash_end = R"(  mapfile -t COMPREPLY < <(
    compgen -W "$words" -- "$cur"
    ((toml)) && compgen -f -X '!*.toml' -- "$cur"
    ((toml || folder)) && compgen -d -- "$cur"
  )
  if ((toml || folder)); then compopt -o filenames 2>/dev/null; fi
  return 0
}
complete -F _thinwall thinwall
)";

std::string bash_script(std::span<const CompletedCommand> commands) {
  std::vector<std::string> names;
  std::string values, targets;
  for (const CompletedCommand& command : commands) {
    names.push_back(command.name);
    std::vector<std::string> own;
    for (const CompletedOption& option : command.options) {
      own.push_back(option.name);
      if (!option.takes_value) continue;
      values += fmt::format("    {}:{}) {} is_value=1 ;;\n", command.name, option.name, bash_value(option.value));
    }
    targets += fmt::format("    {}) {}; [[ $cur == -* ]] && {{ words={}; toml=0; folder=0; }} ;;\n", command.name,
                           bash_value(command.target), single_quoted(joined(own)));
  }
  return "# Completion of thinwall for bash. To load it: source <(thinwall completion bash)\n"
         "_thinwall() {\n"
         "  local cur=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]}\n"
         "  local words= toml=0 folder=0 is_value=0\n"
         "  ((COMP_CWORD == 1)) && words=" +
         single_quoted(joined(names) + " --help --version") +
         "\n"
         "  ((COMP_CWORD > 2)) && case $command:$before in\n" +
         values +
         "  esac\n"
         "  ((COMP_CWORD > 1 && !is_value)) && case $command in\n" +
         targets + "  esac\n" + bash_end;
}

// zsh --------------------------------------------------------------------------------------------------------------

/// Within an argument of _arguments or _describe.
std::string zsh_escaped(const std::string& text) {
  return replaced(text, {{'[', "\\["}, {']', "\\]"}, {':', "\\:"}, {'\\', "\\\\"}});
}

std::string zsh_action(const CompletedValue& value) {
  if (value.words.empty() && !value.toml && !value.folder) return " ";
  return fmt::format("{{_thinwall_offer {:d} {:d} {}}}", value.toml, value.folder, joined(value.words));
}

constexpr const char* zsh_offer = R"(_thinwall_offer() {
  local toml=$1 folder=$2
  shift 2
  (($#)) && compadd -- "$@"
  ((toml)) && _files -g '*.toml'
  ((folder)) && _files -/
}
)";

std::string zsh_script(std::span<const CompletedCommand> commands) {
  std::string names, cases;
  for (const CompletedCommand& command : commands) {
    names += "    " + single_quoted(zsh_escaped(command.name) + ":" + zsh_escaped(command.summary)) + "\n";
    cases += fmt::format("    {})\n      _arguments", command.name);
    for (const CompletedOption& option : command.options) {
      cases +=
          " \\\n        " + single_quoted(fmt::format("{}[{}]{}", option.name, zsh_escaped(option.meaning),
                                                      option.takes_value ? ":value:" + zsh_action(option.value) : ""));
    }
    cases += " \\\n        " + single_quoted("*:argument:" + zsh_action(command.target)) + " ;;\n";
  }
  return "#compdef thinwall\n"
         "# Completion of thinwall for zsh. To load it: source <(thinwall completion zsh)\n" +
         std::string(zsh_offer) + "_thinwall() {\n  local -a commands=(\n" + names +
         "  )\n  if ((CURRENT == 2)); then\n    _describe command commands\n    return\n  fi\n"
         "  local command=$words[2]\n  shift words\n  ((CURRENT--))\n  case $command in\n" +
         cases +
         "  esac\n}\n"
         "if [[ $funcstack[1] == _thinwall ]]; then _thinwall \"$@\"; else compdef _thinwall thinwall; fi\n";
}

// fish -------------------------------------------------------------------------------------------------------------

std::string fish_quoted(const std::string& text) { return "'" + replaced(text, {{'\'', "\\'"}, {'\\', "\\\\"}}) + "'"; }

std::string fish_arguments(const CompletedValue& value) {
  std::vector<std::string> parts = value.words;
  if (value.toml) parts.emplace_back("(__fish_complete_suffix .toml)");
  if (value.folder) parts.emplace_back("(__fish_complete_directories)");
  return parts.empty() ? "" : " -a " + fish_quoted(joined(parts));
}

std::string fish_script(std::span<const CompletedCommand> commands) {
  std::string out =
      "# Completion of thinwall for fish. To load it: thinwall completion fish | source\ncomplete -c thinwall -f\n";
  for (const CompletedCommand& command : commands) {
    out += fmt::format("complete -c thinwall -n __fish_use_subcommand -a {} -d {}\n", command.name,
                       fish_quoted(command.summary));
    const std::string here = fmt::format("complete -c thinwall -n '__fish_seen_subcommand_from {}'", command.name);
    for (const CompletedOption& option : command.options) {
      out += fmt::format("{} -l {}{} -d {}\n", here, option.name.substr(2),
                         option.takes_value ? " -x" + fish_arguments(option.value) : "", fish_quoted(option.meaning));
    }
    if (const std::string target = fish_arguments(command.target); !target.empty()) out += here + target + "\n";
  }
  return out;
}

constexpr const char* completion_examples =
    R"(  source <(thinwall completion bash)      for this shell; in ~/.bashrc for every one
  source <(thinwall completion zsh)
  thinwall completion fish | source
)";

constexpr std::array<std::string_view, 3> shells = {"bash", "zsh", "fish"};

struct CompletionText {
  std::string shell;
  bool json = false;
};

int print_completion(const CompletionText& text, const Call& call) {
  if (text.shell.empty()) throw UsageError("completion: a shell is missing; bash, zsh or fish");
  const std::string shell = parse_choice("completion", text.shell, shells);
  const std::vector<CompletedCommand> all = completed_commands(call.experiments);
  const std::string script = shell == "bash" ? bash_script(all) : shell == "zsh" ? zsh_script(all) : fish_script(all);
  call.out << (text.json ? json_line({{"shell", shell}, {"script", script}}) : script);
  return exit_done;
}

void add_options(CLI::App& self, CompletionText& text) {
  add_target(self, "shell", text.shell, "The shell that is to complete", "bash|zsh|fish");
  add_json(self, text.json);
}

}  // namespace

std::vector<CompletedCommand> completed_commands(std::span<const Experiment> experiments) {
  std::vector<CompletedCommand> out;
  for (const Command& command : commands()) {
    CLI::App app;
    app.set_help_flag("-h,--help", "Print this");
    command.declare(app);
    CompletedCommand completed{command.name, command.summary, {}, {}};
    for (const CLI::Option* option : app.get_options()) {
      const CompletedValue value = value_of_form(option->get_option_text(), experiments);
      if (option->get_positional()) {
        completed.target = value;
      } else {
        completed.options.push_back({"--" + option->get_lnames().front(), option->get_description(),
                                     option->get_items_expected_max() > 0, value});
      }
    }
    out.push_back(std::move(completed));
  }
  return out;
}

Command completion_command() {
  return {"completion", "Print a script that completes commands, options and experiments in a shell",
          completion_examples, options(add_options, print_completion)};
}

}  // namespace thinwall
