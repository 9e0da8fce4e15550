#pragma once
/// An experiment for the tests of what stands between an experiment and its user: small, quick, and it fails on demand.

#include <atomic>
#include <csignal>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/lab/columns.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/lab/tasks.hpp>

#include "support/program.hpp"
#include "support/reply.hpp"

namespace thinwall {

/// What the toy does beside its work; not part of its configuration.
struct ToyControl {
  static inline std::atomic<int> computed = 0;         ///< units computed by the last call of the program
  static inline std::atomic<int> interrupt_after = 0;  ///< > 0: that many units from now SIGINT is raised
  static inline std::atomic<int> fail_at = 0;          ///< > 0: the unit of that number throws
  static inline std::atomic<bool> pass = true;         ///< of its self-test
  static inline std::string removes;                   ///< not empty: the folder that every unit removes
};

struct ToyRow {
  std::int64_t cell, square;
  double seconds;
};

inline Outcome toy_outcome(const Done<std::int64_t>& done) {
  std::vector<ToyRow> rows;
  Series points{.label = "squares"};
  for (const std::int64_t square : done.results) {
    const auto y = static_cast<double>(square);
    points.add(static_cast<double>(rows.size()), y);
    points.lower.push_back(y - 1);
    points.upper.push_back(y + 1);
    rows.push_back({std::ssize(rows), square, done.seconds[rows.size()]});
  }
  const auto cells = columns_of<ToyRow>(
      value("cell", "1", "Its number.", &ToyRow::cell),
      value("square", "m^2", "Its square, plus the seed.", &ToyRow::square),
      text("name", "Awkward, to be quoted.", [](const ToyRow&) { return "a, \"b\""; }),
      value("root", "m", "A third of it; none of 0.",
            [](const ToyRow& r) { return r.cell > 0 ? std::optional(static_cast<double>(r.cell) / 3) : std::nullopt; }),
      value("even", "", "If it is.", [](const ToyRow& r) { return r.cell % 2 == 0; }));
  const auto seconds = columns_of<ToyRow>(value("seconds", "s", "To compute a cell.", &ToyRow::seconds));
  return {
      .answer = "The squares & <their> sum.",
      .summary = "cells: " + std::to_string(rows.size()),
      .tables = {in_report(table("cells", "Squares, and the seed.", cells, rows)),
                 timing(table("timings", "How long.", seconds, rows))},
      .figures = {{"squares",
                   "Squares",
                   "What a square is.",
                   {{.x_label = "x [m]", .y_label = "y [m^2]", .series = {points}}}},
                  {"cost", "Cost", "How long.", {{.x_label = "x [m]", .y_label = "t [s]", .series = {points}}}, true}},
      .sections = {{"Method", "First.\n\nSecond."}, {"Limits", "None."}},
      .self_test_passed = ToyControl::pass};
}

inline std::int64_t toy_square(std::int64_t cell, std::uint64_t seed) {
  ++ToyControl::computed;
  if (ToyControl::fail_at == cell + 1) throw std::runtime_error("no luck");
  if (!ToyControl::removes.empty()) std::filesystem::remove_all(ToyControl::removes);
  if (ToyControl::interrupt_after > 0 && --ToyControl::interrupt_after == 0) std::raise(SIGINT);
  return cell * cell + static_cast<std::int64_t>(seed);
}

inline Experiment toy_experiment() {
  return {.name = "toy",
          .question = "What is a square?",
          .default_toml = "experiment = \"toy\"\ncells = 20\ntrials = 10\nspeed = [1, 10]  # [m/s]\n",
          .configure = [](const Settings& settings, const RunOptions& options) {
            const std::int64_t trials = options.trials.value_or(settings.integer("trials", 1, 1000));
            settings.numbers("speed", {.lower = 0, .lower_open = true, .unit = "m/s"});
            std::vector<Task<std::int64_t>> tasks;
            for (std::int64_t cell = 0; cell < settings.integer("cells", 1, 1000); ++cell) {
              const auto compute = [=, seed = options.seed] { return toy_square(cell, seed); };
              tasks.push_back({"cell " + std::to_string(cell), trials, compute});
            }
            return make_run([](const Done<std::int64_t>& done) { return toy_outcome(done); }, std::move(tasks));
          }};
}

// ---- The program with the toy experiment alone, called as a user calls it, with a result folder of its own.

struct ToyProgram : ::testing::Test {
  TemporaryFolder folder;
  std::string out = folder / "out";

  ToyProgram() {
    ToyControl::interrupt_after = ToyControl::fail_at = 0;
    ToyControl::pass = true;
    ToyControl::removes.clear();
  }

  static Reply call(const Words& words) {
    ToyControl::computed = 0;
    return call_program(words, {toy_experiment()});
  }
  Reply run(const Words& more = {}) const { return call(joined({"run", "toy", "--out", out}, more)); }
  /// On one thread, and interrupted after so many units.
  void interrupt(int units) const {
    ToyControl::interrupt_after = units;
    ASSERT_EQ(run({"--threads", "1"}).status, 130);
  }

  /// In one line that holds every part of `said`, and nothing below `folder` is changed.
  void expect_refused(const Words& words, const Words& said = {}) const {
    const auto before = files_in(folder.path());
    expect_refusal(call(words), said);
    EXPECT_EQ(files_in(folder.path()), before);
  }

  nlohmann::json manifest() const { return nlohmann::json::parse(read_text(out + "/manifest.json")); }
  void change_manifest(const std::string& pointer, const nlohmann::json& value) const {
    nlohmann::json json = manifest();
    json[nlohmann::json::json_pointer(pointer)] = value;
    write_text(out + "/manifest.json", json.dump());
  }
};

}  // namespace thinwall
