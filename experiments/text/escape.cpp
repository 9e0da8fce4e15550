#include <thinwall/experiments/text/escape.hpp>

#include <algorithm>

#include <fmt/format.h>

namespace thinwall {
namespace {

bool is_control(char letter) { return static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f; }

/// Each letter as `replacement(letter)` says, or itself where that is empty.
template <class Replacement> std::string replaced(std::string_view text, Replacement replacement) {
  std::string out;
  out.reserve(text.size());
  for (const char letter : text) {
    const std::string_view other = replacement(letter);
    if (other.empty()) {
      out += letter;
    } else {
      out += other;
    }
  }
  return out;
}

}  // namespace

std::string one_line(std::string_view text) {
  std::string out;
  for (const char letter : text) {
    out += is_control(letter) ? fmt::format("\\x{:02x}", static_cast<unsigned char>(letter)) : std::string(1, letter);
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
  return replaced(text, [](char letter) -> std::string_view {
    switch (letter) {
      case '&': return "&amp;";
      case '<': return "&lt;";
      case '>': return "&gt;";
      case '"': return "&quot;";
      case '\'': return "&#39;";
      default: return {};
    }
  });
}

std::string latex_escaped(std::string_view text) {
  return replaced(text, [](char letter) -> std::string_view {
    switch (letter) {
      case '\\': return "\\textbackslash{}";
      case '~': return "\\textasciitilde{}";
      case '^': return "\\textasciicircum{}";
      case '&': return "\\&";
      case '%': return "\\%";
      case '$': return "\\$";
      case '#': return "\\#";
      case '_': return "\\_";
      case '{': return "\\{";
      case '}': return "\\}";
      case '<': return "\\textless{}";
      case '>': return "\\textgreater{}";
      case '|': return "\\textbar{}";
      case '"': return "''";
      default: return {};
    }
  });
}

std::string markdown_escaped(std::string_view text) {
  std::string out = replaced(text, [](char letter) -> std::string_view {
    switch (letter) {
      case '|': return "\\|";
      case '*': return "\\*";
      case '_': return "\\_";
      case '`': return "\\`";
      case '<': return "&lt;";
      case '\\': return "\\\\";
      case '\n': return " ";
      default: return {};
    }
  });
  for (auto at = out.find("]("); at != std::string::npos; at = out.find("](", at)) out.insert(at + 1, 1, '\\');
  return out;
}

std::string shell_line(const std::vector<std::string>& words) {
  constexpr std::string_view plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-+=./:,@%";
  std::string line;
  for (const std::string& word : words) {
    if (!line.empty()) line += ' ';
    if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) {
      line += word;
    } else {
      line += '\'' + replaced(word, [](char letter) { return letter == '\'' ? "'\\''" : ""; }) + '\'';
    }
  }
  return line;
}

std::string tsv_escaped(std::string_view text) {
  return replaced(text, [](char letter) -> std::string_view {
    switch (letter) {
      case '\t': return "\\t";
      case '\n': return "\\n";
      case '\r': return "\\r";
      case '\\': return "\\\\";
      default: return {};
    }
  });
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
