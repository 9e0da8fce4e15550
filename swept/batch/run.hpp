#pragma once
/// What passes between the front door of a batch and its vector code.

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/discrete/obb.hpp>
#include <thinwall/swept/moving.hpp>
#include <thinwall/swept/toi.hpp>

namespace thinwall::batch {

inline constexpr std::size_t most_columns = 18;

/// The arrays of one side, or one number each, in the order of RowsOf::columns.
template <class S> struct Rows {
  const S* columns[most_columns];
  std::size_t count;
  bool is_one;  ///< one shape against every row of the other side

  Rows from(std::size_t i) const {
    Rows rows = *this;
    for (std::size_t k = 0; k < count && !is_one; ++k) rows.columns[k] += i;
    return rows;
  }
};

/// Where the answers to n rows go.
template <class S> struct Answers {
  ToiStatus* status;
  S* time;
  S* upper = nullptr;  ///< of a certified batch, whose `time` is the lower bound

  Answers from(std::size_t i) const { return {status + i, time + i, upper == nullptr ? nullptr : upper + i}; }
};

/// Marks a row that rounding might turn. The closed form never gives up on the pairs that have a batch.
inline constexpr ToiStatus not_clear = ToiStatus::gave_up;

/// Answers n rows by the widest vectors that this machine has, or that use_vectors() chose, and
/// returns how many of them are not_clear. Defined for the pairs of batch.hpp, in their order, for float and double.
template <class ItemA, class ItemB, class S>
std::size_t run(const Rows<S>& a, const Rows<S>& b, std::size_t n, const Answers<S>& out);

/// The same for certified answers of two spheres.
std::size_t run_certified_spheres(const Rows<double>& a, const Rows<double>& b, std::size_t n,
                                  const Answers<double>& out);

}  // namespace thinwall::batch

// ---- What a batch asks of its spans: equal lengths, and answers that overwrite nothing it still reads.

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

// ---- Which vectors batches use.

namespace thinwall {

/// The instruction sets that batches are built for and that this machine has, the widest first: "AVX3" is AVX-512. The
/// last is scalar code and always there.
std::vector<std::string> vector_targets();

/// Makes batches use the target of that name from now on, in every thread; "" is the widest again. Throws std::invalid_argument
/// for one that vector_targets() does not name. For tests and benchmarks: call it while no batch runs.
void use_vectors(const std::string& name);

/// The one in use.
std::string vectors_in_use();

// ---- How a batch is shared among threads.

struct BatchOptions {
  int threads = 1;  ///< >= 0; 0, and any number above, is as many as the machine has
};

namespace batch {

/// Calls `visit(begin, end)` for blocks of `block` rows that cover [0, rows), by as many threads as asked for; in order, by
/// this one alone, where one is asked for or one block is all. Throws std::invalid_argument for less than 0 threads.
void for_each_block(std::size_t rows, std::size_t block, const BatchOptions& options,
                    const std::function<void(std::size_t begin, std::size_t end)>& visit);

}  // namespace batch

}  // namespace thinwall
