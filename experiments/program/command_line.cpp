#include <thinwall/experiments/program/command.hpp>

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <ostream>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/files.hpp>
#include <thinwall/experiments/lab/json_reader.hpp>
#include <thinwall/experiments/lab/manifest.hpp>
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

Action declare_list(CLI::App& self) {
  const auto json = std::make_shared<bool>(false);
  add_json(self, *json);
  return [json](const Call& call) {
    call.out << (*json ? list_json(call.experiments) : list_text(call.experiments));
    return exit_done;
  };
}

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
  add_text(command, "--out", out, "The result folder (default: results/NAME)", "DIR");
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

void write_own_file(std::string_view option, const std::filesystem::path& file, std::string_view text,
                    std::string_view command) {
  const auto refuse = [&](const std::string& why) {
    throw UsageError(fmt::format("{} {}: {}", option, one_line(file.string()), why));
  };
  if (file.empty()) throw UsageError(fmt::format("{}: '' is not allowed; a file is needed", option));
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (std::filesystem::is_directory(status)) refuse("is a folder; a file is needed");
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) refuse("is not a file");
  if (std::filesystem::exists(status)) {
    std::string first;
    std::ifstream in(file);
    std::getline(in, first);
    if (first != text.substr(0, text.find('\n')))
      refuse(fmt::format("is there already, and not from {}; another name is needed", command));
  }
  const std::filesystem::path fresh = file.string() + ".new";
  if (std::filesystem::exists(fresh, error)) refuse("needs the name " + one_line(fresh.string()) + ", which is taken");
  try {
    write_file(fresh, text);
    std::filesystem::rename(fresh, file);
  } catch (const std::system_error& why) {
    std::filesystem::remove(fresh, error);
    refuse("cannot be written: " + why.code().message());
  }
}

std::streambuf::int_type HarmlessOutput::Buffer::overflow(int_type value) {
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

int HarmlessOutput::Buffer::sync() {
  if (std::exchange(after_c2_, false)) out_.put('\xc2');
  return out_.flush() ? 0 : -1;
}

std::span<const Command> commands() {
  static const std::array all = {
      list_command(),        //
      run_command(),         //
      compare_command(),     //
      plan_command(),        //
      advise_command(),      //
      explore_command(),     //
      validate_command(),    //
      merge_command(),       //
      report_command(),      //
      reproduce_command(),   //
      cite_command(),        //
      completion_command(),  //
  };
  return all;
}

Command list_command() { return {"list", "Print every experiment and its question", list_examples, declare_list}; }

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
