#include <functional>

#include <fmt/format.h>

#include <thinwall/experiments/engines/report.hpp>

namespace thinwall {

namespace {

/// A column, and what a line writes into it.
struct EngineField {
  Column column;
  std::function<Value(const EngineLine&)> read;
};

using enum ColumnType;

Value engine_value(const std::optional<double>& x) { return x ? Value(*x) : Value(); }

/// Missing where none turned: the extremes are infinite then.
EngineField of_turned(Column column, double EngineTally::*field) {
  return {std::move(column),
          [field](const EngineLine& l) { return l.tally.turned > 0 ? Value(l.tally.*field) : Value(); }};
}

std::vector<EngineField> engine_names() {
  return {{{"engine", text, "", "The physics engine."}, [](const EngineLine& l) { return l.setup->engine.called; }},
          {{"mode", text, "", "How it is set up."}, [](const EngineLine& l) { return l.setup->mode.name; }}};
}

std::vector<EngineField> engine_factors() {
  return {{{"wall_size", number, "m", "Side of the wall, a square."},
           [](const EngineLine& l) { return l.cell->wall_size; }},
          {{"path", number, "m", "Path of the ball in a step."}, [](const EngineLine& l) { return l.cell->path; }}};
}

std::vector<EngineField> engine_verdicts() {
  return {
      {{"shots", integer, "1", "Shots, each of which hits the wall by the oracle."},
       [](const EngineLine& l) { return l.tally.shots; }},
      {{"tunneled", integer, "1", "Balls whose center ended beyond the wall."},
       [](const EngineLine& l) { return l.tally.tunneled; }},
      {{"tunneled_percent", number, "%", "100 tunneled / shots.", "percent_lower", "percent_upper"},
       [](const EngineLine& l) {
         return 100.0 * static_cast<double>(l.tally.tunneled) / static_cast<double>(l.tally.shots);
       }},
      {{"percent_lower", number, "%", "Lower end of its 95 % Wilson interval."},
       [](const EngineLine& l) { return 100 * tunneled_interval(l).lower; }},
      {{"percent_upper", number, "%", "Upper end of it."},
       [](const EngineLine& l) { return 100 * tunneled_interval(l).upper; }},
      {{"theory_percent", number, "%", "By theory, where only poses are looked at; missing elsewhere."},
       [](const EngineLine& l) { return l.theory ? Value(100 * *l.theory) : Value(); }},
      {{"verdict", text, "", "By the oracle: right if every ball was kept in front of the wall."},
       [](const EngineLine& l) { return std::string(wrong_shots(l) == 0 ? "right" : "wrong"); }},
  };
}

std::vector<EngineField> engine_ends() {
  return {
      {{"unseen", integer, "1", "Of the tunneled, balls that are where they would be without a wall."},
       [](const EngineLine& l) { return l.tally.unseen; }},
      {{"stuck", integer, "1", "Balls whose center ended between the wall's faces."},
       [](const EngineLine& l) { return l.tally.stuck; }},
      {{"lost", integer, "1", "Balls without a finite place at the end."},
       [](const EngineLine& l) { return l.tally.lost; }},
      {{"turned", integer, "1", "Balls that fly away in front of the wall at the end."},
       [](const EngineLine& l) { return l.tally.turned; }},
      {{"held", integer, "1", "Balls in front of the wall that do not."},
       [](const EngineLine& l) { return l.tally.kept() - l.tally.turned; }},
  };
}

std::vector<EngineField> engine_bounces() {
  return {{{"lateness", number, "steps", "Mean over the turned, from first contact to where the lines of flight meet."},
           [](const EngineLine& l) { return engine_value(mean_late(l)); }},
          of_turned({"latest", number, "steps", "The most of them."}, &EngineTally::latest),
          {{"energy", number, "1", "Energy after over energy before, mean over the turned."},
           [](const EngineLine& l) { return engine_value(mean_energy(l)); }},
          of_turned({"least_energy", number, "1", "The least of them."}, &EngineTally::least_energy),
          of_turned({"most_energy", number, "1", "The most of them."}, &EngineTally::most_energy)};
}

std::vector<EngineField> engine_depths() {
  return {
      {{"lateness_path", number, "m", "The mean lateness as a path."},
       [](const EngineLine& l) {
         const auto late = mean_late(l);
         return late ? Value(*late * l.cell->path) : Value();
       }},
      of_turned({"earliest", number, "steps", "The least lateness; < 0 is before contact."}, &EngineTally::earliest),
      of_turned({"deepest", number, "m", "Deepest in the wall at the end of a step, of the turned; < 0 is apart."},
                &EngineTally::deepest)};
}

Table engine_table(const std::vector<EngineLine>& lines, const std::vector<std::vector<EngineField>>& groups) {
  Table table;
  for (const auto& group : groups) {
    for (const EngineField& field : group) table.columns.push_back(field.column);
  }
  for (const EngineLine& line : lines) {
    std::vector<Value> row;
    for (const auto& group : groups) {
      for (const EngineField& field : group) row.push_back(field.read(line));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::vector<EngineLine> told_engine_lines(const std::vector<EngineLine>& lines) {
  std::vector<EngineLine> told;
  for (const double wall_size : wall_sizes(lines)) {
    const auto some = lines_at(lines, told_path(lines), wall_size);
    told.insert(told.end(), some.begin(), some.end());
  }
  return told;
}

}  // namespace

Table told_engines_table(const std::vector<EngineLine>& lines) {
  const std::vector<EngineField> safe = {
      {{"right_up_to", number, "m", "Longest path up to which it kept every ball in front; 0 is none of those asked."},
       [&lines](const EngineLine& l) { return safe_up_to(lines, l.setup->label(), l.cell->wall_size); }}};
  Table table = engine_table(told_engine_lines(lines),
                             {engine_names(), engine_factors(), engine_verdicts(), safe, engine_bounces()});
  table.name = "engines";
  table.description = fmt::format("Every engine and mode at {} m a step.", told_path(lines));
  table.in_report = true;
  return table;
}

Table engine_cells_table(const std::vector<EngineLine>& lines) {
  Table table = engine_table(
      lines, {engine_names(), engine_factors(), engine_verdicts(), engine_ends(), engine_bounces(), engine_depths()});
  table.name = "cells";
  table.description = "Every engine and mode at every path and wall.";
  return table;
}

Table engine_timings_table(const std::vector<EngineLine>& lines) {
  const auto interval = [](const EngineLine& l) { return bootstrap_median(l.nanoseconds, {1, l.nanoseconds.size()}); };
  const std::vector<EngineField> times = {
      {{"nanoseconds", number, "ns", "Time a step of a world of one wall and one ball, median over volleys.", "lower",
        "upper"},
       [](const EngineLine& l) { return median(l.nanoseconds); }},
      {{"lower", number, "ns", "Lower end of its 95 % bootstrap interval."},
       [&](const EngineLine& l) { return interval(l).lower; }},
      {{"upper", number, "ns", "Upper end of it."}, [&](const EngineLine& l) { return interval(l).upper; }},
      {{"volleys", integer, "1", "Timed apart, in turn with the other engines."},
       [](const EngineLine& l) { return static_cast<std::int64_t>(l.nanoseconds.size()); }}};
  Table table = engine_table(lines, {engine_names(), engine_factors(), times});
  table.name = "timings";
  table.description = "Time a step; making the world is not in it.";
  table.is_timing = true;
  return table;
}

}  // namespace thinwall
