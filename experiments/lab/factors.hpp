#pragma once
/// The factors of an experiment, stated once: a setting of the configuration and what it may be, a field of the cell, the cell's
/// key in the journal, and a column.
///
///   const auto grid = factors<Cell>(
///       numbers("speed", &Cell::speed, {.lower = 0, .upper = 1e9, .lower_open = true, .unit = "m/s"}, "Speed of the ball."),
///       number("step", &Cell::step, {.lower = 0, .upper = 1e3, .lower_open = true, .unit = "s"}, "Time step."),
///       choices("wall", &Cell::wall, wall_names, "Infinite, or a finite square."));
///   std::vector<Cell> cells = grid.cells(settings, methods.size());   // every combination, the last factor fastest
///   grid.key(cell);                                                    // "speed 10 step 0.01 wall infinite"
///   columns_of<Row>(grid.columns(&Row::cell), ...);
///
/// `number` and `count` read one value, `numbers`, `counts` and `choices` a list.

#include <algorithm>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <thinwall/experiments/lab/columns.hpp>
#include <thinwall/experiments/lab/random.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/lab/table_text.hpp>

namespace thinwall {

template <class Cell> struct Factor {
  using Set = std::function<void(Cell&)>;
  Column column;
  bool is_list;
  std::function<std::vector<Set>(const Settings&)> read;  ///< what sets a cell's field to each value
  std::function<Value(const Cell&)> get;
};

namespace detail {

template <class Cell, class V, class Read>
Factor<Cell> factor(std::string_view name, V Cell::*member, std::string_view unit, std::string_view description,
                    bool is_list, Read read) {
  return {{std::string(name), column_type<V>(), std::string(unit), std::string(description)},
          is_list,
          [member, read](const Settings& settings) {
            std::vector<typename Factor<Cell>::Set> all;
            for (const auto& x : read(settings)) all.push_back([member, x](Cell& cell) { cell.*member = x; });
            return all;
          },
          [member](const Cell& cell) { return to_value<V>(cell.*member); }};
}

}  // namespace detail

template <class Cell>
Factor<Cell> numbers(std::string_view name, double Cell::*member, const Range& range, std::string_view description) {
  return detail::factor(name, member, range.unit, description, true,
                        [=](const Settings& settings) { return settings.numbers(name, range); });
}
template <class Cell>
Factor<Cell> number(std::string_view name, double Cell::*member, const Range& range, std::string_view description) {
  return detail::factor(name, member, range.unit, description, false,
                        [=](const Settings& settings) { return std::vector{settings.number(name, range)}; });
}
template <class Cell>
Factor<Cell> counts(std::string_view name, std::int64_t Cell::*member, std::int64_t lower, std::int64_t upper,
                    std::string_view description) {
  return detail::factor(name, member, "1", description, true,
                        [=](const Settings& settings) { return settings.integers(name, lower, upper); });
}
template <class Cell>
Factor<Cell> count(std::string_view name, std::int64_t Cell::*member, std::int64_t lower, std::int64_t upper,
                   std::string_view description) {
  return detail::factor(name, member, "1", description, false,
                        [=](const Settings& settings) { return std::vector{settings.integer(name, lower, upper)}; });
}
/// `names` must outlive the factor. A cell holds the name.
template <class Cell>
Factor<Cell> choices(std::string_view name, std::string Cell::*member, std::span<const std::string_view> names,
                     std::string_view description) {
  return detail::factor(name, member, "", description, true,
                        [=](const Settings& settings) { return settings.choices(name, names); });
}
/// A cell holds the name's place, as an enumeration.
template <class Cell, class Place>
  requires std::is_enum_v<Place>
Factor<Cell> choices(std::string_view name, Place Cell::*member, std::span<const std::string_view> names,
                     std::string_view description) {
  const auto read = [=](const Settings& settings) {
    std::vector<typename Factor<Cell>::Set> all;
    for (const std::string& choice : settings.choices(name, names)) {
      const auto place = static_cast<Place>(std::ranges::find(names, choice) - names.begin());
      all.push_back([=](Cell& cell) { cell.*member = place; });
    }
    return all;
  };
  return {
      {std::string(name), ColumnType::text, "", std::string(description)}, true, read, [=](const Cell& cell) -> Value {
        return std::string(names[static_cast<std::size_t>(cell.*member)]);
      }};
}

template <class Cell> class Factors {
 public:
  explicit Factors(std::vector<Factor<Cell>> all) : all_(std::move(all)) {}

  /// Every combination of the settings' values laid over `base`, the last factor fastest; `each` units come of a cell. `adjust` may
  /// change a cell, or return false to leave it out; a cell that is like an earlier one is left out. Throws UsageError.
  std::vector<Cell> cells(const Settings& settings, std::size_t each = 1, const Cell& base = {},
                          const std::function<bool(Cell&)>& adjust = {}) const {
    std::vector<std::vector<typename Factor<Cell>::Set>> values;
    std::vector<std::string_view> lists;
    for (const Factor<Cell>& factor : all_) {
      if (factor.is_list) lists.push_back(factor.column.name);
    }
    settings.limit_cells(lists, each);
    for (const Factor<Cell>& factor : all_) values.push_back(factor.read(settings));
    std::vector<Cell> cells;
    std::set<std::string> keys;
    add(values, 0, base, adjust, keys, cells);
    return cells;
  }

  /// The same, whose `cells` come with the first factor fastest.
  Factors first_fastest() const {
    Factors out = *this;
    out.first_fastest_ = true;
    return out;
  }

  /// One line, for people and the journal.
  std::string key(const Cell& cell) const {
    std::string text;
    for (const Factor<Cell>& factor : all_) {
      text += fmt::format("{}{} {}", text.empty() ? "" : " ", factor.column.name, exact_text(factor.get(cell)));
    }
    return text;
  }

  /// From the factors that are numbers, in their order.
  RandomStream stream(const Cell& cell, std::uint64_t seed) const {
    std::vector<double> numbers;
    for (const Factor<Cell>& factor : all_) {
      const Value value = factor.get(cell);
      if (const auto* real = std::get_if<double>(&value)) numbers.push_back(*real);
      if (const auto* whole = std::get_if<std::int64_t>(&value)) numbers.push_back(static_cast<double>(*whole));
    }
    return {seed, stream_of(numbers)};
  }

  /// A column each, or of those of these names, for rows in which `get` finds the cell.
  template <class Get> auto columns(Get get, std::initializer_list<std::string_view> names = {}) const {
    std::vector<Factor<Cell>> chosen = all_;
    const auto is_other = [&](const Factor<Cell>& f) { return std::ranges::find(names, f.column.name) == names.end(); };
    if (names.size() > 0) std::erase_if(chosen, is_other);
    return FactorColumns<Get>{std::move(chosen), std::move(get)};
  }

 private:
  template <class Get> struct FactorColumns {
    std::vector<Factor<Cell>> all;
    Get get;
    template <class Row> void add_to(Columns<Row>& columns) const {
      for (const Factor<Cell>& factor : all) {
        columns.add(
            {factor.column, [read = factor.get, get = get](const Row& row) { return read(std::invoke(get, row)); }});
      }
    }
  };

  void add(const std::vector<std::vector<typename Factor<Cell>::Set>>& values, std::size_t depth, Cell cell,
           const std::function<bool(Cell&)>& adjust, std::set<std::string>& keys, std::vector<Cell>& cells) const {
    if (depth < values.size()) {
      for (const auto& set : values[first_fastest_ ? values.size() - 1 - depth : depth]) {
        set(cell);
        add(values, depth + 1, cell, adjust, keys, cells);
      }
    } else if ((!adjust || adjust(cell)) && keys.insert(key(cell)).second) {
      cells.push_back(std::move(cell));
    }
  }

  std::vector<Factor<Cell>> all_;
  bool first_fastest_ = false;
};

template <class Cell, class... Rest> Factors<Cell> factors(Factor<Cell> first, Rest... rest) {
  return Factors<Cell>(std::vector<Factor<Cell>>{std::move(first), std::move(rest)...});
}

}  // namespace thinwall
