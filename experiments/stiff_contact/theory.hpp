#pragma once
/// What mathematics says of a penalty contact, and whether what was measured agrees. No simulation in here; all is derived in
/// docs/stiff_contact.md. Steps are in units of 1 / omega, depths in units of speed / omega; the damping ratio is
/// c / (2 sqrt(k m)).

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/lab/statistics.hpp>
#include <thinwall/experiments/stiff_contact/model.hpp>

namespace thinwall {

/// [1/omega] A spring that holds both ways is stable below this step, and not above. 0: at no step. Nothing: at every one.
std::optional<double> step_limit(Scheme scheme, double damping_ratio);

/// [1] |speed out / speed in| of a bounce off a wall that only pushes, in continuous time: 1 without damping.
double restitution(double damping_ratio);

/// [speed/omega] How deep that bounce goes.
double deepest(double damping_ratio);

/// [1] |speed out / speed in| of an undamped bounce by the semi-implicit scheme lies in here, whatever the phase.
/// Nothing for a step of 2 and more.
std::optional<Interval> bounce_bounds(double step);

/// The measured bracket holds the limit, or both have none.
bool holds_theory(const LimitRow& row);

/// A step of the map.
struct MapStep {
  const LimitRow* spring;
  double step;               ///< [1/omega]
  std::int64_t blow_up;      ///< after how many steps it blew up; 0: it did not
  std::string_view verdict;  ///< as measured: "stable", "unstable", or inside the bracket "undecided"
};

/// Every step of every spring. `rows` must outlive it.
std::vector<MapStep> map_of(const StiffPlan& plan, const std::vector<LimitRow>& rows);

/// Every bounce came back, and none got past the middle of the wall.
bool is_clean(const StiffPlan& plan, const ContactRow& row);

/// In continuous time the wall holds the ball.
bool is_stiff_enough(const StiffPlan& plan, const PenaltyContact& c);

/// The one of the same wall and step with the other detection, which must be there.
const ContactRow& twin_of(const std::vector<ContactRow>& rows, const ContactRow& row);

/// What theory claims, over all rows that it speaks of.
struct StiffClaim {
  std::string text;
  std::int64_t judged = 0, wrong = 0;
  bool passed() const { return wrong == 0; }
};
std::vector<StiffClaim> stiff_claims(const StiffResults& results);

}  // namespace thinwall
