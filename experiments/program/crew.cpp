#include <thinwall/experiments/program/crew.hpp>

#include <exception>
#include <iostream>
#include <stdexcept>

#include <fmt/format.h>

#include <thinwall/experiments/program/exit_codes.hpp>
#include <thinwall/experiments/run/shard.hpp>
#include <thinwall/experiments/text/escape.hpp>

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

}  // namespace thinwall
