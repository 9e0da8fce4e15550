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
#include <sys/ioctl.h>
#include <unistd.h>
#include <boost/core/noncopyable.hpp>

#include <thinwall/experiments/lab/draw.hpp>
#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/files.hpp>
#include <thinwall/experiments/lab/json_reader.hpp>
#include <thinwall/experiments/lab/result_folder.hpp>
#include <thinwall/experiments/lab/runner.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/lab/shards.hpp>
#include <thinwall/experiments/lab/terminal.hpp>
#include <thinwall/experiments/lab/text.hpp>
#include <thinwall/experiments/program/command.hpp>

namespace thinwall {

namespace {

constexpr const char* self_test_failed =
    "the self-test failed: do not trust these numbers; the report says more. Chance fails one correct run in a hundred or "
    "fewer: another --seed tells\n";

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
  // What begins a unit, a trial alone or not, is counted for each.
  const bool mostly_beginning = told.cut_tried > 0 && told.trials == 1;
  const char* const bound = told.unknown > 0 ? "at least " : mostly_beginning ? "at most " : "about ";
  return bound + duration_text(seconds) + " on an idle machine";
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

/// `Told`: an Outcome, or the Manifest of a result that lies there already.
template <class Told> int reply(const RunWish& wish, const RunRecord& run, const Told& told, const Call& call) {
  const std::vector<std::string> troubles = draw_figures(wish.out, wish.figures).troubles;
  for (const std::string& trouble : troubles) call.err << trouble << "\n";
  const std::string report = (std::filesystem::path(wish.out) / "report.html").string();
  if (wish.json) {
    ordered_json reply = size_json(run, wish);
    reply["resumed_units"] = run.resumed_units;
    reply["answer"] = told.answer;
    reply["self_test_passed"] = told.self_test_passed;
    reply["report"] = report;
    call.out << json_line(reply);
  } else {
    call.out << summary_text(told.summary) << wrapped(told.answer) << "\nreport: " << one_line(report) << "\n";
  }
  call.out.flush();
  if (told.self_test_passed) return troubles.empty() ? exit_done : exit_failed;
  call.err << self_test_failed;
  return exit_failed;
}

int shard_reply(const RunWish& wish, const RunRecord& run, const Call& call) {
  if (wish.json) {
    ordered_json reply = size_json(run, wish);
    reply["shard"] = to_text(*wish.shard);
    reply["resumed_units"] = run.resumed_units;
    call.out << json_line(reply);
  } else {
    call.out << fmt::format("shard {} of {} is finished, in {}\nwith {} of them: {} merge SHARD... --out DIR\n",
                            to_text(*wish.shard), run.experiment, one_line(wish.out),
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
  RunRecord record = chosen.record;
  record.shard = wish.shard ? to_text(*wish.shard) : "";
  record.argv = call.argv;
  record.units = units.size();
  record.started = std::chrono::system_clock::now();
  record.build = this_build();
  record.machine = this_machine();
  for (const Unit& unit : units) record.total_trials += unit.trials;
  record.ranks = wish.launch.count;
  if (wish.merged) record.shards = wish.merged->records;
  return record;
}

std::vector<Unit> units_of(const Shard& shard, const std::vector<Unit>& all) {
  std::vector<Unit> units;
  for (const std::size_t i : units_of(shard, all.size())) units.push_back(all[i]);
  return units;
}

/// The ranks that compute one run together. Rank 0 holds the folder, tells the others what is left to do, gathers what
/// they did into its journal, and goes on alone. Each keeps what it has finished in a journal of its own until then, so that
/// a killed run loses no more than any other.
class Crew : boost::noncopyable {
 public:
  /// A crew of one needs no MPI. Throws UsageError as Ranks does.
  Crew(const Launch& launch, std::span<const Unit> units) : ranks_(launch), units_(units) {}
  ~Crew() {  // sends home ranks that still wait for rank 0
    if (leads() && !told_) is_one_run("");
  }

  bool leads() const { return ranks_.rank() == 0; }

  /// Of the leader: what `compute_units` returns, by all ranks.
  UnitResults compute(ResultFolder& folder, const std::string& identity, const RunnerOptions& options);

  /// Of the others: computes what the leader says, into a journal in `folder`. Returns the exit code.
  int assist(const std::filesystem::path& folder, const std::string& identity, const RunnerOptions& options);

 private:
  /// Whether all ranks were started with the same configuration, seed and program: none if rank 0 has nothing to do.
  std::optional<bool> is_one_run(const std::string& identity);
  std::vector<Unit> share_of(const std::vector<std::uint8_t>& open) const;  // this rank's

  Ranks ranks_;
  std::span<const Unit> units_;
  bool told_ = false;  // the others know what to do
};

std::optional<bool> Crew::is_one_run(const std::string& identity) {
  const std::string ours = identity.empty() ? std::string(64, ' ') : sha256(identity);
  std::vector<std::uint8_t> of_rank_0(ours.begin(), ours.end());
  ranks_.share(of_rank_0);
  told_ = true;
  if (of_rank_0.front() == ' ') return std::nullopt;
  const bool is_same = std::ranges::equal(of_rank_0, ours);
  if (!is_same) {
    std::cerr << fmt::format("rank {} of {} was started with another configuration, seed or program than rank 0\n",
                             ranks_.rank(), ranks_.count());
  }
  return ranks_.worst(is_same ? finished : failed) == finished;
}

std::vector<Unit> Crew::share_of(const std::vector<std::uint8_t>& open) const {
  std::vector<Unit> left;
  for (std::size_t i = 0; i < units_.size(); ++i) {
    if (open[i]) left.push_back(units_[i]);
  }
  return units_of({ranks_.rank() + 1, ranks_.count()}, left);
}

UnitResults Crew::compute(ResultFolder& folder, const std::string& identity, const RunnerOptions& options) {
  Journal& journal = folder.journal();
  if (ranks_.count() == 1) return compute_units(units_, journal, options);
  if (!is_one_run(identity).value_or(true))
    throw std::runtime_error("the ranks do not work on one run, as the line of another says; nothing was computed");
  std::vector<std::uint8_t> open;
  for (const Unit& unit : units_) open.push_back(journal.finished().contains(unit.key) ? 0 : 1);
  ranks_.share(open);

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
  if (worst == finished && !all.complete) {
    throw std::runtime_error(
        "another rank kept what it finished where rank 0 does not find it: all must see the same --out");
  }
  return all;
}

int Crew::assist(const std::filesystem::path& folder, const std::string& identity, const RunnerOptions& options) {
  const auto one_run = is_one_run(identity);
  if (!one_run) return exit_done;
  if (!*one_run) return exit_failed;
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
    std::cerr << fmt::format("rank {} of {} failed: {}\n", ranks_.rank(), ranks_.count(), one_line(error.what()));
    ending = failed;
  }
  ranks_.worst(ending);
  return ending == finished ? exit_done : ending == stopped ? exit_interrupted : exit_failed;
}

/// True if stderr is a terminal that can redraw a line (TERM is not `dumb`).
bool stderr_is_terminal() {
  const char* const term = std::getenv("TERM");
  return ::isatty(STDERR_FILENO) == 1 && term != nullptr && std::string_view(term) != "dumb";
}

/// On a terminal: nothing is printed where stderr is none.
class ProgressBar : boost::noncopyable {
 public:
  explicit ProgressBar(bool enabled) : enabled_(enabled) {}
  ~ProgressBar() {
    if (drawn_) erase();
  }

  static void erase() { std::fputs("\r\x1b[K", stderr); }

  void show(const Progress& progress) {
    constexpr auto pause = std::chrono::milliseconds(100);
    const auto now = Clock::now();
    if (!enabled_ || (drawn_ && now - last_ < pause && progress.units_done < progress.units)) return;
    drawn_ = true;
    last_ = now;
    std::string line = progress_line(progress, std::chrono::duration<double>(now - start_).count());
    winsize window{};
    if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &window) == 0 && window.ws_col > 0)
      line.resize(std::min(line.size(), std::size_t{window.ws_col} - 1));  // what wraps is not erased
    std::fprintf(stderr, "\r%s\x1b[K", line.c_str());
    std::fflush(stderr);
  }

