#pragma once
/// The library against published queries and against exact arithmetic: who answers what, and who is wrong.

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <thinwall/experiments/validate/rigid_query.hpp>

namespace thinwall {

/// Counts of queries; all of one kind of primitives from one family, or of everything.
struct QueryCounts {
  std::int64_t read = 0;
  std::int64_t checked = 0;
  std::int64_t hits = 0;                     ///< of those checked, by exact arithmetic
  std::int64_t rounded = 0;                  ///< of those checked, with a displacement rounded to double
  std::array<std::int64_t, 3> skipped = {};  ///< by Skipped
  std::int64_t false_negatives = 0;          ///< the library misses what exact arithmetic, or the file, calls a hit
  std::int64_t false_positives = 0;          ///< the reverse
  std::int64_t undecided = 0;                ///< the library gives no verdict: it gave up, or calls the input invalid
  std::int64_t file_differs = 0;             ///< the published answer is not the exact one

  std::int64_t all_skipped() const { return skipped[0] + skipped[1] + skipped[2]; }
  std::int64_t wrong() const { return false_negatives + false_positives + undecided + file_differs; }
  QueryCounts& operator+=(const QueryCounts& other);
};

struct QueryFamily {
  std::string name;  ///< the folders between the one given and the one named after the primitives
  Primitives primitives = Primitives::vertex_face;
  QueryCounts counts;
};

struct Validation {
  std::vector<QueryFamily> families;  ///< in the order of the files
  QueryCounts total;
  double median_ns = 0;             ///< [ns] a checked query, called again and again: in cache, and predicted
  std::vector<std::string> wrongs;  ///< the first few: `file:line: what is wrong`
};

/// Judges every query in every CSV file below `folder`. Throws UsageError for what cannot be read.
Validation validate(const std::filesystem::path& folder);

}  // namespace thinwall
