#include <thinwall/experiments/lab/escape.hpp>

#include <algorithm>

#include <fmt/format.h>
#include <boost/locale/utf.hpp>

#include <thinwall/experiments/lab/text.hpp>

namespace thinwall {
namespace {

bool is_control(char letter) { return static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f; }

/// How many bytes the UTF-8 letter has that `text` begins with; 0 if there is none that can be shown: a control character, one
/// that Unicode says is no character (U+FFFE, U+FFFF), or bytes that are not UTF-8.
std::size_t letter_bytes(std::string_view text) {
  namespace utf = boost::locale::utf;
  const auto* at = text.begin();
  const utf::code_point code = utf::utf_traits<char>::decode(at, text.end());
  const bool control = code < 0x20 || (code >= 0x7f && code < 0xa0);
  const bool letter = code != utf::illegal && code != utf::incomplete && !control && (code & 0xfffe) != 0xfffe;
  return letter ? static_cast<std::size_t>(at - text.begin()) : 0;
}

}  // namespace

std::string replaced(std::string_view text, std::initializer_list<std::pair<char, std::string_view>> spelled) {
  std::string out;
  for (const char letter : text) {
    const auto* const found = std::ranges::find(spelled, letter, &std::pair<char, std::string_view>::first);
    out += found == spelled.end() ? std::string_view(&letter, 1) : found->second;
  }
  return out;
}

std::string one_line(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t bytes = letter_bytes(text);
    out +=
        bytes > 0 ? std::string(text.substr(0, bytes)) : fmt::format("\\x{:02x}", static_cast<unsigned char>(text[0]));
    text.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return out;
}

std::string gnuplot_quoted(std::string_view text) {
  std::string plain = one_line(text), out = "\"";
  if (plain.find('\'') == std::string::npos) return "'" + plain + "'";
  for (const char letter : plain) {
    const bool special = std::string_view("'\"\\`@").find(letter) != std::string_view::npos;
    out += special ? fmt::format("\\{:03o}", static_cast<unsigned char>(letter)) : std::string(1, letter);
  }
  return out + '"';
}

std::string gnuplot_unquoted(std::string_view script) {
  const auto begin = script.find_first_of("'\"");
  if (begin == std::string_view::npos) return {};
  const char quote = script[begin];
  const auto digit = [&](std::size_t at) { return at < script.size() && script[at] >= '0' && script[at] <= '7'; };
  std::string out;
  for (std::size_t at = begin + 1; at < script.size(); ++at) {
    if (script[at] == quote) {
      if (quote == '"' || !script.substr(at).starts_with("''")) break;
      ++at;  // a doubled one
    } else if (quote == '"' && script[at] == '\\' && digit(at + 1) && digit(at + 2) && digit(at + 3)) {
      out += static_cast<char>((script[at + 1] - '0') * 64 + (script[at + 2] - '0') * 8 + script[at + 3] - '0');
      at += 3;
      continue;
    }
    out += script[at];
  }
  return out;
}

std::string clipped(std::string_view text, std::size_t letters) {
  if (text.size() <= letters) return std::string(text);
  const auto continues = [&](std::size_t at) { return (static_cast<unsigned char>(text[at]) & 0xc0) == 0x80; };
  while (letters > 0 && continues(letters)) --letters;
  return std::string(text.substr(0, letters)) + "...";
}

std::string json_string(std::string_view text) {
  std::string out = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') {
      out += '\\';
      out += letter;
    } else if (is_control(letter)) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned char>(letter));
    } else {
      out += letter;
    }
  }
  return out + '"';
}

std::string html_escaped(std::string_view text) {
  return replaced(text, {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}, {'\'', "&#39;"}});
}

std::string latex_escaped(std::string_view text) {
  return replaced(text, {{'\\', "\\textbackslash{}"},
                         {'~', "\\textasciitilde{}"},
                         {'^', "\\textasciicircum{}"},
                         {'&', "\\&"},
                         {'%', "\\%"},
                         {'$', "\\$"},
                         {'#', "\\#"},
                         {'_', "\\_"},
                         {'{', "\\{"},
                         {'}', "\\}"},
                         {'<', "\\textless{}"},
                         {'>', "\\textgreater{}"},
                         {'|', "\\textbar{}"},
                         {'"', "''"}});
}

std::string markdown_escaped(std::string_view text) {
  std::string out = replaced(
      text, {{'|', "\\|"}, {'*', "\\*"}, {'_', "\\_"}, {'`', "\\`"}, {'<', "&lt;"}, {'\\', "\\\\"}, {'\n', " "}});
  replace_all(out, "](", "]\\(");
  return out;
}

std::string single_quoted(std::string_view text) { return "'" + replaced(text, {{'\'', "'\\''"}}) + "'"; }

std::string shell_line(const std::vector<std::string>& words) {
  constexpr std::string_view plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-+=./:,@%";
  std::string line;
  for (const std::string& word : words) {
    if (!line.empty()) line += ' ';
    const bool is_plain = !word.empty() && word.find_first_not_of(plain) == std::string::npos;
    line += is_plain ? word : single_quoted(word);
  }
  return line;
}

std::string tsv_escaped(std::string_view text) {
  return replaced(text, {{'\t', "\\t"}, {'\n', "\\n"}, {'\r', "\\r"}, {'\\', "\\\\"}});
}

std::string tsv_unescaped(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\\' || i + 1 == text.size()) {
      out += text[i];
      continue;
    }
    const char code = text[++i];
    out += code == 't' ? '\t' : code == 'n' ? '\n' : code == 'r' ? '\r' : code;
  }
  return out;
}

}  // namespace thinwall
