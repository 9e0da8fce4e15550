#include <thinwall/experiments/lab/record.hpp>

#include <charconv>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/text.hpp>

namespace thinwall {

void RealSum::add(double x) {
  ++count;
  units += std::llround(std::ldexp(x, 32));
}

std::optional<double> RealSum::mean() const {
  if (count == 0) return std::nullopt;
  return std::ldexp(static_cast<double>(units), -32) / static_cast<double>(count);
}

std::string& JournalWriter::next() {
  if (!out_.empty()) out_ += ' ';
  return out_;
}

void JournalWriter::put(std::int64_t number) { next() += std::to_string(number); }
void JournalWriter::put(double number) { next() += fmt::format("{:a}", number); }

void JournalWriter::put(std::string_view text) {
  std::string& out = next() += '\'';  // so that an empty text is a word too
  for (const char letter : text) {
    const auto byte = static_cast<unsigned char>(letter);
    if (byte <= ' ' || byte == '%' || byte == 0x7f) {
      out += fmt::format("%{:02x}", byte);
    } else {
      out += letter;
    }
  }
}

void JournalReader::require(bool condition) const {
  if (!condition) throw std::runtime_error("not a record of this run: " + clipped(std::string(whole_), 200));
}

std::string_view JournalReader::word() {
  require(!rest_.empty());
  const auto end = rest_.find(' ');
  const std::string_view word = rest_.substr(0, end);
  rest_ = end == std::string_view::npos ? std::string_view() : rest_.substr(end + 1);
  require(!word.empty() && (end == std::string_view::npos || !rest_.empty()));
  return word;
}

std::int64_t JournalReader::integer() {
  const auto number = parsed<std::int64_t>(word());
  require(number.has_value());
  return *number;
}

std::size_t JournalReader::size() {
  const std::int64_t number = integer();
  require(number >= 0 && static_cast<std::size_t>(number) <= rest_.size());
  return static_cast<std::size_t>(number);
}

double JournalReader::real() {
  const std::string text(word());
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);  // from_chars does not read 0x, nor streams hexadecimals
  require(end == text.c_str() + text.size());
  return number;
}

std::string JournalReader::text() {
  std::string_view rest = word();
  require(rest[0] == '\'');
  std::string out;
  for (rest.remove_prefix(1); !rest.empty(); rest.remove_prefix(1)) {
    if (rest[0] != '%') {
      out += rest[0];
      continue;
    }
    unsigned byte = 0;
    require(rest.size() >= 3 && std::from_chars(rest.data() + 1, rest.data() + 3, byte, 16).ptr == rest.data() + 3);
    out += static_cast<char>(byte);
    rest.remove_prefix(2);
  }
  return out;
}

}  // namespace thinwall
