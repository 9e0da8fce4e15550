#include <thinwall/swept/batch/threads.hpp>

#include <algorithm>
#include <stdexcept>
#include <string>

#include <tbb/blocked_range.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace thinwall::batch {

void for_each_block(std::size_t rows, std::size_t block, const BatchOptions& options,
                    const std::function<void(std::size_t begin, std::size_t end)>& visit) {
  if (options.threads < 0) {
    throw std::invalid_argument("thinwall batch: threads must be at least 0, which takes all; they are " +
                                std::to_string(options.threads));
  }
  const std::size_t blocks = rows / block + (rows % block != 0 ? 1 : 0);
  const auto visit_blocks = [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) visit(i * block, std::min((i + 1) * block, rows));
  };
  if (options.threads == 1 || blocks <= 1) return visit_blocks(0, blocks);
  const int most = tbb::info::default_concurrency();
  tbb::task_arena arena(options.threads == 0 ? most : std::min(options.threads, most));
  arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, blocks, 4),
                      [&](const auto& range) { visit_blocks(range.begin(), range.end()); });
  });
}

}  // namespace thinwall::batch
