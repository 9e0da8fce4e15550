#pragma once
/// The columns of a table, stated once: what each is called, and what a row writes into it.
///
///   const auto columns = columns_of<Row>(
///       factors.columns(&Row::cell),                          // lab/factors.hpp
///       fields(&Row::tally),                                  // every field of a record that stands nowhere else here
///       share("probability", "tunneled / shots.", &Row::tunneled, &Row::shots),  // and its Wilson interval
///       value("theory", "1", "By theory.", [](const Row& r) { return r.theory; }));  // an empty optional: an empty cell
///   Table cells = table("cells", "Every cell.", columns, rows);
///   Table methods = table("methods", "Every method.", totals, text("method", "Its name.", &Total::method), fields(&Total::tally));
///   Table brief = in_report(table("bullet", "The bullet.", columns.without({"queries"}), bullets));

#include <algorithm>
#include <concepts>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <thinwall/experiments/lab/judge.hpp>
#include <thinwall/experiments/lab/record.hpp>
#include <thinwall/experiments/lab/statistics.hpp>
#include <thinwall/experiments/lab/table.hpp>

namespace thinwall {

namespace detail {

template <class T> struct Unwrapped {
  using type = T;
};
template <class T> struct Unwrapped<std::optional<T>> {
  using type = T;
};

/// What a column holds whose rows give a `T`, which may be optional.
template <class T> constexpr ColumnType column_type() {
  using V = typename Unwrapped<std::remove_cvref_t<T>>::type;
  if constexpr (std::same_as<V, bool>) return ColumnType::boolean;
  if constexpr (std::floating_point<V>) return ColumnType::number;
  if constexpr (std::integral<V> && !std::same_as<V, bool>) return ColumnType::integer;
  if constexpr (std::convertible_to<V, std::string_view> || std::is_enum_v<V>) return ColumnType::text;
}

template <class T> Value to_value(const T& x) {
  if constexpr (requires { x.has_value(); }) {
    return x ? to_value(*x) : Value();
  } else if constexpr (std::same_as<T, bool>) {
    return x;
  } else if constexpr (std::floating_point<T>) {
    return static_cast<double>(x);
  } else if constexpr (std::integral<T>) {
    return static_cast<std::int64_t>(x);
  } else if constexpr (std::is_enum_v<T>) {
    return std::string(name(x));
  } else {
    return std::string(x);
  }
}

}  // namespace detail

template <class Row> struct ColumnOf {
  Column column;
  std::function<Value(const Row&)> read;
  bool waits = false;  ///< gives way to a column of the same name: see `fields`
};

template <class Row> class Columns {
 public:
  void add(ColumnOf<Row> column) { all_.push_back(std::move(column)); }
  void add_to(Columns& others) const { others.all_.insert(others.all_.end(), all_.begin(), all_.end()); }
  const std::vector<ColumnOf<Row>>& all() const { return all_; }

  /// Without those of these names; each must be there.
  Columns without(std::initializer_list<std::string_view> names) const {
    Columns out = *this;
    for (const std::string_view name : names) {
      const auto removed = std::erase_if(out.all_, [&](const auto& c) { return c.column.name == name; });
      if (removed == 0) throw std::logic_error("there is no column '" + std::string(name) + "' to leave out");
    }
    return out;
  }

  /// Leaves out what waits for nobody's place.
  void settle() {
    std::vector<ColumnOf<Row>> settled;
    for (ColumnOf<Row>& column : all_) {
      const auto is_it = [&](const ColumnOf<Row>& c) { return !c.waits && c.column.name == column.column.name; };
      if (column.waits && std::ranges::any_of(all_, is_it)) continue;
      column.waits = false;
      settled.push_back(column);
    }
    all_ = std::move(settled);
  }

 private:
  std::vector<ColumnOf<Row>> all_;
};

/// One column: `get` is a member or a function of the row, and may give an optional; its type is the column's.
template <class Get> struct ValueColumn {
  std::string name, unit, description;
  Get get;
  std::string lower = {}, upper = {};

  template <class Row> void add_to(Columns<Row>& columns) const {
    using Result = std::invoke_result_t<const Get&, const Row&>;
    columns.add({{name, detail::column_type<Result>(), unit, description, lower, upper}, [get = get](const Row& row) {
                   return detail::to_value<std::remove_cvref_t<Result>>(std::invoke(get, row));
                 }});
  }
};
template <class Get> ValueColumn(std::string, std::string, std::string, Get) -> ValueColumn<Get>;
template <class Get>
ValueColumn(std::string, std::string, std::string, Get, std::string, std::string) -> ValueColumn<Get>;

template <class Get> ValueColumn<Get> value(std::string name, std::string unit, std::string description, Get get) {
  return {std::move(name), std::move(unit), std::move(description), std::move(get)};
}
template <class Get> ValueColumn<Get> text(std::string name, std::string description, Get get) {
  return {std::move(name), "", std::move(description), std::move(get)};
}

/// What a part of a row says: `of(&Row::tally, &Tally::mean)`.
auto of(auto part, auto what) {
  return [=](const auto& row) { return std::invoke(what, std::invoke(part, row)); };
}

/// The columns of `part`, empty in the rows for which `condition` does not hold.
template <class Condition, class Part> struct OnlyWhere {
  Condition condition;
  Part part;

  template <class Row> void add_to(Columns<Row>& columns) const {
    Columns<Row> inner;
    part.add_to(inner);
    for (ColumnOf<Row> column : inner.all()) {
      column.read = [condition = condition, read = column.read](const Row& row) {
        return std::invoke(condition, row) ? read(row) : Value();
      };
      columns.add(std::move(column));
    }
  }
};
template <class Condition, class Part> OnlyWhere<Condition, Part> where(Condition condition, Part part) {
  return {std::move(condition), std::move(part)};
}

/// The columns of several parts, one after the other, as one part.
template <class... Parts> struct Together {
  std::tuple<Parts...> parts;

  template <class Row> void add_to(Columns<Row>& columns) const {
    std::apply([&](const Parts&... part) { (part.add_to(columns), ...); }, parts);
  }
};
template <class... Parts> Together<Parts...> together(Parts... parts) { return {{std::move(parts)...}}; }

/// A `Measured`, or an optional one, and the ends of its interval, `PREFIX_lower` and `PREFIX_upper`, which are called `ends`.
template <class Get>
auto measured(std::string name, std::string unit, std::string description, Get get, const std::string& prefix = "",
              const std::string& ends = "its 95 % interval") {
  const auto read = [get](auto part) {
    return [get, part](const auto& row) -> std::optional<double> {
      const std::optional<Measured> m = std::invoke(get, row);
      return m ? std::optional(part(*m)) : std::nullopt;
    };
  };
  const std::string lower = prefix + "lower", upper = prefix + "upper";
  return together(
      ValueColumn{std::move(name), unit, std::move(description), read([](const Measured& m) { return m.value; }), lower,
                  upper},
      value(lower, unit, "Lower end of " + ends + ".", read([](const Measured& m) { return m.interval.lower; })),
      value(upper, unit, "Upper end of " + ends + ".", read([](const Measured& m) { return m.interval.upper; })));
}

/// The share of a count in another with its 95 % Wilson interval; empty where the other is 0.
template <class Get, class Whole>
auto share(std::string name, std::string description, Get count, Whole whole, const std::string& prefix = "") {
  const auto get = [count, whole](const auto& row) {
    return measured_share(std::invoke(count, row), std::invoke(whole, row));
  };
  return measured(std::move(name), "1", std::move(description), get, prefix, "the 95 % Wilson interval");
}

/// The fields of a record, in its order, named ones or all: of all, each whose name no other column of the table has. An
/// extreme of nothing is an empty cell; lists have no column, nor has an enumeration without a function `name`.
template <class Get> struct RecordColumns {
  Get get;
  std::vector<std::string_view> names;

  template <class Row> void add_to(Columns<Row>& columns) const {
    using T = std::remove_cvref_t<std::invoke_result_t<const Get&, const Row&>>;
    add_fields<T>(columns, [get = get](const Row& row) -> const T& { return std::invoke(get, row); });
  }

 private:
  template <class T, class Row, class Read> void add_fields(Columns<Row>& columns, const Read& read) const {
    for_each_field<T>([&]<class V>(const Field<T, V>& field) {
      if constexpr (Record<V>) {
        add_fields<V>(columns, [read, member = field.member](const Row& row) -> const V& { return read(row).*member; });
      } else if constexpr (
          std::is_arithmetic_v<V> || std::same_as<V, std::string> || requires(V v) { v.has_value(); } ||
          requires(V v) { std::string_view(name(v)); }) {
        if (!names.empty() && std::ranges::find(names, field.name) == names.end()) return;
        columns.add({{std::string(field.name), detail::column_type<V>(), std::string(field.unit),
                      std::string(field.description)},
                     [read, field](const Row& row) -> Value {
                       const V& x = read(row).*field.member;
                       if constexpr (std::same_as<V, double>) {
                         if (field.merge == Merge::least && x == no_least) return {};
                         if (field.merge == Merge::most && x == no_most) return {};
                       }
                       return detail::to_value<V>(x);
                     },
                     names.empty()});
      }
    });
  }
};
template <class Get> RecordColumns<Get> fields(Get get, std::initializer_list<std::string_view> names = {}) {
  return {std::move(get), names};
}

/// The parts' columns, one after the other.
template <class Row, class... Parts> Columns<Row> columns_of(const Parts&... parts) {
  Columns<Row> columns;
  (parts.add_to(columns), ...);
  columns.settle();
  return columns;
}

/// The interval that a test allows, `PREFIX_lower` and `PREFIX_upper`; what is counted is an integer.
template <class Number = double, class Get>
auto allowed_columns(const std::string& prefix, std::string least, Get allowed) {
  const auto end = [allowed](double Interval::*which) {
    return [=](const auto& row) { return static_cast<Number>(std::invoke(allowed, row).*which); };
  };
  return together(value(prefix + "lower", "1", std::move(least), end(&Interval::lower)),
                  value(prefix + "upper", "1", "Most allowed.", end(&Interval::upper)));
}

/// The chi-square of a test of residuals and what is allowed of it, `PREFIX_lower` and `PREFIX_upper`; empty where nothing is judged.
template <class Get>
auto chi_square_columns(std::string name, std::string description, Get get, const std::string& prefix) {
  return where([get](const auto& row) { return std::invoke(get, row).judged > 0; },
               together(value(std::move(name), "1", std::move(description),
                              [get](const auto& row) { return std::invoke(get, row).chi_square; }),
                        allowed_columns(prefix, "Least allowed: central 99.9 % of the chi-square distribution.",
                                        [get](const auto& row) { return *std::invoke(get, row).allowed(); })));
}

/// How many cells it judged, and that.
template <class Get> auto residual_columns(std::string judged, std::string chi_square, Get get) {
  return together(
      value("judged_cells", "1", std::move(judged), [get](const auto& row) { return std::invoke(get, row).judged; }),
      chi_square_columns("chi_square", std::move(chi_square), get, "chi_square_"));
}

template <class Row>
Table table(std::string name, std::string description, const Columns<Row>& columns, const std::vector<Row>& rows) {
  Table table;
  table.name = std::move(name);
  table.description = std::move(description);
  for (const ColumnOf<Row>& column : columns.all()) table.columns.push_back(column.column);
  table.rows.reserve(rows.size());
  for (const Row& row : rows) {
    std::vector<Value>& values = table.rows.emplace_back();
    values.reserve(table.columns.size());
    for (const ColumnOf<Row>& column : columns.all()) values.push_back(column.read(row));
  }
  return table;
}

/// Of the parts' columns.
template <class Row, class... Parts>
Table table(std::string name, std::string description, const std::vector<Row>& rows, const Parts&... parts) {
  return table(std::move(name), std::move(description), columns_of<Row>(parts...), rows);
}

/// Shown whole in the report.
inline Table in_report(Table table) {
  table.in_report = true;
  return table;
}

/// Differs from run to run.
inline Table timing(Table table) {
  table.is_timing = true;
  return table;
}

}  // namespace thinwall
