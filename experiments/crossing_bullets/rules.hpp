#pragma once
/// The rules that the encounters are put to, sweeping both and the methods of finding the time of impact; and what is counted.

#include <functional>
#include <string>
#include <vector>

#include <thinwall/experiments/crossing_bullets/model.hpp>
#include <thinwall/experiments/lab/judge.hpp>
#include <thinwall/experiments/lab/record.hpp>

namespace thinwall {

struct CrossingTally {
  std::int64_t shots = 0, touching = 0, missed = 0, false_hits = 0, undecided = 0, evaluations = 0;
  std::int64_t beside = 0, early = 0, late = 0, inside = 0;  // of the misses of sweep_then_confirm
  RealSum lateness = {};                                     // [1] of a step, of the timed true hits
  double latest = no_most, earliest = no_least;              // [1] of a step past first contact, of the same
  double widest = no_most, deepest = no_least;               // [m] gap at the answered time, of all timed answers

  static constexpr auto fields() {
    using T = CrossingTally;
    return record(
        sum("shots", &T::shots, "1", "Encounters."),
        sum("touching", &T::touching, "1", "True hits: the balls touch during the step, by the exact relative motion."),
        sum("missed", &T::missed, "1", "True hits that the rule does not see."),
        sum("false_hits", &T::false_hits, "1", "Hits reported although the balls do not touch."),
        sum("undecided", &T::undecided, "1", "Encounters that the method gave up on."),
        sum("evaluations", &T::evaluations, "1", "Overlap tests, rays and closed forms they took."),
        sum("missed_beside", &T::beside, "1",
            "Missed by sweep_then_confirm: the center's ray does not enter the track."),
        sum("missed_early", &T::early, "1", "Missed since the ray enters the track before the other ball arrives."),
        sum("missed_late", &T::late, "1", "Missed since it enters after the other ball has gone."),
        sum("missed_inside", &T::inside, "1",
            "Missed since the ray starts inside the track and looks at the start alone."),
        sum("lateness", &T::lateness, "step", "From first contact to the answer."),
        most("lateness_max", &T::latest, "step", "The latest answer."),
        least("lateness_min", &T::earliest, "step", "The earliest; below 0 by rounding, or by a tolerance."),
        most("gap_max", &T::widest, "m",
             "Widest gap between the balls at the answered time; above 0 by rounding, or false."),
        least("gap_min", &T::deepest, "m", "The least of them; below 0 where they overlap."));
  }
  std::int64_t reported() const { return touching - missed + false_hits; }
  std::int64_t apart() const { return shots - touching; }
  bool operator==(const CrossingTally&) const = default;
};

struct CrossingRule {
  std::string name;
  std::function<void(const Encounter&, CrossingTally&)> ask;  ///< puts one encounter and counts the answer
  std::function<Expected(const CrossingTheory&)> expects;
};

std::vector<CrossingRule> all_crossing_rules();

/// All encounters of a cell, put to one rule.
CrossingTally ask_all(const CrossingRule& rule, const Crossing& c, std::uint64_t seed, std::int64_t shots);

/// A cell, a rule, what was counted and what theory expects.
struct CrossingRow {
  Crossing cell;
  std::string rule;
  CrossingTheory theory;
  Expected expected;
  CrossingTally tally;
  double seconds = 0;  ///< of asking, drawing and the oracle included
};

/// What is held against theory, by rule and event: "reported", "missed" or "false"; the rule "exact motion" is the oracle.
std::vector<CellCount> counts_of(const std::vector<CrossingRow>& rows);

/// The times of impact against what they can be.
struct TimingTest {
  std::string rule;
  std::int64_t cells = 0;       ///< in which the rule gave a time
  std::int64_t apart = 0;       ///< ... for which the balls are apart, more than rounding explains
  std::int64_t wrong_time = 0;  ///< closed_form: overlapping then; others: later than the end of contact
  ResidualTest lateness = {};   ///< of the mean, where sweep_then_confirm has at least 50 times
  bool passed() const { return apart == 0 && wrong_time == 0 && lateness.passed(); }
};
std::vector<TimingTest> timing_test(const std::vector<CrossingRow>& rows);

}  // namespace thinwall
