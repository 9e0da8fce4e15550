#pragma once
/// Reads files of published CCD queries: eight rows a query, in a folder that says which two primitives meet.
/// A row is one vertex: `x_numerator,x_denominator,y_...,z_...,answer`. Rows 1 to 4 are the vertices at the start of the
/// step, rows 5 to 8 the same at its end. Every complaint is a UsageError of one line: file, line, reason.

#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/validate/exact_verdict.hpp>

namespace thinwall {

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

class QueryFile {
 public:
  explicit QueryFile(const std::filesystem::path& file);

  Primitives primitives() const { return primitives_; }
  /// The next query; nothing at the end.
  std::optional<PublishedQuery> next();

 private:
  bool next_row(RationalPoint& vertex, bool& answer);
  [[noreturn]] void refuse(const std::string& reason) const;

  std::string shown_;  ///< the file's name, for complaints
  std::ifstream in_;
  Primitives primitives_ = Primitives::vertex_face;
  std::size_t line_ = 0;
};

/// Every CSV file below `folder`, by name. Throws UsageError if the folder is missing, unreadable or has none.
std::vector<std::filesystem::path> query_files(const std::filesystem::path& folder);

}  // namespace thinwall
