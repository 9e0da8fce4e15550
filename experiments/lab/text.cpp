#include <thinwall/experiments/lab/text.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <boost/algorithm/string.hpp>

namespace thinwall {

namespace {

constexpr double two_to_53 = 0x1p53;  // every whole number up to here is a double

template <class... Format> std::string to_text(double value, Format... format) {
  std::array<char, 64> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, format...).ptr;
  return {buffer.data(), end};
}

int power_of_ten(double value) { return static_cast<int>(std::floor(std::log10(std::abs(value)))); }

/// The power of ten of the last digit that an interval of that half-width supports.
int last_place(double half_width) {
  const int power = power_of_ten(half_width);
  return half_width / std::pow(10, power) < 3 ? power - 1 : power;
}

std::string to_place(double value, int place, bool scientific) {
  if (value == std::trunc(value) && std::abs(value) < 10) return exact_text(value);
  const double unit = std::pow(10, place);
  if (std::abs(value) < unit / 2) return "0";
  if (scientific) return to_text(value, std::chars_format::scientific, std::max(0, power_of_ten(value) - place));
  if (place < 0) return to_text(value, std::chars_format::fixed, -place);
  return exact_text(std::round(value / unit) * unit);
}

char lower(char letter) { return static_cast<char>(std::tolower(static_cast<unsigned char>(letter))); }

/// Where the string that begins at `from` ends: behind its last quote, or at the end of the line where it has none.
std::size_t end_of_string(std::string_view text, std::size_t from) {
  const char quote = text[from];
  const std::string_view three = text.substr(from, 3);
  const bool is_long = three == R"(""")" || three == "'''";
  std::size_t at = from + (is_long ? 3 : 1);
  for (; at < text.size(); ++at) {
    if (quote == '"' && text[at] == '\\') {
      ++at;
    } else if (is_long ? text.substr(at, 3) == three : text[at] == quote || text[at] == '\n') {
      break;
    }
  }
  if (is_long) return std::min(text.find_first_not_of(quote, at), text.size());  // up to two quotes more are its own
  return at < text.size() && text[at] == quote ? at + 1 : at;
}

}  // namespace

std::string exact_text(double value) {
  if (value == 0) return "0";
  const bool whole = std::abs(value) < two_to_53 && value == std::trunc(value);
  if (whole) return std::to_string(static_cast<std::int64_t>(value));
  std::string text = to_text(value);
  // Digits alone would be read as an integer, which need not fit, and is another number than this one to JSON and TOML.
  if (text.find_first_not_of("-0123456789") == std::string::npos) text = to_text(value, std::chars_format::scientific);
  return text;
}

std::string rounded_text(double value, int digits) {
  if (!std::isfinite(value) || value == 0) return exact_text(value);
  const std::string text = to_text(value, std::chars_format::scientific, digits - 1);
  return exact_text(std::strtod(text.c_str(), nullptr));  // the rounded value itself
}

void in_one_notation(const std::vector<std::string*>& texts) {
  std::vector<std::pair<std::string*, double>> numbers;
  bool is_small_or_large = false;
  std::array<bool, 2> seen{};  // without and with a power of ten
  for (std::string* const text : texts) {
    char* end = nullptr;
    const double number = std::strtod(text->c_str(), &end);  // the page's library has no std::from_chars of it
    if (*end != 0 || number == 0 || !std::isfinite(number)) continue;
    numbers.emplace_back(text, number);
    seen[text->find('e') == std::string::npos ? 0 : 1] = true;
    is_small_or_large |= std::abs(number) < 1e-5 || std::abs(number) >= 1e7;
  }
  if (!seen[0] || !seen[1]) return;
  const auto format = is_small_or_large ? std::chars_format::scientific : std::chars_format::fixed;
  for (const auto& [text, number] : numbers) *text = to_text(number, format);
}

std::string grouped_text(std::int64_t value) {
  std::string text = std::to_string(value);
  const std::size_t first = value < 0 ? 1 : 0;
  for (std::size_t at = text.size(); at > first + 3;) text.insert(at -= 3, ",");
  return text;
}

std::string percent_text(const std::optional<double>& share) {
  return share ? fmt::format("{:.1f} %", 100 * *share) : "-";
}

std::string spaced(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

std::string plural_text(std::int64_t count, std::string_view noun) {
  return grouped_text(count).append(" ").append(noun).append(count == 1 ? "" : "s");
}

std::string listed(std::span<const std::string> parts, std::string_view last) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i)
    text.append(i == 0 ? "" : i + 1 < parts.size() ? ", " : last).append(parts[i]);
  return text;
}

std::string duration_text(double seconds) {
  if (seconds < 9.95) return rounded_text(seconds, seconds < 1 ? 1 : 2) + " s";
  const auto whole = static_cast<std::int64_t>(std::llround(seconds));
  if (whole < 60) return std::to_string(whole) + " s";
  if (whole < 3600) return std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
  return std::to_string(whole / 3600) + " h " + std::to_string(whole % 3600 / 60) + " min";
}

IntervalText interval_text(double value, double lower, double upper) {
  constexpr int digits = 4;
  if (!(upper > lower)) return {rounded_text(value, digits), rounded_text(lower, digits), rounded_text(upper, digits)};
  const int place = last_place((upper - lower) / 2);
  const double largest = std::max({std::abs(value), std::abs(lower), std::abs(upper)});
  const bool scientific = largest < 1e-4 || largest >= 1e7;
  const bool may_be_zero = lower <= 0 && upper >= 0;
  const auto shown = [&](double x) {  // what is not 0 is not said to be
    const std::string rounded = to_place(x, place, scientific);
    return rounded == "0" && x != 0 && !may_be_zero ? rounded_text(x, 2) : rounded;
  };
  return {shown(value), shown(lower), shown(upper)};
}

bool contains(const Range& range, double value) {
  const bool above = range.lower_open ? value > range.lower : value >= range.lower;
  const bool below = range.upper_open ? value < range.upper : value <= range.upper;
  return std::isfinite(value) && above && below;
}

std::string range_text(std::string_view kind, const Range& range) {
  std::string text(kind);
  const char* link = " ";
  if (std::isfinite(range.lower)) {
    text += fmt::format(" {} {}", range.lower_open ? ">" : ">=", exact_text(range.lower));
    link = " and ";
  }
  if (std::isfinite(range.upper)) {
    text += fmt::format("{}{} {}", link, range.upper_open ? "<" : "<=", exact_text(range.upper));
  }
  if (!range.unit.empty() && range.unit != "1") text += fmt::format(" [{}]", range.unit);
  return text;
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  // Row i holds the distances of a's first i letters to every beginning of b.
  std::vector<std::size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(before, above);
    std::swap(above, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (same ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::string spelling_hint(std::string_view word, std::span<const std::string_view> candidates) {
  std::string_view nearest;
  const std::size_t letters = word.size() - std::min(word.size(), word.find_first_not_of('-'));
  std::size_t fewest = (letters + 1) / 3 + 1;  // a third of them may be wrong
  for (const std::string_view candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < fewest && distance < candidate.size()) {
      fewest = distance;
      nearest = candidate;
    }
  }
  const std::string list = fmt::format("allowed: {}", fmt::join(candidates, ", "));
  return nearest.empty() ? list : fmt::format("did you mean '{}'? ({})", nearest, list);
}

int line_of_deep_key(std::string_view text, int most) {
  constexpr std::string_view in_a_key = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_. \t\"'";
  int parts = 1;
  for (std::size_t at = 0; at < text.size();) {
    const char letter = text[at];
    if (in_a_key.find(letter) == std::string_view::npos) parts = 1;
    if (letter == '.' && ++parts > most) return 1 + static_cast<int>(std::ranges::count(text.substr(0, at), '\n'));
    if (letter == '#') {
      at = std::min(text.find('\n', at), text.size());
    } else {
      at = letter == '"' || letter == '\'' ? end_of_string(text, at) : at + 1;
    }
  }
  return 0;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  boost::split(parts, text, [separator](char letter) { return letter == separator; });
  return parts;
}

void replace_all(std::string& text, std::string_view from, std::string_view to) { boost::replace_all(text, from, to); }

}  // namespace thinwall
