#pragma once
/// Do measured counts agree with theory, over many cells at once? A theory that is wrong, or a measurement that is,
/// fails here; chance alone fails a right one once in a thousand times, however many names and parts it has.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <thinwall/experiments/lab/statistics.hpp>
#include <thinwall/experiments/lab/table.hpp>

namespace thinwall {

/// What came out of one cell, and what should.
struct CellCount {
  std::string name, part;  ///< cells of one name and part are judged together: a method at a scalar, or a rule's misses
  std::int64_t trials;     ///< > 0
  std::int64_t counted;    ///< in [0, trials]
  double theory;           ///< [1] probability in [0, 1] of being counted
};

/// The verdict on one name and part.
struct SelfTest {
  std::string name, part;
  std::int64_t certain_cells = 0;          ///< theory is 0 or 1: the count must be exactly that
  std::int64_t certain_wrong = 0;          ///< ... and is not
  std::int64_t judged_cells = 0;           ///< at least 5 expected to be counted, and 5 not to
  std::int64_t covered = 0;                ///< ... whose 95 % Wilson interval holds the theory
  Interval covered_allowed = {0, 0};       ///< the middle of Binomial(judged_cells, 0.95)
  double chi_square = 0;                   ///< sum of squared standard residuals over the judged cells
  Interval chi_square_allowed = {0, 0};    ///< the middle of its distribution
  std::int64_t other_cells = 0;            ///< too few expected to judge alone
  std::optional<CellCount> farthest = {};  ///< the first that is certain and wrong, or else the largest residual
  bool passed() const;
};

/// By name and part, in the order of their first cell. With n of them judged each of the two ranges leaves out 1 in 2000 n,
/// so that all together fail a right run no more than once in 1000 (Bonferroni; methods may share their shots).
std::vector<SelfTest> self_test(const std::vector<CellCount>& cells);

/// A paragraph for each: "closed_form, double: 864 cells certain, 0 wrong." One that failed names its cell that is farthest off.
std::string self_test_text(const std::vector<SelfTest>& tests);

/// A column's name and what it says.
struct Heading {
  std::string name, description;
};

/// `of` and `part` head the columns of a test's name and part.
Table self_test_table(
    const std::vector<SelfTest>& tests,
    std::string description = "Counts of independent trials against theory, over all cells of a row at once.",
    const Heading& of = {"method", "Way of detecting the hit."},
    const Heading& part = {"scalar", "Floating-point type the method ran in."});

/// Of verdicts of whatever kind.
template <class Verdict> bool all_passed(const std::vector<Verdict>& verdicts) {
  return std::ranges::all_of(verdicts, &Verdict::passed);
}

/// As a summary says it: `Self-test: counts passed.`
inline const char* verdict_text(bool passed) { return passed ? "passed" : "FAILED"; }

/// Do standard residuals, one of each of several cells, spread as standard normal numbers do? Their squares are added.
struct ResidualTest {
  std::int64_t judged = 0;
  double chi_square = 0;

  void add(double residual);
  /// The central 99.9 % of the chi-square distribution; missing if nothing is judged.
  std::optional<Interval> allowed() const;
  bool passed() const;
};

/// True if at least five trials are expected to be counted and five not to: a cell that can be judged by its residual.
bool can_be_judged(std::int64_t trials, double theory);

}  // namespace thinwall
