#pragma once
/// `thinwall run`, and what `thinwall compare` shares with it.

#include <memory>

#include <thinwall/experiments/program/command.hpp>
#include <thinwall/experiments/program/options.hpp>
#include <thinwall/experiments/program/perform_run.hpp>

namespace thinwall {

/// Options of a run as they were typed.
struct RunText {
  RunWish wish;
  OptionText out, seed, trials, threads, plan, figures, shard, benchmarks;
};

/// --out, --threads, --seed, --plan, --figures, --dry-run and --json.
void add_run_options(CLI::App& self, RunText& text);

/// What the text means. Throws UsageError.
RunWish parse_run(const RunText& text);

Command run_command();

}  // namespace thinwall
