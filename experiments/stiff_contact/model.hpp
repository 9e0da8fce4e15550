#pragma once
/// A spring and a damper between a ball and a wall: the schemes of a step (spring.cpp), and a ball that is followed until it leaves the
/// wall (model.cpp). All is derived in docs/stiff_contact.md; the damping ratio is c / (2 sqrt(k m)). Contact is the library's:
/// `contact` at the poses, `time_of_impact` between them.

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/lab/statistics.hpp>
#include <thinwall/experiments/lab/tasks.hpp>

namespace thinwall {

enum class Scheme { explicit_euler, semi_implicit, implicit_euler };
inline constexpr std::array all_schemes = {Scheme::explicit_euler, Scheme::semi_implicit, Scheme::implicit_euler};
inline constexpr std::array<std::string_view, 3> scheme_names = {"explicit_euler", "semi_implicit", "implicit_euler"};
constexpr std::string_view name(Scheme scheme) { return scheme_names[static_cast<std::size_t>(scheme)]; }

struct Spring {
  double mass;       ///< [kg] > 0
  double stiffness;  ///< [N/m] > 0
  double damping;    ///< [N s/m] >= 0
};

/// Of damping ratio `ratio` >= 0.
inline Spring spring_of(double mass, double stiffness, double ratio) {
  return {mass, stiffness, 2 * ratio * std::sqrt(stiffness) * std::sqrt(mass)};
}

inline double frequency(const Spring& spring) { return std::sqrt(spring.stiffness / spring.mass); }  ///< [1/s] omega

struct Motion {
  double depth;  ///< [m] into the wall; < 0 is apart
  double speed;  ///< [m/s] into the wall
};

/// The motion after a step [s] >= 0 of a spring that holds both ways, with the force k depth + c speed against it: linear.
///   explicit_euler: depth and speed both from the old state.
///   semi_implicit:  the new speed from the old state, damping too; the new depth from the new speed (symplectic).
///   implicit_euler: both from the new state.
Motion stepped(Scheme scheme, const Spring& spring, double step, const Motion& old);

/// The same with a wall, which does nothing where its force would pull: in the state that the scheme takes it from.
Motion pushed(Scheme scheme, const Spring& spring, double step, const Motion& old);

// Growth, measured on the scheme's own steps, without any formula for its limit: by squaring their matrix.

enum class Fate {
  decays,  ///< the largest entry of the power falls below 2^-32
  holds,   ///< neither, in 2^50 steps (2^36 without damping, where rounding would be seen first)
  grows,   ///< it passes 2^32
};

/// `step` [s] > 0.
Fate fate(Scheme scheme, const Spring& spring, double step);

/// A number of steps after which the power first passes 2^32, found by halving; nothing if it does not. The largest entry of a
/// state that oscillates dips, so an earlier step may have passed by less than one oscillation.
std::optional<std::int64_t> blow_up_step(Scheme scheme, const Spring& spring, double step);

/// Where stable ends, in steps of 1/omega: it decays at the lower end, or holds if undamped, and grows at the upper. The lower is 0 if
/// it grows at every step that was tried, the upper infinity if at none.
/// Tries 2^-20 (2^-14 without damping) to 2^20 by factors of 2, then bisects. Its damping ratio: 0, or 1e-5 to 1e5,
/// where 2^50 steps tell growth from decay.
Interval measured_limit(Scheme scheme, const Spring& spring);

// What mathematics says, without any step. Steps are in units of 1/omega, depths in units of speed / omega.

/// [1/omega] A spring that holds both ways is stable below this step, and not above. 0: at no step. Nothing: at every one.
std::optional<double> step_limit(Scheme scheme, double damping_ratio);

/// [1] |speed out / speed in| of a bounce off a wall that only pushes, in continuous time: 1 without damping.
double restitution(double damping_ratio);

/// [speed/omega] How deep that bounce goes.
double deepest(double damping_ratio);

/// [1] |speed out / speed in| of an undamped bounce by the semi-implicit scheme lies in here, whatever the phase.
/// Nothing for a step of 2 and more.
inline std::optional<Interval> bounce_bounds(double step) {
  const double least = std::sqrt(1 - step * step / 4);
  return step < 2 ? std::optional(Interval{least, 1 / least}) : std::nullopt;
}

// The bounce.

enum class Detection {
  discrete,   ///< a step pushes if the ball touches at its start, so contact begins late by the phase
  toi_split,  ///< a step that meets the wall is split at the time of impact, and its rest pushes
};
inline constexpr std::array all_detections = {Detection::discrete, Detection::toi_split};
constexpr std::string_view name(Detection detection) {
  return detection == Detection::discrete ? "discrete" : "toi_split";
}

/// What flies at what.
struct Approach {
  double mass;       ///< [kg] > 0
  double speed;      ///< [m/s] > 0, straight at the wall
  double radius;     ///< [m] >= 0
  double thickness;  ///< [m] >= 0, of the wall; radius + thickness > 0
  double blow_up;    ///< [incoming speeds] > 1: a run that gets this fast has blown up

