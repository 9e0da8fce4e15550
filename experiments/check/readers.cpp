#include <thinwall/experiments/check/readers.hpp>

#include <algorithm>
#include <limits>
#include <locale>
#include <memory>
#include <utility>
#include <vector>

#include <expat.h>
#include <fmt/format.h>
#include <boost/algorithm/string.hpp>

#include <thinwall/experiments/lab/text.hpp>

namespace thinwall {

std::string xml_fault(std::string_view text) {
  const std::unique_ptr<XML_ParserStruct, void (*)(XML_Parser)> parser(XML_ParserCreate("UTF-8"), XML_ParserFree);
  XML_UseParserAsHandlerArg(parser.get());
  // A document type may declare entities, elsewhere too, which a reader need not have: a name is all it may be.
  XML_SetStartDoctypeDeclHandler(parser.get(), [](void* itself, const XML_Char*, const XML_Char* elsewhere,
                                                  const XML_Char*, int has_declarations) {
    if (elsewhere != nullptr || has_declarations != 0) XML_StopParser(static_cast<XML_Parser>(itself), XML_FALSE);
  });
  if (text.size() > std::size_t{std::numeric_limits<int>::max()}) return "too long to be read";
  if (XML_Parse(parser.get(), text.data(), static_cast<int>(text.size()), XML_TRUE) == XML_STATUS_OK) return {};
  const XML_Error error = XML_GetErrorCode(parser.get());
  return fmt::format("line {}, column {}: {}", XML_GetCurrentLineNumber(parser.get()),
                     XML_GetCurrentColumnNumber(parser.get()) + 1,
                     XML_ErrorString(error == XML_ERROR_ABORTED ? XML_ERROR_UNDEFINED_ENTITY : error));
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
  return boost::to_lower_copy(std::string(text), std::locale::classic());
}

std::string html_unescaped(std::string_view text) {
  std::string out(text);
  for (const auto& [entity, letter] :
       {std::pair{"&lt;", "<"}, {"&gt;", ">"}, {"&quot;", "\""}, {"&#39;", "'"}, {"&amp;", "&"}})
    replace_all(out, entity, letter);
  return out;
}

}  // namespace thinwall
