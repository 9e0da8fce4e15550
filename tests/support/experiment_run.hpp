#pragma once
/// Runs of an experiment in memory, for its tests, and what the result of every experiment owes its reader.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/lab/files.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/lab/statistics.hpp>
#include <thinwall/experiments/lab/table_text.hpp>

#include "support/said.hpp"

namespace thinwall {

// ---- What a reader is owed.

/// No line of it is too long for a terminal.
inline void expect_narrow(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const auto letters = std::ranges::count_if(line, [](char c) { return (c & 0xc0) != 0x80; });  // not bytes, in UTF-8
    EXPECT_LE(letters, 100) << line;
  }
}

/// Every row of a table is as long as its columns are many, no number in it is none, and every column has a description and,
/// if it is a number, a unit. There is an answer, and a summary that fits a terminal.
inline void expect_readable(const Outcome& outcome) {
  const auto is_nan = [](const Value& value) {
    const double* const number = std::get_if<double>(&value);
    return number != nullptr && std::isnan(*number);
  };
  for (const Table& t : outcome.tables) {
    for (const std::vector<Value>& row : t.rows) {
      ASSERT_EQ(row.size(), t.columns.size()) << t.name;
      EXPECT_EQ(std::ranges::find_if(row, is_nan) - row.begin(), std::ssize(row)) << t.name;
    }
    for (const Column& column : t.columns) {
      EXPECT_FALSE(column.description.empty()) << t.name << " " << column.name;
      EXPECT_EQ(column.unit.empty(), column.type == ColumnType::text || column.type == ColumnType::boolean)
          << t.name << " " << column.name;
    }
  }
  EXPECT_FALSE(outcome.answer.empty());
  expect_narrow(outcome.summary);
}

// ---- Runs of an experiment.

/// The first of the list that has that name.
template <class List> const auto& called(const List& list, std::string_view name) {
  const auto found = std::ranges::find_if(list, [&](const auto& one) { return one.name == name; });
  if (found == std::ranges::end(list)) throw std::out_of_range("none is called " + std::string(name));
  return *found;
}

/// Configured by `text`, laid over the experiment's defaults. Throws UsageError.
inline std::unique_ptr<Run> run_of(const Experiment& experiment, std::string_view text,
                                   RunOptions options = {.seed = 1, .trials = {}}) {
  const Settings settings(text, "test.toml", experiment.default_toml);
  settings.reject_unknown_keys();
  return experiment.configure(settings, options);
}

/// What is said against such a text; empty if it is taken.
inline std::string refusal_of(const Experiment& experiment, std::string_view text) {
  return error_of<UsageError>([&] { run_of(experiment, text); });
}

/// A text that an experiment does not take, and what it says of it in its one line.
struct Refusal {
  std::string text, said;
};

inline void expect_refusals(const Experiment& experiment, const std::vector<Refusal>& refusals) {
  for (const auto& [text, said] : refusals) {
    const std::string refusal = refusal_of(experiment, text);
    EXPECT_TRUE(holds(refusal, said)) << text;
    EXPECT_EQ(refusal.find('\n'), std::string::npos) << refusal;
  }
}

/// A configuration of a second or two.
inline std::string small_toml(std::string_view experiment) {
  return file_text(std::filesystem::path(THINWALL_SOURCE) / "tests/results/small" /
                   (std::string(experiment) + ".toml"));
}

inline std::vector<std::string> results_of(const std::vector<Unit>& units) {
  std::vector<std::string> results;
  for (const Unit& unit : units) results.push_back(unit.compute());
  return results;
}

inline Outcome outcome_of(const Run& run) {
  const std::vector<std::string> results = results_of(run.units());
  return run.finish(results, std::vector<double>(results.size(), 1e-3));
}

inline Outcome outcome_of(const Experiment& experiment, std::string_view text,
                          RunOptions options = {.seed = 1, .trials = {}}) {
  return outcome_of(*run_of(experiment, text, options));
}

/// Of its small configuration, run once for all tests that only look.
inline const Outcome& small_outcome(const Experiment& experiment) {
  static std::map<std::string, Outcome> outcomes;
  const std::string name(experiment.name);
  if (!outcomes.contains(name)) outcomes[name] = outcome_of(experiment, small_toml(name));
  return outcomes[name];
}

/// So many draws in [0, 1), over so many bins: the chi-square statistic lies in its central 99.99 %.
template <class Draw> void expect_uniform(std::uint64_t bins, std::uint64_t draws, const Draw& draw) {
  const double parts = static_cast<double>(bins), expected = static_cast<double>(draws) / parts;
  std::vector<double> counts(bins);
  for (std::uint64_t i = 0; i < draws; ++i) ++counts[std::min(bins - 1, static_cast<std::uint64_t>(parts * draw(i)))];
  double sum = 0;
  for (const double count : counts) sum += (count - expected) * (count - expected) / expected;
  EXPECT_TRUE(chi_square_range(static_cast<std::int64_t>(bins) - 1, 0.9999).contains(sum)) << sum;
}

// ---- What is in a result.

inline const Table& table_of(const Outcome& outcome, std::string_view name) { return called(outcome.tables, name); }

inline const Value& value_of(const Table& table, std::size_t row, const std::string& column) {
  return table.rows[row][place_of(table, column)];
}

/// Of the row that starts with `first`, in a table with one such row.
inline const Value& value_of(const Table& table, const std::string& first, const std::string& column) {
  const auto row = std::ranges::find_if(table.rows, [&](const auto& r) { return r[0] == Value(first); });
  return (*row)[place_of(table, column)];
}

}  // namespace thinwall
