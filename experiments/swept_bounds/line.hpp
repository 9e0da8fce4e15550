#pragma once
/// One line of the results: a cell, a bound, what was counted and what theory expects; and sums of lines.

#include <optional>
#include <string>
#include <vector>

#include <thinwall/experiments/self_test.hpp>
#include <thinwall/experiments/swept_bounds/bounds.hpp>

namespace thinwall {

/// A bound that serves a cell's shape.
struct SweepPair {
  Sweep sweep;
  const SweptBound* bound;
};
std::vector<SweepPair> serving_pairs(const std::vector<Sweep>& sweeps, const std::vector<SweptBound>& bounds);

struct SweepLine {
  Sweep sweep;
  std::string bound;
  bool is_volume;  ///< not a question to the moving shape itself
  SweepTheory theory;
  SweepTally tally;
};
SweepLine make_line(const SweepPair& pair, const SweepTally& tally);

std::optional<double> false_fraction(const SweepTally& tally);  ///< [1] of those reported, if there are any

/// Reported, truly touched, false and missed against theory, as the self-test wants it: `method` is the bound, `scalar`
/// the event.
std::vector<CellCount> counts_of(const std::vector<SweepLine>& lines);

/// One bound of one shape, over all of their cells.
struct SweepTotal {
  SweptForm form;
  std::string bound;
  std::int64_t cells = 0;
  SweepTally tally = {};
  double least_false = 1;  ///< [1] false fraction by theory, in the cell where it is least
  double most_false = 0;   ///< ... where it is most
};
std::vector<SweepTotal> totals(const std::vector<SweepLine>& lines);  ///< by shape, then bound

}  // namespace thinwall
