#pragma once
/// What geometry expects of a cell, derived in docs/hitscan.md, and whether what was counted and measured agrees with it.

#include <optional>
#include <string>
#include <vector>

#include <boost/icl/interval_set.hpp>

#include <thinwall/experiments/hitscan/model.hpp>
#include <thinwall/experiments/lab/judge.hpp>
#include <thinwall/experiments/lab/statistics.hpp>

namespace thinwall {

// Which places of a ball a path meets: plane geometry.

/// A straight bit of path in the plane of the arc, x0 < x1.
struct PathPiece {
  double x0, s0, x1, s1;  ///< [m]
};

/// A set of places on a line.
using Places = boost::icl::interval_set<double>;

/// The places `p` for which some point of the pieces has (x - range)^2 + (s - p)^2 <= radius^2.
Places shadow(const std::vector<PathPiece>& pieces, double range, double radius);

/// [m^2] What two discs, their centers `apart`, have in common.
double lens_area(double radius_a, double radius_b, double apart);

/// Mean and spread of a quantity from shot to shot.
struct HitscanMoments {
  double mean = 0, sigma = 0;
};

/// What a rule should count, as shares of the shots, and measure.
struct HitscanExpected {
  double touch;                            ///< the bullet truly hits
  double reported;                         ///< the rule says so
  double missed;                           ///< the bullet hits, and the rule says no
  double false_hits;                       ///< it does not, and the rule says so
  HitscanMoments path_error;               ///< [m] from the rule's path to the arc at the range
  double path_error_most;                  ///< [m] none is larger
  std::optional<HitscanMoments> lateness;  ///< [s], of next_frame
};
HitscanExpected expected_of(const HitscanRule& rule, const HitscanCell& c);

/// The limit of flat fire: the shadows are discs, `deflection` [m] apart.
double flat_missed(double target, double radius, double deflection);  ///< [1] of the true hits, by hitscan
double flat_false(double target, double radius, double deflection);   ///< [1] of its hits

/// [m] The range at which hitscan misses that share of the true hits, of a bullet without radius, in the limit of flat
/// fire. The other factors are the cell's. Nothing where no range does: no pull, or the bullet does not get there.
std::optional<double> range_of_missed(const HitscanCell& c, double share);

// Whether the two agree.

/// A cell, a rule, what was counted and measured and what theory expects.
struct HitscanRow {
  HitscanCell cell;
  HitscanRule rule;
  HitscanExpected expected;
  HitscanTally tally;
};

inline std::string_view rule_name(const HitscanRow& row) { return row.rule.name; }

/// By cell, then rule. `tallies[i]` is of cell i, as long as `rules`.
std::vector<HitscanRow> hitscan_rows(const std::vector<HitscanCell>& cells, const std::vector<HitscanRule>& rules,
                                     const std::vector<std::vector<HitscanTally>>& tallies);

/// What is held against theory: of each rule "reported", "missed" and "false", of the oracle, "exact arc", "touching".
std::vector<CellCount> counts_of(const std::vector<HitscanRow>& rows);

/// A measured quantity of one rule, over all cells, against theory: means by chi-square, extremes by what geometry
/// allows.
struct HitscanMomentTest {
  std::string rule, quantity;
  std::int64_t cells = 0;          ///< with a measurement
  std::int64_t out_of_bounds = 0;  ///< ... that is beyond what is possible, more than rounding explains
  ResidualTest means = {};         ///< with an expected mean, and at least 50 shots
  bool passed() const { return out_of_bounds == 0 && means.passed(); }
};
std::vector<HitscanMomentTest> moment_tests(const std::vector<HitscanRow>& rows);

}  // namespace thinwall
