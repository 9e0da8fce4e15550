#include <thinwall/experiments/program/perform_run.hpp>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <numeric>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

#include <thinwall/experiments/program/exit_codes.hpp>
#include <thinwall/experiments/program/json_reply.hpp>
#include <thinwall/experiments/program/progress_bar.hpp>
#include <thinwall/experiments/results/results.hpp>
#include <thinwall/experiments/run/runner.hpp>
#include <thinwall/experiments/run/stop_signal.hpp>
#include <thinwall/experiments/text/escape.hpp>
#include <thinwall/experiments/text/numbers.hpp>

namespace thinwall {
namespace {

using Clock = std::chrono::system_clock;

std::string plural(std::int64_t count, const std::string& noun) {
  return grouped_text(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string size_text(const RunRecord& run) {
  return fmt::format("{}: {}, {} on {}", run.experiment, plural(static_cast<std::int64_t>(run.units), "unit"),
                     plural(run.total_trials, "trial"), plural(run.threads, "thread"));
}

int dry_run(const RunWish& wish, const RunRecord& run, std::span<const Unit> units, std::ostream& out) {
  const double seconds = estimate_seconds(units, run.threads);
  if (wish.json) {
    out << dry_run_reply(run, wish.out, seconds);
  } else {
    out << fmt::format("{}\nabout {}; results would go to {}\n", size_text(run), duration_text(seconds), wish.out);
  }
  return exit_done;
}

int list_cells(const RunWish& wish, const RunRecord& run, std::span<const Unit> units, std::ostream& out) {
  if (wish.json) {
    out << list_cells_reply(run, wish.out, units);
  } else {
    for (const Unit& unit : units) out << fmt::format("{:>12}  {}\n", unit.trials, one_line(unit.key));
  }
  return exit_done;
}

int reply(const RunWish& wish, const RunRecord& run, const Outcome& outcome, const Call& call) {
  auto& [experiments, argv, out, err] = call;
  const std::string report = (std::filesystem::path(wish.out) / "report.html").string();
  if (wish.json) {
    out << run_reply(run, wish.out, outcome, report);
  } else {
    if (!outcome.summary.empty()) out << outcome.summary << (outcome.summary.ends_with('\n') ? "\n" : "\n\n");
    out << outcome.answer << "\n\nreport: " << report << "\n";
  }
  out.flush();
  if (outcome.self_test_passed) return exit_done;
  err << "the self-test failed: do not trust these numbers; the report says more. Chance fails one correct run in a hundred or "
         "fewer: another --seed tells\n";
  return exit_failed;
}

int interrupted(const RunWish& wish, const std::string& kept, const Call& call) {
  call.err << fmt::format("interrupted: {} in {}; to continue:\n{}\n", kept, wish.out, shell_line(call.argv));
  return exit_interrupted;
}

}  // namespace

int perform_run(const RunWish& given, const Call& call) try {
  const RunOptions& options = given.request.options;
  const ConfiguredRun chosen = configure_run(given.target, given.request, call.experiments);
  const std::vector<Unit> units = chosen.run->units();
  RunWish wish = given;
  if (wish.out.empty()) wish.out = "results/" + chosen.name;
  RunRecord record{.experiment = std::string(chosen.experiment.name),
                   .question = chosen.question,
                   .config = chosen.config,
                   .default_config = chosen.default_config,
                   .seed = options.seed,
                   .trials = options.trials,
                   .argv = call.argv,
                   .threads = options.threads,
                   .units = units.size(),
                   .started = Clock::now(),
                   .finished = {},
                   .build = this_build(),
                   .machine = this_machine()};
  for (const Unit& unit : units) record.total_trials += unit.trials;
  if (wish.list_cells) return list_cells(wish, record, units, call.out);
  if (wish.dry_run) return dry_run(wish, record, units, call.out);

  ResultFolder folder(wish.out, {record.experiment, record.config, record.seed, record.trials, this_program_sha256()});
  for (const std::string& note : folder.notes()) call.err << note << "\n";
  if (const auto& kept = folder.complete()) {
    Outcome outcome;
    outcome.answer = kept->answer;
    outcome.summary = kept->summary;
    outcome.self_test_passed = kept->self_test_passed;
    return reply(wish, record, outcome, call);
  }

  watch_for_stop();
  std::optional<StopGuard> guard(std::in_place, std::chrono::milliseconds(500), [&] {  // a unit may be long
    if (stderr_is_terminal()) call.err << "\r\x1b[K";                                  // the progress bar
    std::_Exit(interrupted(wish, "finished units are kept", call));
  });
  call.err << size_text(record) << std::endl;
  UnitResults results;
  {
    ProgressBar bar(stderr_is_terminal());
    results =
        compute_units(units, folder.journal(),
                      {.threads = record.threads, .stop = stop_requested, .on_progress = [&](const Progress& progress) {
                         bar.show(progress);
                       }});
  }
  if (!results.complete) {
    guard.reset();
    return interrupted(wish, "finished units are kept", call);
  }
  record.resumed_units = results.resumed;
  if (results.resumed > 0)
    call.err << fmt::format("{} of {} units were read from the journal\n", results.resumed, units.size());

  const Outcome outcome = chosen.run->finish(results.results, results.seconds);
  record.finished = Clock::now();
  const auto notes = write_results(folder, record, outcome);
  guard.reset();
  for (const std::string& note : notes) call.err << note << "\n";
  return reply(wish, record, outcome, call);
} catch (const std::system_error& error) {  // of a full disk, mostly; the journal keeps what was finished
  const auto* const file = dynamic_cast<const std::filesystem::filesystem_error*>(&error);
  throw std::runtime_error(fmt::format("{}; what was finished is kept: mend this, and the same command goes on",
                                       file ? file->path1().string() + ": " + error.code().message() : error.what()));
}

}  // namespace thinwall
