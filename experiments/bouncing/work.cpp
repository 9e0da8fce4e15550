#include <thinwall/experiments/bouncing/work.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace thinwall {

namespace {

constexpr std::int64_t even_phases = 32;
constexpr double steps_a_round = 1 << 14;  // less than a millisecond: most rounds are not interrupted

}  // namespace

std::int64_t BounceSubject::bounces() const { return even_phases * passes; }

double BounceWork::mean_error() const { return errors.mean * delta(cell); }
double BounceWork::rms_error() const { return errors.rms() * delta(cell); }

std::vector<BounceSubject> bounce_subjects(const std::vector<BounceCell>& cells,
                                           const std::vector<BouncePolicy>& policies) {
  std::vector<BounceSubject> subjects;
  double last = 0;
  for (BounceCell cell : cells) {  // cells of a step lie together
    if (cell.step == last) continue;
    last = cell.step;
    cell.restitution = 1;
    const double steps = 2 / delta(cell) * static_cast<double>(even_phases);
    for (const BouncePolicy& policy : policies) {
      subjects.push_back({policy, cell, std::max(1, static_cast<int>(steps_a_round / steps))});
    }
  }
  return subjects;
}

std::vector<Unit> bounce_timing_units(const std::vector<BounceSubject>& subjects, std::int64_t rounds) {
  std::vector<Unit> units;
  for (std::int64_t round = 0; round < rounds; ++round) {
    for (const BounceSubject& s : subjects) {
      units.push_back({fmt::format("time {} {} {}", round, key(s.cell), s.policy.name), s.bounces(), [&s] {
                         BounceTally tally;
                         for (int pass = 0; pass < s.passes; ++pass)
                           tally = even_bounces(s.policy, s.cell, even_phases);
                         return to_line(tally);
                       }});
    }
  }
  return units;
}

std::vector<BounceWork> bounce_work(const std::vector<BounceSubject>& subjects, std::span<const std::string> results,
                                    std::span<const double> seconds) {
  std::vector<BounceWork> work;
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    const BounceSubject& s = subjects[i];
    std::vector<double> rounds;
    for (std::size_t k = i; k < seconds.size(); k += subjects.size()) {
      rounds.push_back(1e9 * seconds[k] / static_cast<double>(s.bounces()));
    }
    const std::array<double, 1> factors = {static_cast<double>(i)};
    work.push_back({s.policy.name, s.cell, bounce_tally_from_line(results[i]), median(rounds),
                    bootstrap_median(rounds, {0, stream_of(factors)})});
  }
  return work;
}

}  // namespace thinwall
