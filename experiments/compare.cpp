#include <memory>
#include <utility>

#include <fmt/format.h>

#include <thinwall/experiments/scene.hpp>
#include <thinwall/experiments/scenes/compare_results.hpp>
#include <thinwall_embedded.hpp>

namespace thinwall {

namespace {

/// A unit for each repeat of each contender, repeats outermost so that they lie apart in time; the exact run last.
class CompareRun final : public Run {
 public:
  explicit CompareRun(Comparison comparison) : comparison_(std::move(comparison)) {}

  std::vector<Unit> units() const override {
    std::vector<Unit> units;
    for (int repeat = 0; repeat < comparison_.repeats; ++repeat) {
      for (const Contender& c : comparison_.contenders)
        units.push_back(unit(c, fmt::format("{} {} repeat {}", c.label(), c.dt, repeat)));
    }
    units.push_back(unit(comparison_.exact, fmt::format("exact {}", comparison_.exact.dt)));
    return units;
  }

  Outcome finish(const std::vector<std::string>& results, const std::vector<double>&) const override {
    const std::size_t count = comparison_.contenders.size();
    const Trial exact = trial_from_line(results.back());
    std::vector<Contest> contests;
    for (std::size_t i = 0; i < count; ++i) {
      std::vector<Trial> repeats;
      for (std::size_t at = i; at + 1 < results.size(); at += count) repeats.push_back(trial_from_line(results[at]));
      contests.push_back(contest(comparison_.contenders[i], repeats, exact, comparison_.scene.duration()));
    }
    return compare_outcome(comparison_, exact, contests);
  }

 private:
  Unit unit(const Contender& contender, std::string key) const {
    return {std::move(key), scene_for(comparison_, contender).steps,
            [this, &contender] { return to_line(run_trial(scene_for(comparison_, contender))); }};
  }

  Comparison comparison_;
};

std::unique_ptr<Run> configure(const Settings& settings, const RunOptions& options) {
  return std::make_unique<CompareRun>(read_comparison(settings, options));
}

}  // namespace

Experiment compare_experiment() {
  return {"compare", "Discrete or swept, on this scene: what is missed, how far off, and at what run time?",
          embedded_toml("scene"), configure};
}

}  // namespace thinwall
