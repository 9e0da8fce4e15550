#include <thinwall/experiments/program/harmless_output.hpp>

#include <utility>

#include <fmt/format.h>

namespace thinwall {

std::streambuf::int_type HarmlessOutput::Buffer::overflow(int_type value) {
  if (traits_type::eq_int_type(value, traits_type::eof())) return traits_type::not_eof(value);
  const char letter = traits_type::to_char_type(value);
  const auto code = static_cast<unsigned char>(letter);
  const bool after_c2 = std::exchange(after_c2_, code == 0xc2);
  const bool is_c1 = after_c2 && 0x80 <= code && code < 0xa0;
  if (after_c2 && !is_c1) out_.put('\xc2');
  if (is_c1 || code == 0x7f) {
    out_ << fmt::format("\\u{:04x}", code);
  } else if (code < 0x20 && letter != '\n' && letter != '\t') {
    out_ << fmt::format("\\x{:02x}", code);
  } else if (!after_c2_) {
    out_.put(letter);
  }
  return out_ ? value : traits_type::eof();
}

int HarmlessOutput::Buffer::sync() {
  if (std::exchange(after_c2_, false)) out_.put('\xc2');
  return out_.flush() ? 0 : -1;
}

}  // namespace thinwall
