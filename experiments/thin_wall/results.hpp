#pragma once
/// The thin wall's plan, its rows (a cell at a method and scalar) and the verdicts on them.

#include <cstdint>
#include <optional>
#include <vector>

#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/lab/judge.hpp>
#include <thinwall/experiments/models/shot_methods.hpp>

namespace thinwall {

template <class Cell> class Factors;  // lab/factors.hpp

extern const Factors<Cell> cell_factors;  ///< all but the wall's size, which is the same in every finite wall

struct ShotPlan {
  std::vector<Cell> cells;  ///< the bullet first, then every combination of the settings' factors
  std::vector<ThinWallMethod> methods;
  std::int64_t shots;  ///< of each cell and method
  std::uint64_t seed;
  Response response;
};

/// Throws UsageError.
ShotPlan make_plan(const Settings& settings, const RunOptions& options);

/// At evenly spread phases, too: at an infinite wall, in double.
bool is_fired_evenly(const Cell& cell, const ThinWallMethod& method);

struct ThinWallRow {
  Cell cell;
  const ThinWallMethod* method;  ///< one of the plan's
  Theory theory;
  Tally tally = {};
  std::optional<std::int64_t> tunneled_evenly = {};  ///< of `stratified_shots`
  double seconds = 0;                                ///< of computing all shots, aiming included
};

/// By cell, then method; nothing is counted yet. The plan must outlive them.
std::vector<ThinWallRow> rows_of(const ShotPlan& plan);

/// What a shot may come to: how many did, and the chance of it.
struct ThinWallFate {
  std::int64_t (*count)(const Tally&);
  std::optional<double> Theory::*chance;
};
inline constexpr ThinWallFate tunneling = {[](const Tally& t) { return t.tunneled; }, &Theory::probability};
inline constexpr ThinWallFate going_through = {[](const Tally& t) { return t.went_through(); }, &Theory::through};

/// Of every row with a theory of it.
std::vector<CellCount> counts_of(const std::vector<ThinWallRow>& rows, const ThinWallFate& fate);

/// In an infinite wall a ball ends behind it if and only if it went through. True if all counts say so.
bool ends_agree(const std::vector<ThinWallRow>& rows);

/// Of the shots for which theory has a chance: how many, and of how many that came true or was expected to.
struct Foretold {
  std::int64_t shots = 0, counted = 0;
  double expected = 0;

  double share() const { return static_cast<double>(counted) / static_cast<double>(shots); }  ///< NaN of none
  double theory() const { return expected / static_cast<double>(shots); }
};

/// A method at a scalar over all of its cells, and the verdicts on it.
struct ThinWallTotal {
  const ThinWallMethod* method;
  Tally tally = {};                           ///< without lateness, whose unit is each cell's own
  std::int64_t cells = 0, clean_cells = 0;    ///< clean: none tunneled
  Foretold tunneled = {}, through = {};       ///< through: tunneled, or pushed out on the wrong side
  std::optional<double> worst_residual = {};  ///< [1] of the cells that can be judged alone, the one farthest from 0

  // Lateness: means by their standard residuals, extremes by their bounds. A hit with a gap between ball and wall that
  // the method does not own up to would be a false one: it is looked for in every cell, also without a theory.
  std::int64_t detected_cells = 0;  ///< in which anything was
  std::int64_t false_cells = 0;     ///< ... with a gap between ball and wall, by more than theory or rounding explains
  std::int64_t late_cells = 0;      ///< ... later than theory's largest lateness, by more than rounding explains
  ResidualTest lateness = {};       ///< where theory varies, and enough was detected for the mean to be near normal

  // Evenly spread phases.
  std::int64_t even_cells = 0;   ///< with a theory
  double largest_deviation = 0;  ///< [1] of |k - n p| over those cells

  bool is_clean() const { return tally.tunneled + tally.undecided == 0; }
  bool lateness_passes() const { return false_cells == 0 && late_cells == 0 && lateness.passed(); }
  bool even_passes() const { return largest_deviation <= 1; }
};
std::vector<ThinWallTotal> totals_of(const std::vector<ThinWallRow>& rows);

}  // namespace thinwall
