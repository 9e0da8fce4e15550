#include <thinwall/experiments/validate/validate.hpp>

#include <algorithm>
#include <chrono>
#include <system_error>

#include <fmt/format.h>

#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/lab/statistics.hpp>
#include <thinwall/experiments/lab/text.hpp>
#include <thinwall/swept/time_of_impact.hpp>

namespace thinwall {

namespace {

RationalPoint exact_point(const Vec3<double>& v) { return {Rational(v[0]), Rational(v[1]), Rational(v[2])}; }

/// The nearest doubles; nothing if one is out of range.
std::optional<Vec3<double>> nearest(const RationalPoint& point) {
  Vec3<double> v;
  for (std::size_t i = 0; i < 3; ++i) v[static_cast<int>(i)] = point[i].convert_to<double>();
  return is_finite(v) ? std::optional(v) : std::nullopt;
}

std::optional<Rational> exact_contact(Primitives primitives, const std::array<RationalPoint, 4>& at,
                                      const RationalPoint& displacement_a, const RationalPoint& displacement_b) {
  ExactQuery query;
  if (primitives == Primitives::vertex_face) {  // the vertex, seen from the face
    query = {FlatSet::triangle, difference(at[0], at[1]), difference(displacement_a, displacement_b),
             difference(at[2], at[1]), difference(at[3], at[1])};
  } else {  // the second edge, seen from the first
    query = {FlatSet::parallelogram, difference(at[2], at[0]), difference(displacement_b, displacement_a),
             difference(at[1], at[0]), difference(at[2], at[3])};
  }
  return first_contact(query);
}

namespace fs = std::filesystem;

constexpr std::size_t columns = 7;
constexpr std::size_t most_digits = 10'000;  // of an integer; the largest ratio a double needs has 324

bool is_integer(std::string_view text) {
  if (text.starts_with('-')) text.remove_prefix(1);
  return !text.empty() && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

/// Boost takes a leading zero for octal.
Integer integer(std::string_view text) {
  const bool negative = text.starts_with('-');
  const std::size_t first = text.find_first_not_of("-0");
  if (first == std::string_view::npos) return 0;
  const Integer value(std::string(text.substr(first)));
  return negative ? -value : value;
}

std::string shown(const fs::path& path) { return one_line(path.string()); }

constexpr std::size_t most_wrongs = 20;
constexpr int timed_calls = 32;

std::string family_name(const fs::path& folder, const fs::path& file, Primitives primitives) {
  fs::path family;
  for (const fs::path& part : file.lexically_relative(folder).parent_path()) {
    if (part != name(primitives)) family /= part;
  }
  return family.empty() ? "." : one_line(family.generic_string());
}

double nanoseconds_a_call(const RigidQuery& query) {
  using Clock = std::chrono::steady_clock;
  volatile double sink = 0;
  const Clock::time_point start = Clock::now();
  for (int call = 0; call < timed_calls; ++call) {
    const Toi<double> toi = library_answer(query);
    sink = sink + toi.time + toi.normal[0] + toi.point[0];
  }
  return std::chrono::duration<double, std::nano>(Clock::now() - start).count() / timed_calls;
}

/// Counts one answer and says what is wrong with it; nothing if all agree.
std::string judge(ToiStatus status, bool exact, bool published, QueryCounts& counts) {
  const bool hit = status == ToiStatus::hit || status == ToiStatus::overlapping;
  counts.hits += exact;
  std::string wrong;
  if (exact != published) {
    ++counts.file_differs;
    wrong += fmt::format("the file says {}, exact arithmetic {}; ", published ? "hit" : "miss", exact ? "hit" : "miss");
  }
  if (status == ToiStatus::gave_up || status == ToiStatus::invalid) {
    ++counts.undecided;
    wrong += "the library gives no verdict; ";
  } else if (!hit && (exact || published)) {
    ++counts.false_negatives;
    wrong += "false negative; ";
  } else if (hit && !(exact && published)) {
    ++counts.false_positives;
    wrong += "false positive; ";
  }
  return wrong.substr(0, wrong.empty() ? 0 : wrong.size() - 2);
}

}  // namespace

RigidReading read_rigid(Primitives primitives, const PublishedQuery& published) {
  const std::size_t first_b = primitives == Primitives::vertex_face ? 1 : 2;
  std::array<RationalPoint, 4> displacement;
  for (std::size_t k = 0; k < 4; ++k) {
    displacement[k] = difference(published.at_end[k], published.at_start[k]);
    const std::size_t leader = k < first_b ? 0 : first_b;
    if (displacement[k] != displacement[leader]) return {std::nullopt, Skipped::not_rigid};
  }
  RigidQuery query;
  query.primitives = primitives;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto vertex = nearest(published.at_start[k]);
    if (!vertex || exact_point(*vertex) != published.at_start[k]) return {std::nullopt, Skipped::not_double};
    query.at_start[k] = *vertex;
  }
  const auto a = nearest(displacement[0]), b = nearest(displacement[first_b]);
  if (!a || !b) return {std::nullopt, Skipped::not_double};
  query.displacement_a = *a;
  query.displacement_b = *b;
  const RationalPoint posed_a = exact_point(*a), posed_b = exact_point(*b);
  query.rounded = posed_a != displacement[0] || posed_b != displacement[first_b];
  query.published_contact = exact_contact(primitives, published.at_start, displacement[0], displacement[first_b]);
  query.posed_contact = query.rounded ? exact_contact(primitives, published.at_start, posed_a, posed_b)  //
                                      : query.published_contact;
  if (query.posed_contact.has_value() != query.published_contact.has_value()) {
    return {std::nullopt, Skipped::rounding_decides};
  }
  return {query, Skipped::not_rigid};
}

Toi<double> library_answer(const RigidQuery& query) {
  const auto& at = query.at_start;
  if (query.primitives == Primitives::vertex_face) {
    return time_of_impact(Moving{Sphere<double>{at[0], 0}, query.displacement_a},
                          Moving{Triangle<double>{at[1], at[2], at[3]}, query.displacement_b});
  }
  return time_of_impact(Moving{Capsule<double>{at[0], at[1], 0}, query.displacement_a},
                        Moving{Capsule<double>{at[2], at[3], 0}, query.displacement_b});
}

std::string_view name(Primitives primitives) {
  return primitives == Primitives::vertex_face ? "vertex-face" : "edge-edge";
}

QueryLines::QueryLines(const fs::path& file) : shown_(one_line(file.string())), in_(file, std::ios::binary) {
  if (!in_) throw UsageError(shown_ + ": cannot be read");
}

bool QueryLines::next() {
  if (!std::getline(in_, text_)) {
    if (in_.bad()) throw UsageError(shown_ + ": cannot be read");
    return false;
  }
  ++line_;
  if (text_.ends_with('\r')) text_.pop_back();
  return true;
}

std::vector<std::string_view> QueryLines::fields(std::size_t needed) const {
  std::vector<std::string_view> made = split(text_, ',');
  if (made.size() != needed) refuse(fmt::format("{} columns; {} are needed", made.size(), needed));
  return made;
}

void QueryLines::refuse(const std::string& reason) const {
  throw UsageError(fmt::format("{}:{}: {}", shown_, std::max(line_, std::size_t{1}), reason));
}

void QueryLines::complain(std::string_view field, std::size_t column, std::string_view what) const {
  refuse(fmt::format("column {}: '{}' {}", column + 1, one_line(clipped(field, 40)), what));
}

QueryFile::QueryFile(const fs::path& file) : lines_(file) {
  bool found = false;
  for (const fs::path& part : fs::absolute(file)) {
    for (const Primitives primitives : {Primitives::vertex_face, Primitives::edge_edge}) {
      if (part != name(primitives)) continue;
      primitives_ = primitives;
      found = true;
    }
  }
  if (!found) {
    throw UsageError(lines_.shown() +
                     ": is in no folder named vertex-face or edge-edge; queries of shapes that turn need --turning");
  }
}

bool QueryFile::next_row(RationalPoint& vertex, bool& answer) {
  if (!lines_.next()) return false;
  const std::vector<std::string_view> fields = lines_.fields(columns);
  for (std::size_t i = 0; i + 1 < columns; ++i) {
    const std::string_view field = fields[i];
    if (field.size() > most_digits) lines_.refuse(fmt::format("column {}: more than {} digits", i + 1, most_digits));
    if (!is_integer(field)) lines_.complain(field, i, "is not an integer");
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const auto denominator = integer(fields[2 * i + 1]);
    if (denominator == 0) lines_.refuse(fmt::format("column {}: a denominator of zero", 2 * i + 2));
    vertex[i] = Rational(integer(fields[2 * i])) / Rational(denominator);  // whose sign may be either
  }
  const std::string_view last = fields[columns - 1];
  if (last != "0" && last != "1") lines_.refuse(fmt::format("column 7: '{}'; 0 or 1", one_line(clipped(last, 40))));
  answer = last == "1";
  return true;
}

std::optional<PublishedQuery> QueryFile::next() {
  PublishedQuery query;
  for (std::size_t row = 0; row < 8; ++row) {
    RationalPoint& vertex = row < 4 ? query.at_start[row] : query.at_end[row - 4];
    bool answer = false;
    if (!next_row(vertex, answer)) {
      if (row > 0) lines_.refuse(fmt::format("the file ends after {} of the 8 rows of a query", row));
      if (lines_.line() == 0) lines_.refuse("the file is empty; 8 rows a query");
      return std::nullopt;
    }
    if (row > 0 && answer != query.collides) lines_.refuse("column 7: differs within the 8 rows of a query");
    if (row == 0) query.line = lines_.line();
    query.collides = answer;
  }
  return query;
}

std::vector<fs::path> query_files(const fs::path& folder, bool below) {
  std::error_code error;
  if (!fs::exists(folder, error)) {
    throw UsageError(shown(folder) + (error ? ": cannot be read: " + error.message() : ": there is no such folder"));
  }
  if (!fs::is_directory(folder, error)) throw UsageError(shown(folder) + ": is not a folder");
  std::vector<fs::path> files;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (!below) entry.disable_recursion_pending();
    if (entry->path().extension() == ".csv") files.push_back(entry->path());
  }
  if (error) throw UsageError(shown(folder) + ": cannot be read: " + error.message());
  if (files.empty()) throw UsageError(shown(folder) + ": has no CSV files of queries");
  std::ranges::sort(files);
  for (const fs::path& file : files) {
    if (!fs::is_regular_file(file, error)) throw UsageError(shown(file) + ": is not a regular file; no other is read");
  }
  return files;
}

