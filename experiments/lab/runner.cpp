#include <thinwall/experiments/lab/runner.hpp>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <exception>
#include <map>
#include <numeric>
#include <optional>
#include <random>
#include <set>
#include <stdexcept>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/lab/text.hpp>

namespace thinwall {

namespace {

volatile std::sig_atomic_t requested = 0;

void request_stop(int) {
  requested = 1;
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction now = {};
    if (::sigaction(signal, nullptr, &now) == 0 && now.sa_handler == request_stop) std::signal(signal, SIG_DFL);
  }
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Journal::Row timed(const Unit& unit) {
  const auto start = std::chrono::steady_clock::now();
  std::string result;
  try {
    result = unit.compute();
  } catch (const std::exception& error) {
    throw std::runtime_error("unit '" + unit.key + "' failed: " + error.what());
  }
  return {seconds_since(start), std::move(result)};
}

std::int64_t total_trials(std::span<const Unit> units) {
  return std::accumulate(units.begin(), units.end(), std::int64_t{0},
                         [](std::int64_t sum, const Unit& unit) { return sum + unit.trials; });
}

void require_unique_keys(std::span<const Unit> units) {
  std::set<std::string_view> keys;
  for (const Unit& unit : units) {
    if (!keys.insert(unit.key).second) throw std::logic_error("two units have the key '" + unit.key + "'");
  }
}

/// Calls `body(i)` for every i below `count`, on `threads` threads, also if the machine has fewer cores.
template <class Body> void parallel_for_each_index(std::size_t count, int threads, const Body& body) {
  namespace tbb = oneapi::tbb;
  const auto width = static_cast<std::size_t>(threads);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, width);
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, count, 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
          for (std::size_t i = range.begin(); i < range.end(); ++i) body(i);
        },
        tbb::simple_partitioner());
  });
}

using Tell = std::function<void(const RunEstimate&)>;

std::unique_ptr<Run> run_of(const ConfigureTrials& again, std::int64_t trials) {
  try {
    return again(trials);
  } catch (const UsageError&) {
    return nullptr;
  }
}

/// What was timed.
struct Rate {
  double seconds = 0, trials = 0;
  std::int64_t units = 0;

  void time(const Unit& unit) {
    const auto start = std::chrono::steady_clock::now();
    if (unit.seconds == 0) unit.compute();
    seconds += unit.seconds > 0 ? unit.seconds : seconds_since(start);
    trials += static_cast<double>(unit.trials);
    units += 1;
  }
};

/// The units of a run, parted by what fewer trials do to them.
struct Parts {
  double cut_trials = 0;
  std::int64_t cut = 0, whole = 0;
  std::map<std::int64_t, std::vector<const Unit*>> groups{};  ///< of whole units, by their trials, shuffled
  std::unordered_set<std::string_view> whole_keys{};
};

/// A whole unit has as many trials in a smaller run.
Parts parts_of(std::span<const Unit> units, const std::vector<Unit>& smaller) {
  std::unordered_map<std::string_view, std::int64_t> trials;
  for (const Unit& unit : smaller) trials[unit.key] = unit.trials;
  Parts parts;
  for (const Unit& unit : units) {
    const auto same = trials.find(unit.key);
    if (same == trials.end() || same->second != unit.trials) {
      parts.cut += 1;
      parts.cut_trials += static_cast<double>(unit.trials);
      continue;
    }
    parts.whole += 1;
    parts.groups[unit.trials].push_back(&unit);
    parts.whole_keys.insert(unit.key);
  }
  std::minstd_rand order(1);  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same in every run
  for (auto& [of_trials, group] : parts.groups) std::shuffle(group.begin(), group.end(), order);
  return parts;
}

/// Some of the cut units, spread over the run: its cells differ in cost.
std::vector<const Unit*> samples_of(const std::vector<Unit>& units, const Parts& parts) {
  constexpr std::size_t most = 16;
  std::vector<const Unit*> cut, some;
  for (const Unit& unit : units) {
    if (!parts.whole_keys.contains(unit.key)) cut.push_back(&unit);
  }
  const std::size_t count = std::min(most, cut.size());
  constexpr double golden = 0.6180339887498949;  // out of step with any order that comes round
  for (std::size_t k = 0; k < count; ++k) {
    const double place = static_cast<double>(k) + std::fmod(golden * static_cast<double>(k), 1);
    some.push_back(cut[static_cast<std::size_t>(place * static_cast<double>(cut.size()) / static_cast<double>(count))]);
  }
  return some;
}

