#pragma once
/// Do measured counts agree with theory, over many cells at once? A theory that is wrong, or a measurement that is,
/// fails here; chance alone fails a right one once in a thousand times, however many methods and scalars it has.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <thinwall/experiments/lab/statistics.hpp>
#include <thinwall/experiments/lab/table.hpp>

namespace thinwall {

/// What came out of one cell, and what should.
struct CellCount {
  std::string method, scalar;
  std::int64_t shots;     ///< > 0
  std::int64_t tunneled;  ///< in [0, shots]
  double theory;          ///< [1] probability in [0, 1]
};

/// The verdict on one method at one scalar.
struct SelfTest {
  std::string method, scalar;
  std::int64_t certain_cells = 0;        ///< theory is 0 or 1: the count must be exactly that
  std::int64_t certain_wrong = 0;        ///< ... and is not
  std::int64_t judged_cells = 0;         ///< at least 5 expected to tunnel, and 5 not to
  std::int64_t covered = 0;              ///< ... whose 95 % Wilson interval holds the theory
  Interval covered_allowed = {0, 0};     ///< the middle of Binomial(judged_cells, 0.95)
  double chi_square = 0;                 ///< sum of squared standard residuals over the judged cells
  Interval chi_square_allowed = {0, 0};  ///< the middle of its distribution
  std::int64_t other_cells = 0;          ///< too few expected to judge alone
  bool passed() const;
};

/// By method and scalar, in the order of their first cell. With n of them judged each of the two ranges leaves out 1 in 2000 n,
/// so that all together fail a right run no more than once in 1000 (Bonferroni; methods may share their shots).
std::vector<SelfTest> self_test(const std::vector<CellCount>& cells);

/// A paragraph for each: "closed_form, double: 864 cells certain, 0 wrong."
std::string self_test_text(const std::vector<SelfTest>& tests);

Table self_test_table(const std::vector<SelfTest>& tests);
bool all_passed(const std::vector<SelfTest>& tests);

/// Do standard residuals, one of each of several cells, spread as standard normal numbers do? Their squares are added.
struct ResidualTest {
  std::int64_t judged = 0;
  double chi_square = 0;

  void add(double residual);
  std::optional<Interval> allowed()
      const;  ///< central 99.9 % of the chi-square distribution; missing if nothing is judged
  bool passed() const;
};

/// True if at least five shots are expected to tunnel and five not to: a cell that can be judged by its residual.
bool can_be_judged(std::int64_t shots, double theory);

}  // namespace thinwall
