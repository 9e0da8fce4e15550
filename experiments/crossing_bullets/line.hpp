#pragma once
/// One line of the results: a cell, a rule, what was counted and what theory expects; and whether the two agree.

#include <optional>
#include <string>
#include <vector>

#include <thinwall/experiments/crossing_bullets/rules.hpp>
#include <thinwall/experiments/self_test.hpp>

namespace thinwall {

struct CrossingLine {
  Crossing crossing;
  std::string rule;
  CrossingTheory theory;
  Expected expected;
  CrossingTally tally;
};

std::optional<double> missed_share(const CrossingLine& line);         ///< [1] of the true hits, if there are any
std::optional<double> missed_share_theory(const CrossingLine& line);  ///< [1]
std::optional<double> mean_lateness(const CrossingLine& line);        ///< [1] of a step, of the timed true hits
/// Standard errors between the mean lateness and theory, where sweep_then_confirm has at least 50 times.
std::optional<double> lateness_residual(const CrossingLine& line);

/// `tallies[i]` is of cell i / rules and rule i % rules.
std::vector<CrossingLine> make_lines(const std::vector<Crossing>& cells, const std::vector<CrossingRule>& rules,
                                     const std::vector<CrossingTally>& tallies);

/// What is held against theory, as the self-test wants it: `method` is the rule, `scalar` the event, "reported",
/// "missed" or "false"; the rule "exact motion" is the oracle.
std::vector<CellCount> counts_of(const std::vector<CrossingLine>& lines);

/// The times of impact against what they can be.
struct TimingTest {
  std::string rule;
  std::int64_t cells = 0;                ///< in which the rule gave a time
  std::int64_t apart = 0;                ///< ... for which the balls are apart, more than rounding explains
  std::int64_t wrong_time = 0;           ///< closed_form: overlapping then; others: later than the end of contact
  std::int64_t judged = 0;               ///< cells with a lateness residual
  double chi_square = 0;                 ///< sum of their squares
  Interval chi_square_allowed = {0, 0};  ///< central 99.9 %
  bool passed() const;
};
std::vector<TimingTest> timing_test(const std::vector<CrossingLine>& lines);

}  // namespace thinwall
