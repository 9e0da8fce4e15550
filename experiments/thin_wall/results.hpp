#pragma once
/// The thin wall's plan, its rows (a cell at a method and scalar) and the verdicts on them.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/lab/judge.hpp>
#include <thinwall/experiments/thin_wall/methods.hpp>

namespace thinwall {

struct ShotPlan {
  std::vector<Cell> cells;  ///< the bullet first, then every combination of the settings' factors
  std::vector<ThinWallMethod> methods;
  std::int64_t shots;  ///< of each cell and method
  std::uint64_t seed;
  Response response;
};

/// Throws UsageError.
ShotPlan make_plan(const Settings& settings, const RunOptions& options);

struct ThinWallRow {
  Cell cell;
  std::string method, scalar;
  Theory theory;
  Tally tally;
  int poses_per_step;    ///< as the method's
  double step_ratio;     ///< [1] v h cos(angle) / (w + 2 r)
  double lateness_unit;  ///< [m] of tally.lateness
  double resolution;     ///< [m] how well the scalar holds a pose of this cell
  double seconds;        ///< of computing all shots, aiming included
};

/// `tallies[i]` and `seconds[i]` are of cell i / methods and method i % methods.
std::vector<ThinWallRow> make_rows(const ShotPlan& plan, const std::vector<Tally>& tallies,
                                   const std::vector<double>& seconds);

/// Every row with a theory of tunneling, or of going through when it bounces.
std::vector<CellCount> tunneled_counts(const std::vector<ThinWallRow>& rows);
std::vector<CellCount> through_counts(const std::vector<ThinWallRow>& rows);

/// In an infinite wall a ball ends behind it if and only if it went through. True if all counts say so.
bool ends_agree(const std::vector<ThinWallRow>& rows);

/// Does the lateness of detection agree with theory? Means by their standard residuals, extremes by their bounds. A hit with a gap
/// between ball and wall that the method does not own up to would be a false one: it is looked for in every cell, also where there
/// is no theory. The verdict on one method at one scalar.
struct LatenessTest {
  std::string method, scalar;
  std::int64_t cells = 0;        ///< in which anything was detected
  std::int64_t false_cells = 0;  ///< ... with a gap between ball and wall, by more than theory or rounding explains
  std::int64_t late_cells = 0;   ///< ... later than theory's largest lateness, by more than rounding explains
  ResidualTest mean = {};        ///< where theory varies, and enough was detected for the mean to be near normal
  bool passed() const { return false_cells == 0 && late_cells == 0 && mean.passed(); }
};
std::vector<LatenessTest> lateness_test(const std::vector<ThinWallRow>& rows);

/// What of a plan is fired at evenly spread phases: the cells with an infinite wall, at every method in double.
ShotPlan evenly_spread(const ShotPlan& plan);

/// The verdict on one method.
struct StratifiedTest {
  std::string method;
  std::int64_t cells = 0;        ///< with a theory
  double largest_deviation = 0;  ///< [1] of |k - n p| over those cells
  bool passed() const { return largest_deviation <= 1; }
};
/// `counts[i]` is what stratified_counts returned for cell i.
std::vector<StratifiedTest> stratified_test(const ShotPlan& plan, const std::vector<std::vector<std::int64_t>>& counts);

}  // namespace thinwall
