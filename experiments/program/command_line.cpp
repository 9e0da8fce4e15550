#include <thinwall/experiments/program/command_line.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <string_view>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <thinwall/experiments/results/record.hpp>
#include <thinwall/experiments/run/runner.hpp>
#include <thinwall/experiments/settings.hpp>
#include <thinwall/experiments/text/escape.hpp>
#include <thinwall/experiments/text/numbers.hpp>
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
  thinwall validate ccd-queries               published queries against exact arithmetic
)";

constexpr const char* run_examples = R"(Examples:
  thinwall run thin_wall
  thinwall run my.toml --seed 7 --out results/mine
  thinwall run scene.toml --trace --plan full

)";

constexpr const char* compare_examples = R"(Examples:
  thinwall compare experiments/scenes/bullet_against_bullet.toml
  thinwall compare my_scene.toml --out results/mine --threads 1

)";

constexpr const char* plan_examples = R"(Examples:
  thinwall plan experiments/scenes/rain.toml
  thinwall plan my_scene.toml --json

)";

constexpr const char* compare_footer =
    R"(The scene is stepped under every time policy and step that its [compare] names, and once more by events, with steps
finer than the finest: the exact run that the others are held against. A folder is continued as by `run`.
)";

constexpr const char* validate_examples = R"(Examples:
  thinwall validate ccd-queries                 every CSV file below the folder
  thinwall validate ccd-queries/unit-tests --json

)";

constexpr const char* validate_footer =
    R"(A file has 8 rows a query and lies in a folder named vertex-face or edge-edge. Queries whose two primitives translate
rigidly are checked, the others counted. Exit code 1: a verdict is wrong.
)";

constexpr const char* exit_codes = R"(Exit codes:
  0    done
  1    a run failed, or its self-test did; or validate found a wrong verdict
  2    bad input: one line on stderr says where and what is allowed
  130  interrupted: what was finished is kept, and the line that continues is printed

Results and --json go to stdout, notes and progress to stderr; the progress bar only to a terminal that is not dumb.
Nothing is colored, with NO_COLOR or without.
)";

constexpr int most_threads = 4096;

std::uint64_t parse_seed(const std::string& text) {
  std::uint64_t seed = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (error != std::errc{} || stop != text.data() + text.size()) {
    throw UsageError(fmt::format("--seed: '{}' is not allowed; a whole number from 0 to {}", one_line(text),
                                 std::numeric_limits<std::uint64_t>::max()));
  }
  return seed;
}

std::int64_t parse_positive(std::string_view option, const std::string& text, std::int64_t most) {
  const auto count = parse_count(text);
  if (!count || *count < 1 || *count > most) {
    throw UsageError(fmt::format("{}: '{}' is not allowed; a whole number from 1 to {}", option, one_line(text), most));
  }
  return *count;
}

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

}  // namespace

