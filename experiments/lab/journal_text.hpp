#pragma once
/// Values as one line of text for a run's journal: every bit is kept, and none is a tab or a newline.

#include <cstdint>
#include <string>
#include <string_view>

namespace thinwall {

class JournalWriter {
 public:
  void put(std::int64_t number);
  void put(double number);
  void put(std::string_view text);
  std::string text() && { return std::move(out_); }

 private:
  std::string& next();
  std::string out_;
};

/// Every function throws std::runtime_error, which quotes the text, if it does not read on as it should.
class JournalReader {
 public:
  explicit JournalReader(std::string_view text) : whole_(text), rest_(text) {}

  std::int64_t integer();
  std::size_t size();  ///< of a list whose entries follow; no more than there is text left for
  double real();
  std::string text();
  bool at_end() const { return rest_.empty(); }
  void require(bool condition) const;

 private:
  std::string_view word();

  std::string_view whole_, rest_;
};

}  // namespace thinwall
