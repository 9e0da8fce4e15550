#include <thinwall/experiments/check/readers.hpp>

#include <algorithm>
#include <array>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <thinwall/experiments/lab/escape.hpp>

namespace thinwall {

namespace {

constexpr std::string_view blanks = " \t\r\n";

/// Thrown where the text stops being XML.
struct IllFormed {
  std::string what;
};

class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}

  void read() {
    read_letters();
    while (at_ < text_.size()) {
      if (take("<!--")) {
        take_until("--");
        expect(">");
      } else if (take("<![CDATA[")) {
        if (open_.empty()) fail("text outside of the one element");
        take_until("]]>");
      } else if (take("<?")) {
        take_until("?>");
      } else if (take("<!DOCTYPE")) {
        take_until(">");
      } else if (take("</")) {
        if (const std::string name = take_name(); open_.empty() || open_.back() != name)
          fail("</" + name + "> ends nothing");
        open_.pop_back();
        take_blanks();
        expect(">");
      } else if (take("<")) {
        read_tag();
      } else {
        read_text();
      }
    }
    if (!open_.empty()) fail("<" + open_.back() + "> has no end");
    if (!has_root_) fail("there is no element");
  }

  std::size_t line() const { return 1 + static_cast<std::size_t>(std::ranges::count(text_.substr(0, at_), '\n')); }

 private:
  [[noreturn]] static void fail(const std::string& what) { throw IllFormed{what}; }

  bool take(std::string_view word) {
    if (!text_.substr(at_).starts_with(word)) return false;
    at_ += word.size();
    return true;
  }
  void expect(std::string_view word) {
    if (!take(word)) fail(fmt::format("{} is missing", word));
  }
  void take_blanks() { at_ = std::min(text_.find_first_not_of(blanks, at_), text_.size()); }
  std::string_view take_until(std::string_view end) {
    const auto found = text_.find(end, at_);
    if (found == std::string_view::npos) fail(fmt::format("{} is missing", end));
    const std::string_view out = text_.substr(at_, found - at_);
    at_ = found + end.size();
    return out;
  }
  std::string take_name() {
    const auto begin = at_;
    at_ = std::min(text_.find_first_of(" \t\r\n<>&/='\"", at_), text_.size());
    if (begin == at_ || std::string_view("-.0123456789").find(text_[begin]) != std::string_view::npos)
      fail("a name is missing");
    return std::string(text_.substr(begin, at_ - begin));
  }

  void read_letters() {
    while (at_ < text_.size()) {
      const std::size_t bytes = blanks.find(text_[at_]) != std::string_view::npos ? 1 : letter_bytes(text_.substr(at_));
      if (bytes == 0) fail("no letter: " + one_line(text_.substr(at_, 1)));
      at_ += bytes;
    }
    at_ = 0;
  }

  void read_tag() {
    if (open_.empty() && has_root_) fail("a second element");
    has_root_ = true;
    const std::string name = take_name();
    std::set<std::string> attributes;
    for (;;) {
      const std::size_t before = at_;
      take_blanks();
      if (take("/>")) return;
      if (take(">")) break;
      if (before == at_) fail("a blank is missing in <" + name + ">");
      if (const std::string attribute = take_name(); !attributes.insert(attribute).second)
        fail(attribute + " stands twice");
      take_blanks();
      expect("=");
      take_blanks();
      const std::string_view value = take("'") ? take_until("'") : (expect("\""), take_until("\""));
      if (value.find('<') != std::string_view::npos) fail("< in an attribute");
      check_references(value);
    }
    open_.push_back(name);
  }

  void read_text() {
    const std::size_t end = std::min(text_.find('<', at_), text_.size());
    const std::string_view text = text_.substr(at_, end - at_);
    if (open_.empty() && text.find_first_not_of(blanks) != std::string_view::npos)
      fail("text outside of the one element");
    if (const auto end_of_data = text.find("]]>"); end_of_data != std::string_view::npos) {
      at_ += end_of_data;
      fail("]]> in text");
    }
    check_references(text);
    at_ = end;
  }

  static void check_references(std::string_view text) {
    for (auto at = text.find('&'); at != std::string_view::npos; at = text.find('&', at + 1)) {
      const std::string_view name = text.substr(at + 1, std::min(text.find(';', at), text.size()) - at - 1);
      const bool ends = at + 1 + name.size() < text.size();
      const bool hex = name.starts_with("#x");
      const std::string_view digits = name.substr(std::min<std::size_t>(hex ? 2 : 1, name.size()));
      const bool number =
          name.starts_with("#") && !digits.empty() &&
          digits.find_first_not_of(hex ? "0123456789abcdefABCDEF" : "0123456789") == std::string_view::npos;
      const std::set<std::string_view> known = {"amp", "lt", "gt", "quot", "apos"};
      if (!ends || (!number && !known.contains(name))) fail("& without an entity");
    }
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::vector<std::string> open_;
  bool has_root_ = false;
};

}  // namespace

