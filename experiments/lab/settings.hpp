#pragma once
/// Typed, checked access to one TOML file laid over an experiment's defaults.
/// Every complaint is a `UsageError` of one line: file, line, key, what is allowed, and the nearest valid spelling.

#include <array>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/lab/record.hpp>
#include <thinwall/experiments/lab/text.hpp>

namespace thinwall {

/// The user asked for something that cannot be done. The program prints the one line and exits with 2.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The most cells of a design, in the widest sense: every one is kept in memory, and most are a unit.
inline constexpr std::size_t most_cells = 1'000'000;

/// A whole number as people type it, also as 1e6; nothing if `text` is anything else or does not fit.
std::optional<std::int64_t> parse_count(std::string_view text);

class Settings {
 public:
  /// `text` is what the user wrote, `file` the name to quote in complaints; keys it leaves out come from `defaults`.
  Settings(std::string_view text, const std::string& file, std::string_view defaults);
  ~Settings();
  Settings(Settings&&) noexcept;
  Settings& operator=(Settings&&) noexcept;

  /// True if the user's file or the defaults have the key.
  bool has(std::string_view key) const;

  /// True if the user's file has the key.
  bool given(std::string_view key) const;

  /// Refuses what leaves out a key that has no sensible default.
  void require(std::string_view key, std::string_view what_is_needed) const;

  /// A list has 1 to `most_cells` values, none of them twice.
  double number(std::string_view key, const Range& range) const;
  std::vector<double> numbers(std::string_view key, const Range& range) const;
  std::array<double, 3> vector(std::string_view key, const Range& range) const;
  std::int64_t integer(std::string_view key, std::int64_t lower, std::int64_t upper) const;
  std::vector<std::int64_t> integers(std::string_view key, std::int64_t lower, std::int64_t upper) const;
  bool flag(std::string_view key) const;
  std::string text(std::string_view key) const;  ///< any, of one line and at most 200 bytes
  std::string choice(std::string_view key, std::span<const std::string_view> allowed) const;
  std::vector<std::string> choices(std::string_view key, std::span<const std::string_view> allowed) const;
  /// The same, in the order of `allowed` and with "all" for all of them.
  std::vector<std::string> choices_or_all(std::string_view key, std::span<const std::string_view> allowed) const;
  /// The same, in the order asked for.
  std::vector<std::string> choices_as_asked(std::string_view key, std::span<const std::string_view> allowed) const;

  /// The tables of the list `[[key]]`, each laid over `defaults`; complaints name this file, the line and `key.inner`.
  std::vector<Settings> tables(std::string_view key, std::string_view defaults) const;

  /// As `integer`, or what `--trials` says in its place, in the same range.
  std::int64_t trials(std::string_view key, std::int64_t lower, std::int64_t upper,
                      std::optional<std::int64_t> option) const;

  /// Refuses a design that would have more than `most_cells`, before any is made: one, or `each`, for every combination of
  /// the values of these lists.
  void limit_cells(std::span<const std::string_view> lists, std::size_t each = 1) const;
  void limit_cells(std::initializer_list<std::string_view> lists, std::size_t each = 1) const {
    limit_cells(std::span(lists.begin(), lists.size()), each);
  }

  /// As if the user's file said so: for an option of the command line. The key must not have a dot.
  void assign(std::string_view key, const std::string& text);
  void assign_flag(std::string_view key, bool flag);

  /// The key a complaint should name, for a check that only the experiment can make. Where the user left the key out, the
  /// complaint says so and names the user's file: what is wrong is how its other keys go with the default.
  [[noreturn]] void complain(std::string_view key, std::string_view what_is_allowed) const;

  /// Refuses a key that the defaults do not have, by name, line and nearest valid spelling.
  void reject_unknown_keys() const;

  /// The whole resolved configuration as canonical JSON text, keys in order: what the manifest keeps and the hash covers.
  std::string resolved_json() const;

 private:
  struct Impl;
  explicit Settings(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// Those of a list of things with a `name` that the key's choices name, in the list's order.
template <class Thing>
std::vector<Thing> chosen(const Settings& settings, std::string_view key, const std::vector<Thing>& all) {
  const std::vector<std::string> asked = settings.choices_or_all(key, names_of(all));
  return only(all, [&](const Thing& thing) { return std::ranges::find(asked, thing.name) != asked.end(); });
}

}  // namespace thinwall
