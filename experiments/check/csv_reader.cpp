#include <thinwall/experiments/check/csv_reader.hpp>

#include <algorithm>

namespace thinwall {
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
