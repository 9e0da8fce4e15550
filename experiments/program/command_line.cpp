#include <thinwall/experiments/program/command_line.hpp>

#include <ostream>
#include <string_view>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <thinwall/experiments/program/exit_codes.hpp>
#include <thinwall/experiments/results/record.hpp>
#include <thinwall/experiments/run/ranks.hpp>
#include <thinwall/experiments/settings.hpp>
#include <thinwall/experiments/text/escape.hpp>
#include <thinwall/experiments/text/spelling.hpp>

namespace thinwall {
namespace {

constexpr const char* root_help = R"(thinwall runs experiments on tunneling and continuous collision detection.

Examples:
  thinwall list                               what there is to run
  thinwall run thin_wall                      the headline experiment, into results/thin_wall
  thinwall run thin_wall --dry-run            how large it is and how long it takes; writes nothing
  thinwall run my.toml --out results/mine     your own configuration, laid over the defaults
  thinwall run thin_wall --trials 1e6 --json  one JSON object on stdout, for scripts
  thinwall run scene.toml --trace             a scene of your own, step by step; experiments/scenes/ has some
  thinwall compare scene.toml                 discrete or swept, on that scene?
  thinwall plan scene.toml                    what that scene does not need, and why
  thinwall advise --help                      which method will do for my speed, wall and step, and costs least?
  thinwall reproduce results/thin_wall        does it come out the same again?
  thinwall validate ccd-queries               published queries against exact arithmetic
)";

constexpr const char* exit_codes = R"(Exit codes:
  0    done
  1    a run failed, or its self-test did; reproduce found a difference, report --check a fault, validate a wrong verdict
  2    bad input: one line on stderr says where and what is allowed
  130  interrupted: what was finished is kept, and the line that continues is printed

Results and --json go to stdout, notes and progress to stderr; the progress bar only to a terminal that is not dumb.
Nothing is colored, with NO_COLOR or without.
)";

/// Names the first word that nothing takes, and the nearest one that something would.
void refuse_extras(const CLI::App& app, const std::vector<std::string>& extras) {
  if (extras.empty()) return;
  std::vector<std::string> names;
  std::string unknown = extras.front();
  for (const std::string& extra : extras) {
    if (extra.starts_with("-")) {
      unknown = extra.substr(0, extra.find('='));
      break;
    }
  }
  const bool is_option = unknown.starts_with("-");
  if (is_option) {
    for (const CLI::Option* option : app.get_options()) {
      if (!option->get_lnames().empty()) names.push_back("--" + option->get_lnames().front());
    }
  } else {
    for (const CLI::App* command : app.get_subcommands(nullptr)) names.push_back(command->get_name());
  }
  const std::string word = one_line(unknown);
  if (names.empty()) throw UsageError(fmt::format("'{}': one word too many after '{}'", word, app.get_name()));
  const std::vector<std::string_view> views(names.begin(), names.end());
  throw UsageError(
      fmt::format("'{}': unknown {}; {}", word, is_option ? "option" : "command", spelling_hint(unknown, views)));
}

std::string version_text() {
  const BuildRecord build = this_build();
  return fmt::format("thinwall {} (commit {}{}, {}, {})\n", build.version, build.commit.substr(0, 12),
                     build.dirty ? " with uncommitted changes" : "", build.compiler, build.build_type);
}

/// `list, run or plan`.
std::string every_name() {
  std::string out;
  for (const Command& command : commands()) {
    const bool last = &command == &commands().back();
    out += fmt::format("{}{}", out.empty() ? "" : last ? " or " : ", ", command.name);
  }
  return out;
}

Action print(std::string text) {
  return [text = std::move(text)](const Call& call) {
    call.out << text;
    return exit_done;
  };
}

}  // namespace

Action parse_command_line(const std::vector<std::string>& argv) {
  CLI::App app(root_help, "thinwall");
  app.footer(exit_codes);
  app.allow_extras();
  app.require_subcommand(0, 1);  // so that the second word of `run plan` is an experiment
  app.set_help_flag("-h,--help", "Print this");
  app.set_version_flag("--version", version_text(), "Print the version, the commit and the compiler");
  std::vector<Action> actions;
  for (const Command& command : commands()) {
    CLI::App& self = *app.add_subcommand(command.name, command.summary);
    actions.push_back(command.declare(self));
    self.allow_extras();
  }

  const auto chosen = [&]() -> CLI::App& {
    const auto parsed = app.get_subcommands();
    return parsed.empty() ? app : *parsed.front();
  };
  const auto index = [&] {
    std::size_t i = 0;
    while (commands()[i].name != chosen().get_name()) ++i;
    return i;
  };
  try {
    std::vector<std::string> words(argv.rbegin(), argv.rend() - (argv.empty() ? 0 : 1));
    app.parse(words);
  } catch (const CLI::CallForHelp&) {
    if (&chosen() == &app) return print(app.help());
    const std::string examples = commands()[index()].examples;
    return print((examples.empty() ? "" : "Examples:\n" + examples + "\n") + chosen().help("thinwall"));
  } catch (const CLI::CallForVersion&) {
    return print(version_text());
  } catch (const CLI::ArgumentMismatch& error) {
    const std::string what = one_line(error.what()), option = what.substr(0, what.find_first_of(": "));
    const bool is_flag = what.find("flag override") != std::string::npos;
    throw UsageError((is_flag ? "--" + option + ": takes no value" : option + ": exactly one value is needed") +
                     "; see thinwall --help");
  } catch (const CLI::ParseError& error) {
    throw UsageError(one_line(error.what()) + "; see thinwall --help");
  }
  refuse_extras(chosen(), chosen().remaining());
  refuse_extras(app, app.remaining());
  if (&chosen() == &app) throw UsageError(fmt::format("a command is missing; {}, see thinwall --help", every_name()));
  if (launch_of_this_process().rank > 0 && !commands()[index()].by_all_ranks) return print("");
  return actions[index()];
}

}  // namespace thinwall
