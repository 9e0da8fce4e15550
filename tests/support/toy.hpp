#pragma once
/// An experiment for the tests of what stands between an experiment and its user: small, quick, and it fails on demand.

#include <atomic>
#include <csignal>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/lab/settings.hpp>

#include "support/program.hpp"
#include "support/reply.hpp"

namespace thinwall {

/// What the toy does beside its work; not part of its configuration.
struct ToyControl {
  static inline std::atomic<int> computed = 0;         ///< units computed since a test set it to 0
  static inline std::atomic<int> interrupt_after = 0;  ///< > 0: that many units from now SIGINT is raised
  static inline std::atomic<int> fail_at = 0;          ///< > 0: the unit of that number throws
  static inline std::atomic<bool> pass = true;         ///< of its self-test
  static inline std::string removes;                   ///< not empty: the folder that every unit removes
};

class ToyRun final : public Run {
 public:
  ToyRun(std::int64_t cells, std::int64_t trials, std::uint64_t seed, std::vector<double> speeds)
      : cells_(cells), trials_(trials), seed_(seed), speeds_(std::move(speeds)) {}

  std::vector<Unit> units() const override {
    std::vector<Unit> out;
    for (int i = 0; i < cells_; ++i) {
      out.push_back({"cell " + std::to_string(i), trials_, [i, seed = seed_] {
                       ++ToyControl::computed;
                       if (ToyControl::fail_at == i + 1) throw std::runtime_error("no luck");
                       if (!ToyControl::removes.empty()) std::filesystem::remove_all(ToyControl::removes);
                       if (ToyControl::interrupt_after > 0 && --ToyControl::interrupt_after == 0) std::raise(SIGINT);
                       return std::to_string(static_cast<std::uint64_t>(i * i) + seed);
                     }});
    }
    return out;
  }

  Outcome finish(const std::vector<std::string>& results, const std::vector<double>& seconds) const override {
    Outcome out;
    Table cells{.name = "cells", .description = "Squares, and the seed.", .columns = {}, .rows = {}, .in_report = true};
    cells.columns = {{"cell", ColumnType::integer, "1", "Its number."},
                     {"square", ColumnType::integer, "m^2", "Its square, plus the seed."},
                     {"name", ColumnType::text, "", "Awkward, to be quoted."},
                     {"root", ColumnType::number, "m", "Its square root; none for 0."},
                     {"even", ColumnType::boolean, "", "If it is."}};
    Table timings{.name = "timings", .description = "How long.", .columns = {}, .rows = {}, .is_timing = true};
    timings.columns = {{"seconds", ColumnType::number, "s", "To compute a cell."}};
    Series points{.label = "squares", .mark = Mark::points, .x = {}, .y = {}, .lower = {}, .upper = {}};
    for (std::size_t i = 0; i < results.size(); ++i) {
      const auto number = static_cast<std::int64_t>(i);
      const double x = static_cast<double>(i), y = std::stod(results[i]);
      cells.rows.push_back(
          {number, std::stoll(results[i]), std::string("a, \"b\""), i == 0 ? Value{} : Value{x / 3}, number % 2 == 0});
      timings.rows.push_back({seconds[i]});
      points.x.push_back(x);
      points.y.push_back(y);
      points.lower.push_back(y - 1);
      points.upper.push_back(y + 1);
    }
    out.answer = "The squares & <their> sum.";
    out.summary = "cells: " + std::to_string(results.size());
    out.tables = {cells, timings};
    out.figures = {{"squares", "Squares", "What a square is.", {{"x [m]", "y [m^2]", false, false, 1, {points}}}}};
    out.figures.push_back({"cost", "Cost", "How long.", {{"x [m]", "t [s]", false, false, 1, {points}}}, true});
    out.sections = {{"Method", "First.\n\nSecond."}, {"Limits", "None."}};
    out.self_test_passed = ToyControl::pass;
    return out;
  }

 private:
  std::int64_t cells_, trials_;
  std::uint64_t seed_;
  std::vector<double> speeds_;
};

inline Experiment toy_experiment() {
  return {.name = "toy",
          .question = "What is a square?",
          .default_toml = "experiment = \"toy\"\ncells = 20\ntrials = 10\nspeed = [1, 10]  # [m/s]\n",
          .configure = [](const Settings& settings, const RunOptions& options) -> std::unique_ptr<Run> {
            return std::make_unique<ToyRun>(settings.integer("cells", 1, 1000),
                                            options.trials.value_or(settings.integer("trials", 1, 1000)), options.seed,
                                            settings.numbers("speed", {.lower = 0, .lower_open = true, .unit = "m/s"}));
          }};
}

// ---- The program with the toy experiment alone, called as a user calls it, with a result folder of its own.

struct ToyProgram : ::testing::Test {
  TemporaryFolder folder;
  std::string out = folder / "out";

  ToyProgram() {
    ToyControl::computed = ToyControl::interrupt_after = ToyControl::fail_at = 0;
    ToyControl::pass = true;
    ToyControl::removes.clear();
  }

  static Reply call(const Words& words) { return call_program(words, {toy_experiment()}); }
  Reply run(const Words& more = {}) const { return call(joined({"run", "toy", "--out", out}, more)); }

  nlohmann::json manifest() const { return nlohmann::json::parse(read_text(out + "/manifest.json")); }
};

}  // namespace thinwall
