#include <thinwall/experiments/hitscan/summary.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include <fmt/format.h>

#include <thinwall/experiments/text/numbers.hpp>

namespace thinwall {

namespace {

std::string percent(const std::optional<double>& x) { return x ? fmt::format("{:.1f} %", 100 * *x) : "-"; }
std::string percent(double part, std::int64_t whole) {
  return whole > 0 ? percent(part / static_cast<double>(whole)) : "-";
}
std::string percent(std::int64_t part, std::int64_t whole) { return percent(static_cast<double>(part), whole); }
std::string meters(double x) { return rounded_text(x, 3) + " m"; }

std::string known_answer(const std::vector<HitscanLine>& lines) {
  std::string text;
  for (const HitscanLine& l : lines) {
    if (l.rule.name != hitscan_ray.name || !is_known(l.cell)) continue;
    text += fmt::format("{}{} with a {} (theory {}, the arc {} off the line of fire)",
                        text.empty() ? "Of the true hits the ray misses " : ", ", percent(missed_share(l)),
                        known_name(l.cell), percent(missed_share_theory(l)), meters(deflection(l.cell)));
  }
  return text.empty() ? text : text + ". ";
}

/// The lines of hitscan whose bullet has that radius, of the settings' cells.
std::vector<HitscanLine> ray_lines(const std::vector<HitscanLine>& lines, bool smallest) {
  std::vector<HitscanLine> rays;
  std::copy_if(lines.begin(), lines.end(), std::back_inserter(rays), [](const HitscanLine& l) {
    return l.rule.name == hitscan_ray.name && !is_known(l.cell) && l.tally.touching > 0;
  });
  if (rays.empty()) return rays;
  const auto [least, most] = std::minmax_element(
      rays.begin(), rays.end(), [](const auto& a, const auto& b) { return a.cell.radius < b.cell.radius; });
  const double radius = (smallest ? least : most)->cell.radius;
  std::erase_if(rays, [&](const HitscanLine& l) { return l.cell.radius != radius; });
  return rays;
}

/// From when on the ray is no longer good, and what its lack of a radius costs.
std::string ray_answer(const std::vector<HitscanLine>& lines) {
  std::string text;
  double good = 0, bad = std::numeric_limits<double>::infinity();
  const auto thin = ray_lines(lines, true), thick = ray_lines(lines, false);
  for (const HitscanLine& l : thin) {
    if (*missed_share(l) < 0.05) good = std::max(good, flight_time(l.cell));
    if (*missed_share(l) > 0.5) bad = std::min(bad, flight_time(l.cell));
  }
  if (0 < good && good < bad) {
    text += fmt::format(
        "The flight time decides: of bullets of radius {:g} mm the ray misses less than 5 % in flights of up to {} s",
        1e3 * thin.front().cell.radius, rounded_text(good, 2));
    if (std::isfinite(bad)) text += fmt::format(" and more than half from {} s on", rounded_text(bad, 2));
    text += ". ";
  }
  double least = 1;
  for (const HitscanLine& l : thick) least = std::min(least, *missed_share(l));
  if (!thick.empty() && thick.front().cell.radius > 0) {
    text += fmt::format("It has no radius: of the hits of a bullet of {:g} mm it misses {} and more. ",
                        1e3 * thick.front().cell.radius, percent(least));
  }
  return text;
}

std::string total_answer(const HitscanTotal& t) {
  if (t.rule.name == next_frame.name && t.timed > 0) {
    return fmt::format(
        "A ray along each step that reports at the next frame is {:.2f} of a step late on average and {:.2f} at most; it "
        "misses {} of the true hits, and {} of its own are false. ",
        t.late_steps / static_cast<double>(t.timed), t.latest, percent(t.missed, t.touching),
        percent(t.false_hits, t.reported));
  }
  if (t.rule.name == swept_steps.name) {
    return fmt::format(
        "The ball swept along each step is wrong on {} of {} shots and at most {} off the arc at the range.",
        grouped_text(t.missed + t.false_hits), grouped_text(t.shots), meters(t.path_error_most));
  }
  return "";
}

constexpr const char* layout = "{:<14}{:>12} {:>10} {:>8} {:>8} {:>8} {:>8} {:>11} {:>10}\n";

std::string header() {
  return fmt::format(fmt::runtime(layout), "rule", "true hits", "missed", "share", "theory", "false", "theory",
                     "off [m]", "late");
}

std::string row(const HitscanLine& l) {
  const auto late = mean_lateness(l);
  return fmt::format(fmt::runtime(layout), l.rule.name, grouped_text(l.tally.touching), grouped_text(l.tally.missed),
                     percent(missed_share(l)), percent(missed_share_theory(l)), percent(false_share(l)),
                     percent(false_share_theory(l)), rounded_text(mean_path_error(l), 3),
                     late ? fmt::format("{:.3f}", *late / l.cell.step) : "-");
}

std::string row(const HitscanTotal& t) {
  const auto late = t.late_steps / static_cast<double>(std::max<std::int64_t>(1, t.timed));
  return fmt::format(fmt::runtime(layout), t.rule.name, grouped_text(t.touching), grouped_text(t.missed),
                     percent(t.missed, t.touching), percent(t.missed_theory, t.touching),
                     percent(t.false_hits, t.reported), percent(t.false_theory, t.reported),
                     rounded_text(t.path_error_most, 3), t.timed > 0 ? fmt::format("{:.3f}", late) : "-");
}

template <class Tests> bool all_of_them(const Tests& tests) {
  return std::all_of(tests.begin(), tests.end(), [](const auto& test) { return test.passed(); });
}

std::string tests_text(const HitscanVerdicts& verdicts) {
  std::string text;
  for (const SelfTest& t : verdicts.counts) {
    text += fmt::format("{}, {}: ", t.method, t.scalar);
    if (t.judged_cells > 0) {
      text += fmt::format(
          "{} of {} intervals hold the theory (allowed {} to {}), chi-square {:.1f} (allowed {:.1f} to {:.1f})",
          t.covered, t.judged_cells, t.covered_allowed.lower, t.covered_allowed.upper, t.chi_square,
          t.chi_square_allowed.lower, t.chi_square_allowed.upper);
    } else {
      text += "too few expected to judge";
    }
    if (t.certain_cells > 0) text += fmt::format("; {} cells certain, {} wrong", t.certain_cells, t.certain_wrong);
    text += t.passed() ? ".\n\n" : ": FAILED.\n\n";
  }
  for (const HitscanMomentTest& t : verdicts.moments) {
    text += fmt::format("{}, {}: {} cells, {} out of bounds", t.rule, t.quantity, t.cells, t.out_of_bounds);
    if (t.judged > 0) {
      text += fmt::format("; {} means, chi-square {:.1f} (allowed {:.1f} to {:.1f})", t.judged, t.chi_square,
                          t.chi_square_allowed.lower, t.chi_square_allowed.upper);
    }
    text += t.passed() ? ".\n\n" : ": FAILED.\n\n";
  }
  return text;
}

}  // namespace

bool HitscanVerdicts::passed() const { return all_passed(counts) && all_of_them(moments); }

std::string hitscan_answer(const std::vector<HitscanLine>& lines, const std::vector<HitscanTotal>& totals) {
  std::string text = known_answer(lines) + ray_answer(lines);
  for (const HitscanTotal& total : totals) text += total_answer(total);
  for (const HitscanTotal& t : totals) {
    if (!text.empty()) break;
    text = fmt::format("{} misses {} of {} true hits and makes {} false ones.", t.rule.name, grouped_text(t.missed),
                       grouped_text(t.touching), grouped_text(t.false_hits));
  }
  return text;
}

std::string hitscan_summary(const std::vector<HitscanLine>& lines, const std::vector<HitscanTotal>& totals,
                            const HitscanVerdicts& verdicts) {
  std::string text =
      "Missed: of the true hits. False: of the rule's own hits. Off: mean distance from the arc there.\n"
      "Late: mean time from contact to the report, in steps; below 0 is early.\n";
  for (const KnownShot& known : known_shots) {
    const HitscanCell& c = known.cell;
    text += fmt::format("\n{}: {:g} m/s, {:g} m, radius {:g} mm, drag {:g} 1/s, wind {:g} m/s\n", known.name, c.speed,
                        c.range, 1e3 * c.radius, c.drag, c.wind);
    text += header();
    for (const HitscanLine& line : lines) {
      if (line.cell == c) text += row(line);
    }
  }
  text += fmt::format("\nAll {} cells; off: the largest\n", lines.size() / totals.size());
  text += header();
  for (const HitscanTotal& total : totals) text += row(total);
  text += fmt::format("\nSelf-test: counts {}, errors {}.\n", all_passed(verdicts.counts) ? "passed" : "FAILED",
                      all_of_them(verdicts.moments) ? "passed" : "FAILED");
  return text;
}

std::vector<Section> hitscan_sections(const HitscanVerdicts& verdicts) {
  return {
      {"What is asked",
       "A bullet leaves the origin level. It has a radius, falls, is slowed by the air and carried by a crosswind. The target is "
       "a ball at the range; its center is uniform over two discs, one around the line of fire, one around the arc, so that both "
       "what the ray hits and what the bullet hits are drawn. Nobody holds over: how well a sight is set is another question.\n\n"
       "hitscan casts a ray along the line of fire when the gun goes off. hitscan_ball sweeps the ball there. next_frame casts a "
       "ray every frame, from the bullet's center along its velocity, as long as the step; what it meets counts as hit at the next "
       "frame. swept_steps sweeps the ball every frame along the chord of the arc. The gun goes off anywhere in a step."},
      {"Oracle",
       "The arc has a closed form. Its closest approach to the target's center and, before it, first contact are bracketed and "
       "solved in long double, by the distance flown. No code of the rules is used."},
      {"Theory",
       "The places of the target that a path meets are its shadow along the path; docs/hitscan.md derives it slice by slice. In flat "
       "fire the shadows are discs and what they share is a lens. Path errors follow from the arc's own form, as it begins anew at "
       "every step; the lateness of next_frame is what is left of a step, and how much earlier the ball touches than its center."},
      {"Self-test",
       "Where theory is exactly 0 or 1 the count must be. Where at least 5 events are expected and 5 not to be, the number of 95 % "
       "Wilson intervals that hold the theory must lie in the central 99.9 % of its binomial distribution, and the sum of squared "
       "standard residuals in that of its chi-square. Mean path error and lateness are held against theory in the same way, their "
       "extremes against what geometry allows.\n\n" +
           tests_text(verdicts)},
      {"Limits",
       "Drag grows as the speed, not as its square, and the numbers of the known shots are rough. The bullet is placed exactly on its "
       "arc at every frame: the error of an integrator comes on top. One target at rest, nothing in between. Totals over all cells "
       "weigh them alike and depend on which are asked; the cells do not."},
  };
}

}  // namespace thinwall
