#include <thinwall/experiments/program/run.hpp>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <ostream>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <thinwall/experiments/compare/compare.hpp>
#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/json_reader.hpp>
#include <thinwall/experiments/lab/manifest.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/lab/text.hpp>
#include <thinwall/experiments/program/command.hpp>
#include <thinwall/experiments/scenes/scene.hpp>
#include <thinwall/experiments/world/world.hpp>

namespace thinwall {

namespace {

namespace fs = std::filesystem;

const Experiment* find_experiment(std::span<const Experiment> experiments, std::string_view name) {
  const auto found = std::ranges::find(experiments, name, &Experiment::name);
  return found == experiments.end() ? nullptr : &*found;
}

bool is_scene(const Experiment& experiment) { return experiment.name == "scene" || experiment.name == "compare"; }

/// What the file is: the value of its key `experiment`; without one, a scene if it has the key `scene`.
std::string experiment_named_in(const std::string& text, const std::string& file,
                                std::span<const Experiment> experiments) {
  constexpr std::string_view key = "experiment";
  const std::vector<std::string_view> names = names_of(experiments);
  const Settings settings(text, file, "");
  if (settings.has(key)) return settings.choice(key, names);
  if (settings.has("scene")) return "scene";
  throw UsageError(
      fmt::format("{}:1: key '{}': missing, and so is 'scene': one of them says what the file is, as in {} = \"{}\" or "
                  "scene = \"my_scene\"; {}",
                  one_line(file), key, key, names.front(), spelling_hint("", names)));
}

UsageError not_a_scene(const std::string& file, std::string_view experiment) {
  return UsageError(
      fmt::format("{}: is a configuration of {}, not a scene; thinwall run it", one_line(file), experiment));
}

/// Every experiment that a file may configure.
std::vector<Experiment> with_scenes(std::span<const Experiment> experiments) {
  std::vector<Experiment> all(experiments.begin(), experiments.end());
  all.push_back(scene_experiment());
  all.push_back(compare_experiment());
  return all;
}

/// A configuration may come from anywhere: it names no programs to start. The command line may.
void choose_benchmarks(Settings& settings, const std::string& folder) {
  constexpr std::string_view key = "benchmarks";
  if (!settings.has(key)) {
    if (!folder.empty()) throw UsageError("--benchmarks: only speed starts other programs");
  } else if (!folder.empty()) {
    settings.assign(key, folder);
  } else if (!settings.text(key).empty()) {
    settings.complain(key, "\"\"; to start the programs of that folder, say so: --benchmarks DIR");
  }
}

ConfiguredRun configured(const Experiment& chosen, Settings& settings, const RunOptions& options) {
  ConfiguredRun out{.name = std::string(chosen.name), .run = chosen.configure(settings, options), .record = {}};
  out.record.experiment = chosen.name;
  out.record.question = chosen.question;
  out.record.config = settings.resolved_json();
  out.record.default_config = out.record.config == Settings("", "", chosen.default_toml).resolved_json();
  out.record.seed = options.seed;
  out.record.trials = options.trials;
  out.record.threads = options.threads;
  if (is_scene(chosen)) {
    out.name = (chosen.name == "compare" ? "compare_" : "") + settings.text("scene");
    if (chosen.name == "scene") out.record.question = settings.text("question");
  }
  return out;
}

/// The text of a TOML file. Throws UsageError.
std::string read_config(const std::string& file) {
  constexpr std::uintmax_t most = 16 << 20;  // [byte]; no configuration is as long
  const std::string name = one_line(file);
  std::error_code error;
  const auto status = fs::status(file, error);
  if (!fs::status_known(status)) throw UsageError(name + ": cannot be read: " + error.message());
  if (!fs::exists(status))
    throw UsageError(name + ": there is no such file; the TOML file of an experiment or a scene is needed");
  if (!fs::is_regular_file(status)) throw UsageError(name + ": is not a file; a TOML file is needed");
  if (fs::file_size(file, error) > most) throw UsageError(name + ": is too long for a configuration; 16 MiB at most");
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (!in) throw UsageError(name + ": cannot be read: " + std::generic_category().message(errno));
  return text;
}

}  // namespace

ConfiguredRun configure_again(const RunIdentity& identity, int threads, std::span<const Experiment> experiments) {
  const std::vector<Experiment> all = with_scenes(experiments);
  const Experiment* const chosen = find_experiment(all, identity.experiment);
  if (!chosen) throw UsageError(fmt::format("'{}': unknown experiment", one_line(identity.experiment)));
  Settings settings(config_toml(identity), "configuration", chosen->default_toml);
  settings.reject_unknown_keys();
  ConfiguredRun out = configured(*chosen, settings, {identity.seed, identity.trials, threads});
  // JSON may spell a number otherwise
  if (const std::string difference = identity_difference(out.record, identity); !difference.empty()) {
    throw UsageError(fmt::format("the configuration reads back as another one ({})", difference));
  }
  return out;
}

bool looks_like_a_file(std::string_view target) {
  return target.ends_with(".toml") || target.find('/') != std::string_view::npos;
}

ConfiguredRun configure_run(const std::string& target, const RunRequest& request,
                            std::span<const Experiment> experiments) {
  const std::vector<Experiment> all = with_scenes(experiments);
  const Experiment* chosen = request.compare || request.text ? nullptr : find_experiment(experiments, target);
  std::string text, file = std::string(target) + " (built-in)";
  if (!chosen) {
    std::error_code none;
    const bool is_path = request.text || looks_like_a_file(target) || fs::exists(target, none);
    if (!is_path && !request.compare) {
      throw UsageError(fmt::format("'{}': unknown experiment; {}; or name a TOML file", one_line(target),
                                   spelling_hint(target, names_of(experiments))));
    }
    file = target;
    text = request.text ? *request.text : read_config(file);
    const std::string named = experiment_named_in(text, file, all);
    chosen = find_experiment(all, request.compare && named == "scene" ? "compare" : named);
  }
  if (request.compare && chosen->name != "compare") throw not_a_scene(file, chosen->name);
  if (!is_scene(*chosen) && request.trace) throw UsageError("--trace: only a scene has a trace");
  if (!is_scene(*chosen) && !request.plan_kind.empty()) throw UsageError("--plan: only a scene has a plan");

  Settings settings(text, file, chosen->default_toml);
  settings.reject_unknown_keys();
  if (is_scene(*chosen)) settings.assign("experiment", std::string(chosen->name));
  if (request.trace) settings.assign_flag("trace", true);
  if (!request.plan_kind.empty()) settings.assign("plan", request.plan_kind);
  choose_benchmarks(settings, request.benchmarks);
  return configured(*chosen, settings, request.options);
}

namespace {

// Options that run, compare and plan share.

/// Options of a run as they were typed.
struct RunText {
  RunWish wish;
  OptionText out, seed, trials, threads, plan, figures, shard, benchmarks;
};

void add_scene_target(CLI::App& self, std::string& target) {
  add_target(self, "scene", target, "The TOML file of a scene", "FILE.toml");
}

void add_plan_kind(CLI::App& self, OptionText& plan) {
  add_text(self, "--plan", plan, "Of a scene: full omits nothing; the outcome is the same to the bit", "lean|full");
}

void require_scene_target(const char* command, const std::string& target) {
  if (!target.empty()) return;
  throw UsageError(fmt::format("{0}: the TOML file of a scene is missing; see thinwall {0} --help", command));
}

std::string parse_plan_kind(const OptionText& plan) {
  constexpr std::array<std::string_view, 2> kinds = {"lean", "full"};
  return parse_choice("--plan", plan, kinds);
}

void add_seed(CLI::App& command, OptionText& seed) {
  add_text(command, "--seed", seed, "Chooses the random numbers (default: 0)", "N");
}

std::uint64_t parse_seed(const OptionText& text) {
  if (!text) return 0;
  const auto seed = parsed<std::uint64_t>(*text);
  if (!seed) {
    throw UsageError(fmt::format("--seed: '{}' is not allowed; a whole number from 0 to {}", one_line(*text),
                                 std::numeric_limits<std::uint64_t>::max()));
  }
  return *seed;
}

void add_run_options(CLI::App& self, RunText& text) {
  add_out(self, text.out);
  add_threads(self, text.threads);
  add_flag(self, "--dry-run", text.wish.dry_run, "Print the size and an estimate of the time, and write nothing");
  add_flag(self, "--list-cells", text.wish.list_cells, "Print the key and the trials of every unit, and write nothing");
  add_seed(self, text.seed);
  add_plan_kind(self, text.plan);
  add_figures(self, text.figures);
  add_json(self, text.wish.json);
}

RunWish parse_run(const RunText& text) {
  RunWish wish = text.wish;
  wish.request.plan_kind = parse_plan_kind(text.plan);
  wish.request.benchmarks = text.benchmarks.value_or("");
  RunOptions& chosen = wish.request.options;
  chosen.seed = parse_seed(text.seed);
  if (text.trials) chosen.trials = parse_positive("--trials", *text.trials, std::numeric_limits<std::int64_t>::max());
  chosen.threads = parse_threads(text.threads);
  wish.out = parse_folder(text.out);
  wish.figures = parse_figures(text.figures);
  if (text.shard) wish.shard = parse_shard(*text.shard);
  if (wish.shard && !wish.figures.empty())
    throw UsageError("--figures: a shard has none; draw the whole: thinwall report RESULT --figures pdf,tex");
  return wish;
}

constexpr const char* run_examples = R"(  thinwall run thin_wall
  thinwall run my.toml --seed 7 --out results/mine
  thinwall run scene.toml --trace --plan full
  thinwall run thin_wall --list-cells
  thinwall run my.toml --shard 2/4 --out part2    then: thinwall merge part1 part2 part3 part4 --out whole
  mpirun -n 8 thinwall run my.toml
)";

void add_run(CLI::App& self, RunText& text) {
  self.footer("A folder that holds the same run, unfinished, is continued; one that holds another run is refused.\n");
  add_target(self, "experiment", text.wish.target, "The name of an experiment, or a TOML file; of a scene too",
             "NAME|FILE.toml");
  add_text(self, "--trials", text.trials, "Overrides the number of trials in the configuration; of a scene, its steps",
           "N");
  add_text(self, "--shard", text.shard, "Compute the i-th of N shards alone, for thinwall merge", "i/N");
  add_flag(self, "--trace", text.wish.request.trace, "Of a scene: write trace.jsonl, for a viewer");
  add_benchmarks(self, text.benchmarks);
  add_run_options(self, text);
}

int run(const RunText& text, const Call& call) {
  if (text.wish.target.empty())
    throw UsageError("run: an experiment's name or a TOML file is missing; see thinwall list");
  return perform_run(parse_run(text), call);
}

constexpr const char* compare_examples = R"(  thinwall compare experiments/scenes/bullet_against_bullet.toml
  thinwall compare my_scene.toml --out results/mine --threads 1
)";

