#include <thinwall/experiments/lab/settings.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <type_traits>
#include <utility>

#include <fmt/format.h>
#include <toml++/toml.h>

#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/text.hpp>

namespace thinwall {
namespace {

/// Canonical JSON: keys in order, numbers in shortest form (1 and 1.0 are the same number).
std::string json_text(const toml::node& node) {
  if (const auto* table = node.as_table()) {
    std::string out;
    for (const auto& [key, value] : *table) {  // toml++ keeps keys in order
      out += fmt::format("{}{}:{}", out.empty() ? "" : ",", json_string(key.str()), json_text(value));
    }
    return "{" + out + "}";
  }
  if (const auto* array = node.as_array()) {
    std::string out;
    for (const auto& value : *array) out += (out.empty() ? "" : ",") + json_text(value);
    return "[" + out + "]";
  }
  if (const auto text = node.value_exact<std::string_view>()) return json_string(*text);
  if (const auto integer = node.value_exact<std::int64_t>()) return std::to_string(*integer);
  if (const auto flag = node.value_exact<bool>()) return *flag ? "true" : "false";
  if (const auto number = node.value_exact<double>()) return exact_text(*number);  // NaN and infinity for a complaint
  return "null";                                                                   // a date: no experiment takes one
}

/// A value as a complaint shows it.
std::string shown(const toml::node& node) {
  const std::string text = node.is_floating_point() ? exact_text(*node.value_exact<double>())
                           : node.is_string()       ? "'" + *node.value_exact<std::string>() + "'"
                           : node.is_table()        ? "a table"
                           : node.is_date() || node.is_time() || node.is_date_time() ? "a date or time"
                                                                                     : json_text(node);
  return one_line(clipped(text, 40));
}

std::optional<double> in_range(const toml::node& node, const Range& range) {
  auto value = node.value_exact<double>();
  if (const auto whole = node.value_exact<std::int64_t>()) value = static_cast<double>(*whole);
  return value && contains(range, *value) ? std::optional(*value + 0.0) : std::nullopt;  // -0 becomes 0
}

std::optional<std::int64_t> in_range(const toml::node& node, std::int64_t lower, std::int64_t upper) {
  auto value = node.value_exact<std::int64_t>();
  if (const auto real = node.value_exact<double>()) value = parse_count(exact_text(*real));  // 1e6 is a count too
  return value && *value >= lower && *value <= upper ? value : std::nullopt;
}

std::optional<std::string> one_of(const toml::node& node, std::span<const std::string_view> allowed) {
  const auto value = node.value_exact<std::string>();
  return value && std::ranges::find(allowed, *value) != allowed.end() ? value : std::nullopt;
}

/// What is allowed in the place of a node, in words: some, or one of these names.
std::string words_of(const std::string& words, const toml::node&) { return words; }
std::string words_of(std::span<const std::string_view> names, const toml::node& node) {
  return spelling_hint(node.value_exact<std::string_view>().value_or(""), names);
}

/// The table's own entry, or the one that a dotted path leads to.
const toml::node* find(const toml::table& table, std::string_view path) {
  if (const toml::node* whole = table.get(path)) return whole;
  const auto dot = path.find('.');
  if (dot == std::string_view::npos) return nullptr;
  const toml::node* inner = table.get(path.substr(0, dot));
  return inner && inner->is_table() ? find(*inner->as_table(), path.substr(dot + 1)) : nullptr;
}

/// `defaults` with the user's values in the places of its own.
void lay_over(toml::table& defaults, const toml::table& user) {
  for (auto& [key, value] : user) {
    toml::node* below = defaults.get(key.str());
    if (!below) continue;
    if (below->is_table() && value.is_table()) {
      lay_over(*below->as_table(), *value.as_table());
    } else {
      defaults.insert_or_assign(key, value);
    }
  }
}

}  // namespace

struct Settings::Impl {
  std::string file;
  std::string path = {};                    // of the keys, before their names: `body.`
  std::uint32_t line = 1;                   // where the table begins
  std::shared_ptr<toml::table> owner = {};  // of everything the user wrote; copies of a node forget their line
  toml::table* user = nullptr;
  toml::table defaults = {};

