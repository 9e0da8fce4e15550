#include <thinwall/experiments/broad_phase/survey.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <memory>
#include <mutex>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include <thinwall/discrete/broad_phase/uniform_grid.hpp>
#include <thinwall/experiments/broad_phase/finder.hpp>

namespace thinwall {

namespace {

/// [s] of the processor that this thread has had: what others do meanwhile does not count.
double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Both sorted.
std::int64_t count_in_first_only(const std::vector<ProxyPair>& a, const std::vector<ProxyPair>& b) {
  std::int64_t count = 0;
  auto other = b.begin();
  for (const ProxyPair& pair : a) {
    while (other != b.end() && *other < pair) ++other;
    if (other == b.end() || *other != pair) ++count;
  }
  return count;
}

using Steps = std::array<std::vector<Proxy>, 2>;

/// [s] a call, over `calls` of them, on the boxes of one step and of the other in turn. `turn` says whose is next.
double time_calls(Finder& finder, const Steps& steps, std::int64_t calls, std::size_t& turn) {
  const double start = thread_seconds();
  for (std::int64_t i = 0; i < calls; ++i) finder.find(steps[turn ^= 1]);
  return (thread_seconds() - start) / static_cast<double>(calls);
}

constexpr std::int64_t least_rounds = 3;
constexpr double least_seconds = 1e-4;     // [s] that a round takes at least: reading the clock takes 1e-6
constexpr std::int64_t most_calls = 1000;  // a round

/// The finders have seen the first of the steps.
void time_rounds(const Steps& steps, const SurveyOptions& options, std::vector<std::unique_ptr<Finder>>& finders,
                 std::vector<Finding>& findings) {
  std::vector<std::pair<std::int64_t, std::size_t>> calls_and_turns;
  for (const auto& finder : finders) {
    std::size_t turn = 0;
    const double once = time_calls(*finder, steps, 1, turn);
    calls_and_turns.emplace_back(once > least_seconds ? 1 : most_calls, turn);
    if (once > least_seconds / static_cast<double>(most_calls) && once <= least_seconds)
      calls_and_turns.back().first = static_cast<std::int64_t>(std::ceil(least_seconds / once));
  }
  for (std::int64_t round = 0; round < options.rounds; ++round) {
    for (std::size_t k = 0; k < finders.size(); ++k) {
      auto& [calls, turn] = calls_and_turns[k];
      std::vector<double>& times = findings[k].milliseconds;
      const double spent = 1e-3 * std::accumulate(times.begin(), times.end(), 0.0) * static_cast<double>(calls);
      if (round >= least_rounds && spent > options.seconds) continue;
      times.push_back(1e3 * time_calls(*finders[k], steps, calls, turn));
    }
  }
}

Finding finding_from(const std::string& text) {
  std::istringstream in(text);
  Finding f;
  std::int64_t bytes = 0;
  std::size_t rounds = 0;
  in >> f.finder >> f.is_exact >> f.pairs >> f.missing >> f.extra >> bytes >> rounds;
  if (bytes >= 0) f.bytes = bytes;
  for (std::size_t i = 0; i < rounds && in; ++i) {
    double t = 0;
    in >> t;
    f.milliseconds.push_back(t);
  }
  if (!in || !(in >> std::ws).eof()) throw std::runtime_error("not a finding: " + text);
  return f;
}

}  // namespace

std::vector<std::string> finders_for(std::int64_t count, const SurveyOptions& options) {
  std::vector<std::string> names = options.finders;
  std::erase_if(names, [&](const std::string& name) {
    if (name == "all_pairs" || name == "all_ordered_pairs") return count > options.loops_up_to;
    return name == "sort_and_sweep" && count > options.sweep_up_to;
  });
  return names;
}

Survey survey(const CrowdFactors& factors, const SurveyOptions& options) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  const Crowd crowd = make_crowd(factors, options.seed);
  const Steps steps = {proxies_of(crowd), proxies_of(next_step(crowd))};
  Survey result;
  std::vector<std::unique_ptr<Finder>> finders;
  std::vector<ProxyPair> truth;
  find_pairs(UniformGrid{}, steps[0], truth);
  for (const std::string& name : finders_for(factors.count, options)) {
    finders.push_back(make_finder(name));
    Finder& finder = *finders.back();
    finder.find(steps[0]);
    const std::vector<ProxyPair> found = finder.pairs();
    if (finders.size() == 1 && finder.is_exact()) truth = found;
    Finding& f = result.findings.emplace_back();
    f.finder = name;
    f.is_exact = finder.is_exact();
    f.pairs = static_cast<std::int64_t>(found.size());
    f.missing = count_in_first_only(truth, found);
    f.extra = count_in_first_only(found, truth);
  }
  result.pairs = static_cast<std::int64_t>(truth.size());
  result.meetings = count_meetings(crowd, truth);
  time_rounds(steps, options, finders, result.findings);
  for (std::size_t k = 0; k < finders.size(); ++k) {
    if (const auto bytes = finders[k]->bytes()) result.findings[k].bytes = static_cast<std::int64_t>(*bytes);
  }
  return result;
}

std::string to_line(const Survey& survey) {
  std::string line = fmt::format("{} {}", survey.pairs, survey.meetings);
  for (const Finding& f : survey.findings) {
    line += fmt::format(";{} {:d} {} {} {} {} {}", f.finder, f.is_exact, f.pairs, f.missing, f.extra,
                        f.bytes.value_or(-1), f.milliseconds.size());
    for (const double t : f.milliseconds) line += fmt::format(" {:.17g}", t);
  }
  return line;
}

Survey survey_from_line(const std::string& line) {
  Survey survey;
  std::size_t at = std::min(line.find(';'), line.size());
  std::istringstream in(line.substr(0, at));
  if (!(in >> survey.pairs >> survey.meetings)) throw std::runtime_error("not a survey: " + line);
  while (at < line.size()) {
    const std::size_t end = std::min(line.find(';', at + 1), line.size());
    survey.findings.push_back(finding_from(line.substr(at + 1, end - at - 1)));
    at = end;
  }
  return survey;
}

}  // namespace thinwall
