#include <thinwall/experiments/check/html_tags.hpp>

#include <algorithm>
#include <array>
#include <utility>

namespace thinwall {
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
  const std::string blanks(space);
  HtmlTag tag{lower_case(take_word(page, at, blanks + "/>")), {}};
  for (;;) {
    skip(page, at, blanks + "/\"'");
    if (at == page.size() || page[at] == '>') return tag;
    const std::size_t begin = at++;  // a name may begin with =
    take_word(page, at, blanks + "/>=");
    auto& [name, value] = tag.attributes.emplace_back(lower_case(page.substr(begin, at - begin)), "");
    skip(page, at, blanks);
    if (at == page.size() || page[at] != '=') continue;
    skip(page, ++at, blanks);
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

}  // namespace thinwall