  static toml::table parse(std::string_view text, const std::string& name) {
    constexpr int most_parts = 16;  // a table in a table is recursion, for the parser as for us
    if (const int line = line_of_deep_key(text, most_parts)) {
      throw UsageError(
          fmt::format("{}:{}: a key of more than {} parts, which no configuration has", name, line, most_parts));
    }
    try {
      return toml::parse(text, name);
    } catch (const toml::parse_error& error) {
      const auto where = error.source().begin;
      throw UsageError(fmt::format("{}:{}: not TOML, at column {}: {}", name, where.line, where.column,
                                   one_line(error.description())));
    }
  }

  struct Entry {
    const toml::node* node;
    bool by_user;
  };

  Entry entry(std::string_view key) const {
    if (const toml::node* node = find(*user, key)) return {node, true};
    if (const toml::node* node = find(defaults, key)) return {node, false};
    throw UsageError(fmt::format("{}:{}: key '{}{}': missing", file, line, path, key));
  }

  [[noreturn]] void complain(std::string_view key, const toml::node& node, std::string_view what,
                             std::string_view allowed) const {
    const bool by_user = entry(key).by_user;
    throw UsageError(fmt::format("{}:{}: key '{}'{}: {}; {}", file, by_user ? node.source().begin.line : line,
                                 one_line(path + std::string(key)), by_user ? "" : ", left at its default", what,
                                 allowed));
  }

  [[noreturn]] void refuse(std::string_view key, const toml::node& node, std::string_view allowed) const {
    complain(key, node, shown(node) + " is not allowed", allowed);
  }

  /// `read` returns what a node holds, or nothing if that is not allowed; `allowed` is what `words_of` takes.
  template <class Allowed, class Read> auto one(std::string_view key, const Allowed& allowed, Read read) const {
    const toml::node& node = *entry(key).node;
    const auto value = read(node);
    const auto* const list = node.as_array();
    if (list && list->size() == 1 && read(*list->get(0)))
      complain(key, node, shown(node) + " is a list", "leave the brackets out");
    if (!value) refuse(key, node, words_of(allowed, node));
    return *value;
  }

  template <class Allowed, class Read> auto several(std::string_view key, const Allowed& allowed, Read read) const {
    const toml::node& node = *entry(key).node;
    const auto* const array = node.as_array();
    if (!array && read(node)) complain(key, node, shown(node) + " is not a list", "put it in brackets");
    if (!array) complain(key, node, shown(node) + " is not a list", words_of(allowed, node));
    if (array->empty()) complain(key, node, "an empty list is not allowed", words_of(allowed, node));
    if (array->size() > most_cells) {
      complain(key, node, fmt::format("{} values", grouped_text(std::ssize(*array))),
               fmt::format("at most {}", grouped_text(most_cells)));
    }
    std::vector<std::remove_cvref_t<decltype(*read(node))>> values;
    std::set<std::remove_cvref_t<decltype(*read(node))>> seen;
    for (const toml::node& item : *array) {
      const auto value = read(item);
      if (!value) refuse(key, item, words_of(allowed, item));
      if (!seen.insert(*value).second) complain(key, item, shown(item) + " stands twice", "every value once");
      values.push_back(*value);
    }
    return values;
  }

