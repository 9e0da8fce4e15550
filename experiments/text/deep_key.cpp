#include <thinwall/experiments/text/deep_key.hpp>

#include <algorithm>

namespace thinwall {
namespace {

/// Where the string that begins at `from` ends: behind its last quote, or at the end of the line where it has none.
std::size_t end_of_string(std::string_view text, std::size_t from) {
  const char quote = text[from];
  const std::string_view three = text.substr(from, 3);
  const bool is_long = three == R"(""")" || three == "'''";
  std::size_t at = from + (is_long ? 3 : 1);
  for (; at < text.size(); ++at) {
    if (quote == '"' && text[at] == '\\') {
      ++at;
    } else if (is_long ? text.substr(at, 3) == three : text[at] == quote || text[at] == '\n') {
      break;
    }
  }
  if (is_long) return std::min(text.find_first_not_of(quote, at), text.size());  // up to two quotes more are its own
  return at < text.size() && text[at] == quote ? at + 1 : at;
}

}  // namespace

int line_of_deep_key(std::string_view text, int most) {
  constexpr std::string_view in_a_key = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_. \t\"'";
  int parts = 1;
  for (std::size_t at = 0; at < text.size();) {
    const char letter = text[at];
    if (in_a_key.find(letter) == std::string_view::npos) parts = 1;
    if (letter == '.' && ++parts > most) return 1 + static_cast<int>(std::ranges::count(text.substr(0, at), '\n'));
    if (letter == '#') {
      at = std::min(text.find('\n', at), text.size());
    } else {
      at = letter == '"' || letter == '\'' ? end_of_string(text, at) : at + 1;
    }
  }
  return 0;
}

}  // namespace thinwall