 private:
  using Clock = std::chrono::steady_clock;
  bool enabled_, drawn_ = false;
  Clock::time_point start_ = Clock::now(), last_;
};

}  // namespace

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

int perform_run(RunWish wish, const Call& call) try {
  const ConfiguredRun chosen =
      wish.merged ? configure_again(wish.merged->identity, wish.request.options.threads, call.experiments)
                  : configure_run(wish.target, wish.request, call.experiments);
  if (wish.shard && wish.launch.count > 1)
    throw UsageError("--shard: mpirun shares a run out among its ranks already; use one of the two");
  const std::vector<Unit> all = chosen.run->units(),
                          part = wish.shard ? units_of(*wish.shard, all) : std::vector<Unit>();
  const std::vector<Unit>& units = wish.shard ? part : all;
  if (wish.out.empty()) wish.out = default_folder(chosen, wish.shard);
  RunRecord record = record_of(chosen, wish, call, units);
  if (wish.list_cells) return list_cells(wish, record, units, call.out);
  const auto tell = [&](const std::vector<std::string>& notes) {
    for (const std::string& note : notes) call.err << note << "\n";
  };
  if (wish.dry_run) {
    tell(chosen.run->notes());
    return dry_run(wish, record, all, call);
  }

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
  tell(folder.notes());
  if (const auto& kept = folder.complete()) {
    return reply(wish, record, *kept, call);
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
      std::_Exit(interrupted(wish, call));  // what was staged is the next run's to remove: this one may still write
    });
  }
  tell(chosen.run->notes());
  call.err << size_text(record) << std::endl;
  if (!wish.merged) {
    const auto& finished = folder.journal().finished();
    for (const Unit& unit : units) record.resumed_units += finished.contains(unit.key);
  }
  if (const auto done = static_cast<std::int64_t>(record.resumed_units); done > 0) {
    call.err << fmt::format("goes on: {} of {} are done", grouped_text(done), plural_text(std::ssize(units), "unit"))
             << std::endl;
  }
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
  if (wish.shard) {
    record.finished = std::chrono::system_clock::now();
    folder.seal(record);
    guard.reset();
    return shard_reply(wish, record, call);
  }

  const Outcome outcome = chosen.run->finish(results.results, results.seconds);
  record.finished = std::chrono::system_clock::now();
  const auto notes = write_results(folder, record, outcome);
  guard.reset();
  tell(notes);
  return reply(wish, record, outcome, call);
} catch (const std::system_error& error) {  // of a full disk, mostly; the journal keeps what was finished
  const auto* const file = dynamic_cast<const std::filesystem::filesystem_error*>(&error);
  const auto place_of = [](const auto& e) { return (e.path2().empty() ? e.path1() : e.path2()).string(); };
  const std::string why = file ? place_of(*file) + ": " + error.code().message() : error.what();
  std::error_code none;  // somebody may have deleted the folder
  const bool is_kept = std::filesystem::exists(std::filesystem::path(wish.out) / journal_name, none);
  throw std::runtime_error(why +
                           (is_kept ? "; what was finished is kept: mend this, and the same command goes on" : ""));
}

}  // namespace thinwall
