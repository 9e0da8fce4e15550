#include <thinwall/experiments/swept_bounds/timing.hpp>

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace thinwall {

namespace {

constexpr std::array works = {TimedWork::build, TimedWork::test, TimedWork::exact, TimedWork::pipeline};
constexpr std::array work_names = {"build", "test", "exact", "pipeline"};
constexpr int balls_in_question = 2048, tests_a_round = 1 << 13;

/// Where the centers of balls are whose bounding box overlaps that of the swept shape.
BallRegion box_pairs(const Sweep& s) {
  const FittedBody box = enclosing_aabb_body(s);
  BallRegion region = {path(s) / 2, box.axes, {}};
  for (int i = 0; i < 3; ++i) region.half_extents[i] = half_width(box.body, box.axes.col(i)) + ball_radius(s);
  return region;
}

double share(std::size_t part, std::size_t whole) { return static_cast<double>(part) / static_cast<double>(whole); }

/// The value below which `part` of the rounds lie, straight between neighbors.
double quantile(std::vector<double> rounds, double part) {
  std::sort(rounds.begin(), rounds.end());
  const double place = part * static_cast<double>(rounds.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, rounds.size() - 1);
  return rounds[below] + (rounds[above] - rounds[below]) * (place - static_cast<double>(below));
}

void note(SweepCost& cost, TimedWork work, const std::vector<double>& rounds) {
  switch (work) {
    case TimedWork::build: cost.build_ns = quantile(rounds, 0.5); break;
    case TimedWork::test: cost.test_ns = quantile(rounds, 0.5); break;
    case TimedWork::exact: cost.false_ns = quantile(rounds, 0.5); break;
    case TimedWork::pipeline:
      cost.pair_ns = quantile(rounds, 0.5);
      cost.pair_lower_ns = quantile(rounds, 0.25);
      cost.pair_upper_ns = quantile(rounds, 0.75);
      break;
  }
}

}  // namespace

std::vector<TimedSubject> timed_subjects(const std::vector<Sweep>& sweeps, const std::vector<SweptBound>& bounds,
                                         std::uint64_t seed) {
  std::vector<TimedSubject> subjects;
  for (const SweepPair& pair : serving_pairs(sweeps, bounds)) {
    const Sweep& s = pair.sweep;
    const BallRegion region = box_pairs(s);
    const RandomStream stream = random_stream(s, seed);
    std::vector<Sphere<double>> all, wrong;
    std::size_t reported = 0;
    for (std::uint64_t i = 0; i < balls_in_question; ++i) {
      all.push_back(ball_in(region, s, stream, i));
      if (!pair.bound->reports(s, all.back())) continue;
      ++reported;
      if (!touches(s, all.back().center)) wrong.push_back(all.back());
    }
    for (const TimedWork work : works) {
      const std::vector<Sphere<double>>& balls = work == TimedWork::exact ? wrong : all;
      if (balls.empty()) continue;
      const int passes = std::max(1, tests_a_round / static_cast<int>(balls.size()));
      subjects.push_back({pair, work, balls, passes, share(reported, all.size()), share(wrong.size(), all.size())});
    }
  }
  return subjects;
}

std::vector<Unit> timing_units(const std::vector<TimedSubject>& subjects, std::int64_t repeats) {
  std::vector<Unit> units;
  for (std::int64_t round = 0; round < repeats; ++round) {
    for (const TimedSubject& t : subjects) {
      units.push_back({fmt::format("time {} {} {} {}", round, key(t.pair.sweep), t.pair.bound->name,
                                   work_names[static_cast<std::size_t>(t.work)]),
                       t.tests(),
                       [&t] { return std::to_string(t.pair.bound->repeat(t.work, t.pair.sweep, t.balls, t.passes)); }});
    }
  }
  return units;
}

std::vector<SweepCost> sweep_costs(const std::vector<TimedSubject>& subjects, std::span<const double> seconds) {
  std::vector<SweepCost> costs;
  if (seconds.empty()) return costs;
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    const TimedSubject& t = subjects[i];
    if (costs.empty() || costs.back().sweep != t.pair.sweep || costs.back().bound != t.pair.bound->name) {
      costs.push_back({t.pair.sweep, t.pair.bound->name, t.reported, t.false_hits, 0, 0, {}, 0, 0, 0});
    }
    std::vector<double> rounds;
    for (std::size_t k = i; k < seconds.size(); k += subjects.size()) {
      rounds.push_back(1e9 * seconds[k] / static_cast<double>(t.tests()));
    }
    note(costs.back(), t.work, rounds);
  }
  return costs;
}

Table sweep_timings_table(const std::vector<SweepCost>& costs) {
  using enum ColumnType;
  Table table;
  table.name = "timings";
  table.description =
      "What each bound costs among the pairs that a broad phase of boxes hands over: medians over rounds, on this machine.";
  table.is_timing = table.in_report = true;
  table.columns = {
      {"shape", text, "", "What moves."},
      {"speed", number, "m/s", "Its speed."},
      {"path", number, "widths", "How far it moves in a step."},
      {"bound", text, "", "What stands for the volume it sweeps."},
      {"reported", number, "1", "Share of the pairs that it reports."},
      {"false_hits", number, "1", "Share of the pairs that it reports although they do not touch."},
      {"build_ns", number, "ns", "Time to make the bound, once a shape and step."},
      {"test_ns", number, "ns", "Time to put a pair to it."},
      {"false_ns", number, "ns", "Time of the closed form on one of its false hits; missing if there are none."},
      {"wasted_ns", number, "ns", "false_hits * false_ns: time a pair that false hits cost."},
      {"pair_ns", number, "ns", "Time a pair, the bound first and then the closed form on those reported."},
      {"pair_lower_ns", number, "ns", "Lower quartile of the rounds."},
      {"pair_upper_ns", number, "ns", "Upper quartile of them."},
  };
  for (const SweepCost& c : costs) {
    table.rows.push_back({std::string(name(c.sweep.form)), c.sweep.speed, path_in_widths(c.sweep), c.bound, c.reported,
                          c.false_hits, c.build_ns, c.test_ns, c.false_ns ? Value(*c.false_ns) : Value(), c.wasted_ns(),
                          c.pair_ns, c.pair_lower_ns, c.pair_upper_ns});
  }
  return table;
}

}  // namespace thinwall