CommandLine parse_command_line(std::vector<std::string> argv) {
  CommandLine out;
  out.argv = argv;
  std::string seed = "0", trials, threads;
  constexpr std::array<std::string_view, 2> plans = {"lean", "full"};

  CLI::App app(root_help, "thinwall");
  app.footer(exit_codes);
  app.allow_extras();
  app.require_subcommand(0, 1);  // so that the second word of `run plan` is an experiment
  app.set_help_flag("-h,--help", "Print this");
  app.set_version_flag("--version", version_text(), "Print the version, the commit and the compiler");

  CLI::App* const list = app.add_subcommand("list", "Print every experiment and its question");
  list->add_flag("--json", out.json, "Print a JSON array on stdout")->disable_flag_override();

  CLI::App* const run =
      app.add_subcommand("run", "Run an experiment; leave its data, figures, tables and report in a folder");
  run->footer("A folder that holds the same run, unfinished, is continued; one that holds another run is refused.\n");
  run->add_option("experiment", out.target, "The name of an experiment, or a TOML file; of a scene too")
      ->option_text("NAME|FILE.toml");
  run->add_option("--trials", trials, "Overrides the number of trials in the configuration; of a scene, its steps")
      ->option_text("N");
  run->add_flag("--trace", out.trace, "Of a scene: write trace.jsonl, for a viewer")->disable_flag_override();

  CLI::App* const compare =
      app.add_subcommand("compare", "Step a scene under every time policy, and hold each against the exact run");
  compare->footer(compare_footer);
  compare->add_option("scene", out.target, "The TOML file of a scene")->option_text("FILE.toml");
  for (CLI::App* command : {run, compare}) {
    command->add_option("--out", out.out, "The result folder (default: results/NAME)")->option_text("DIR");
    command->add_option("--threads", threads, "Threads to compute with (default: all cores)")->option_text("N");
    command->add_flag("--dry-run", out.dry_run, "Print the size and an estimate of the time, and write nothing")
        ->disable_flag_override();
  }

  CLI::App* const plan = app.add_subcommand("plan", "Print what a scene does not need, and why");
  plan->add_option("scene", out.target, "The TOML file of a scene")->option_text("FILE.toml");
  for (CLI::App* command : {run, compare, plan}) {
    command->add_option("--seed", seed, "Chooses the random numbers (default: 0)")->option_text("N");
    command->add_option("--plan", out.plan_kind, "Of a scene: full omits nothing; the outcome is the same to the bit")
        ->option_text("lean|full");
    command->add_flag("--json", out.json, "Print one JSON object on stdout")->disable_flag_override();
  }

  CLI::App* const validate =
      app.add_subcommand("validate", "Check the verdicts of published queries against exact arithmetic");
  validate->footer(validate_footer);
  validate->add_option("folder", out.target, "Where the CSV files of queries are")->option_text("DIR");
  validate->add_flag("--json", out.json, "Print one JSON object on stdout")->disable_flag_override();
  for (CLI::App* command : {list, run, compare, plan, validate}) command->allow_extras();

  const auto chosen = [&]() -> CLI::App& {
    const auto parsed = app.get_subcommands();
    return parsed.empty() ? app : *parsed.front();
  };
  try {
    std::vector<std::string> words(argv.rbegin(), argv.rend() - (argv.empty() ? 0 : 1));
    app.parse(words);
  } catch (const CLI::CallForHelp&) {
    const CLI::App& command = chosen();
    out.text = &command == run        ? run_examples + run->help("thinwall")
               : &command == compare  ? compare_examples + compare->help("thinwall")
               : &command == plan     ? plan_examples + plan->help("thinwall")
               : &command == validate ? validate_examples + validate->help("thinwall")
                                      : command.help();
    return out;
  } catch (const CLI::CallForVersion&) {
    out.text = version_text();
    return out;
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
  if (&chosen() == &app)
    throw UsageError("a command is missing; list, run, compare, plan or validate, see thinwall --help");
  out.command = run->parsed()        ? Command::run
                : compare->parsed()  ? Command::compare
                : plan->parsed()     ? Command::plan
                : validate->parsed() ? Command::validate
                                     : Command::list;
  if (validate->parsed() && out.target.empty()) {
    throw UsageError("validate: a folder of published queries is missing; see thinwall validate --help");
  }
  if (list->parsed() || validate->parsed()) return out;

  if (run->parsed() && out.target.empty())
    throw UsageError("run: an experiment's name or a TOML file is missing; see thinwall list");
  if (out.target.empty()) {
    throw UsageError(
        fmt::format("{0}: the TOML file of a scene is missing; see thinwall {0} --help", chosen().get_name()));
  }
  if (chosen().count("--plan") > 0 && std::ranges::find(plans, out.plan_kind) == plans.end()) {
    throw UsageError(
        fmt::format("--plan: '{}' is not allowed; {}", one_line(out.plan_kind), spelling_hint(out.plan_kind, plans)));
  }
  out.seed = parse_seed(seed);
  out.threads = default_threads();
  if (plan->parsed()) return out;
  if (run->count("--trials") > 0)
    out.trials = parse_positive("--trials", trials, std::numeric_limits<std::int64_t>::max());
  if (chosen().count("--threads") > 0)
    out.threads = static_cast<int>(parse_positive("--threads", threads, most_threads));
  if (chosen().count("--out") > 0 && out.out.empty()) throw UsageError("--out: '' is not allowed; a folder");
  return out;
}

}  // namespace thinwall
