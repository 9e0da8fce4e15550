#include <thinwall/experiments/thin_wall/line.hpp>

#include <thinwall/experiments/self_test.hpp>

namespace thinwall {

std::optional<double> lateness_mean(const Line& line) {
  const std::int64_t detected = line.tally.detected();
  if (detected == 0) return std::nullopt;
  return static_cast<double>(line.tally.lateness) * line.lateness_unit / static_cast<double>(detected);
}

double probability(const Line& line) {
  return static_cast<double>(line.tally.tunneled) / static_cast<double>(line.tally.shots);
}

Interval interval(const Line& line) { return wilson(line.tally.tunneled, line.tally.shots); }

std::optional<double> residual(const Line& line) {
  const std::optional<double>& p = line.theory.probability;
  if (!p || *p <= 0 || *p >= 1) return std::nullopt;
  return standard_residual(line.tally.tunneled, line.tally.shots, *p);
}

bool can_be_judged(const Line& line) {
  return residual(line).has_value() && can_be_judged(line.tally.shots, *line.theory.probability);
}

std::vector<Line> make_lines(const ShotPlan& plan, const std::vector<Tally>& tallies,
                             const std::vector<double>& seconds) {
  std::vector<Line> lines;
  lines.reserve(tallies.size());
  for (const Cell& cell : plan.cells) {
    const Target fired = target(cell);
    const double ratio = step_length(cell) / slab_chord(cell);
    for (const Detector& detector : plan.detectors) {
      const std::size_t i = lines.size();
      // A time in [0, 1] is rounded once, and so are a few coordinates as large as a step, a chord or the wall; or the time
      // backs off by as much, so as not to be late.
      const double resolution = 32 * detector.round_off * (fired.step_length + slab_chord(cell) + cell.wall_size);
      lines.push_back(
          {&cell, &detector, detector.theory(cell), tallies[i], ratio, fired.lateness_unit, resolution, seconds[i]});
    }
  }
  return lines;
}

}  // namespace thinwall
