#pragma once
/// Values as one line of text for a run's journal: every bit is kept, and none is a tab or a newline.

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <functional>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace thinwall {

class JournalWriter {
 public:
  void put(std::int64_t number);
  void put(double number);
  void put(std::string_view text);
  std::string text() && { return std::move(out_); }

 private:
  std::string& next();
  std::string out_;
};

/// Every function throws std::runtime_error, which quotes the text, if it does not read on as it should.
class JournalReader {
 public:
  explicit JournalReader(std::string_view text) : whole_(text), rest_(text) {}

  std::int64_t integer();
  std::size_t size();  ///< of a list whose entries follow; no more than there is text left for
  double real();
  std::string text();
  bool at_end() const { return rest_.empty(); }
  void require(bool condition) const;

 private:
  std::string_view word();

  std::string_view whole_, rest_;
};

// ---- The fields of a record, stated once: adding two records, their text in a journal, and their columns follow.
//
//   struct Tally {
//     std::int64_t shots = 0, tunneled = 0;
//     double latest = no_most;  // [m]
//     static constexpr auto fields() {
//       return record(sum("shots", &Tally::shots, "1", "Shots fired."),
//                     sum("tunneled", &Tally::tunneled, "1", "Shots that nothing saw."),
//                     most("latest", &Tally::latest, "m", "The latest detection."));
//     }
//   };
//   tally += more;                                    // exact, in any order and grouping
//   tally = from_text<Tally>(to_text(tally));         // no bit is lost
//   columns_of<Row>(fields(&Row::tally));             // lab/columns.hpp

/// What `least` and `most` are of nothing.
inline constexpr double no_least = std::numeric_limits<double>::infinity(), no_most = -no_least;

/// What becomes of a field when two records are added.
enum class Merge {
  sum,    ///< of whole numbers, of lists of them entry by entry, of records
  least,  ///< the smaller one; of nothing it is infinity
  most,   ///< the larger one; of nothing it is minus infinity
  kept    ///< the first that is not empty: it says what was counted, or stands in one part alone
};

template <class T, class V> struct Field {
  std::string_view name;  ///< snake_case, unique in its table
  V T::*member;
  std::string_view unit, description;  ///< as those of a column
  Merge merge;
};

template <class T, class V>
constexpr Field<T, V> sum(std::string_view name, V T::*member, std::string_view unit, std::string_view description) {
  return {name, member, unit, description, Merge::sum};
}
template <class T>
constexpr Field<T, double> least(std::string_view name, double T::*member, std::string_view unit,
                                 std::string_view description) {
  return {name, member, unit, description, Merge::least};
}
template <class T>
constexpr Field<T, double> most(std::string_view name, double T::*member, std::string_view unit,
                                std::string_view description) {
  return {name, member, unit, description, Merge::most};
}
template <class T, class V>
constexpr Field<T, V> kept(std::string_view name, V T::*member, std::string_view unit = "",
                           std::string_view description = "") {
  return {name, member, unit, description, Merge::kept};
}
/// A record in a record: its fields stand in the other's place.
template <class T, class V> constexpr Field<T, V> part(V T::*member) { return {"", member, "", "", Merge::sum}; }

template <class... Fields> constexpr std::tuple<Fields...> record(Fields... fields) { return {fields...}; }

template <class T>
concept Record = requires { T::fields(); };

/// A real added up in whole multiples of 2^-32, so that no sum depends on its order: for numbers of about 1.
struct RealSum {
  std::int64_t count = 0, units = 0;

  void add(double x);
  std::optional<double> mean() const;  ///< missing if there is none
  static constexpr auto fields() {
    return record(sum("count", &RealSum::count, "1", "How many."), sum("units", &RealSum::units, "1", "In 2^-32."));
  }
  bool operator==(const RealSum&) const = default;
};

/// Calls `visit(field)` for each.
template <Record T, class Visitor> constexpr void for_each_field(const Visitor& visit) {
  std::apply([&](const auto&... field) { (visit(field), ...); }, T::fields());
}

template <Record T> T& operator+=(T& into, const T& more);

namespace detail {

// NOLINTBEGIN(bugprone-branch-clone): branches of `if constexpr` are alike in words, not in types.
template <class V> void merge(Merge how, V& into, const V& more) {
  if (how == Merge::kept) {
    if constexpr (std::equality_comparable<V>) {
      if (into == V{}) into = more;
    }
  } else if constexpr (Record<V>) {
    into += more;
  } else if constexpr (requires { into.begin(); } && !std::same_as<V, std::string>) {
    if constexpr (requires { into.resize(more.size()); }) {
      if (into.size() < more.size()) into.resize(more.size());
    }
    for (std::size_t i = 0; i < more.size(); ++i) merge(how, into[i], more[i]);
  } else if constexpr (std::integral<V> && !std::same_as<V, bool>) {
    if (how == Merge::sum) into += more;
  } else if constexpr (std::same_as<V, double>) {
    if (how == Merge::least ? more < into : how == Merge::most && more > into) into = more;
  }
}

template <class V> void write(JournalWriter& out, const V& value) {
  if constexpr (Record<V>) {
    for_each_field<V>([&](const auto& field) { write(out, value.*field.member); });
  } else if constexpr (std::is_enum_v<V>) {
    out.put(static_cast<std::int64_t>(value));
  } else if constexpr (requires { value.has_value(); }) {
    out.put(std::int64_t{value.has_value()});
    if (value) write(out, *value);
  } else if constexpr (requires { value.begin(); } && !std::same_as<V, std::string>) {
    out.put(static_cast<std::int64_t>(value.size()));
    for (const auto& item : value) write(out, item);
  } else if constexpr (std::integral<V>) {
    out.put(static_cast<std::int64_t>(value));
  } else {
    out.put(value);
  }
}

template <class V> void read(JournalReader& in, V& value) {
  if constexpr (Record<V>) {
    for_each_field<V>([&](const auto& field) { read(in, value.*field.member); });
  } else if constexpr (std::is_enum_v<V>) {
    value = static_cast<V>(in.integer());
  } else if constexpr (requires { value.has_value(); }) {
    value.reset();
    if (in.integer() != 0) read(in, value.emplace());
  } else if constexpr (requires { value.begin(); } && !std::same_as<V, std::string>) {
    const std::size_t size = in.size();
    if constexpr (requires { value.resize(size); }) {
      value.resize(size);
    } else {
      in.require(size == value.size());
    }
    for (auto& item : value) read(in, item);
  } else if constexpr (std::integral<V>) {
    value = static_cast<V>(in.integer());
  } else if constexpr (std::same_as<V, double>) {
    value = in.real();
  } else {
    value = in.text();
  }
}

// NOLINTEND(bugprone-branch-clone)

}  // namespace detail

/// As if one record had counted what both did.
template <Record T> T& operator+=(T& into, const T& more) {
  for_each_field<T>([&](const auto& field) { detail::merge(field.merge, into.*field.member, more.*field.member); });
  return into;
}

/// One line without tabs. `T` is a record, a number, a text, an enumeration, or a list, an array or an optional of such.
template <class T> std::string to_text(const T& value) {
  JournalWriter out;
  detail::write(out, value);
  return std::move(out).text();
}

/// Throws std::runtime_error if `text` is not what `to_text` made of a `T`.
template <class T> T from_text(std::string_view text) {
  JournalReader in(text);
  T value{};
  detail::read(in, value);
  in.require(in.at_end());
  return value;
}

/// The rows for which `is_it` holds.
template <class Row> std::vector<Row> only(const std::vector<Row>& rows, const auto& is_it) {
  std::vector<Row> some;
  std::ranges::copy_if(rows, std::back_inserter(some), is_it);
  return some;
}

/// The values of the key, each once, in the order of their first.
template <class Row, class Key> auto distinct(const std::vector<Row>& rows, const Key& key) {
  std::vector<std::remove_cvref_t<std::invoke_result_t<const Key&, const Row&>>> values;
  for (const Row& row : rows) {
    if (std::ranges::find(values, std::invoke(key, row)) == values.end()) values.push_back(std::invoke(key, row));
  }
  return values;
}

template <class Row> using Group = std::vector<const Row*>;

/// The rows of each key, both in the order of their first. `rows` must outlive the groups.
template <class Row, class Key> std::vector<Group<Row>> group_by(const std::vector<Row>& rows, const Key& key) {
  std::vector<Group<Row>> groups;
  for (const Row& row : rows) {
    const auto is_its = [&](const Group<Row>& group) { return std::invoke(key, *group[0]) == std::invoke(key, row); };
    auto found = std::find_if(groups.begin(), groups.end(), is_its);
    if (found == groups.end()) found = groups.insert(groups.end(), Group<Row>());
    found->push_back(&row);
  }
  return groups;
}

/// All rows of several lists, or of a list in each of several things, one list after the other.
template <class Thing, class Get = std::identity> auto flat(const std::vector<Thing>& things, const Get& get = {}) {
  std::remove_cvref_t<std::invoke_result_t<const Get&, const Thing&>> all;
  for (const Thing& thing : things) {
    const auto& list = std::invoke(get, thing);
    all.insert(all.end(), list.begin(), list.end());
  }
  return all;
}

/// What the records of a group add up to.
template <class Row, Record T> T total_of(const Group<Row>& group, T Row::*record) {
  T sum = group[0]->*record;
  for (std::size_t i = 1; i < group.size(); ++i) sum += group[i]->*record;
  return sum;
}

}  // namespace thinwall