  /// [m] How far the center is from the middle of the wall at first contact. Past the middle, the wall pushes it on.
  double reach() const { return radius + thickness / 2; }
};

/// A spring, and how its steps are computed.
struct SpringCell {
  Scheme scheme;
  double stiffness;      ///< [N/m] > 0
  double damping_ratio;  ///< [1] >= 0

  bool operator==(const SpringCell&) const = default;
  static constexpr auto fields() {
    using C = SpringCell;
    return record(kept("scheme", &C::scheme, "", "How a step is computed."),
                  kept("stiffness", &C::stiffness, "N/m", "Of the spring."),
                  kept("damping_ratio", &C::damping_ratio, "1", "damping / (2 sqrt(stiffness mass))."));
  }
};

/// How the contact is computed.
struct PenaltyContact {
  SpringCell spring;
  Detection detection;
  double step;  ///< [1/omega] > 0

  bool operator==(const PenaltyContact&) const = default;
  static constexpr auto fields() {
    using C = PenaltyContact;
    return record(part(&C::spring),
                  kept("detection", &C::detection, "", "discrete: at the poses; toi_split: at the time of impact."),
                  kept("step", &C::step, "1/omega", "Time step, with omega = sqrt(stiffness / mass)."));
  }
};

/// [1/s] omega.
inline double frequency(const Approach& e, const PenaltyContact& c) { return std::sqrt(c.spring.stiffness / e.mass); }
/// [m] Of the incoming ball in a step.
inline double step_path(const Approach& e, const PenaltyContact& c) { return e.speed * (c.step / frequency(e, c)); }

enum class Ending {
  returned,    ///< left on the side it came from
  escaped,     ///< left on the other
  unfinished,  ///< it rests there, or is there after 1024 + 64 (1 + zeta) / step steps, or is no finite number
};

struct Bounce {
  Ending ending;
  double speed;                ///< [incoming speeds] >= 0, at the end; 0 if unfinished
  double deepest;              ///< [m] past the front face, at a pose (or the time of impact)
  std::int64_t contact_steps;  ///< steps in which the wall was asked for a force
  std::int64_t blow_up_step;   ///< the first after which it was too fast; 0 if none
};

/// The ball starts `phase` in [0, 1) of a step before first contact. Nothing in here is NaN.
Bounce bounce(const Approach& e, const PenaltyContact& c, double phase);

/// Over all phases of one contact; what is of the returned has no value where none did.
struct ContactTally {
  std::int64_t returned = 0, escaped = 0, unfinished = 0, blown_up = 0;
  std::optional<std::int64_t> blow_up_step;      ///< the first after which one of them was too fast
  std::int64_t contact_steps = 0;                ///< of the returned, as all that follows
  double slowest = no_least, fastest = no_most;  ///< [incoming speeds] on leaving
  double speed_sum = 0, square_error = 0;        ///< [incoming speeds] sums of speed and (speed - restitution)^2
  double deepest = no_most;                      ///< [m]
  double least_path = no_least;                  ///< [reaches] of a step that let one through