constexpr const char* compare_footer =
    R"(The scene is stepped under every time policy and step that its [compare] names, and once more by events, with steps
finer than the finest: the exact run that the others are held against. A folder is continued as by `run`.
)";

void add_compare(CLI::App& self, RunText& text) {
  text.wish.request.compare = true;
  self.footer(compare_footer);
  add_scene_target(self, text.wish.target);
  add_run_options(self, text);
}

int compare(const RunText& text, const Call& call) {
  require_scene_target("compare", text.wish.target);
  return perform_run(parse_run(text), call);
}

std::string json_reply(const Scene& scene, const Plan& plan) {
  using nlohmann::ordered_json;
  ordered_json reply = {{"scene", scene.name},
                        {"bodies", scene.bodies.size()},
                        {"full", plan.full},
                        {"broad_phase", plan.broad_phase},
                        {"lines", ordered_json::array()}};
  for (const PlanLine& line : plan.lines)
    reply["lines"].push_back({{"what", line.what}, {"omitted", line.omitted}, {"why", line.why}});
  return json_line(reply);
}

struct PlanText {
  std::string target;
  OptionText seed, plan;
  bool json = false;
};

int print_plan(const PlanText& text, const Call& call) {
  require_scene_target("plan", text.target);
  const std::string kind = parse_plan_kind(text.plan);
  const std::uint64_t seed = parse_seed(text.seed);
  const std::string config = read_config(text.target);
  const std::vector<Experiment> all = with_scenes(call.experiments);
  const Experiment& named = *find_experiment(all, experiment_named_in(config, text.target, all));
  if (!is_scene(named)) throw not_a_scene(text.target, named.name);
  Settings settings(config, text.target, scene_experiment().default_toml);
  settings.reject_unknown_keys();
  settings.require("scene", "its name; without one the file is not a scene");
  if (!kind.empty()) settings.assign("plan", kind);
  const Scene scene = read_scene(settings, {.seed = seed, .trials = {}});
  const Plan made = plan(scene.bodies, scene.options);
  call.out << (text.json ? json_reply(scene, made) : to_text(made));
  return exit_done;
}

constexpr const char* plan_examples = R"(  thinwall plan experiments/scenes/rain.toml
  thinwall plan my_scene.toml --json
)";

void add_plan(CLI::App& self, PlanText& text) {
  add_scene_target(self, text.target);
  add_seed(self, text.seed);
  add_plan_kind(self, text.plan);
  add_json(self, text.json);
}

}  // namespace

std::vector<Command> run_commands() {
  return {{"run", "Run an experiment; leave its data, figures, tables and report in a folder", run_examples,
           options(add_run, run), true},
          {"compare", "Step a scene under every time policy, and hold each against the exact run", compare_examples,
           options(add_compare, compare), true},
          {"plan", "Print what a scene does not need, and why", plan_examples, options(add_plan, print_plan)}};
}

}  // namespace thinwall
