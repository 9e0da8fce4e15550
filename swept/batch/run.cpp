#include <thinwall/swept/batch/run.hpp>

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <string>

#include <hwy/highway.h>
#include <tbb/blocked_range.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace thinwall::batch {
namespace {

bool share_memory(const Column& a, const Column& b) {
  const std::less<const std::byte*> before;
  return before(a.bytes.data(), b.bytes.data() + b.bytes.size()) &&
         before(b.bytes.data(), a.bytes.data() + a.bytes.size());
}

void require_apart(const Column& answer, const Column& other) {
  if (share_memory(answer, other)) {
    throw std::invalid_argument(std::string("thinwall batch: ") + answer.what + " share memory with " + other.what);
  }
}

}  // namespace

std::size_t common_rows(std::span<const Column> read, std::span<const Column> answers) {
  const Column& first = answers.front();
  for (const std::span<const Column> columns : {read, answers}) {
    for (const Column& column : columns) {
      if (column.rows != first.rows) {
        throw std::invalid_argument(std::string("thinwall batch: ") + first.what + " have " +
                                    std::to_string(first.rows) + " rows, and a column of " + column.what + " has " +
                                    std::to_string(column.rows));
      }
    }
  }
  for (std::size_t i = 0; i < answers.size(); ++i) {
    for (const Column& column : read) require_apart(answers[i], column);
    for (std::size_t j = 0; j < i; ++j) require_apart(answers[i], answers[j]);
  }
  return first.rows;
}

}  // namespace thinwall::batch

namespace thinwall {

namespace {

std::vector<std::int64_t> targets() {
  std::vector<std::int64_t> out = hwy::SupportedAndGeneratedTargets();  // the lowest bit is the widest
  if (out.empty() || out.back() != HWY_STATIC_TARGET) out.push_back(HWY_STATIC_TARGET);
  return out;
}

std::int64_t& in_use() {
  static std::int64_t target = targets().front();
  return target;
}

}  // namespace

std::vector<std::string> vector_targets() {
  std::vector<std::string> names;
  for (const std::int64_t target : targets()) names.emplace_back(hwy::TargetName(target));
  return names;
}

void use_vectors(const std::string& name) {
  for (const std::int64_t target : targets()) {
    if (!name.empty() && name != hwy::TargetName(target)) continue;
    hwy::GetChosenTarget().Update(target);
    in_use() = target;
    return;
  }
  std::string known;
  for (const std::string& one : vector_targets()) known += (known.empty() ? "" : ", ") + one;
  throw std::invalid_argument("thinwall batch: no vectors \"" + name + "\" on this machine; there are " + known);
}

std::string vectors_in_use() { return hwy::TargetName(in_use()); }

}  // namespace thinwall

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
