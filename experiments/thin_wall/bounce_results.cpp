#include <thinwall/experiments/thin_wall/bounce_results.hpp>

#include <algorithm>

#include <fmt/format.h>

#include <thinwall/experiments/statistics.hpp>
#include <thinwall/experiments/text/numbers.hpp>
#include <thinwall/experiments/thin_wall/plan.hpp>

namespace thinwall {

namespace {

/// One method at one scalar over its cells.
struct BounceTotal {
  std::string method, scalar;
  std::int64_t shots = 0, tunneled = 0, wrong_side = 0, behind = 0;
  std::int64_t theory_shots = 0, theory_through = 0;
  double theory_expected = 0;
};

std::vector<BounceTotal> bounce_totals(const std::vector<Line>& lines) {
  std::vector<BounceTotal> all;
  for (const Line& line : lines) {
    auto found = std::find_if(all.begin(), all.end(), [&](const BounceTotal& t) {
      return t.method == line.detector->method && t.scalar == line.detector->scalar;
    });
    if (found == all.end()) {
      found = all.insert(all.end(), BounceTotal{});
      found->method = line.detector->method;
      found->scalar = line.detector->scalar;
    }
    found->shots += line.tally.shots;
    found->tunneled += line.tally.tunneled;
    found->wrong_side += line.tally.wrong_side;
    found->behind += line.tally.behind;
    if (!line.theory.through) continue;
    found->theory_shots += line.tally.shots;
    found->theory_through += went_through(line.tally);
    found->theory_expected += *line.theory.through * static_cast<double>(line.tally.shots);
  }
  return all;
}

std::string percent_of(double share) { return fmt::format("{:.2f} %", 100 * share); }

std::string share_of(std::int64_t part, std::int64_t whole) {
  return percent_of(static_cast<double>(part) / static_cast<double>(whole));
}

}  // namespace

std::int64_t went_through(const Tally& tally) { return tally.tunneled + tally.wrong_side; }

std::vector<CellCount> through_counts(const std::vector<Line>& lines) {
  std::vector<CellCount> counts;
  for (const Line& line : lines) {
    if (!line.theory.through) continue;
    counts.push_back({line.detector->method, line.detector->scalar, line.tally.shots, went_through(line.tally),
                      *line.theory.through});
  }
  return counts;
}

Table bounce_table(const std::vector<Line>& lines) {
  Table table;
  table.name = "bounce";
  table.description = "What became of the balls, each method over all of its cells.";
  table.in_report = true;
  table.columns = {
      {"method", ColumnType::text, "", "Way of detecting the hit."},
      {"scalar", ColumnType::text, "", "Floating-point type the query is asked in."},
      {"shots", ColumnType::integer, "1", "Shots fired."},
      {"tunneled", ColumnType::integer, "1", "Shots that passed the wall undetected."},
      {"wrong_side", ColumnType::integer, "1",
       "Shots seen where the least penetration pushes them ahead or sideways, not back."},
      {"behind", ColumnType::integer, "1", "Shots that flew away behind the wall in the end, the tunneled included."},
      {"theory_shots", ColumnType::integer, "1", "Shots in cells with a theory of going through."},
      {"theory_through", ColumnType::integer, "1",
       "Of those, counted to tunnel or to be pushed out on the wrong side."},
      {"theory_expected", ColumnType::number, "1", "Of those, expected to."},
  };
  for (const BounceTotal& t : bounce_totals(lines)) {
    table.rows.push_back({t.method, t.scalar, t.shots, t.tunneled, t.wrong_side, t.behind, t.theory_shots,
                          t.theory_through, t.theory_expected});
  }
  return table;
}

Table bounce_self_test_table(const std::vector<SelfTest>& tests) {
  Table table = self_test_table(tests);
  table.name = "bounce_self_test";
  table.description = "Counts that went through, tunneled or pushed out on the wrong side, against theory.";
  return table;
}

bool ends_agree(const std::vector<Line>& lines) {
  return std::all_of(lines.begin(), lines.end(), [](const Line& line) {
    const bool known = line.cell->wall == Wall::infinite && line.tally.undecided == 0;
    return !known || line.tally.behind == went_through(line.tally);
  });
}

std::string bounce_text(const std::vector<Line>& lines, const std::vector<SelfTest>& tests) {
  const auto spoken = [&lines](const std::string& scalar) {
    return std::any_of(lines.begin(), lines.end(), [&](const Line& l) { return l.detector->scalar == scalar; });
  };
  const std::string scalar = spoken("double") ? "double" : "float";
  std::string text = fmt::format(
      "With a bounce, the bullet goes through unseen, or seen too late: pushed out on the wrong side.\n"
      "{:<25}{:>9} {:>10} {:>10} {:>10} {:>18} {:>10}\n",
      "method", "shots", "tunneled", "wrong side", "through", "95 % interval", "theory");
  for (const Line& line : lines) {
    if (*line.cell != bullet || line.detector->scalar != scalar) continue;
    const std::int64_t through = went_through(line.tally), shots = line.tally.shots;
    const Interval bars = wilson(through, shots);
    text += fmt::format("{:<25}{:>9} {:>10} {:>10} {:>10} {:>18} {:>10}\n", line.detector->method, grouped_text(shots),
                        share_of(line.tally.tunneled, shots), share_of(line.tally.wrong_side, shots),
                        share_of(through, shots), fmt::format("[{:.2f}, {:.2f}] %", 100 * bars.lower, 100 * bars.upper),
                        line.theory.through ? percent_of(*line.theory.through) : "-");
  }
  text += fmt::format("\nAll cells ({}). Share and theory: of the shots for which there is a formula.\n", scalar);
  text += fmt::format("{:<25}{:>11} {:>12} {:>12} {:>12} {:>10} {:>10}\n", "method", "shots", "tunneled", "wrong side",
                      "behind", "share", "theory");
  for (const BounceTotal& t : bounce_totals(lines)) {
    if (t.scalar != scalar) continue;
    const bool known = t.theory_shots > 0;
    text += fmt::format("{:<25}{:>11} {:>12} {:>12} {:>12} {:>10} {:>10}\n", t.method, grouped_text(t.shots),
                        grouped_text(t.tunneled), grouped_text(t.wrong_side), grouped_text(t.behind),
                        known ? share_of(t.theory_through, t.theory_shots) : "-",
                        known ? percent_of(t.theory_expected / static_cast<double>(t.theory_shots)) : "-");
  }
  return text + fmt::format("Self-test of the bounce: counts {}, ends {}.\n\n", all_passed(tests) ? "passed" : "FAILED",
                            ends_agree(lines) ? "passed" : "FAILED");
}

std::string bounce_answer(const std::vector<Line>& lines) {
  std::string text;
  for (const BounceTotal& t : bounce_totals(lines)) {
    if (t.scalar != lines.back().detector->scalar) continue;
    if (t.method == "end_of_step" && t.theory_shots > 0) {
      text = fmt::format(
          "Testing only the end of the step, {} of {} balls that should have bounced went through (theory {}): "
          "{} of all shots unseen, {} seen and pushed out on the wrong side. ",
          share_of(t.theory_through, t.theory_shots), grouped_text(t.theory_shots),
          percent_of(t.theory_expected / static_cast<double>(t.theory_shots)), share_of(t.tunneled, t.shots),
          share_of(t.wrong_side, t.shots));
    }
    if (t.method == "closed_form") {
      text += fmt::format("Swept with the closed form, {} of {} did.", grouped_text(t.tunneled + t.wrong_side),
                          grouped_text(t.shots));
    }
  }
  return text;
}

Section bounce_section(const std::vector<SelfTest>& tests) {
  return {
      "The bounce",
      "A ball that is seen is put where it was seen, pushed out of the wall along the normal by what it is in, and "
      "reflected if it approaches: restitution 1, the wall stays. It then flies on, asked about at every step, until it "
      "has left. The normal of a pose inside the wall is the one of least penetration: past the middle it leads "
      "ahead, and the ball goes on as if there were no wall. So testing poses a distance d apart lets max(0, 1 - (r "
      "+ w / 2) / (d cos(angle))) through: the step that is safe is half as long as the one that is always seen. At a "
      "wall that ends, a ball pushed out to a side across its motion counts as on the wrong side too.\n\nIn an "
      "infinite wall the balls that end behind it must be those that tunneled or were pushed out on the wrong "
      "side.\n\n" +
          self_test_text(tests)};
}

}  // namespace thinwall
