#pragma once
/// Every method of the method list, at every scalar, behind one interface: fire a shot at it, and ask what theory expects of it.
/// A method added to the list appears here by itself; its theory is empty until given in shot_methods.cpp.

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/discrete/aabb.hpp>
#include <thinwall/discrete/sphere.hpp>
#include <thinwall/experiments/lab/record.hpp>
#include <thinwall/experiments/models/shots.hpp>
#include <thinwall/experiments/models/tunneling_theory.hpp>
#include <thinwall/swept/moving.hpp>
#include <thinwall/swept/toi.hpp>

namespace thinwall {

/// What theory expects of a cell. Derived in docs/tunneling_theory.md.
struct Theory {
  std::optional<double> probability = {};  ///< of tunneling
  std::optional<Lateness> lateness = {};   ///< [m] along the path, of the detected
  std::optional<double> latest = {};       ///< [m] the most there can be, where nothing is said of its mean
  double widest = 0;                       ///< [m] how far from the wall a detection may be, rounding aside
  std::optional<double> through = {};      ///< of a bounce: of tunneling or being pushed out on the wrong side
  const char* why = "";                    ///< of an infinite wall: the formula of the probability, as docs/ writes it
  const char* why_late = "";               ///< ... and of the largest lateness

  std::optional<double> largest_lateness() const { return lateness ? std::optional(lateness->largest) : latest; }
};

Theory pose_theory(const Cell& cell, int poses_per_step);
Theory early_theory(const Cell& cell, double tolerance);  ///< [1] of a step: detects so much before contact at most

/// What is counted over the shots of one cell, method and scalar.
struct Tally {
  std::int64_t shots = 0, tunneled = 0, undecided = 0, queries = 0, evaluations = 0;
  std::int64_t lateness = 0;  // in whole units of Target::lateness_unit
  std::int64_t wrong_side = 0, behind = 0;
  double latest = no_most, earliest = no_least, widest = no_most;  // [m], of the detected

  static constexpr auto fields() {
    using T = Tally;
    return record(
        sum("shots", &T::shots, "1", "Shots fired, at independent uniform phases."),
        sum("tunneled", &T::tunneled, "1", "Shots that passed the wall undetected."),
        sum("undecided", &T::undecided, "1", "Shots that ended because the method gave up."),
        sum("queries", &T::queries, "1", "Steps that the method was asked about, over all shots."),
        sum("evaluations", &T::evaluations, "1",
            "Overlap tests, rays and closed forms those took: the machine-independent cost."),
        sum("lateness", &T::lateness, "", "From first contact to detection along the path, of the detected."),
        sum("wrong_side", &T::wrong_side, "1",
            "Shots seen where the least penetration pushes them ahead or sideways, not back."),
        sum("behind", &T::behind, "1", "Shots that flew away behind the wall in the end, the tunneled included."),
        most("lateness_max", &T::latest, "m", "Largest path length from first contact to detection."),
        least("lateness_min", &T::earliest, "m", "Least one; where the ball grazes, rounding makes it uncertain."),
        most("gap_max", &T::widest, "m",
             "Widest gap between ball and wall at detection; above 0 by rounding, or a false hit."));
  }
  std::int64_t detected() const { return shots - tunneled - undecided; }
  std::int64_t went_through() const { return tunneled + wrong_side; }  ///< unseen, or pushed out on the wrong side
  bool operator==(const Tally&) const = default;
};

/// What becomes of a ball that was seen: docs/thin_wall.md, "With a bounce".
enum class Response { none, bounce };
inline constexpr std::array<std::string_view, 2> response_names = {"none", "bounce"};

/// A ball in flight: where its center is, and how far it goes in a step. Both in meters.
struct Flight {
  Vec3<double> position;
  Vec3<double> displacement;
};

/// Pushes the ball out along `normal`, which points into the wall, and reflects it there if it approaches.
void respond(const Target& target, const Vec3<double>& normal, Flight& flight);

/// Beyond the wall on some axis and moving away: it cannot touch any more.
bool has_left(const Target& target, const Flight& flight);

/// One step of a shot, as it is put to a method.
struct ShotStep {
  Moving<Sphere<double>> ball;
  Moving<Aabb<double>> wall;
};

/// Of a random shot: `back` steps before the one in which the ball touches.
ShotStep random_step(const Target& target, const RandomStream& stream, std::uint64_t shot, double back);

struct StepAnswer {
  ToiStatus status;
  double time;  ///< [1] of the step
};

struct ThinWallMethod {
  std::string name;    ///< the method's; with the number of poses for `substeps`: substeps_8
  std::string scalar;  ///< "float" or "double"
  int poses_per_step;  ///< [1] that it tests and nothing else; 0 if it does more
  double round_off;    ///< [1] machine epsilon of the scalar
  std::function<void(const Target&, const Vec3<double>& start, Tally&)> fire;
  std::function<Theory(const Cell&)> theory;
  std::function<StepAnswer(const ShotStep&)> answer;
  std::function<void(std::span<const ShotStep>)> ask;  ///< to be timed: asks about each step and keeps no answer
};

std::vector<std::string_view> method_names();
inline constexpr std::array<std::string_view, 2> scalar_names = {"float", "double"};
inline constexpr int least_substeps = 2, most_substeps = 1000;  ///< poses a step

/// By scalar, then in the order of the method list, then by the number of poses.
std::vector<ThinWallMethod> thin_wall_methods(std::span<const std::string> names,
                                              std::span<const std::int64_t> substeps,
                                              std::span<const std::string> scalars, Response response = Response::none);

/// All of them, in double.
std::vector<ThinWallMethod> thin_wall_methods(std::span<const std::int64_t> substeps);

/// Shots `first`, `first + 1`, ... of a cell: a piece that is short enough to lose. What the pieces count adds up to what one
/// would, to the bit: a shot's random numbers depend on its number alone.
struct Volley {
  std::int64_t first = 0;
  std::int64_t shots = 0;
};

/// A minute's work at most, at the speed of a slow method; a cell of fewer shots is one volley. Volleys are longer where
/// a cell would have more than so many: each is a unit, kept in memory.
inline constexpr std::int64_t most_shots_a_volley = std::int64_t(1) << 22, most_volleys = 32;

/// Lateness is summed in 64 bits, of which a shot takes up to 32.
inline constexpr std::int64_t most_shots_a_cell = std::int64_t(1) << 30;

std::vector<Volley> volleys_of(std::int64_t shots, std::int64_t most = most_shots_a_volley);

Tally fire(const Cell& cell, const ThinWallMethod& method, const Volley& volley, std::uint64_t seed);

/// Phases (i + c) / n, c random, common to a cell. A prime: it has no factor in common with a number of poses a step, so
/// that the phases are as evenly spread over the gap between two poses as they are over the step.
inline constexpr std::int64_t stratified_shots = 1009;

/// The number that tunneled of phases spread evenly over the step, not drawn: within one of n p, almost without chance.
/// For an infinite wall, where the phase is all there is to draw.
std::int64_t tunneled_evenly(const Cell& cell, const ThinWallMethod& method, std::uint64_t seed);

}  // namespace thinwall
