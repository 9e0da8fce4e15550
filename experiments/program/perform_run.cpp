#include <thinwall/experiments/program/run.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <thinwall/experiments/lab/draw.hpp>
#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/json_reader.hpp>
#include <thinwall/experiments/lab/result_folder.hpp>
#include <thinwall/experiments/lab/runner.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/lab/shards.hpp>
#include <thinwall/experiments/lab/text.hpp>
#include <thinwall/experiments/program/command.hpp>

namespace thinwall {

namespace {

/// How a rank's part ended, in order of severity.
enum Ending : int { finished, stopped, failed };

/// 1234567 as 1.2 M.
std::string short_text(double count) {
  for (const auto& [size, letter] : {std::pair{1e12, "T"}, {1e9, "G"}, {1e6, "M"}, {1e3, "k"}}) {
    if (count >= size) return rounded_text(count / size, count / size < 10 ? 2 : 3) + " " + letter;
  }
  return rounded_text(count, 3);
}

using nlohmann::ordered_json;

constexpr std::chrono::milliseconds patience(500);  // for a unit to end when Ctrl-C is pressed; one may be long

std::string size_text(const RunRecord& run) {
  const std::string threads = plural_text(run.threads, "thread");
  return fmt::format("{}: {}, {} on {}", run.experiment, plural_text(static_cast<std::int64_t>(run.units), "unit"),
                     plural_text(run.total_trials, "trial"),
                     run.ranks > 1 ? fmt::format("{} ranks of {}", run.ranks, threads) : threads);
}

/// What every answer in JSON begins with.
ordered_json size_json(const RunRecord& run, const RunWish& wish) {
  return {{"experiment", run.experiment}, {"out", wish.out},  {"units", run.units},
          {"trials", run.total_trials},   {"seed", run.seed}, {"threads", run.threads}};
}

std::string time_text(const RunEstimate& told, double seconds) {
  if (told.tried() == 0) return "for how long, cannot be told";
  const bool mostly_beginning =
      told.cut_tried > 0 && told.trials == 1;  // what begins a unit, a trial alone or not, is counted for each
  return (told.unknown > 0 ? "at least " : mostly_beginning ? "at most " : "about ") + duration_text(seconds);
}

int dry_run(const RunWish& wish, const RunRecord& run, std::span<const Unit> all, const Call& call) {
  const auto again = [&](std::int64_t trials) {
    RunRequest request = wish.request;
    request.options.trials = trials;
    return configure_run(wish.target, request, call.experiments).run;
  };
  const RunEstimate told = estimate(all, again);
  double trials = 0;  // of the whole run, of which a shard is a part
  for (const Unit& unit : all) trials += static_cast<double>(unit.trials);
  const auto crew = std::min(static_cast<double>(run.threads) * run.ranks, static_cast<double>(run.units));
  const double seconds = told.seconds * static_cast<double>(run.total_trials) / trials / crew;
  if (wish.json) {
    ordered_json reply = size_json(run, wish);
    reply["dry_run"] = true;
    reply["estimated_seconds"] = told.tried() > 0 ? ordered_json(seconds) : ordered_json();
    reply["units_left_out_of_estimate"] = told.unknown;
    reply["estimated_from"] = basis_text(told);
    call.out << json_line(reply);
  } else {
    call.out << fmt::format("{}\n{} ({}); results would go to {}\n", size_text(run), time_text(told, seconds),
                            basis_text(told), one_line(wish.out));
  }
  return exit_done;
}

int list_cells(const RunWish& wish, const RunRecord& run, std::span<const Unit> units, std::ostream& out) {
  if (wish.json) {
    ordered_json reply = size_json(run, wish);
    reply["cells"] = ordered_json::array();
    for (const Unit& unit : units) reply["cells"].push_back({{"key", unit.key}, {"trials", unit.trials}});
    out << json_line(reply);
  } else {
    for (const Unit& unit : units) out << fmt::format("{:>12}  {}\n", unit.trials, one_line(unit.key));
  }
  return exit_done;
}

int reply(const RunWish& wish, const RunRecord& run, const Outcome& outcome, const Call& call) {
  auto& [experiments, argv, out, err] = call;
  const std::vector<std::string> troubles = draw_figures(wish.out, wish.figures).troubles;
  for (const std::string& trouble : troubles) err << trouble << "\n";
  const std::string report = (std::filesystem::path(wish.out) / "report.html").string();
  if (wish.json) {
    ordered_json reply = size_json(run, wish);
    reply["resumed_units"] = run.resumed_units;
    reply["answer"] = outcome.answer;
    reply["self_test_passed"] = outcome.self_test_passed;
    reply["report"] = report;
    out << json_line(reply);
  } else {
    if (!outcome.summary.empty()) out << outcome.summary << (outcome.summary.ends_with('\n') ? "\n" : "\n\n");
    out << outcome.answer << "\n\nreport: " << one_line(report) << "\n";
  }
  out.flush();
  if (outcome.self_test_passed) return troubles.empty() ? exit_done : exit_failed;
  err << "the self-test failed: do not trust these numbers; the report says more. Chance fails one correct run in a hundred or "
         "fewer: another --seed tells\n";
  return exit_failed;
}

int shard_reply(const RunWish& wish, const RunRecord& run, const Call& call) {
  if (wish.json) {
    ordered_json reply = size_json(run, wish);
    reply["shard"] = to_text(*wish.shard);
    reply["resumed_units"] = run.resumed_units;
    call.out << json_line(reply);
  } else {
    call.out << fmt::format("shard {} of {} is finished, in {}\n", to_text(*wish.shard), run.experiment,
                            one_line(wish.out));
    call.out << fmt::format("with {} of them: {} merge SHARD... --out DIR\n",
                            wish.shard->count == 1 ? "one" : fmt::format("all {}", wish.shard->count),
                            shell_line({call.argv.front()}));
  }
  call.out.flush();
  return exit_done;
}

int interrupted(const RunWish& wish, const Call& call) {
  const int ranks = wish.launch.count;
  call.err << fmt::format("interrupted: finished units are kept in {}; to continue:\n{}{}\n", one_line(wish.out),
                          ranks > 1 ? fmt::format("mpirun -n {} ", ranks) : "", shell_line(call.argv));
  return exit_interrupted;
}

std::string default_folder(const ConfiguredRun& chosen, const std::optional<Shard>& shard) {
  return "results/" + chosen.name + (shard ? fmt::format("-{}-of-{}", shard->index, shard->count) : "");
}

RunRecord record_of(const ConfiguredRun& chosen, const RunWish& wish, const Call& call, std::span<const Unit> units) {
  RunRecord record;
  record.experiment = chosen.experiment.name;
  record.question = chosen.question;
  record.config = chosen.config;
  record.default_config = chosen.default_config;
  record.seed = wish.merged ? wish.merged->identity.seed : wish.request.options.seed;
  record.trials = wish.merged ? wish.merged->identity.trials : wish.request.options.trials;
  record.shard = wish.shard ? to_text(*wish.shard) : "";
  record.argv = call.argv;
  record.threads = wish.request.options.threads;
  record.units = units.size();
  record.started = std::chrono::system_clock::now();
  record.build = this_build();
  record.machine = this_machine();
  for (const Unit& unit : units) record.total_trials += unit.trials;
  record.ranks = wish.launch.count;
  if (wish.merged) record.shards = wish.merged->records;
  return record;
}

std::vector<Unit> units_of(const Shard& shard, const Launch& launch, const std::vector<Unit>& all) {
  if (launch.count > 1) {
    throw UsageError("--shard: mpirun shares a run out among its ranks already; use one of the two");
  }
  std::vector<Unit> units;
  for (const std::size_t i : units_of(shard, all.size())) units.push_back(all[i]);
  return units;
}

}  // namespace

Crew::Crew(const Launch& launch, std::span<const Unit> units) : ranks_(launch), units_(units) {}

Crew::~Crew() {
  if (!leads() || told_) return;
  std::vector<std::uint8_t> nothing(units_.size());
  ranks_.share(nothing);
  ranks_.worst(finished);
}

std::vector<Unit> Crew::share_of(const std::vector<std::uint8_t>& open) const {
  std::vector<Unit> left;
  for (std::size_t i = 0; i < units_.size(); ++i) {
    if (open[i]) left.push_back(units_[i]);
  }
  std::vector<Unit> ours;
  for (const std::size_t i : units_of({ranks_.rank() + 1, ranks_.count()}, left.size())) ours.push_back(left[i]);
  return ours;
}

UnitResults Crew::compute(ResultFolder& folder, const std::string& identity, const RunnerOptions& options) {
  Journal& journal = folder.journal();
  if (count() == 1) return compute_units(units_, journal, options);
  std::vector<std::uint8_t> open(units_.size());
  std::size_t known = 0;
  for (std::size_t i = 0; i < units_.size(); ++i) {
    const bool done = journal.finished().contains(units_[i].key);
    open[i] = done ? 0 : 1;
    known += done ? 1U : 0U;
  }
  ranks_.share(open);
  told_ = true;

  Ending ending = finished;
  std::exception_ptr why;
  try {
    if (!compute_units(share_of(open), journal, options).complete) ending = stopped;
  } catch (const std::exception&) {
    ending = failed;
    why = std::current_exception();
  }
  const int worst = ranks_.worst(ending);
  folder.gather_rank_journals(identity);
  if (why) std::rethrow_exception(why);
  if (worst == failed) throw std::runtime_error("another rank failed, as its own line says; what was finished is kept");
  UnitResults all = compute_units(units_, journal, {.threads = 1, .stop = [] { return true; }, .on_progress = {}});
  all.resumed = known;
  return all;
}

int Crew::assist(const std::filesystem::path& folder, const std::string& identity, const RunnerOptions& options) {
  std::vector<std::uint8_t> open(units_.size());
  ranks_.share(open);
  Ending ending = finished;
  try {
    const std::vector<Unit> ours = share_of(open);
    if (!ours.empty()) {
      Journal journal(ResultFolder::rank_journal(folder, ranks_.rank()), identity);
      if (!compute_units(ours, journal, options).complete) ending = stopped;
    }
  } catch (const std::exception& error) {
    std::cerr << fmt::format("rank {} of {} failed: {}\n", ranks_.rank(), count(), one_line(error.what()));
    ending = failed;
  }
  ranks_.worst(ending);
  return ending == finished ? exit_done : ending == stopped ? exit_interrupted : exit_failed;
}

bool stderr_is_terminal() {
  const char* const term = std::getenv("TERM");
  return ::isatty(STDERR_FILENO) == 1 && term != nullptr && std::string_view(term) != "dumb";
}

std::string progress_line(const Progress& progress, double seconds) {
  constexpr int width = 24;
  const bool weighed = progress.trials > 0;  // units differ in size: their trials tell more than their number
  const double all = weighed ? static_cast<double>(progress.trials) : static_cast<double>(progress.units);
  const double done = weighed ? static_cast<double>(progress.trials_done) : static_cast<double>(progress.units_done);
  const double share = all > 0 ? std::min(done / all, 1.0) : 1;
  const int filled = static_cast<int>(share * width);
  std::string line = fmt::format("[{:=>{}}{:>{}}] {:3.0f} %  {} trials", "", filled, "", width - filled, 100 * share,
                                 short_text(static_cast<double>(progress.trials_done)));
  const double now = static_cast<double>(progress.trials_done - progress.trials_resumed);
  if (now > 0 && seconds > 0) {
    const double rate = now / seconds, left = static_cast<double>(progress.trials - progress.trials_done) / rate;
    line += fmt::format("  {}/s  {} left", short_text(rate), duration_text(left));
  }
  return line;
}

void ProgressBar::show(const Progress& progress) {
  constexpr auto pause = std::chrono::milliseconds(100);
  const auto now = Clock::now();
  if (!enabled_ || (drawn_ && now - last_ < pause && progress.units_done < progress.units)) return;
  drawn_ = true;
  last_ = now;
  const std::string line = progress_line(progress, std::chrono::duration<double>(now - start_).count());
  std::fprintf(stderr, "\r%s\x1b[K", line.c_str());
  std::fflush(stderr);
}

void ProgressBar::erase() { std::fputs("\r\x1b[K", stderr); }

ProgressBar::~ProgressBar() {
  if (drawn_) erase();
}

int perform_run(RunWish wish, const Call& call) try {
  const ConfiguredRun chosen =
      wish.merged ? configure_again(wish.merged->identity, wish.request.options.threads, call.experiments)
                  : configure_run(wish.target, wish.request, call.experiments);
  const std::vector<Unit> all = chosen.run->units();
  const std::vector<Unit> part = wish.shard ? units_of(*wish.shard, wish.launch, all) : std::vector<Unit>();
  const std::vector<Unit>& units = wish.shard ? part : all;
  if (wish.out.empty()) wish.out = default_folder(chosen, wish.shard);
  RunRecord record = record_of(chosen, wish, call, units);
  if (wish.list_cells) return list_cells(wish, record, units, call.out);
  if (wish.dry_run) return dry_run(wish, record, all, call);

  record.program = this_program_sha256();
  const Journal::Rows merged = wish.merged ? all_rows(*wish.merged, units) : Journal::Rows();
  Crew crew(wish.launch, units);
  if (!crew.leads()) {
    watch_for_stop();
    const StopGuard guard(patience, [] { std::_Exit(exit_interrupted); });
    return crew.assist(wish.out, identity_text(record),
                       {.threads = record.threads, .stop = stop_requested, .on_progress = {}});
  }
  ResultFolder folder(wish.out, record);
  for (const std::string& note : folder.notes()) call.err << note << "\n";
  if (const auto& kept = folder.complete()) {
    Outcome outcome;
    outcome.answer = kept->answer;
    outcome.summary = kept->summary;
    outcome.self_test_passed = kept->self_test_passed;
    return reply(wish, record, outcome, call);
  }
  if (wish.shard && is_sealed(folder, record)) {
    call.err << one_line(wish.out) << ": finished already; nothing was computed\n";
    return shard_reply(wish, record, call);
  }
  folder.journal().add(merged);

  std::optional<StopGuard> guard;
  if (!wish.watch) {
    watch_for_stop();
    guard.emplace(patience, [&] {
      if (stderr_is_terminal()) ProgressBar::erase();
      Workshop::remove_all();
      std::_Exit(interrupted(wish, call));
    });
  }
  for (const std::string& note : chosen.run->notes()) call.err << note << "\n";
  call.err << size_text(record) << std::endl;
  UnitResults results;
  {
    ProgressBar bar(!wish.watch && stderr_is_terminal());
    const RunWatch watch = wish.watch.value_or(
        RunWatch{.stop = stop_requested, .on_progress = [&](const Progress& progress) { bar.show(progress); }});
    results = crew.compute(folder, identity_text(record),
                           {.threads = record.threads, .stop = watch.stop, .on_progress = watch.on_progress});
  }
  if (!results.complete) {
    guard.reset();
    return interrupted(wish, call);
  }
  if (!wish.merged && results.resumed > 0) {
    record.resumed_units = results.resumed;
    call.err << fmt::format("{} of {} units were read from the journal\n", results.resumed, units.size());
  }
  if (wish.shard) {
    record.finished = std::chrono::system_clock::now();
    seal_shard(folder, record);
    guard.reset();
    return shard_reply(wish, record, call);
  }

  const Outcome outcome = chosen.run->finish(results.results, results.seconds);
  record.finished = std::chrono::system_clock::now();
  const auto notes = write_results(folder, record, outcome);
  guard.reset();
  for (const std::string& note : notes) call.err << note << "\n";
  return reply(wish, record, outcome, call);
} catch (const std::system_error& error) {  // of a full disk, mostly; the journal keeps what was finished
  const auto* const file = dynamic_cast<const std::filesystem::filesystem_error*>(&error);
  const std::string why = file ? file->path1().string() + ": " + error.code().message() : error.what();
  std::error_code none;  // somebody may have deleted the folder
  const bool is_kept = std::filesystem::exists(std::filesystem::path(wish.out) / journal_name, none);
  throw std::runtime_error(why +
                           (is_kept ? "; what was finished is kept: mend this, and the same command goes on" : ""));
}

}  // namespace thinwall
