#include <thinwall/experiments/lab/comparison.hpp>

#include <algorithm>
#include <set>
#include <sstream>
#include <string_view>

#include <fmt/format.h>

#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/files.hpp>
#include <thinwall/experiments/lab/table_text.hpp>

namespace thinwall {

namespace {

using Kind = FileDifference::Kind;
namespace fs = std::filesystem;

std::string text_of(const std::vector<CsvRow>& rows, std::size_t i) {
  return i < rows.size() ? fmt::format("{}", fmt::join(rows[i].fields, ",")) : std::string();
}

/// Nothing for the same fields, otherwise quoted, and for what is no CSV.
std::optional<FileDifference> csv_difference(const std::string& file, const std::string& recorded,
                                             const std::string& rerun) try {
  const auto a = read_csv(recorded), b = read_csv(rerun);
  for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
    const auto number = static_cast<std::int64_t>(i);
    const bool alike = i < a.size() && i < b.size() && a[i].fields.size() == b[i].fields.size();
    if (alike && a[i].fields == b[i].fields) continue;
    if (i == 0 || !alike)
      return FileDifference{file, i == 0 ? Kind::columns : Kind::row, number, {}, text_of(a, i), text_of(b, i)};
    const auto [ours, theirs] = std::ranges::mismatch(a[i].fields, b[i].fields);
    const auto column = static_cast<std::size_t>(ours - a[i].fields.begin());
    const std::vector<std::string>& names = a[0].fields;
    return FileDifference{file, Kind::cell, number, column < names.size() ? names[column] : "", *ours, *theirs};
  }
  return std::nullopt;
} catch (const CsvError&) {
  return std::nullopt;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// What a line of a BibTeX file says of the result, not of the day or the program that computed it.
std::string lasting_part(const std::string& line) {
  const std::string_view word = std::string_view(line).substr(std::min(line.find_first_not_of(' '), line.size()));
  for (const char* field : {"date ", "year ", "version "}) {
    if (word.starts_with(field)) return field;
  }
  return line.substr(0, line.find(", commit "));
}

std::optional<FileDifference> line_difference(const std::string& file, const std::string& recorded,
                                              const std::string& rerun) {
  const auto a = lines_of(recorded), b = lines_of(rerun);
  const bool dated = file.ends_with(".bib");
  for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
    const std::string left = i < a.size() ? a[i] : "", right = i < b.size() ? b[i] : "";
    const bool same = dated ? lasting_part(left) == lasting_part(right) : left == right;
    if (same && i < a.size() && i < b.size()) continue;
    return FileDifference{file, Kind::line, static_cast<std::int64_t>(i) + 1, {}, left, right};
  }
  if (dated || recorded == rerun) return std::nullopt;
  return FileDifference{file, Kind::line, static_cast<std::int64_t>(a.size()),
                        {},   "the end",  "another end of the last line"};
}

/// Of two long values, the part where they first differ.
std::string both(const std::string& recorded, const std::string& rerun) {
  constexpr std::size_t before = 20, most = 60;  // letters
  const auto length = std::min(recorded.size(), rerun.size());
  std::size_t same = 0;
  while (same < length && recorded[same] == rerun[same]) ++same;
  const std::size_t from = std::max(recorded.size(), rerun.size()) > most && same > before ? same - before : 0;
  const auto shown = [&](const std::string& value) {
    if (value.empty()) return std::string("nothing");
    return (from > 0 ? "..." : "") +
           clipped(one_line(std::string_view(value).substr(std::min(from, value.size()))), most);
  };
  return fmt::format("recorded {}, rerun {}", shown(recorded), shown(rerun));
}

}  // namespace

std::optional<FileDifference> first_difference(const std::string& file, const std::string& recorded,
                                               const std::string& rerun) {
  if (recorded == rerun) return std::nullopt;
  if (file.ends_with(".csv")) {
    if (auto difference = csv_difference(file, recorded, rerun)) return difference;
  }
  return line_difference(file, recorded, rerun);
}

std::string to_text(const FileDifference& difference) {
  const std::string values = both(difference.recorded, difference.rerun);
  switch (difference.kind) {
    case Kind::cell:
      return fmt::format("{}: row {}, column '{}': {}", difference.file, difference.row, difference.column, values);
    case Kind::row: return fmt::format("{}: row {}: {}", difference.file, difference.row, values);
    case Kind::columns: return fmt::format("{}: the columns: {}", difference.file, values);
    case Kind::line: return fmt::format("{}: line {}: {}", difference.file, difference.row, values);
    case Kind::only_recorded: return difference.file + ": not in the rerun";
    case Kind::only_rerun: return difference.file + ": only in the rerun";
  }
  return {};
}

std::vector<std::string> files_changed_since(const fs::path& result, const Manifest& recorded) {
  std::vector<std::string> out;
  for (const auto& [file, hash] : recorded.hashes) {
    if (!is_unchanged(result, file, hash)) out.push_back(file);
  }
  return out;
}

RerunComparison compare_rerun(const fs::path& result, const Manifest& recorded, const std::vector<std::string>& changed,
                              const fs::path& rerun, const Manifest& again) {
  RerunComparison out{.differences = {}, .facts = changed_facts(recorded, again)};
  std::set<std::string> files;
  for (const auto* hashes : {&recorded.hashes, &again.hashes}) {
    for (const auto& [file, hash] : *hashes) files.insert(file);
  }
  out.files = static_cast<int>(files.size());
  bool by_hand = true;
  for (const std::string& file : files) {
    const auto as_recorded = recorded.hashes.find(file), as_rerun = again.hashes.find(file);
    const bool there = as_recorded != recorded.hashes.end(), here = as_rerun != again.hashes.end();
    std::optional difference = FileDifference{file, here ? Kind::only_rerun : Kind::only_recorded, 0, {}, {}, {}};
    if (here && there && holds_file(result, file))
      difference = first_difference(file, file_text(result / file), file_text(rerun / file));
    if (!difference) continue;
    out.differences.push_back(*difference);
    by_hand = by_hand && std::ranges::find(changed, file) != changed.end() && here && there &&
              (as_recorded->second == as_rerun->second || file.ends_with(".bib"));
  }
  out.explained_by_hand = by_hand && !out.differences.empty();
  return out;
}

}  // namespace thinwall
