#pragma once
/// Readers that trust nothing: XML, the tags of HTML, CSV.

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace thinwall {

// ---- Is a text an XML document that every reader takes?

/// What is ill-formed in it, with the line; empty if nothing is. An internal subset of a DOCTYPE is not read, nor entities of its own.
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

// ---- CSV as RFC 4180 defines it, but for lines that end in LF.

struct CsvRow {
  std::size_t line = 0;  ///< where it begins, from 1
  std::vector<std::string> fields;
};

/// Says what is wrong and in which line.
struct CsvError : std::runtime_error {
  CsvError(std::size_t at, const std::string& what) : std::runtime_error(what), line(at) {}
  std::size_t line;
};

/// Every row, the header too. Throws CsvError.
std::vector<CsvRow> read_csv(std::string_view text);

}  // namespace thinwall
