#include <thinwall/experiments/experiment_list.hpp>

#include <algorithm>
#include <array>
#include <iterator>
#include <memory>
#include <span>
#include <utility>

#include <fmt/format.h>

#include <thinwall/experiments/bouncing/figures.hpp>
#include <thinwall/experiments/bouncing/summary.hpp>
#include <thinwall/experiments/bouncing/tables.hpp>
#include <thinwall_embedded.hpp>

namespace thinwall {

namespace {

struct BouncingOptions {
  std::vector<BounceCell> cells;
  std::vector<BouncePolicy> policies;
  std::int64_t bounces = 0, runs = 0, run_bounces = 0, rounds = 0;
  std::vector<std::string> scenarios;
  std::vector<double> mass_ratios;
  int digits = 0;
  std::uint64_t seed = 0;
};

constexpr std::array<std::string_view, 7> scenario_names = {"zeno",   "rest",   "walls", "gap",
                                                            "masses", "cradle", "digits"};

std::vector<BounceScenario> run_scenarios(const std::string& name, const BouncingOptions& o) {
  if (name == "zeno") return zeno_scenarios();
  if (name == "rest") return rest_scenarios();
  if (name == "walls") return corner_scenarios();
  if (name == "gap") return gap_scenarios();
  if (name == "masses") return mass_scenarios(o.mass_ratios);
  if (name == "cradle") return cradle_scenarios();
  return digit_scenarios(o.digits);
}

class BouncingRun final : public Run {
 public:
  explicit BouncingRun(BouncingOptions options)
      : options_(std::move(options)), subjects_(bounce_subjects(options_.cells, options_.policies)) {}

  /// The crowds of impacts, the cells, the long runs, the timed bounces.
  std::vector<Unit> units() const override {
    std::vector<Unit> units;
    for (const std::string& name : options_.scenarios) {
      units.push_back({"scenario " + name, 1, [this, &name] { return to_line(run_scenarios(name, options_)); }});
    }
    for (const BounceCell& cell : options_.cells) {
      for (const BouncePolicy& policy : options_.policies) {
        units.push_back({fmt::format("{} {}", key(cell), policy.name), options_.bounces, [this, &cell, &policy] {
                           return to_line(random_bounces(policy, cell, options_.seed, options_.bounces));
                         }});
      }
    }
    for (const BouncePolicy& policy : options_.policies) {
      units.push_back({fmt::format("long run {}", policy.name), options_.runs * options_.run_bounces, [this, &policy] {
                         return to_line(
                             long_run(policy, long_cell(), options_.seed, options_.runs, options_.run_bounces));
                       }});
    }
    std::vector<Unit> timings = bounce_timing_units(subjects_, options_.rounds);
    std::move(timings.begin(), timings.end(), std::back_inserter(units));
    return units;
  }

  Outcome finish(const std::vector<std::string>& results, const std::vector<double>& seconds) const override {
    std::size_t at = 0;
    BouncingResults all;
    for (const std::string& name : options_.scenarios) {
      all.groups.push_back({name, bounce_scenarios_from_line(results[at++])});
    }
    std::vector<BounceTally> tallies;
    for (std::size_t i = 0; i < options_.cells.size() * options_.policies.size(); ++i) {
      tallies.push_back(bounce_tally_from_line(results[at++]));
    }
    all.lines = make_bounce_lines(options_.cells, options_.policies, tallies);
    all.tests = bounce_tests(all.lines);
    for (const BouncePolicy& policy : options_.policies) {
      all.long_runs.push_back(
          make_long_run(policy, long_cell(), options_.run_bounces, long_run_from_line(results[at++])));
    }
    all.work = bounce_work(subjects_, std::span(results).subspan(at), std::span(seconds).subspan(at));
    return {.answer = bouncing_answer(all),
            .summary = bouncing_summary(all),
            .tables = {bounce_means_table(all.lines), scenarios_table(all.groups), long_runs_table(all.long_runs),
                       dropped_table(all.long_runs), bounce_test_table(all.tests), bounce_cells_table(all.lines),
                       even_phases_table(all.work), bounce_timings_table(all.work)},
            .figures = bouncing_figures(all, options_.policies),
            .sections = bouncing_sections(all),
            .self_test_passed = all.passed()};
  }

 private:
  /// The middle step, without loss.
  BounceCell long_cell() const {
    BounceCell cell = options_.cells[options_.cells.size() / 2];
    cell.restitution = 1;
    return cell;
  }

  BouncingOptions options_;
  std::vector<BounceSubject> subjects_;
};

/// The names under `key`; every name for "all".
std::vector<std::string> chosen(const Settings& settings, std::string_view key,
                                std::span<const std::string_view> names) {
  std::vector<std::string_view> allowed(names.begin(), names.end());
  allowed.emplace_back("all");
  std::vector<std::string> some = settings.choices(key, allowed);
  if (std::find(some.begin(), some.end(), "all") != some.end()) some.assign(names.begin(), names.end());
  return some;
}

std::unique_ptr<Run> configure(const Settings& settings, const RunOptions& options) {
  BouncingOptions o;
  o.policies = bounce_policies(chosen(settings, "policy", bounce_policy_names()));
  settings.limit_cells({"step", "restitution"}, o.policies.size());
  o.cells = make_bounce_cells(settings);
  o.scenarios = chosen(settings, "scenario", scenario_names);
  o.bounces = settings.trials("bounces", 1, std::int64_t(1) << 30, options.trials);
  o.runs = settings.integer("runs", 2, 100000);
  o.run_bounces = settings.integer("run_bounces", 1, 4096);
  o.rounds = settings.integer("rounds", 1, 1000);
  o.mass_ratios = settings.numbers("mass_ratio", {.lower = 1, .upper = 1e16});
  o.digits = static_cast<int>(settings.integer("digits", 0, 7));
  o.seed = options.seed;
  return std::make_unique<BouncingRun>(std::move(o));
}

}  // namespace

Experiment bouncing_experiment() {
  return {
      "bouncing",
      "A ball bounces on a floor: what does each way to find and answer the impact do to its energy, and what time does it "
      "take?",
      embedded_toml("bouncing"), configure};
}

}  // namespace thinwall
