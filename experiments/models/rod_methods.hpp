#pragma once
/// Every method of the list for shapes that turn, behind one interface: put a flight or a pass to it, count, and ask what theory
/// expects. A method added to the list appears here by itself; its theory and its claims are empty until given in rod_methods.cpp.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/lab/record.hpp>
#include <thinwall/experiments/models/rods.hpp>
#include <thinwall/swept/toi.hpp>

namespace thinwall {

/// What is counted over the trials of one cell and method.
struct RodTally {
  std::int64_t trials = 0, tunneled = 0, undecided = 0, false_hits = 0, late = 0, steps = 0, evaluations = 0;
  RealSum lateness = {};                         // [steps] of the detected
  double latest = no_most, earliest = no_least;  // [steps] of the same
  double widest = no_most, deepest = no_least;   // [m] gap at the reported time, of the same

  static constexpr auto fields() {
    using T = RodTally;
    return record(
        sum("trials", &T::trials, "1", "Flights or passes, at independent uniform phases; each truly touches."),
        sum("tunneled", &T::tunneled, "1", "Of those, passed undetected."),
        sum("undecided", &T::undecided, "1", "Ended because the method gave up."),
        sum("false_hits", &T::false_hits, "1", "First hit reported in a step by whose end nothing has touched yet."),
        sum("late", &T::late, "1", "First hit later than first contact, by more than a millionth of a step."),
        sum("steps", &T::steps, "1", "Steps that the method was asked about."),
        sum("evaluations", &T::evaluations, "1", "Looks at a pose and closed forms those took."),
        sum("lateness", &T::lateness, "step", "From first contact to the hit."),
        most("lateness_max", &T::latest, "step", "The latest hit."),
        least("lateness_min", &T::earliest, "step", "The earliest; below 0 before contact."),
        most("gap_max", &T::widest, "m", "Widest gap at the time of a hit, of the rod as it has turned by then."),
        least("gap_min", &T::deepest, "m", "The least of them; below 0 where they overlap."));
  }
  std::int64_t detected() const { return trials - tunneled - undecided; }
  bool operator==(const RodTally&) const = default;
};

/// What a method owes, whatever theory says of it.
struct RodClaims {
  bool never_late = false;
  std::optional<double> most_gap = {};  ///< [1] of the fastest point's path: a hit with a wider gap is none
};

struct RodMethod {
  std::string name;  ///< the method's; with the number of poses for `substeps`: substeps_4
  RodClaims claims;
  std::function<Toi<double>(const Turning<Capsule<double>>&, const Moving<Obb<double>>&)> at_wall;
  std::function<Toi<double>(const Turning<Capsule<double>>&, const Moving<Capsule<double>>&)> at_post;
  std::function<std::optional<double>(const RodFlight&)> wall_theory;  ///< [1] chance of tunneling
  std::function<std::optional<double>(const BladePass&)> post_theory;
};

std::vector<std::string_view> rod_method_names();
inline constexpr int least_rod_substeps = 2, most_rod_substeps = 1000;  ///< poses a step

/// In the order of the method list, then by the number of poses.
std::vector<RodMethod> rod_methods(std::span<const std::string> names, std::span<const std::int64_t> substeps);

/// Lateness is summed in 64 bits; no rod takes more than some hundred steps.
inline constexpr std::int64_t most_rod_trials = std::int64_t(1) << 22;

/// All flights of a cell, each step by step until the method reports a hit or nothing can touch any more.
/// Those of the numbers `first`, `first + 1` and so on: what the pieces count adds up to what one would.
RodTally fly(const RodFlight& c, const RodMethod& method, std::int64_t flights, std::uint64_t seed,
             std::int64_t first = 0);
RodTally pass(const BladePass& c, const RodMethod& method, std::int64_t passes, std::uint64_t seed);

}  // namespace thinwall
