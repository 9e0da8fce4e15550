#pragma once
/// Published queries of shapes that turn, with their exact times: every method that turns is asked and judged.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace thinwall {

/// What one method answered. Of a query that touches at the start the time of first contact is 0.
struct TurningCounts {
  std::int64_t queries = 0;
  std::int64_t touching = 0;    ///< of those, that touch during the step, by the file
  std::int64_t late = 0;        ///< hits after first contact, by however little
  std::int64_t missed = 0;      ///< touching, and said to be apart
  std::int64_t false_hits = 0;  ///< apart, and said to touch
  std::int64_t near = 0;        ///< of those, where the file proves no clearance beyond what the method calls contact
  std::int64_t gave_up = 0;
  double largest_error = 0;  ///< [1] of a step, of the times of what touches and is said to

  TurningCounts& operator+=(const TurningCounts& other);
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
