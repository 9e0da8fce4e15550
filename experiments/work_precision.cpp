#include <thinwall/experiments/experiment_list.hpp>

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include <thinwall/experiments/settings.hpp>
#include <thinwall/experiments/work_precision/figures.hpp>
#include <thinwall/experiments/work_precision/summary.hpp>
#include <thinwall/experiments/work_precision/tables.hpp>
#include <thinwall/swept/methods.hpp>
#include <thinwall_embedded.hpp>

namespace thinwall {

namespace {

class WorkPrecisionRun final : public Run {
 public:
  WorkPrecisionRun(std::vector<Heat> heats, RaceOptions options)
      : heats_(std::move(heats)), options_(std::move(options)) {}

  std::vector<Unit> units() const override {
    std::vector<Unit> units;
    for (const Heat& heat : heats_) {
      const auto race = heat.scalar == "float" ? heat.set->in_float : heat.set->in_double;
      units.push_back({fmt::format("{} {} {}", heat.set->name, name(heat.kind), heat.scalar), options_.queries,
                       [this, race, kind = heat.kind] { return to_line(race(kind, options_)); }});
    }
    return units;
  }

  Outcome finish(const std::vector<std::string>& results, const std::vector<double>&) const override {
    std::vector<Heat> heats = heats_;
    for (std::size_t i = 0; i < heats.size(); ++i) heats[i].racers = racers_from_line(results[i]);
    return {.answer = work_precision_answer(heats),
            .summary = work_precision_summary(heats),
            .tables = {trailing_table(heats), errors_table(heats), times_table(heats)},
            .figures = work_precision_figures(heats),
            .sections = work_precision_sections(heats),
            .self_test_passed = std::all_of(heats.begin(), heats.end(), keeps_contract)};
  }

 private:
  std::vector<Heat> heats_;
  RaceOptions options_;
};

/// The names chosen under `key`, of `allowed`; all of them for "all".
struct Choice {
  std::vector<std::string> names;
  bool all;
  bool has(std::string_view name) const { return std::find(names.begin(), names.end(), name) != names.end(); }
};

Choice choice_of(const Settings& settings, std::string_view key, std::vector<std::string_view> allowed) {
  const std::vector<std::string> everything(allowed.begin(), allowed.end());
  allowed.emplace_back("all");
  const std::vector<std::string> chosen = settings.choices(key, allowed);
  const bool all = std::find(chosen.begin(), chosen.end(), "all") != chosen.end();
  return {all ? everything : chosen, all};
}

/// A pair that a method does not serve is left out where all are asked for, and refused where it is named.
void check_served(const Settings& settings, const QuerySet& set, const Choice& sets, const Choice& methods) {
  if (sets.all || methods.all) return;
  for (const std::string& method : methods.names) {
    if (std::find(set.methods.begin(), set.methods.end(), method) != set.methods.end()) continue;
    settings.complain("method", fmt::format("for the set \"{}\" one of {}; \"{}\" does not serve that pair of shapes",
                                            set.name, fmt::join(set.methods, ", "), method));
  }
}

std::unique_ptr<Run> configure(const Settings& settings, const RunOptions& options) {
  std::vector<std::string_view> set_names, method_names;
  for (const QuerySet& set : query_sets()) set_names.push_back(set.name);
  for_each_type(Methods<double>{}, [&]<class Method>(TypeTag<Method>) { method_names.push_back(Method::name); });
  const Choice sets = choice_of(settings, "set", set_names), methods = choice_of(settings, "method", method_names);
  static constexpr std::array<std::string_view, 2> all_scalars = {"float", "double"};
  const std::vector<std::string> scalars = settings.choices("scalar", all_scalars);

  RaceOptions race;
  race.methods = methods.names;
  race.ladder.tolerances = settings.numbers("tolerance", {.lower = std::numeric_limits<double>::epsilon(), .upper = 1});
  std::sort(race.ladder.tolerances.begin(), race.ladder.tolerances.end(), std::greater<>());
  race.ladder.poses = settings.integers("substeps", 1, 1 << 20);
  std::sort(race.ladder.poses.begin(), race.ladder.poses.end());
  race.queries = settings.trials("queries", 1, 1 << 24, options.trials);
  race.rounds = settings.integer("rounds", 1, 1 << 20);
  race.seed = options.seed;
  if (std::find(scalars.begin(), scalars.end(), "float") != scalars.end() &&
      race.ladder.tolerances.front() < double{std::numeric_limits<float>::epsilon()}) {
    settings.complain("tolerance", fmt::format("for scalar \"float\" at least one of {:g} to 1, which it can resolve",
                                               std::numeric_limits<float>::epsilon()));
  }

  std::vector<Heat> heats;
  for (const QuerySet& set : query_sets()) {
    if (!sets.has(set.name)) continue;
    check_served(settings, set, sets, methods);
    const bool any = std::any_of(set.methods.begin(), set.methods.end(), [&](auto name) { return methods.has(name); });
    for (const std::string& scalar : scalars) {
      for (const QueryClass kind : all_query_classes) {
        if (any) heats.push_back({&set, kind, scalar, {}});
      }
    }
  }
  if (heats.empty()) settings.complain("method", "at least one that serves a pair of the sets");
  return std::make_unique<WorkPrecisionRun>(std::move(heats), std::move(race));
}

}  // namespace

Experiment work_precision_experiment() {
  return {"work_precision", "What error does each way to find a time of impact make, and what time does it take?",
          embedded_toml("work_precision"), configure};
}

}  // namespace thinwall
