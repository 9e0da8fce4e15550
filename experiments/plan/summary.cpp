#include <algorithm>

#include <fmt/format.h>

#include <thinwall/experiments/plan/report.hpp>
#include <thinwall/experiments/text/numbers.hpp>

namespace thinwall {

namespace {

constexpr double noise = 0.02;  // [1] of a step's time: less is not called a saving in words

/// Ways that omit or keep, over all scenes, and those of other bits.
std::pair<std::int64_t, std::int64_t> count_wrong(const std::vector<PlanRace>& races) {
  std::int64_t ways = 0, wrong = 0;
  for (const PlanRace& race : races) {
    for (const Way& way : race.ways) {
      if (way.name == gate_way || way.name == lean_way) continue;
      ++ways;
      wrong += way.repeated_alike && way.outcome == race.ways.front().outcome ? 0 : 1;
    }
  }
  return {ways, wrong};
}

std::int64_t early_meetings(const std::vector<GateLine>& shots) {
  std::int64_t early = 0;
  for (const GateLine& line : shots) early += line.tally.early;
  return early;
}

std::string self_test_words(const PlanResults& results) {
  const auto [ways, wrong] = count_wrong(results.races);
  std::string words = fmt::format("same bits as with the plan in {} of {} ways to step; ", ways - wrong, ways);
  for (const SelfTest& test : gate_self_test(results.shots)) {
    words +=
        fmt::format("{}: {} cells certain, {} of them wrong, {} of {} others hold the theory ({:g} to {:g} allowed); ",
                    test.method, test.certain_cells, test.certain_wrong, test.covered, test.judged_cells,
                    test.covered_allowed.lower, test.covered_allowed.upper);
  }
  return words + fmt::format("{} meetings told early", early_meetings(results.shots));
}

std::string kilobytes(std::int64_t bytes) { return rounded_text(1e-3 * static_cast<double>(bytes), 3); }

std::string race_text(const PlanRace& race) {
  std::string text = fmt::format("{}: {} bodies, {} steps\n{:<28}{:>11}{:>9}{:>12}{:>10}{:>12}{:>9}{:>7}\n", race.scene,
                                 grouped_text(race.bodies), grouped_text(race.steps), "", "ms a step", "x plan",
                                 "sweeps", "kB", "hits", "tunnel", "same");
  for (const Way& way : race.ways) {
    const bool is_judged = way.name == lean_way || way.name == gate_way;
    text += fmt::format(
        "{:<28}{:>11}{:>9}{:>12}{:>10}{:>12}{:>9}{:>7}\n",
        way.name == lean_way || way.name == full_way || way.name == gate_way ? way.name : "- " + way.name,
        rounded_text(median(way.milliseconds), 3), rounded_text(saved_by(race, way).ratio, 3), grouped_text(way.sweeps),
        kilobytes(way.bytes), grouped_text(way.hits), is_judged ? grouped_text(way.tunneled) : "",
        way.outcome == race.ways.front().outcome ? "yes" : "no");
  }
  return text + "\n";
}

std::string shots_text(const std::vector<GateLine>& shots) {
  std::string text =
      fmt::format("Shots and the gate: missed of {}, theory in parentheses\n{:<16}{:>8}{:>22}{:>22}{:>14}\n",
                  shots.empty() ? "0" : grouped_text(shots.front().cell.shots), "path [radii]", "gate", "at a wall",
                  "at a ball", "late [steps]");
  for (std::size_t i = 0; i + 1 < shots.size(); i += 2) {
    const GateLine &wall = shots[i], &ball = shots[i + 1];
    if (wall.cell.path > wall.cell.gate) continue;  // all are swept
    const auto missed = [](const GateLine& line) {
      return fmt::format("{} ({})", grouped_text(line.tally.missed),
                         rounded_text(missed_by_gate(line.cell) * static_cast<double>(line.cell.shots), 4));
    };
    text += fmt::format("{:<16}{:>8}{:>22}{:>22}{:>14}\n", rounded_text(wall.cell.path, 4),
                        rounded_text(wall.cell.gate, 4), missed(wall), missed(ball), rounded_text(wall.tally.late, 2));
  }
  return text;
}

/// The omission that saves most of this scene, or null.
const Way* best_omission(const PlanRace& race) {
  const Way* best = nullptr;
  for (const Way& way : race.ways) {
    if (way.name == lean_way || way.name == full_way || way.name == gate_way) continue;
    if (best == nullptr || saved_by(race, way).ratio > saved_by(race, *best).ratio) best = &way;
  }
  return best;
}

}  // namespace

std::vector<SelfTest> gate_self_test(const std::vector<GateLine>& shots) {
  std::vector<CellCount> cells;
  for (const GateLine& line : shots) {
    const CellCount cell{"gate at a " + gate_target_name(line.cell.target), "double", line.cell.shots,
                         line.tally.missed, missed_by_gate(line.cell)};
    const auto same = [&](const GateLine& other) {  // the shots of a path are the same at every gate: one counts
      return &other < &line && other.cell.target == line.cell.target && other.cell.path == line.cell.path &&
             other.cell.path <= other.cell.gate && line.cell.path <= line.cell.gate;
    };
    if (std::none_of(shots.begin(), shots.end(), same)) cells.push_back(cell);
  }
  return self_test(cells);
}

bool all_right(const PlanResults& results) {
  const auto missed = [](const GateLine& line) { return line.tally.missed_swept; };
  return std::all_of(results.races.begin(), results.races.end(), is_right) &&
         all_passed(gate_self_test(results.shots)) && early_meetings(results.shots) == 0 &&
         std::all_of(results.shots.begin(), results.shots.end(), [&](const GateLine& l) { return missed(l) == 0; });
}

std::string plan_answer(const PlanResults& results) {
  const auto [ways, wrong] = count_wrong(results.races);
  std::string text =
      wrong == 0 ? fmt::format("No omission changes a bit, in {} ways to step {} scenes.", ways, results.races.size())
                 : fmt::format("{} of {} ways to step change the outcome.", wrong, ways);
  for (const PlanRace& race : results.races) {
    const Way* const best = best_omission(race);
    const Way* const full = way_named(race, full_way);
    if (best == nullptr || full == nullptr) continue;
    text += fmt::format(" {}: {} times as long without any omission", race.scene,
                        rounded_text(saved_by(race, *full).ratio, 3));
    if (const Saved saved = saved_by(race, *best); saved.ratio > 1 + noise) {
      text +=
          fmt::format(", {} times with the omission of {} alone taken back", rounded_text(saved.ratio, 3), best->name);
    }
    text += ".";
  }
  for (const PlanRace& race : results.races) {
    const Way* const gate = way_named(race, gate_way);
    if (gate == nullptr || 2 * gate->gated < gate->sweeps || gate->gated == 0) continue;
    text += fmt::format(
        " The gate of {} spares {} of {} sweeps and {:.0f} % of the time, for {} hits instead of {} and {} pairs "
        "that pass through each other.",
        race.scene, grouped_text(gate->gated), grouped_text(gate->sweeps), 100 * (1 - saved_by(race, *gate).ratio),
        grouped_text(gate->hits), grouped_text(race.ways.front().hits), grouped_text(gate->tunneled));
  }
  return text;
}

std::string plan_summary(const PlanResults& results) {
  std::string text;
  for (const PlanRace& race : results.races) text += race_text(race);
  text += shots_text(results.shots);
  return text + fmt::format("\nSelf-test {}.\n", all_right(results) ? "passed" : "FAILED");
}

std::vector<Section> plan_sections(const PlanResults& results) {
  return {
      {"What is compared",
       "Each scene is stepped with its plan, then with each single omission of the plan taken back, then with the full plan, which "
       "omits nothing. Every round takes all ways in turn. Time is the processor's for this thread, within steps alone, on one "
       "thread; memory is what stepping holds at most, without the broad phase's own."},
      {"Self-test", "The states after each step, and every hit and event that was asked for, to the bit: " +
                        self_test_words(results) + "."},
      {"The gate",
       "With a gate g a pair is not swept if neither body moves more than g times its least half width in the step; it is looked at "
       "where the step starts. That is no omission. The shots say what it misses where nobody is stopped, against theory; the scenes "
       "what it does to all that follows. In scenes that bounce any two runs part after the first difference, so that counts of "
       "hits differ for that alone."},
      {"Limits",
       "What an omission saves is measured with all others in place. Savings do not add up: who keeps disjoint boxes sweeps all "
       "pairs, and the full plan those of static and masked bodies too. A saving of few percent is within what the machine's caches "
       "and neighbors do."},
  };
}

}  // namespace thinwall
