#include <thinwall/experiments/broad_phase/survey.hpp>

#include <algorithm>
#include <array>
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

constexpr std::int64_t least_rounds = 3;

using Steps = std::array<std::vector<Proxy>, 2>;

void time_rounds(const Steps& steps, const SurveyOptions& options, std::vector<std::unique_ptr<Finder>>& finders,
                 std::vector<Finding>& findings) {
  for (std::int64_t round = 0; round < options.rounds; ++round) {
    for (std::size_t k = 0; k < finders.size(); ++k) {
      std::vector<double>& times = findings[k].milliseconds;
      if (round >= least_rounds && std::accumulate(times.begin(), times.end(), 0.0) > 1e3 * options.seconds) continue;
      const double start = thread_seconds();
      finders[k]->find(steps[static_cast<std::size_t>((round + 1) % 2)]);  // the first step was taken to warm up
      times.push_back(1e3 * (thread_seconds() - start));
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