  static constexpr auto fields() {
    using T = ContactTally;
    return record(
        sum("returned", &T::returned, "1", "Left on the side they came from."),
        sum("escaped", &T::escaped, "1", "Left on the other side: tunneled."),
        sum("unfinished", &T::unfinished, "1", "Came to rest at the wall, or did not leave it."),
        sum("blown_up", &T::blown_up, "1", "At some step faster than the settings' blow_up, however they ended."),
        kept("blow_up_step", &T::blow_up_step, "1", "The first step after which one was; missing if none."),
        sum("contact_steps", &T::contact_steps, "1", "Steps that pushed."),
        least("speed_min", &T::slowest, "1", "Of those that returned: the least speed out over speed in."),
        most("speed_max", &T::fastest, "1", "The greatest."), kept("speed_sum", &T::speed_sum),
        kept("square_error", &T::square_error),
        most("depth_max", &T::deepest, "m", "Deepest of all, past the front face."),
        least("least_path", &T::least_path, "1",
              "Of a step that let one through, over the way from touch to the middle."));
  }

  std::int64_t bounces() const { return returned + escaped + unfinished; }
  double mean_speed() const { return speed_sum / static_cast<double>(returned); }
  double rms_error() const { return std::sqrt(square_error / static_cast<double>(returned)); }
};

/// The phases: one in each of `count` equal parts of the step, at random. The same for every scheme and detection.
ContactTally bounce_all(const Approach& e, const PenaltyContact& c, std::uint64_t seed, std::int64_t count);

// What is asked, and the rows of what was found.

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

/// Throws UsageError.
StiffPlan make_stiff_plan(const Settings& settings, const RunOptions& options);

/// A step of the map: what it does to a spring.
struct MapStep {
  SpringCell spring;
  double step;                               ///< [1/omega]
  std::string verdict;                       ///< "stable", "unstable", or inside the bracket of the limit "undecided"
  std::optional<std::int64_t> blow_up_step;  ///< nothing: it did not

  static constexpr auto fields() {
    using M = MapStep;
    return record(
        part(&M::spring), kept("step", &M::step, "1/omega", "Time step, with omega = sqrt(stiffness / mass)."),
        kept("verdict", &M::verdict, "", "Measured: stable, unstable, or undecided (inside the bracket of the limit)."),
        kept("blow_up_step", &M::blow_up_step, "1",
             "Steps after which the state is 2^32 times its start; missing if never."));
  }
};

/// Where stable ends.
struct LimitRow {
  SpringCell spring;
  std::optional<double> theory;                  ///< the limit; nothing: there is none
  double stable = no_most, unstable = no_least;  ///< as `measured_limit` has them
  std::vector<MapStep> map;

  /// The measured bracket holds the limit, or both have none.
  bool holds_theory() const { return theory ? stable <= *theory && *theory <= unstable : std::isinf(unstable); }
  static constexpr auto fields() {
    using L = LimitRow;
    return record(
        part(&L::spring), kept("limit", &L::theory, "1/omega", "By formula; missing where every step is stable."),
        most("stable", &L::stable, "1/omega", "Measured: the state decays here (undamped: stays bounded)."),
        least("unstable", &L::unstable, "1/omega", "Measured: it grows here; missing if it grows at no step."),
        kept("map", &L::map));
  }
};

/// One wall that only pushes, at one step, over all phases.
struct ContactRow {
  PenaltyContact contact;
  ContactTally tally;
  std::vector<double> nanoseconds = {};  ///< a bounce, round by round; of the race alone

  static constexpr auto fields() {
    using R = ContactRow;
    return record(part(&R::contact), part(&R::tally), kept("nanoseconds", &R::nanoseconds));
  }
};

/// What is measured. Of a wall, or of the race at one damping ratio, all rows: of the race every scheme and detection at the greatest
/// stiffness, from rough to fine steps, the same bounces timed in interleaved rounds.
struct StiffTasks {
  std::vector<Task<LimitRow>> springs;
  std::vector<Task<std::vector<ContactRow>>> walls, races;
};
StiffTasks stiff_tasks(const std::shared_ptr<const StiffPlan>& plan);

struct StiffResults {
  StiffPlan plan;
  std::vector<LimitRow> limits;
  std::vector<ContactRow> bounces, racers;
};

// Whether what was measured agrees with theory.

/// Every bounce came back, and none got past the middle of the wall.
inline bool is_clean(const StiffPlan& plan, const ContactRow& row) {
  return row.tally.returned == row.tally.bounces() && row.tally.deepest < plan.approach.reach();
}

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
