#include <thinwall/experiments/engines/line.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <thinwall/experiments/engines/theory.hpp>

namespace thinwall {

namespace {

/// In the order of the units.
template <class Visit> void for_each_volley(const EnginePlan& plan, const Visit& visit) {
  const std::vector<EngineVolley> volleys = engine_volleys(plan.shots);
  for (const EngineCell& cell : plan.cells) {
    for (const EngineVolley& volley : volleys) {
      for (const EngineSetup& setup : plan.setups) {
        if (setup.can_do(cell)) visit(cell, volley, setup);
      }
    }
  }
}

bool is_ours(const EngineLine& line) { return line.setup->engine.package.empty(); }

std::optional<double> mean_of(std::int64_t sum, std::int64_t count) {
  if (count == 0) return std::nullopt;
  return std::ldexp(static_cast<double>(sum), -32) / static_cast<double>(count);
}

CellCount count_of(const EngineLine& line, double theory) {
  return {line.setup->label(), "double", line.tally.shots, wrong_shots(line), theory};
}

}  // namespace

std::vector<Unit> engine_units(const EnginePlan& plan) {
  std::vector<Unit> units;
  for_each_volley(plan, [&](const EngineCell& cell, const EngineVolley& volley, const EngineSetup& setup) {
    units.push_back(
        {fmt::format("{} {} {} from {}", key(cell), setup.engine.name, setup.mode.name, volley.first), volley.shots,
         [&cell, volley, &setup, seed = plan.seed] { return to_line(fire(cell, setup.mode, volley, seed)); }});
  });
  return units;
}

std::vector<EngineLine> engine_lines(const EnginePlan& plan, const std::vector<std::string>& results) {
  std::vector<EngineLine> lines;
  for (const EngineCell& cell : plan.cells) {
    for (const EngineSetup& setup : plan.setups) {
      if (!setup.can_do(cell)) continue;
      const int poses = setup.mode.poses_per_step;
      const auto theory = poses > 0 ? std::optional(through_theory(cell, poses, setup.mode.skin)) : std::nullopt;
      lines.push_back({&cell, &setup, {}, {}, theory});
    }
  }
  std::size_t next = 0;
  for_each_volley(plan, [&](const EngineCell& cell, const EngineVolley&, const EngineSetup& setup) {
    const auto line = std::find_if(lines.begin(), lines.end(),
                                   [&](const EngineLine& l) { return l.cell == &cell && l.setup == &setup; });
    const EngineTally tally = engine_tally_from_line(results.at(next++));
    line->tally += tally;
    line->nanoseconds.push_back(1e9 * tally.seconds / static_cast<double>(tally.shots * cell.steps));
  });
  return lines;
}

double tunneled_share(const EngineLine& line) {
  return static_cast<double>(line.tally.tunneled) / static_cast<double>(line.tally.shots);
}
Interval tunneled_interval(const EngineLine& line) { return wilson(line.tally.tunneled, line.tally.shots); }
std::optional<double> mean_late(const EngineLine& line) { return mean_of(line.tally.lateness, line.tally.turned); }
std::optional<double> mean_energy(const EngineLine& line) { return mean_of(line.tally.energy, line.tally.turned); }
std::int64_t wrong_shots(const EngineLine& line) { return line.tally.shots - line.tally.kept(); }

double told_path(const std::vector<EngineLine>& lines) {
  double told = lines.front().cell->path;
  for (const EngineLine& line : lines) {
    if (std::abs(std::log(line.cell->path)) < std::abs(std::log(told))) told = line.cell->path;
  }
  return told;
}

std::vector<EngineLine> lines_at(const std::vector<EngineLine>& lines, double path, double wall_size) {
  std::vector<EngineLine> some;
  for (const EngineLine& line : lines) {
    if (line.cell->path == path && line.cell->wall_size == wall_size) some.push_back(line);
  }
  return some;
}

std::vector<EngineLine> lines_of(const std::vector<EngineLine>& lines, const std::string& label, double wall_size) {
  std::vector<EngineLine> some;
  for (const EngineLine& line : lines) {
    if (line.setup->label() == label && line.cell->wall_size == wall_size) some.push_back(line);
  }
  return some;
}

std::vector<double> wall_sizes(const std::vector<EngineLine>& lines) {
  std::vector<double> sizes;
  for (const EngineLine& line : lines) {
    if (sizes.empty() || sizes.back() != line.cell->wall_size) sizes.push_back(line.cell->wall_size);
  }
  return sizes;
}

std::vector<std::string> labels_of(const std::vector<EngineLine>& lines) {
  std::vector<std::string> labels;
  for (const EngineLine& line : lines) {
    if (std::find(labels.begin(), labels.end(), line.setup->label()) == labels.end()) {
      labels.push_back(line.setup->label());
    }
  }
  return labels;
}

double safe_up_to(const std::vector<EngineLine>& lines, const std::string& label, double wall_size) {
  double safe = 0;
  for (const EngineLine& line : lines_of(lines, label, wall_size)) {
    if (wrong_shots(line) > 0) break;
    safe = line.cell->path;
  }
  return safe;
}

std::vector<CellCount> own_counts(const std::vector<EngineLine>& lines) {
  std::vector<CellCount> counts;
  for (const EngineLine& line : lines) {
    if (!is_ours(line)) continue;
    const bool first_wall = line.cell->wall_size == lines.front().cell->wall_size;
    if (line.theory && first_wall) counts.push_back(count_of(line, *line.theory));
    if (line.setup->mode.exact) counts.push_back(count_of(line, 0));
  }
  return counts;
}

std::vector<EngineAgreement> peer_agreement(const std::vector<EngineLine>& lines) {
  std::vector<EngineAgreement> all;
  for (const std::string& label : labels_of(lines)) {
    EngineAgreement agreement = {.label = label};
    for (const EngineLine& line : lines_of(lines, label, lines.front().cell->wall_size)) {
      if (is_ours(line) || !line.theory) continue;
      ++agreement.cells;
      if (tunneled_interval(line).contains(*line.theory)) ++agreement.covered;
      const double excess = tunneled_share(line) - *line.theory;
      if (std::abs(excess) <= std::abs(agreement.largest_excess)) continue;
      agreement.largest_excess = excess;
      agreement.at_path = line.cell->path;
    }
    if (agreement.cells > 0) all.push_back(std::move(agreement));
  }
  return all;
}

}  // namespace thinwall
