#include <thinwall/experiments/experiment_list.hpp>

#include <algorithm>
#include <memory>
#include <regex>
#include <utility>

#include <fmt/format.h>

#include <thinwall/experiments/settings.hpp>
#include <thinwall/experiments/speed/bench_program.hpp>
#include <thinwall/experiments/speed/report.hpp>
#include <thinwall_embedded.hpp>

namespace thinwall {

namespace {

constexpr double rows_of_a_program = 700;  // about, on average: for the estimate of a dry run, which starts none

class SpeedRun final : public Run {
 public:
  SpeedRun(std::filesystem::path folder, std::vector<std::string> programs, std::int64_t rounds, BenchOptions options)
      : folder_(std::move(folder)), programs_(std::move(programs)), rounds_(rounds), options_(std::move(options)) {}

  std::vector<Unit> units() const override {
    std::vector<Unit> units;
    for (std::int64_t round = 1; round <= rounds_; ++round) {
      for (const std::string& program : programs_) {
        units.push_back({fmt::format("{} {}", program, round), 1,
                         [this, &program] { return to_line(run_bench_program(folder_, program, options_)); },
                         rows_of_a_program * options_.seconds});
      }
    }
    return units;
  }

  Outcome finish(const std::vector<std::string>& results, const std::vector<double>&) const override {
    SpeedResult result;
    for (const std::string& line : results) result.outputs.push_back(bench_output_from_line(line));
    result.ways = ways(result.outputs);
    Outcome outcome{.answer = speed_answer(result),
                    .summary = speed_summary(result),
                    .tables = {speed_race_table(result), speed_programs_table(result), speed_floors_table(result),
                               speed_errors_table(result), speed_timings_table(result)},
                    .figures = speed_figures(result),
                    .sections = speed_sections(result),
                    .self_test_passed = speed_self_test(result)};
    std::erase_if(outcome.tables, [](const Table& table) { return table.rows.empty(); });
    return outcome;
  }

 private:
  std::filesystem::path folder_;
  std::vector<std::string> programs_;
  std::int64_t rounds_;
  BenchOptions options_;
};

std::vector<std::string> chosen_programs(const Settings& settings) {
  std::vector<std::string_view> allowed(bench_program_names().begin(), bench_program_names().end());
  const std::vector<std::string> all(allowed.begin(), allowed.end());
  allowed.emplace_back("all");
  const std::vector<std::string> chosen = settings.choices("programs", allowed);
  return std::find(chosen.begin(), chosen.end(), "all") == chosen.end() ? chosen : all;
}

std::unique_ptr<Run> configure_speed(const Settings& settings, const RunOptions& options) {
  const std::vector<std::string> programs = chosen_programs(settings);
  const std::string named = settings.text("benchmarks");
  const std::filesystem::path folder = named.empty() ? built_benchmarks() : std::filesystem::path(named);
  BenchOptions bench{settings.number("seconds", {.lower = 0.001, .upper = 100, .unit = "s"}), settings.text("filter")};
  const std::int64_t rounds = settings.trials("rounds", 1, 1000, options.trials);
  try {
    const std::regex checked(bench.filter);
  } catch (const std::regex_error&) {
    settings.complain("filter", "a regular expression, or \"\" for every row");
  }
  if (std::none_of(programs.begin(), programs.end(), [&](const std::string& p) { return is_program(folder / p); })) {
    settings.complain(
        "benchmarks",
        fmt::format(
            "a folder that holds at least one of the benchmark programs asked for; {} has none. Build them: cmake --preset release "
            "-DTHINWALL_BUILD_BENCH=ON && cmake --build --preset release",
            folder.string()));
  }
  return std::make_unique<SpeedRun>(folder, programs, rounds, std::move(bench));
}

}  // namespace

Experiment speed_experiment() {
  return {"speed",
          "What does an answer cost on this machine, and how wrong is it: ours, the plain form, other libraries?",
          embedded_toml("speed"), configure_speed};
}

}  // namespace thinwall
