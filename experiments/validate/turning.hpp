#pragma once
/// Published queries of shapes that turn, with their exact times: every method that turns is asked and judged.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <thinwall/experiments/lab/record.hpp>

namespace thinwall {

/// What one method answered. Of a query that touches at the start the time of first contact is 0.
struct TurningCounts {
  std::int64_t queries = 0, touching = 0, late = 0, missed = 0, false_hits = 0, near = 0, gave_up = 0;
  double largest_error = 0;  ///< [1] of a step

  static constexpr auto fields() {
    using T = TurningCounts;
    return record(sum("queries", &T::queries, "1", "Asked."),
                  sum("touching", &T::touching, "1", "Of those, that touch during the step, by the file."),
                  sum("late", &T::late, "1", "Hits after first contact, by however little."),
                  sum("missed", &T::missed, "1", "Touching, and said to be apart."),
                  sum("false", &T::false_hits, "1", "Apart, and said to touch."),
                  sum("near", &T::near, "1",
                      "Of those, where the file proves no clearance beyond what the method calls contact."),
                  sum("gave_up", &T::gave_up, "1", "Without an answer."),
                  most("largest_error", &T::largest_error, "1", "Of the times of what touches and is said to."));
  }
};

/// A method, and what it owes.
struct TurningMethod {
  std::string name;
  bool never_late = false;  ///< nor does it miss
  bool hits_are_true = false;
};

/// By pair of shapes, and all together; `counts[i]` is of `methods[i]`.
struct TurningPairCounts {
  std::string pair;  ///< the two shapes' names
  std::vector<TurningCounts> counts;
};

struct TurningValidation {
  std::vector<TurningMethod> methods;
  std::vector<TurningPairCounts> pairs;  ///< in the order of the files
  std::vector<TurningCounts> total;
  std::vector<double> median_ns;    ///< [ns] of a call, the first about this query
  std::int64_t wrong = 0;           ///< answers that break what their method claims
  std::vector<std::string> wrongs;  ///< the first few: `file:line: method: what is wrong`
};

/// Judges every query of a CSV file, or of those in a folder, as docs/data/README.md describes them. Throws UsageError of one line, with file
/// and line, for what cannot be read.
TurningValidation validate_turning(const std::filesystem::path& file_or_folder);

}  // namespace thinwall
