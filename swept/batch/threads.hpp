#pragma once
/// How a batch is shared among threads.

#include <cstddef>
#include <functional>

namespace thinwall {

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
