#include <thinwall/experiments/program/command.hpp>

#include <algorithm>
#include <ostream>
#include <streambuf>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/json_reader.hpp>
#include <thinwall/experiments/lab/manifest.hpp>
#include <thinwall/experiments/lab/record.hpp>
#include <thinwall/experiments/lab/runner.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/lab/text.hpp>
#include <thinwall/experiments/program/run.hpp>

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
void refuse_extras(const CLI::App& app, std::vector<std::string> extras) {
  std::erase(extras, "--");  // after which nothing is an option: said, not left over
  if (extras.empty()) return;
  std::vector<std::string> names;
  const auto option = std::ranges::find_if(extras, [](const std::string& extra) { return extra.starts_with("-"); });
  const bool is_option = option != extras.end();
  const std::string unknown = is_option ? option->substr(0, option->find('=')) : extras.front();
  if (is_option) {
    for (const CLI::Option* known : app.get_options()) {
      if (!known->get_lnames().empty()) names.push_back("--" + known->get_lnames().front());
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
  std::vector<std::string> names;
  for (const Command& command : commands()) names.emplace_back(command.name);
  return listed(names, " or ");
}

Action print(std::string text) {
  return [text = std::move(text)](const Call& call) {
    call.out << text;
    return exit_done;
  };
}

constexpr int most_threads = 4096;

std::string list_json(std::span<const Experiment> experiments) {
  auto out = nlohmann::ordered_json::array();
  for (const Experiment& experiment : experiments)
    out.push_back({{"name", experiment.name}, {"question", experiment.question}});
  return json_line(out);
}

std::string list_text(std::span<const Experiment> experiments) {
  std::size_t longest = 0;
  for (const Experiment& experiment : experiments) longest = std::max(longest, experiment.name.size());
  std::string out;
  for (const Experiment& experiment : experiments) {
    out += fmt::format("{:<{}}  {}\n", experiment.name, longest, experiment.question);
  }
  return out;
}

int list(const bool& json, const Call& call) {
  call.out << (json ? list_json(call.experiments) : list_text(call.experiments));
  return exit_done;
}

/// Output that drives no terminal, whatever text it is given: a name, a manifest or a file may hold escape sequences. Hands letters
/// on to another stream. Of control characters the end of a line and the tab pass; others are spelled out, `\x1b` or, where JSON may
/// hold them, `\u009b`, which stays JSON and means the same.
class HarmlessBuffer final : public std::streambuf {
 public:
  explicit HarmlessBuffer(std::ostream& to) : out_(to) {}

 private:
  int_type overflow(int_type value) override {
    if (traits_type::eq_int_type(value, traits_type::eof())) return traits_type::not_eof(value);
    const char letter = traits_type::to_char_type(value);
    const auto code = static_cast<unsigned char>(letter);
    const bool after_c2 = std::exchange(after_c2_, code == 0xc2);
    const bool is_c1 = after_c2 && 0x80 <= code && code < 0xa0;
    if (after_c2 && !is_c1) out_.put('\xc2');
    if (is_c1 || code == 0x7f) {
      out_ << fmt::format("\\u{:04x}", code);
    } else if (code < 0x20 && letter != '\n' && letter != '\t') {
      out_ << fmt::format("\\x{:02x}", code);
    } else if (!after_c2_) {
      out_.put(letter);
    }
    return out_ ? value : traits_type::eof();
  }

  int sync() override {
    if (std::exchange(after_c2_, false)) out_.put('\xc2');
    return out_.flush() ? 0 : -1;
  }

  std::ostream& out_;
  bool after_c2_ = false;  // the first byte of U+0080 to U+00BF in UTF-8 was held back
};

constexpr const char* list_examples = R"(  thinwall list
  thinwall list --json
)";

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
    return print(fmt::format("Examples:\n{}\n{}", commands()[index()].examples, chosen().help("thinwall")));
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

void add_flag(CLI::App& command, const std::string& name, bool& flag, const std::string& meaning) {
  command.add_flag(name, flag, meaning)->disable_flag_override();
}

void add_text(CLI::App& command, const std::string& name, OptionText& text, const std::string& meaning,
              const std::string& form) {
  command.add_option(name, text, meaning)->option_text(form);
}

void add_json(CLI::App& command, bool& json) { add_flag(command, "--json", json, "Print one JSON value on stdout"); }

void add_threads(CLI::App& command, OptionText& threads) {
  add_text(command, "--threads", threads, "Threads to compute with (default: all cores)", "N");
}

void add_out(CLI::App& command, OptionText& out) {
  add_text(command, "--out", out, "The result folder (default: results/NAME, of compare results/compare_NAME)", "DIR");
}

void add_benchmarks(CLI::App& command, OptionText& folder) {
  add_text(command, "--benchmarks", folder, "Of speed: the folder of the programs to start (default: beside this one)",
           "DIR");
}

void add_target(CLI::App& command, const std::string& name, std::string& target, const std::string& meaning,
                const std::string& form) {
  command.add_option(name, target, meaning)->option_text(form);
}

int parse_threads(const OptionText& text) {
  return text ? static_cast<int>(parse_positive("--threads", *text, most_threads)) : default_threads();
}

std::string parse_folder(const OptionText& text) {
  if (text && text->empty()) throw UsageError("--out: '' is not allowed; a folder");
  return text.value_or("");
}

std::int64_t parse_positive(std::string_view option, const std::string& text, std::int64_t most) {
  const auto count = parse_count(text);
  if (!count || *count < 1 || *count > most) {
    throw UsageError(fmt::format("{}: '{}' is not allowed; a whole number from 1 to {}", option, one_line(text), most));
  }
  return *count;
}

std::string parse_choice(std::string_view option, const OptionText& text, std::span<const std::string_view> allowed) {
  if (!text) return "";
  if (std::ranges::find(allowed, *text) == allowed.end()) {
    throw UsageError(
        fmt::format("{}: '{}' is not allowed; {}", option, one_line(*text), spelling_hint(*text, allowed)));
  }
  return *text;
}

std::string summary_text(const std::string& summary) {
  return summary.empty() ? "" : summary + (summary.ends_with('\n') ? "\n" : "\n\n");
}

std::span<const Command> commands() {
  static const std::vector<Command> all = flat<std::vector<Command>>(
      {{{"list", "Print every experiment and its question", list_examples, options(add_json, list)}},
       run_commands(),
       thin_wall_commands(),
       {validate_command()},
       result_commands(),
       {completion_command()}});
  return all;
}

int run_program(const std::vector<std::string>& argv, std::span<const Experiment> experiments, std::ostream& to_stdout,
                std::ostream& to_stderr) {
  HarmlessBuffer harmless_out(to_stdout), harmless_err(to_stderr);
  std::ostream out(&harmless_out), err(&harmless_err), nowhere(nullptr);
  const Launch launch = launch_of_this_process();
  const bool quiet = launch.rank > 0;  // of the ranks that mpirun started, one speaks, but of what went wrong
  const std::string who = quiet ? fmt::format("rank {} of {}: ", launch.rank, launch.count) : "";
  Action action;
  try {
    action = parse_command_line(argv);
  } catch (const UsageError& error) {  // every rank has these words
    (quiet ? nowhere : err) << error.what() << std::endl;
    return exit_bad_input;
  }
  try {
    const int status = action({experiments, argv, quiet ? nowhere : out, quiet ? nowhere : err});
    if (out.flush()) return status;
    err << who << "failed: stdout cannot be written" << std::endl;  // a full disk, where it goes to a file
    return exit_failed;
  } catch (const UsageError& error) {
    err << who << error.what() << std::endl;
    return exit_bad_input;
  } catch (const std::exception& error) {
    err << who << "failed: " << one_line(error.what()) << std::endl;
    return exit_failed;
  }
}

}  // namespace thinwall
