#pragma once
/// Runs of the precision ladder in memory, for its tests.

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/experiment_list.hpp>
#include <thinwall/experiments/extremes/line.hpp>

#include "support/experiment_run.hpp"

namespace thinwall {

/// Two balls along two axes, small enough for a debug build.
inline constexpr std::string_view few_extremes = R"(
  axis = ["distance", "scale"]
  distance = [1, 1e4]
  scale = [1e-100, 1]
  pair = ["sphere_sphere"]
  precision = ["float", "double"]
  queries = 6
)";

inline std::unique_ptr<Run> extreme_run(std::string_view text) {
  return run_of(extremes_experiment(), text, {.seed = 3, .trials = {}});
}
inline Outcome extreme_outcome(std::string_view text) { return outcome_of(*extreme_run(text)); }

enum : std::size_t { in_float, in_double, in_long_double, at_50_digits };

/// The lines of one pair and precision along one axis.
inline std::vector<ExtremeLine> extreme_lines(std::string_view pair_name, std::size_t precision, ExtremeAxis axis,
                                              const std::vector<double>& values, std::int64_t queries,
                                              const std::vector<std::string>& methods) {
  const auto pairs = extreme_pairs();
  const auto pair = std::find_if(pairs.begin(), pairs.end(), [&](const ExtremePair& p) { return p.name == pair_name; });
  std::vector<ExtremeLine> lines;
  for (const double value : values) {
    const Place place = {axis, value};
    for (ExtremeTally& tally : pair->ask[precision]({place, queries, 1, methods, 1})) {
      lines.push_back({&*pair, precision, place, std::move(tally)});
    }
  }
  return lines;
}

inline ExtremeTally tally_of(std::string_view pair, std::size_t precision, const Place& place, std::int64_t queries,
                             const std::string& method) {
  return extreme_lines(pair, precision, place.axis, {place.value}, queries, {method}).at(0).tally;
}

/// Two decades of the distance, two balls, the closed form and the foil, in a precision.
inline std::vector<ExtremeLine> loss_lines(std::size_t precision, std::vector<double> distances = {10, 100}) {
  return extreme_lines("sphere_sphere", precision, ExtremeAxis::distance, distances, 24, {"textbook", "closed_form"});
}

}  // namespace thinwall
