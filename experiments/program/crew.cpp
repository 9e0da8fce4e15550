#include <thinwall/experiments/program/run.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>
#include <unistd.h>

#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/shards.hpp>
#include <thinwall/experiments/lab/text.hpp>
#include <thinwall/experiments/program/command.hpp>

namespace thinwall {

namespace {

/// How a rank's part ended, in order of severity.
enum Ending : int { finished, stopped, failed };

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

namespace {

/// 1234567 as 1.2 M.
std::string short_text(double count) {
  for (const auto& [size, letter] : {std::pair{1e12, "T"}, {1e9, "G"}, {1e6, "M"}, {1e3, "k"}}) {
    if (count >= size) return rounded_text(count / size, count / size < 10 ? 2 : 3) + " " + letter;
  }
  return rounded_text(count, 3);
}

}  // namespace

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

}  // namespace thinwall
