#include <thinwall/swept/batch/check_rows.hpp>

#include <functional>
#include <stdexcept>
#include <string>

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
