#include <algorithm>

#include <fmt/format.h>

#include <thinwall/experiments/engines/report.hpp>
#include <thinwall/experiments/text/numbers.hpp>

namespace thinwall {

namespace {

std::string engine_percent(double share) { return fmt::format("{:.3g} %", 100 * share); }

std::string with_interval(const EngineLine& line) {
  const Interval i = tunneled_interval(line);
  return fmt::format("{} {:.3g} % [{:.3g}, {:.3g}]", line.setup->label(), 100 * tunneled_share(line), 100 * i.lower,
                     100 * i.upper);
}

std::string listed(const std::vector<std::string>& parts) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) text += i + 1 < parts.size() ? ", " : " and ";
    text += parts[i];
  }
  return text;
}

/// One row an engine and mode, one column a path.
std::string percent_matrix(const std::vector<EngineLine>& lines, double wall_size) {
  std::vector<double> paths;
  for (const EngineLine& line : lines) {
    if (std::find(paths.begin(), paths.end(), line.cell->path) == paths.end()) paths.push_back(line.cell->path);
  }
  constexpr std::size_t most_columns = 12;
  const std::size_t shown = std::min(paths.size(), most_columns);
  std::string text =
      fmt::format("Percent through a wall {} m wide, against meters a step\n{:<23}", wall_size, "engine and mode");
  for (std::size_t i = 0; i < shown; ++i) text += fmt::format("{:>6}", rounded_text(paths[i], 3));
  text += "\n";
  for (const std::string& label : labels_of(lines)) {
    text += fmt::format("{:<23}", label);
    const std::vector<EngineLine> some = lines_of(lines, label, wall_size);
    for (std::size_t i = 0; i < shown; ++i) {
      const auto line =
          std::find_if(some.begin(), some.end(), [&](const EngineLine& l) { return l.cell->path == paths[i]; });
      const bool none = line != some.end() && line->tally.tunneled == 0;
      text += fmt::format("{:>6}", line == some.end() ? "-"
                                   : none             ? "0"
                                                      : fmt::format("{:.1f}", 100 * tunneled_share(*line)));
    }
    text += "\n";
  }
  if (paths.size() > shown) text += "Longer paths are in data/cells.csv.\n";
  return text;
}

/// What became of those that no theory speaks of, at the path that is told.
std::string bounce_text(const EngineLine& line) {
  const auto late = mean_late(line), energy = mean_energy(line);
  if (!late || !energy) return "";
  return fmt::format("{:<23}{:>10.4f}{:>10.4f}{:>10.4f}{:>10.4f}{:>10.4f}\n", line.setup->label(), *late,
                     line.tally.latest, *energy, line.tally.least_energy, line.tally.most_energy);
}

/// All modes and walls get the same shots: those of one are all there are.
std::string own_zero(const std::vector<EngineLine>& lines) {
  std::int64_t shots = 0, wrong = 0;
  std::vector<std::string> modes;
  for (const std::string& label : labels_of(lines)) {
    const std::vector<EngineLine> some = lines_of(lines, label, lines.front().cell->wall_size);
    if (!some.front().setup->mode.exact) continue;
    modes.push_back(label);
    shots = 0;
    for (const EngineLine& line : some) shots += line.tally.shots;
  }
  for (const EngineLine& line : lines) wrong += line.setup->mode.exact ? wrong_shots(line) : 0;
  if (modes.empty()) return "";
  if (wrong > 0)
    return fmt::format(" {} let {} shots through: the self-test fails.", listed(modes), grouped_text(wrong));
  return fmt::format(" {} let none of {} shots through: the chance of one is below {} (95 %, Clopper-Pearson).",
                     listed(modes), grouped_text(shots), engine_percent(clopper_pearson(0, shots).upper));
}

std::string agreement_text(const std::vector<EngineLine>& lines) {
  std::string text;
  for (const EngineAgreement& a : peer_agreement(lines)) {
    text += fmt::format(
        "\n\n{}: theory lies in {} of {} intervals of 95 %; the largest difference is {:+.2f} points, at {} m.",
        a.label, a.covered, a.cells, 100 * a.largest_excess, a.at_path);
  }
  return text.empty() ? ""
                      : "\n\nThe same theory and the engines of others, which the self-test does not judge:" + text;
}

}  // namespace

