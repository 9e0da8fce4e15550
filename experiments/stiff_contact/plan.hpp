#pragma once
/// What the settings ask of the stiff contact.

#include <cstdint>
#include <string>
#include <vector>

#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/settings.hpp>
#include <thinwall/experiments/stiff_contact/bounce.hpp>

namespace thinwall {

struct StiffPlan {
  std::uint64_t seed = 0;
  std::vector<double> stiffness;  ///< [N/m] ascending
  std::vector<double> ratios;     ///< [1] damping of the spring that holds both ways, ascending
  std::vector<double> steps;      ///< [1/omega] of its map, ascending

  Approach approach;                  ///< what flies at the wall that only pushes; its mass is the spring's, too
  std::vector<double> bounce_ratios;  ///< [1] ascending
  std::vector<double> bounce_steps;   ///< [1/omega] ascending
  std::int64_t bounces = 0;           ///< of a cell

  std::vector<double> race_steps;  ///< [1/omega] descending: from rough to fine
  std::int64_t race_bounces = 0, rounds = 0;

  double stiffest() const { return stiffness.back(); }
};

/// A spring that holds both ways.
struct LimitCell {
  Scheme scheme;
  double stiffness, ratio;
};
std::string key(const LimitCell& cell);

/// One wall that only pushes, and one way to compute it, at all steps of the plan.
struct BounceSeries {
  Scheme scheme;
  Detection detection;
  double stiffness, ratio;
};
std::string key(const BounceSeries& series);

/// Throws UsageError.
StiffPlan make_stiff_plan(const Settings& settings, const RunOptions& options);

std::vector<LimitCell> limit_cells(const StiffPlan& plan);
std::vector<BounceSeries> bounce_series(const StiffPlan& plan);

}  // namespace thinwall