/// Tells of the cut units whenever more is known.
void try_cut(std::span<const Unit> units, const ConfigureTrials& again, double budget, const Tell& tell) {
  std::int64_t most = 1, growth = 1;
  for (const Unit& unit : units) most = std::max(most, unit.trials);
  std::optional<Parts> parts;
  const auto know = [&](const Rate& rate, std::int64_t trials) {
    tell({.seconds = rate.trials > 0 ? rate.seconds / rate.trials * parts->cut_trials : 0,
          .cut_tried = rate.units,
          .trials = trials,
          .whole = parts->whole,
          .unknown = rate.units > 0 ? 0 : parts->cut});
  };
  const auto begin = std::chrono::steady_clock::now();
  for (std::int64_t trials = 1;; trials *= growth) {
    const auto start = std::chrono::steady_clock::now();
    double made = 0;  // the run itself, which takes as long whatever its trials
    const std::unique_ptr<Run> run = run_of(again, trials);
    if (run) {
      const std::vector<Unit> smaller = run->units();
      const bool first = !parts;
      if (first) know({}, (parts = parts_of(units, smaller), trials));
      made = seconds_since(start);
      Rate rate;
      for (const Unit* unit : samples_of(smaller, *parts)) {
        rate.time(*unit);
        if (first) know(rate, trials);
      }
      know(rate, trials);  // of a larger number of trials only when it is complete
    }
    if (parts && parts->cut == 0) return;
    const double left = budget - seconds_since(begin) - made, tried = seconds_since(start) - made;
    growth = 4;
    if (trials >= most || static_cast<double>(growth) * tried > left) return;
    while (run && growth * trials < most && static_cast<double>(16 * growth) * tried < left) growth *= 4;
  }
}

/// Tells of the whole units whenever more is known.
void try_whole(std::span<const Unit> units, const ConfigureTrials& again, const Tell& tell) {
  const std::unique_ptr<Run> run = run_of(again, 1);
  if (!run) return;
  const Parts parts = parts_of(units, run->units());
  std::map<std::int64_t, Rate> rates;
  const auto know = [&] {
    RunEstimate known = {.whole = parts.whole};
    for (const auto& [trials, group] : parts.groups) {
      const Rate& rate = rates[trials];
      known.whole_tried += rate.units;
      if (rate.units == 0) known.unknown += std::ssize(group);
      if (rate.units > 0)
        known.seconds += rate.seconds / static_cast<double>(rate.units) * static_cast<double>(group.size());
    }
    tell(known);
  };
  know();
  for (std::size_t round = 0; std::cmp_less(round, parts.whole); ++round) {
    for (const auto& [trials, group] : parts.groups) {
      if (round >= group.size()) continue;
      rates[trials].time(*group[round]);
      know();
    }
  }
}

/// From now on this process has so long to live.
void end_after(double seconds) {
  std::signal(SIGALRM, SIG_DFL);
  sigset_t alarm;
  sigemptyset(&alarm);
  sigaddset(&alarm, SIGALRM);
  sigprocmask(SIG_UNBLOCK, &alarm, nullptr);
  const auto whole = static_cast<time_t>(seconds);
  const auto rest = static_cast<suseconds_t>((seconds - static_cast<double>(whole)) * 1e6);
  const itimerval time = {.it_interval = {}, .it_value = {.tv_sec = whole, .tv_usec = rest}};
  ::setitimer(ITIMER_REAL, &time, nullptr);
}

/// The last that `work` tells in a process of its own, within `seconds`; nothing if that is nothing.
std::optional<RunEstimate> told_within(double seconds, const std::function<void(const Tell&)>& work) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return std::nullopt;
  const int read = ends[0], write = ends[1];
  const pid_t child = ::fork();
  if (child == 0) {
    end_after(seconds);
    try {
      work([write](const RunEstimate& known) {
        if (::write(write, &known, sizeof known) != sizeof known) ::_exit(1);
      });
    } catch (const std::exception&) {  // a unit that fails is for the run itself to tell
    }
    ::_exit(0);
  }
  ::close(write);
  std::optional<RunEstimate> last;
  RunEstimate next;
  for (ssize_t got = 0; (got = ::read(read, &next, sizeof next)) != 0;) {
    if (got == sizeof next) last = next;
    if (got < 0 && errno != EINTR) break;
  }
  ::close(read);
  while (child > 0 && ::waitpid(child, nullptr, 0) < 0 && errno == EINTR) continue;
  return last;
}

}  // namespace

