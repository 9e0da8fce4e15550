#pragma once
/// One line of the results: a cell, a rule, what was counted and measured and what theory expects; and whether the two
/// agree.

#include <optional>
#include <string>
#include <vector>

#include <thinwall/experiments/hitscan/theory.hpp>
#include <thinwall/experiments/self_test.hpp>

namespace thinwall {

struct HitscanLine {
  HitscanCell cell;
  HitscanRule rule;
  HitscanExpected expected;
  HitscanTally tally;
};

std::string_view known_name(const HitscanCell& c);  ///< of a known shot; otherwise empty

std::optional<double> missed_share(const HitscanLine& line);         ///< [1] of the true hits, if there are any
std::optional<double> missed_share_theory(const HitscanLine& line);  ///< [1] of those expected
std::optional<double> false_share(const HitscanLine& line);          ///< [1] of the rule's hits, if there are any
std::optional<double> false_share_theory(const HitscanLine& line);   ///< [1] of those expected

/// Of the true hits that are reported; nothing if there are none.
std::optional<double> mean_lateness(const HitscanLine& line);     ///< [s]
std::optional<double> mean_point_error(const HitscanLine& line);  ///< [m]
double mean_path_error(const HitscanLine& line);                  ///< [m]

/// By cell, then rule. `tallies[i]` is of cell i, as long as `rules`.
std::vector<HitscanLine> make_hitscan_lines(const std::vector<HitscanCell>& cells,
                                            const std::vector<HitscanRule>& rules,
                                            const std::vector<std::vector<HitscanTally>>& tallies);

/// What is held against theory, as the self-test wants it: `method` is the rule, `scalar` the event, "reported",
/// "missed" or "false"; the rule "exact arc" is the oracle.
std::vector<CellCount> counts_of(const std::vector<HitscanLine>& lines);

/// A measured quantity of one rule, over all cells, against theory: means by chi-square, extremes by what geometry
/// allows.
struct HitscanMomentTest {
  std::string rule, quantity;
  std::int64_t cells = 0;                ///< with a measurement
  std::int64_t out_of_bounds = 0;        ///< ... that is beyond what is possible, more than rounding explains
  std::int64_t judged = 0;               ///< with an expected mean, and at least 50 shots
  double chi_square = 0;                 ///< sum of the squared standard residuals of those
  Interval chi_square_allowed = {0, 0};  ///< central 99.9 %
  bool passed() const;
};
std::vector<HitscanMomentTest> moment_tests(const std::vector<HitscanLine>& lines);

}  // namespace thinwall
