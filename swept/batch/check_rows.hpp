#pragma once
/// What a batch asks of its spans: equal lengths, and answers that overwrite nothing it still reads.

#include <cstddef>
#include <span>

namespace thinwall::batch {

/// One span of a batch.
struct Column {
  std::span<const std::byte> bytes;
  std::size_t rows = 0;
  const char* what = "";  ///< it belongs to
};

template <class T> Column column_of(std::span<T> column, const char* what) {
  return {std::as_bytes(column), column.size(), what};
}

/// The number of rows of all. Throws std::invalid_argument where two differ, or an answer shares memory with any other
/// column.
std::size_t common_rows(std::span<const Column> read, std::span<const Column> answers);

}  // namespace thinwall::batch