std::string xml_fault(std::string_view text) {
  Reader reader(text);
  try {
    reader.read();
  } catch (const IllFormed& fault) {
    return fmt::format("line {}: {}", reader.line(), one_line(fault.what));
  }
  return {};
}

namespace {

constexpr std::string_view space = " \t\n\f\r";

/// Moves `at` past the word that ends before one of `ends`, and returns it.
std::string_view take_word(std::string_view page, std::size_t& at, const std::string& ends) {
  const std::size_t begin = at;
  at = std::min(page.find_first_of(ends, begin), page.size());
  return page.substr(begin, at - begin);
}

void skip(std::string_view page, std::size_t& at, const std::string& letters) {
  at = std::min(page.find_first_not_of(letters, at), page.size());
}

std::string_view take_value(std::string_view page, std::size_t& at) {
  if (at < page.size() && (page[at] == '"' || page[at] == '\'')) {
    const std::string quote(1, page[at++]);
    return take_word(page, at, quote);
  }
  return take_word(page, at, std::string(space) + ">");
}

/// The tag whose name begins at `at`.
HtmlTag tag_at(std::string_view page, std::size_t at) {
  const std::string between(space);
  HtmlTag tag{lower_case(take_word(page, at, between + "/>")), {}};
  for (;;) {
    skip(page, at, between + "/\"'");
    if (at == page.size() || page[at] == '>') return tag;
    const std::size_t begin = at++;  // a name may begin with =
    take_word(page, at, between + "/>=");
    auto& [name, value] = tag.attributes.emplace_back(lower_case(page.substr(begin, at - begin)), "");
    skip(page, at, between);
    if (at == page.size() || page[at] != '=') continue;
    skip(page, ++at, between);
    value = take_value(page, at);
  }
}

}  // namespace

std::vector<HtmlTag> tags_of(std::string_view page) {
  std::vector<HtmlTag> out;
  for (auto at = page.find('<'); at != std::string_view::npos; at = page.find('<', at + 1)) {
    const std::string letter = lower_case(page.substr(at + 1, 1));
    if (letter >= "a" && letter <= "z") out.push_back(tag_at(page, at + 1));
  }
  return out;
}

std::string lower_case(std::string_view text) {
  std::string out(text);
  for (char& letter : out) {
    if ('A' <= letter && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  }
  return out;
}

std::string html_unescaped(std::string_view text) {
  using Entity = std::pair<std::string_view, char>;
  constexpr std::array<Entity, 5> entities = {
      Entity{"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&#39;", '\''}};
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const auto found =
        std::ranges::find_if(entities, [&](const Entity& entity) { return text.substr(at).starts_with(entity.first); });
    out += found == entities.end() ? text[at] : found->second;
    at += found == entities.end() ? 1 : found->first.size();
  }
  return out;
}

namespace {

/// The field that begins at `at`, which is moved to what ends it: a comma, a line's end, or the end of the text.
std::string read_field(std::string_view text, std::size_t& at, std::size_t line) {
  if (at == text.size() || text[at] != '"') {
    const std::size_t end = std::min(text.find_first_of(",\n", at), text.size());
    const std::string_view field = text.substr(at, end - at);
    if (field.find_first_of("\"\r") != std::string::npos)
      throw CsvError(line, "a quote or a CR in a field without quotes");
    at = end;
    return std::string(field);
  }
  std::string field;
  for (++at; at < text.size(); ++at) {
    if (text[at] != '"') {
      field += text[at];
    } else if (at + 1 < text.size() && text[at + 1] == '"') {
      field += text[at++];
    } else {
      ++at;
      if (at < text.size() && text[at] != ',' && text[at] != '\n') throw CsvError(line, "text behind a closing quote");
      return field;
    }
  }
  throw CsvError(line, "a quote is not closed");
}

}  // namespace

std::vector<CsvRow> read_csv(std::string_view text) {
  std::vector<CsvRow> rows;
  std::size_t line = 1;
  for (std::size_t at = 0; at < text.size(); ++at) {
    CsvRow row{line, {}};
    for (const std::size_t begin = at;; ++at) {
      row.fields.push_back(read_field(text, at, line));
      if (at < text.size() && text[at] == ',') continue;
      line += static_cast<std::size_t>(std::ranges::count(text.substr(begin, at - begin), '\n')) + 1;
      break;
    }
    if (at == text.size()) throw CsvError(row.line, "the last line has no end: the file was cut");
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace thinwall
