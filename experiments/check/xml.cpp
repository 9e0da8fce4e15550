#include <thinwall/experiments/check/xml.hpp>

#include <algorithm>
#include <set>
#include <vector>

#include <fmt/format.h>

#include <thinwall/experiments/text/escape.hpp>

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

}  // namespace thinwall
