#pragma once
/// Readers that trust nothing: XML, the tags of HTML.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace thinwall {

// ---- Is a text an XML document that every reader takes?

/// What is ill-formed in it, with line and column; empty if nothing is. Nothing outside of it is read.
std::string xml_fault(std::string_view text);

// ---- The tags of an HTML page, read as a browser reads them.

struct HtmlTag {
  std::string name;                                             ///< in lower case
  std::vector<std::pair<std::string, std::string>> attributes;  ///< name in lower case, and value without quotes
};

/// Every opening tag. One that stands where a browser would not look, as in a comment, counts too.
std::vector<HtmlTag> tags_of(std::string_view page);

/// In lower case, for ASCII.
std::string lower_case(std::string_view text);

/// The text that `html_escaped` made so.
std::string html_unescaped(std::string_view text);

}  // namespace thinwall