void watch_for_stop() {
  requested = 0;
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction before = {};
    const bool is_ignored = ::sigaction(signal, nullptr, &before) == 0 && before.sa_handler == SIG_IGN;
    if (!is_ignored) std::signal(signal, request_stop);  // else as whoever started us wants it
  }
}

bool stop_requested() { return requested != 0; }

StopGuard::StopGuard(std::chrono::milliseconds patience, std::function<void()> end)
    : thread_([this, patience, end = std::move(end)] { watch(patience, end); }) {}

StopGuard::~StopGuard() {
  {
    const std::scoped_lock lock(mutex_);
    done_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void StopGuard::watch(std::chrono::milliseconds patience, const std::function<void()>& end) {
  constexpr std::chrono::milliseconds look(50);  // a signal handler may set a flag, but not wake a thread
  std::unique_lock lock(mutex_);
  const auto done = [this] { return done_; };
  while (!changed_.wait_for(lock, look, done)) {
    if (!stop_requested()) continue;
    if (!changed_.wait_for(lock, patience, done)) end();
    return;
  }
}

int default_threads() {
  const int ours = oneapi::tbb::info::default_concurrency(), neighbors = launch_of_this_process().neighbors;
  if (neighbors <= 1) return ours;
  // mpirun may bind ranks to cores or not
  const int fair = static_cast<int>(std::thread::hardware_concurrency()) / neighbors;
  return std::max(1, std::min(ours, fair));
}

UnitResults compute_units(std::span<const Unit> units, Journal& journal, const RunnerOptions& options) {
  require_unique_keys(units);
  UnitResults out;
  out.results.resize(units.size());
  out.seconds.resize(units.size());
  Progress progress{.units = units.size(), .trials = total_trials(units)};

  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < units.size(); ++i) {
    const auto known = journal.finished().find(units[i].key);
    if (known == journal.finished().end()) {
      open.push_back(i);
      continue;
    }
    out.results[i] = known->second.result;
    out.seconds[i] = known->second.seconds;
    progress.trials_resumed += units[i].trials;
  }
  progress.units_done = units.size() - open.size();
  progress.trials_done = progress.trials_resumed;

  std::mutex mutex;
  const auto report = [&] {
    if (options.on_progress) options.on_progress(progress);
  };
  report();
  parallel_for_each_index(open.size(), options.threads, [&](std::size_t k) {
    if (options.stop && options.stop()) return;
    const std::size_t i = open[k];
    Journal::Row row = timed(units[i]);
    journal.add(units[i].key, row);
    const std::scoped_lock lock(mutex);
    out.results[i] = std::move(row.result);
    out.seconds[i] = row.seconds;
    progress.units_done += 1;
    progress.trials_done += units[i].trials;
    report();
  });
  out.complete = progress.units_done == units.size();
  return out;
}

std::string basis_text(const RunEstimate& e) {
  std::vector<std::string> parts;
  if (e.cut_tried > 0) {
    parts.push_back(
        fmt::format("{} tried with {} each", plural_text(e.cut_tried, "unit"), plural_text(e.trials, "trial")));
  }
  if (e.whole_tried > 0) {
    parts.push_back(fmt::format("{} of {} tried whole", grouped_text(e.whole_tried), plural_text(e.whole, "unit")));
  }
  if (e.unknown > 0) parts.push_back(fmt::format("{} too long to try", plural_text(e.unknown, "unit")));
  return fmt::format("{}", fmt::join(parts, ", "));
}

RunEstimate estimate(std::span<const Unit> units, const ConfigureTrials& again, double budget) {
  const double half = budget / 2;
  const auto cut = told_within(half, [&](const Tell& tell) { try_cut(units, again, half, tell); });
  RunEstimate known = cut.value_or(RunEstimate{.unknown = std::ssize(units)});
  if (!cut || cut->whole == 0) return known;
  const auto whole = told_within(half, [&](const Tell& tell) { try_whole(units, again, tell); });
  known.seconds += whole ? whole->seconds : 0;
  known.whole_tried = whole ? whole->whole_tried : 0;
  known.unknown += whole ? whole->unknown : cut->whole;
  return known;
}

}  // namespace thinwall
