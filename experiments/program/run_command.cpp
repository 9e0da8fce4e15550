#include <thinwall/experiments/program/run_command.hpp>

#include <limits>

#include <CLI/CLI.hpp>

#include <thinwall/experiments/program/plan_command.hpp>
#include <thinwall/experiments/program/report_command.hpp>
#include <thinwall/experiments/settings.hpp>

namespace thinwall {
namespace {

constexpr const char* run_examples = R"(  thinwall run thin_wall
  thinwall run my.toml --seed 7 --out results/mine
  thinwall run scene.toml --trace --plan full
  thinwall run thin_wall --list-cells
  thinwall run my.toml --shard 2/4 --out part2    then: thinwall merge part1 part2 part3 part4 --out whole
  mpirun -n 8 thinwall run my.toml
)";

Action declare_run(CLI::App& self) {
  const auto text = std::make_shared<RunText>();
  self.footer("A folder that holds the same run, unfinished, is continued; one that holds another run is refused.\n");
  add_target(self, "experiment", text->wish.target, "The name of an experiment, or a TOML file; of a scene too",
             "NAME|FILE.toml");
  add_text(self, "--trials", text->trials, "Overrides the number of trials in the configuration; of a scene, its steps",
           "N");
  add_text(self, "--shard", text->shard, "Compute the i-th of N shards alone, for thinwall merge", "i/N");
  add_flag(self, "--trace", text->wish.request.trace, "Of a scene: write trace.jsonl, for a viewer");
  add_benchmarks(self, text->benchmarks);
  add_run_options(self, *text);
  return [text](const Call& call) {
    if (text->wish.target.empty())
      throw UsageError("run: an experiment's name or a TOML file is missing; see thinwall list");
    return perform_run(parse_run(*text), call);
  };
}

}  // namespace

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
  RunOptions& options = wish.request.options;
  options.seed = parse_seed(text.seed);
  if (text.trials) options.trials = parse_positive("--trials", *text.trials, std::numeric_limits<std::int64_t>::max());
  options.threads = parse_threads(text.threads);
  wish.out = parse_folder(text.out);
  wish.figures = parse_figures(text.figures);
  if (text.shard) wish.shard = parse_shard(*text.shard);
  return wish;
}

Command run_command() {
  return {"run", "Run an experiment; leave its data, figures, tables and report in a folder", run_examples, declare_run,
          true};
}

}  // namespace thinwall
