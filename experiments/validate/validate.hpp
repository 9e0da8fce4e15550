#pragma once
/// Published queries, asked again and judged in exact arithmetic.

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/discrete/scalar.hpp>
#include <thinwall/experiments/lab/record.hpp>
#include <thinwall/experiments/validate/exact_verdict.hpp>
#include <thinwall/swept/toi.hpp>

namespace thinwall {

// ---- Reads files of published CCD queries: eight rows a query, in a folder that says which two primitives meet.
// A row is one vertex: `x_numerator,x_denominator,y_...,z_...,answer`. Rows 1 to 4 are the vertices at the start of the
// step, rows 5 to 8 the same at its end. Every complaint is a UsageError of one line: file, line, reason.

enum class Primitives {
  vertex_face,  ///< in a folder `vertex-face`: the vertex, then the face's three corners
  edge_edge,    ///< in a folder `edge-edge`: two ends of one edge, then two of the other
};
std::string_view name(Primitives primitives);

/// Coordinates as read, without rounding.
struct PublishedQuery {
  std::array<RationalPoint, 4> at_start, at_end;  ///< [length]
  bool collides = false;                          ///< the published answer
  std::size_t line = 0;                           ///< of its first row in the file, from 1
};

/// The lines of such a file, their fields, and complaints that name them.
class QueryLines {
 public:
  explicit QueryLines(const std::filesystem::path& file);

  bool next();  ///< false at the end
  const std::string& text() const { return text_; }
  std::size_t line() const { return line_; }           ///< from 1
  const std::string& shown() const { return shown_; }  ///< the file's name, for complaints

  std::vector<std::string_view> fields(std::size_t needed) const;  ///< exactly so many
  [[noreturn]] void refuse(const std::string& reason) const;
  [[noreturn]] void complain(std::string_view field, std::size_t column, std::string_view what) const;

 private:
  std::string shown_, text_;
  std::ifstream in_;
  std::size_t line_ = 0;
};

class QueryFile {
 public:
  explicit QueryFile(const std::filesystem::path& file);

  Primitives primitives() const { return primitives_; }
  /// The next query; nothing at the end.
  std::optional<PublishedQuery> next();

 private:
  bool next_row(RationalPoint& vertex, bool& answer);

  QueryLines lines_;
  Primitives primitives_ = Primitives::vertex_face;
};

/// Every CSV file below `folder`, or in it alone, by name. Throws UsageError if that is missing, unreadable or has none.
std::vector<std::filesystem::path> query_files(const std::filesystem::path& folder, bool below = true);

// ---- From a published query, whose vertices move each on its own, to one that the library serves: two shapes that translate.

/// Why a query is left out.
enum class Skipped {
  not_rigid,   ///< the vertices of a primitive do not share one displacement, exactly
  not_double,  ///< a coordinate at the start, or a displacement, has no double near it: too many digits, or too large
  rounding_decides,  ///< a displacement is no double, and with the nearest one the exact answer is another
};

/// A query that fits. Its coordinates are doubles; its displacements are, or the nearest double poses a query with the
/// same exact answer, and that is what the library is judged by.
struct RigidQuery {
  Primitives primitives = Primitives::vertex_face;
  std::array<Vec3<double>, 4> at_start;       ///< [length]
  Vec3<double> displacement_a;                ///< [length] of the vertex, or the first edge
  Vec3<double> displacement_b;                ///< [length] of the face, or the second edge
  bool rounded = false;                       ///< a displacement is not exactly a double
  std::optional<Rational> published_contact;  ///< [1] first contact of the query as published, exactly
  std::optional<Rational> posed_contact;      ///< [1] first contact of the query as posed to the library, exactly
};

struct RigidReading {
  std::optional<RigidQuery> query;
  Skipped skipped = Skipped::not_rigid;  ///< where there is no query
};

RigidReading read_rigid(Primitives primitives, const PublishedQuery& published);

/// What the library's front door answers with its default method, in double.
Toi<double> library_answer(const RigidQuery& query);

// ---- The library against published queries and against exact arithmetic: who answers what, and who is wrong.

/// Counts of queries; all of one kind of primitives from one family, or of everything.
struct QueryCounts {
  std::int64_t read = 0, checked = 0, hits = 0, rounded = 0;
  std::array<std::int64_t, 3> skipped = {};  ///< by Skipped
  std::int64_t false_negatives = 0, false_positives = 0, undecided = 0, file_differs = 0;

  static constexpr auto fields() {
    using T = QueryCounts;
    return record(sum("read", &T::read, "1", "Read."), sum("checked", &T::checked, "1", "Of those, that fit."),
                  sum("hits", &T::hits, "1", "Of those checked, by exact arithmetic."),
                  sum("skipped", &T::skipped, "1", "Of those read, that do not fit: by Skipped."),
                  sum("rounded", &T::rounded, "1", "Of those checked, with a displacement rounded to double."),
                  sum("false_negatives", &T::false_negatives, "1", "Missed: hits by exact arithmetic, or the file."),
                  sum("false_positives", &T::false_positives, "1", "The reverse."),
                  sum("undecided", &T::undecided, "1", "Without a verdict: it gave up, or calls the input invalid."),
                  sum("file_differs", &T::file_differs, "1", "Whose published answer is not the exact one."));
  }
  std::int64_t all_skipped() const { return skipped[0] + skipped[1] + skipped[2]; }
  std::int64_t wrong() const { return false_negatives + false_positives + undecided + file_differs; }
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