  void reject_unknown(const toml::table& given, const toml::table& known, const std::string& inner) const {
    std::vector<std::string_view> names;
    for (const auto& [key, value] : known) names.push_back(key.str());
    for (const auto& [key, value] : given) {
      const std::string full = inner + std::string(key.str());
      const toml::node* below = known.get(key.str());
      if (!below && path.empty() && inner.empty() && key.str() == "experiment") continue;  // says what the file is
      if (!below) {
        throw UsageError(fmt::format("{}:{}: key '{}': unknown key; {}", file, key.source().begin.line,
                                     one_line(path + full), spelling_hint(key.str(), names)));
      }
      if (below->is_table() && !value.is_table()) refuse(full, value, "a table");
      if (below->is_table()) reject_unknown(*value.as_table(), *below->as_table(), full + ".");
    }
  }
};

std::optional<std::int64_t> parse_count(std::string_view text) {
  if (const auto count = parsed<std::int64_t>(text)) return count;
  const auto value = parsed<double>(text);
  if (!value || !(std::abs(*value) < 0x1p53) || *value != std::trunc(*value)) return std::nullopt;
  return static_cast<std::int64_t>(*value);
}

Settings::Settings(std::string_view text, const std::string& file, std::string_view defaults)
    : impl_(std::make_unique<Impl>()) {
  impl_->file = one_line(file);
  impl_->owner = std::make_shared<toml::table>(Impl::parse(text, impl_->file));
  impl_->user = impl_->owner.get();
  impl_->defaults = Impl::parse(defaults, "built-in defaults");
}

Settings::Settings(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

Settings::~Settings() = default;
Settings::Settings(Settings&&) noexcept = default;
Settings& Settings::operator=(Settings&&) noexcept = default;

bool Settings::has(std::string_view key) const { return given(key) || find(impl_->defaults, key); }

bool Settings::given(std::string_view key) const { return find(*impl_->user, key) != nullptr; }

void Settings::require(std::string_view key, std::string_view what_is_needed) const {
  if (given(key)) return;
  throw UsageError(
      fmt::format("{}:{}: key '{}{}': missing; {}", impl_->file, impl_->line, impl_->path, key, what_is_needed));
}

double Settings::number(std::string_view key, const Range& range) const {
  return impl_->one(key, range_text("a number", range), [&](const auto& node) { return in_range(node, range); });
}

std::vector<double> Settings::numbers(std::string_view key, const Range& range) const {
  const std::string allowed = range_text("a list of numbers", range);
  return impl_->several(key, allowed, [&](const auto& node) { return in_range(node, range); });
}

std::array<double, 3> Settings::vector(std::string_view key, const Range& range) const {
  const auto read = [&](const toml::node& node) -> std::optional<std::array<double, 3>> {
    std::array<double, 3> values{};
    const auto* const array = node.as_array();
    if (!array || array->size() != values.size()) return std::nullopt;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto value = in_range((*array)[i], range);
      if (!value) return std::nullopt;
      values[i] = *value;
    }
    return values;
  };
  return impl_->one(key, range_text("a list of 3 numbers", range), read);
}

std::int64_t Settings::integer(std::string_view key, std::int64_t lower, std::int64_t upper) const {
  const std::string allowed = fmt::format("a whole number from {} to {}", lower, upper);
  return impl_->one(key, allowed, [&](const auto& node) { return in_range(node, lower, upper); });
}

std::vector<std::int64_t> Settings::integers(std::string_view key, std::int64_t lower, std::int64_t upper) const {
  const std::string allowed = fmt::format("a list of whole numbers from {} to {}", lower, upper);
  return impl_->several(key, allowed, [&](const auto& node) { return in_range(node, lower, upper); });
}

std::int64_t Settings::trials(std::string_view key, std::int64_t lower, std::int64_t upper,
                              std::optional<std::int64_t> option) const {
  const std::int64_t own = integer(key, lower, upper);
  if (!option) return own;
  if (*option < lower || *option > upper) {
    throw UsageError(
        fmt::format("--trials: {} is not allowed; in the place of the key '{}' a whole number from {} to {}", *option,
                    key, lower, upper));
  }
  return *option;
}

void Settings::limit_cells(std::span<const std::string_view> lists, std::size_t each) const {
  if (lists.empty()) return;
  const auto count = [&](std::string_view key) {
    const auto* const array = impl_->entry(key).node->as_array();
    return array ? array->size() : 1;
  };
  auto cells = static_cast<double>(each);  // the product of so many counts may overflow an integer, but no double
  std::vector<std::string> factors;
  for (const std::string_view key : lists) {
    cells *= static_cast<double>(count(key));
    factors.push_back(fmt::format("{} ({})", key, grouped_text(static_cast<std::int64_t>(count(key)))));
  }
  if (cells <= static_cast<double>(most_cells)) return;
  if (each > 1) factors.push_back(fmt::format("{} for each", grouped_text(static_cast<std::int64_t>(each))));
  const std::string_view longest = *std::ranges::max_element(lists, {}, count);
  impl_->complain(longest, *impl_->entry(longest).node,
                  fmt::format("{} make {} cells", fmt::join(factors, " x "),
                              cells < 1e15 ? grouped_text(std::llround(cells)) : rounded_text(cells, 3)),
                  fmt::format("at most {}", grouped_text(most_cells)));
}

bool Settings::flag(std::string_view key) const {
  return impl_->one(key, "true or false", [](const auto& node) { return node.template value_exact<bool>(); });
}

std::string Settings::text(std::string_view key) const {
  static constexpr std::size_t longest = 200;
  const std::string allowed = fmt::format("a text of one line and at most {} bytes", longest);
  return impl_->one(key, allowed, [](const toml::node& node) {
    auto value = node.value_exact<std::string>();
    const bool fits = value && value->size() <= longest && *value == one_line(*value);
    return fits ? value : std::nullopt;
  });
}

std::string Settings::choice(std::string_view key, std::span<const std::string_view> allowed) const {
  return impl_->one(key, allowed, [&](const auto& node) { return one_of(node, allowed); });
}

std::vector<std::string> Settings::choices(std::string_view key, std::span<const std::string_view> allowed) const {
  return impl_->several(key, allowed, [&](const auto& node) { return one_of(node, allowed); });
}

std::vector<std::string> Settings::choices_as_asked(std::string_view key,
                                                    std::span<const std::string_view> allowed) const {
  std::vector<std::string_view> with_all(allowed.begin(), allowed.end());
  with_all.emplace_back("all");
  const std::vector<std::string> chosen = choices(key, with_all);
  if (std::ranges::find(chosen, "all") == chosen.end()) return chosen;
  return {allowed.begin(), allowed.end()};
}

std::vector<std::string> Settings::choices_or_all(std::string_view key,
                                                  std::span<const std::string_view> allowed) const {
  std::vector<std::string> names = choices_as_asked(key, allowed);
  std::ranges::sort(names, {}, [&](const std::string& name) { return std::ranges::find(allowed, name); });
  return names;
}

std::vector<Settings> Settings::tables(std::string_view key, std::string_view defaults) const {
  toml::node* const node = impl_->user->get(key);
  if (!node) return {};
  const std::string allowed = fmt::format("a list of tables, each below a line [[{}]]", key);
  toml::array* const array = node->as_array();
  if (!array) impl_->complain(key, *node, shown(*node) + " is not a list", allowed);
  std::vector<Settings> all;
  for (toml::node& item : *array) {
    if (!item.is_table()) impl_->refuse(key, item, allowed);
    all.push_back(Settings(std::make_unique<Impl>(Impl{.file = impl_->file,
                                                       .path = impl_->path + std::string(key) + ".",
                                                       .line = item.source().begin.line,
                                                       .owner = impl_->owner,
                                                       .user = item.as_table(),
                                                       .defaults = Impl::parse(defaults, "built-in defaults")})));
  }
  return all;
}

void Settings::assign(std::string_view key, const std::string& text) { impl_->user->insert_or_assign(key, text); }
void Settings::assign_flag(std::string_view key, bool flag) { impl_->user->insert_or_assign(key, flag); }

void Settings::complain(std::string_view key, std::string_view what_is_allowed) const {
  impl_->refuse(key, *impl_->entry(key).node, what_is_allowed);
}

void Settings::reject_unknown_keys() const { impl_->reject_unknown(*impl_->user, impl_->defaults, ""); }

std::string Settings::resolved_json() const {
  toml::table resolved = impl_->defaults;
  lay_over(resolved, *impl_->user);
  return json_text(resolved);
}

}  // namespace thinwall