std::string engines_answer(const std::vector<EngineLine>& lines) {
  const double path = told_path(lines);
  const std::vector<double> walls = wall_sizes(lines);
  std::vector<std::string> poses, safe, unsafe;
  std::optional<double> theory;
  for (const EngineLine& line : lines_at(lines, path, walls.front())) {
    const EngineMode& mode = line.setup->mode;
    if (mode.poses_per_step == 1) poses.push_back(with_interval(line));
    if (mode.poses_per_step == 1 && mode.skin == 0) theory = line.theory;
  }
  for (const std::string& label : labels_of(lines)) {
    std::vector<EngineLine> wrong;
    bool sweeps = false;
    for (const double wall : walls) {
      for (const EngineLine& line : lines_of(lines, label, wall)) {
        sweeps = line.setup->mode.poses_per_step == 0 && !line.setup->mode.exact;
        if (wrong_shots(line) > 0) wrong.push_back(line);
      }
    }
    if (!sweeps) continue;
    if (wrong.empty()) safe.push_back(label);
    const auto worst = std::max_element(wrong.begin(), wrong.end(), [](const EngineLine& a, const EngineLine& b) {
      return wrong_shots(a) < wrong_shots(b);
    });
    if (worst != wrong.end()) {
      unsafe.push_back(fmt::format("{} (at {} m, wall {} m wide)", with_interval(*worst), worst->cell->path,
                                   worst->cell->wall_size));
    }
  }
  std::string text;
  if (!poses.empty()) {
    text =
        fmt::format("At {} m a step, looking at the poses of a step's end, go through (95 %): {}", path, listed(poses));
    text += theory ? fmt::format("; theory says {}.", engine_percent(*theory)) : ".";
  }
  if (!safe.empty()) text += fmt::format(" Sweeping, {} let none of these shots through.", listed(safe));
  if (!unsafe.empty()) text += fmt::format(" Others that sweep do, at worst: {}.", listed(unsafe));
  text += own_zero(lines);
  return text.starts_with(' ') ? text.substr(1) : text;
}

std::string engines_summary(const EnginePlan& plan, const std::vector<EngineLine>& lines) {
  std::string text;
  for (const double wall_size : wall_sizes(lines)) text += percent_matrix(lines, wall_size) + "\n";
  const double path = told_path(lines), wall = wall_sizes(lines).front();
  text += fmt::format(
      "At {} m a step, wall {} m wide, of the balls that turned: lateness in steps, energy after / before\n"
      "{:<23}{:>10}{:>10}{:>10}{:>10}{:>10}\n",
      path, wall, "engine and mode", "late mean", "late most", "energy", "least", "most");
  for (const EngineLine& line : lines_at(lines, path, wall)) text += bounce_text(line);
  text += fmt::format("\nSelf-test of ours: {}.\n", all_passed(self_test(own_counts(lines))) ? "passed" : "FAILED");
  for (const std::string& missing : missing_engines(plan)) text += missing + ".\n";
  return text;
}

std::vector<Section> engines_sections(const EnginePlan& plan, const std::vector<EngineLine>& lines) {
  const EngineCell& cell = plan.cells.front();
  std::string setups, missing;
  const Engine* last = nullptr;
  for (const EngineSetup& setup : plan.setups) {
    if (last == nullptr || last->name != setup.engine.name) {
      setups += fmt::format("{}{}: {}", setups.empty() ? "" : "\n\n", setup.engine.called, setup.engine.made_of);
      if (!setup.engine.why_most_path.empty()) {
        setups += fmt::format(" It moves nothing further than {} m in a step ({}): longer paths are left out.",
                              setup.engine.most_path, setup.engine.why_most_path);
      }
    }
    last = &setup.engine;
    setups += fmt::format(" Mode {}: {}.", setup.mode.name, setup.mode.what);
  }
  for (const std::string& line : missing_engines(plan)) missing += fmt::format("{}.\n\n", line);
  return {
      {"What is fired",
       fmt::format(
           "A ball of radius {} m flies at a wall {} m thick, in steps of {:.6g} s, at an angle of incidence that is uniform "
           "between 0 and {} deg. Where in a step it touches is uniform, too. Restitution is 1; there is no gravity, friction or "
           "damping. Each shot has a world of its own, in which nothing else ever was; every engine and mode gets the same shots, "
           "whatever the width of the wall.\n\nA shot is followed for {} steps; the ball touches in the first two. It tunneled if "
           "its center is beyond the wall then: a ball that an engine pushes out on the wrong side has tunneled as well as one "
           "that it never saw.",
           cell.radius, cell.thickness, cell.step, cell.angle_deg, cell.steps)},
      {"The engines", missing + setups},
      {"Oracle",
       "Every shot hits the wall, and when is known from Newton's method on the distance, which shares no code with any engine. So an "
       "engine is right where each ball ends in front of the wall."},
      {"Lateness and energy",
       "No engine is asked when it saw a contact; the flight tells. The lines of flight before and after the bounce, normal to the "
       "wall, meet at some time: of a ball that turns in an instant, when it turned. Lateness is that time less the oracle's, in steps. A "
       "ball that is turned where a pose was seen in the wall is late by the path from first contact to there. One that is pushed out as it is turned, or "
       "stopped at the wall for the rest of the step, is late by half as much. The energy ratio is the kinetic "
       "energy at the end over that at the start. Both are of the balls that turned alone."},
      {"Theory",
       "An engine that looks at poses does not see a ball that skips the wall, and pushes out ahead what it first sees when the "
       "center is past the wall's middle. The chance is the mean over the angles a of max(0, 1 - (r + w/2) / (v h cos a)), and of those "
       "never seen max(0, 1 - (2r + w) / (v h cos a)): docs/tunneling_theory.md and docs/engines.md."},
      {"Self-test",
       "Ours must let no ball through where it sweeps, and as many as theory says where it looks at poses.\n\n" +
           self_test_text(self_test(own_counts(lines))) + agreement_text(lines)},
      {"Limits",
       "One ball, one wall, one machine, the engines' versions as the manifest names them, at their defaults but for what "
       "is said above. An engine with other settings is another one. A world of two bodies is all overhead: the times say little about "
       "large scenes."},
  };
}

}  // namespace thinwall
