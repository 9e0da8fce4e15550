#pragma once
/// What the tables of every experiment owe their reader.

#include <gtest/gtest.h>

#include <vector>

#include <thinwall/experiments/experiment.hpp>

namespace thinwall {

/// Every row of a table is as long as its columns are many, and every column has a description and,
/// if it is a number, a unit.
inline void expect_described_tables(const Outcome& outcome) {
  for (const Table& t : outcome.tables) {
    for (const std::vector<Value>& row : t.rows) ASSERT_EQ(row.size(), t.columns.size()) << t.name;
    for (const Column& column : t.columns) {
      EXPECT_FALSE(column.description.empty()) << t.name << " " << column.name;
      EXPECT_EQ(column.unit.empty(), column.type == ColumnType::text || column.type == ColumnType::boolean)
          << t.name << " " << column.name;
    }
  }
}

}  // namespace thinwall
