#include <thinwall/experiments/results/citation.hpp>

#include <fmt/format.h>

#include <thinwall/experiments/text/escape.hpp>

namespace thinwall {

std::string bibtex(const RunRecord& run) {
  const std::string commit = run.build.commit.substr(0, 12) + (run.build.dirty ? " with uncommitted changes" : "");
  const std::string day = utc_text(run.finished).substr(0, 10);
  return fmt::format(
      "@software{{thinwall,\n"
      "  author  = {{{{The thinwall authors}}}},\n"
      "  title   = {{thinwall: continuous collision detection and tunneling research}},\n"
      "  version = {{{0}}},\n  date    = {{{1}}},\n  year    = {{{2}}}\n}}\n\n"
      "@misc{{thinwall_{3}_{4},\n"
      "  author = {{{{The thinwall authors}}}},\n"
      "  title  = {{{5}}},\n"
      "  note   = {{Result of the thinwall experiment {6}, run {4}, seed {7}, commit {8}}},\n"
      "  date   = {{{9}}},\n  year   = {{{10}}}\n}}\n",
      run.build.version, run.build.release_date, run.build.release_date.substr(0, 4), run.experiment, run_id(run),
      latex_escaped(run.question), latex_escaped(run.experiment), run.seed, commit, day, day.substr(0, 4));
}

}  // namespace thinwall