Validation validate(const fs::path& folder) {
  Validation out;
  std::vector<double> times;
  for (const fs::path& file : query_files(folder)) {
    QueryFile queries(file);
    const Primitives primitives = queries.primitives();
    QueryCounts counts;
    while (const auto published = queries.next()) {
      ++counts.read;
      const RigidReading reading = read_rigid(primitives, *published);
      if (!reading.query) {
        ++counts.skipped[static_cast<std::size_t>(reading.skipped)];
        continue;
      }
      ++counts.checked;
      counts.rounded += reading.query->rounded;
      const std::string wrong = judge(library_answer(*reading.query).status, reading.query->posed_contact.has_value(),
                                      published->collides, counts);
      if (!wrong.empty() && out.wrongs.size() < most_wrongs) {
        out.wrongs.push_back(fmt::format("{}:{}: {}", one_line(file.string()), published->line, wrong));
      }
      times.push_back(nanoseconds_a_call(*reading.query));
    }
    const std::string family = family_name(folder, file, primitives);
    const bool known =
        !out.families.empty() && out.families.back().name == family && out.families.back().primitives == primitives;
    if (!known) out.families.push_back({family, primitives, {}});
    out.families.back().counts += counts;
    out.total += counts;
  }
  out.median_ns = times.empty() ? 0 : median(times);
  return out;
}

}  // namespace thinwall
