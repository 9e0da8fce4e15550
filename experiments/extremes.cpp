#include <thinwall/experiments/experiment_list.hpp>

#include <algorithm>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include <thinwall/experiments/extremes/figures.hpp>
#include <thinwall/experiments/extremes/summary.hpp>
#include <thinwall/experiments/extremes/tables.hpp>
#include <thinwall/experiments/settings.hpp>
#include <thinwall_embedded.hpp>

namespace thinwall {

namespace {

/// A pair and a precision at a place: one unit, on all methods.
struct ExtremeCell {
  const ExtremePair* pair;
  std::size_t precision;
  ExtremeInquiry inquiry;
};

class ExtremesRun final : public Run {
 public:
  explicit ExtremesRun(std::vector<ExtremeCell> cells) : cells_(std::move(cells)) {}

  std::vector<Unit> units() const override {
    std::vector<Unit> units;
    for (const ExtremeCell& cell : cells_) {
      units.push_back(
          {fmt::format("{} {} {}", cell.pair->name, all_precisions()[cell.precision].name, key(cell.inquiry.place)),
           cell.inquiry.queries, [&cell] { return to_line(cell.pair->ask[cell.precision](cell.inquiry)); }});
    }
    return units;
  }

  Outcome finish(const std::vector<std::string>& results, const std::vector<double>&) const override {
    std::vector<ExtremeLine> lines;
    for (std::size_t i = 0; i < results.size(); ++i) {
      for (ExtremeTally& tally : extreme_tallies_from_line(results[i])) {
        lines.push_back({cells_[i].pair, cells_[i].precision, cells_[i].inquiry.place, std::move(tally)});
      }
    }
    const std::vector<LadderTest> tests = ladder_tests(lines);
    return {.answer = extreme_answer(lines, tests),
            .summary = extreme_summary(lines, tests),
            .tables = {ladder_table(lines), ladder_test_table(tests), breaks_table(lines), extreme_cells_table(lines),
                       extreme_timings_table(lines)},
            .figures = extreme_figures(lines),
            .sections = extreme_sections(tests),
            .self_test_passed =
                std::all_of(tests.begin(), tests.end(), [](const LadderTest& test) { return test.passed(); })};
  }

 private:
  std::vector<ExtremeCell> cells_;
};

/// The names chosen under `key`; all that are allowed for "all".
std::vector<std::string> chosen(const Settings& settings, std::string_view key, std::vector<std::string_view> allowed) {
  std::vector<std::string> everything(allowed.begin(), allowed.end());
  allowed.emplace_back("all");
  std::vector<std::string> names = settings.choices(key, allowed);
  return std::find(names.begin(), names.end(), "all") != names.end() ? everything : names;
}
bool has(const std::vector<std::string>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::unique_ptr<Run> configure(const Settings& settings, const RunOptions& options) {
  std::vector<std::string_view> pair_names, precision_names;
  for (const ExtremePair& pair : extreme_pairs()) pair_names.push_back(pair.name);
  for (const Precision& precision : all_precisions()) precision_names.push_back(precision.name);
  const std::vector<std::string> pairs = chosen(settings, "pair", pair_names);
  const std::vector<std::string> precisions = chosen(settings, "precision", precision_names);
  const std::vector<std::string> methods = chosen(settings, "method", extreme_method_names());
  const std::int64_t queries = settings.trials("queries", 1, 1 << 20, options.trials);
  const std::int64_t one_in = settings.integer("one_in_at_50_digits", 1, 1 << 20);
  const double tolerance = settings.number("tolerance", {.lower = 1, .upper = 1e6, .unit = "epsilon"});

  std::vector<ExtremeCell> cells;
  const std::vector<Place> places = make_places(settings);
  if (places.size() * pairs.size() * precisions.size() > most_cells) {
    settings.complain(
        "axis", fmt::format("fewer: {} values on these axes, for {} pairs and {} precisions, make more than {} cells",
                            places.size(), pairs.size(), precisions.size(), most_cells));
  }
  for (const ExtremePair& pair : extreme_pairs()) {
    for (std::size_t p = 0; p < precision_count; ++p) {
      const Precision& precision = all_precisions()[p];
      if (!has(pairs, pair.name) || !has(precisions, precision.name) || pair.ask[p] == nullptr) continue;
      const std::int64_t count = precision.is_wide ? (queries + one_in - 1) / one_in : queries;
      for (const Place& place : places) {
        if (place.axis == ExtremeAxis::thickness && !pair.has_box) continue;
        cells.push_back({&pair, p, {place, count, options.seed, methods, tolerance}});
      }
    }
  }
  if (cells.empty()) {
    settings.complain("precision", "\"float\" or \"double\" too: the pairs that are chosen are asked in no other");
  }
  return std::make_unique<ExtremesRun>(std::move(cells));
}

}  // namespace

Experiment extremes_experiment() {
  return {
      "extremes",
      "At which scale, distance, speed, thickness, offset, angle or size ratio does each way to find a time of impact break, "
      "in float, double, long double and at 50 digits?",
      embedded_toml("extremes"), configure};
}

}  // namespace thinwall
