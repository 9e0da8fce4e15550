#pragma once
/// Fast balls at a thin wall in whole engines: the shots (thin_wall's, each at an angle of its own) and the stages that are played besides;
/// what theory expects of looking at poses; what becomes of the bodies; and what a run fires, with the rows of the results.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <thinwall/experiments/adapters/engine.hpp>
#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/lab/factors.hpp>
#include <thinwall/experiments/lab/judge.hpp>

namespace thinwall {

/// One physical condition. The same shots are fired in every mode of every engine.
struct EngineCell {
  double path;         ///< [m] > 0, of the ball in a step
  double step;         ///< [s] > 0
  double radius;       ///< [m] > 0
  double thickness;    ///< [m] > 0
  double wall_size;    ///< [m] side of the wall, a square: wide enough that no ball gets round it
  double angle_deg;    ///< [deg] in [0, 89.9]: the angle of incidence is uniform between 0 and this
  std::int64_t steps;  ///< >= 4 that a shot is followed for; the ball touches in the first two

  bool operator==(const EngineCell&) const = default;
};

extern const Factors<EngineCell> engine_factors;

/// Where the bodies start, and what is right: the first body does not pass, and flies away at `velocity`.
struct EngineShot {
  EngineStart start;
  Vec3<double> ahead;  ///< a unit vector
  double beyond;       ///< [m] it has passed where it is farther ahead, from the second body if there is one
  std::optional<Vec3<double>> velocity = {};  ///< [m/s] at the end; nothing where it is not compared
  bool along_wall = false;                    ///< of it only what is along the wall is compared: that should not change
  double contact = 0;  ///< [steps] of the ball at the wall: to first contact, in (0, 2), the oracle's answer
};

/// What is played. Of a cell a stage takes the step, the radius and the thickness, and the path of the motion, relative where two move.
struct StageKind {
  std::string_view name;  ///< snake_case: "head_on"
  std::string_view what;  ///< a clause, for the report
  std::int64_t steps;     ///< that a shot is followed for; 0: as the cell says
  EngineStage (*stage)(const EngineCell&);
  EngineShot (*shot)(const EngineCell&, const RandomWords&);
  /// [1] Chance of passing where so many poses a step are looked at and nothing between; null where no formula is known.
  double (*theory)(const EngineCell&, int poses_per_step, double skin) = nullptr;
  bool spins = false;
};

/// The wall and the ball of a cell, at most a float wider than it says: models/shots.hpp.
extern const StageKind ball_at_wall;

/// What users of engines ask about besides: two fast bodies, walls of many pieces, a rod, with and without spin, and near misses. On each
/// every shot has an exact answer; docs/engines.md has a picture of each in words.
extern const std::vector<StageKind> stage_kinds;

/// From what decides a shot: its motion, and how thick ball and wall are. A wall of another width gets the same shots.
RandomStream random_stream(const StageKind& kind, const EngineCell& cell, std::uint64_t seed);

// Theory: a ball that is looked at in poses alone, at angles of incidence uniform between 0 and a largest one.

/// [1] No pose, `poses_per_step` of them, is in contact: the ball is never seen. `skin`: contact begins so far [m] before the
/// surfaces meet.
double unseen_theory(const EngineCell& cell, int poses_per_step, double skin = 0);

/// [1] No pose is in contact before the ball's center is past the wall's middle, from where the shortest way out leads on: it
/// is never seen, or seen too late.
double through_theory(const EngineCell& cell, int poses_per_step, double skin = 0);

inline constexpr std::int64_t most_engine_shots = std::int64_t(1) << 20;  ///< of a cell: the real sums have 63 bits

/// Over the shots of one cell in one mode; the real numbers are of the turned.
struct EngineTally {
  std::int64_t shots = 0, tunneled = 0, unseen = 0, stuck = 0, lost = 0, turned = 0, unanswered = 0;
  RealSum lateness, energy;                               ///< [steps], [1] at most 1024 each
  double latest = no_most, earliest = no_least;           ///< [steps]
  double least_energy = no_least, most_energy = no_most;  ///< [1]
  double deepest = no_most;                               ///< [m] in the wall at the end of a step
  double seconds = 0;                                     ///< of stepping, in one volley

  static constexpr auto fields() {
    using T = EngineTally;
    return record(
        sum("shots", &T::shots, "1", "Shots, each of which hits the wall by the oracle."),
        sum("tunneled", &T::tunneled, "1", "Balls whose center ended beyond the wall."),
        sum("unseen", &T::unseen, "1", "Of the tunneled, balls that are where they would be without a wall."),
        sum("stuck", &T::stuck, "1", "Balls whose center ended between the wall's faces."),
        sum("lost", &T::lost, "1", "Balls without a finite place at the end."),
        sum("turned", &T::turned, "1", "Balls that fly away in front of the wall at the end."), part(&T::lateness),
        part(&T::energy), most("latest", &T::latest, "steps", "The most of them."),
        least("earliest", &T::earliest, "steps", "The least lateness; < 0 is before contact."),
        least("least_energy", &T::least_energy, "1", "The least of them."),
        most("most_energy", &T::most_energy, "1", "The most of them."),
        most("deepest", &T::deepest, "m", "Deepest in the wall at the end of a step, of the turned; < 0 is apart."),
        sum("unanswered", &T::unanswered, "1", "Shots besides, of an engine that died or hung."),
        kept("seconds", &T::seconds));
  }

  /// By the oracle, which sees each of them hit the wall.
  std::int64_t wrong() const { return tunneled + stuck + lost; }
};

/// Over the shots of one stage in one mode.
struct StageTally {
  std::int64_t shots = 0, passed = 0, lost = 0, disturbed = 0, unanswered = 0;
  RealSum error;  ///< [1] at most 1024 each
  double most_error = no_most;
  double seconds = 0;  ///< of stepping, in one volley

  static constexpr auto fields() {
    using T = StageTally;
    return record(
        sum("shots", &T::shots, "1", "Shots, each in a world of its own."),
        sum("passed", &T::passed, "1", "Bodies that end where they cannot get to."),
        sum("lost", &T::lost, "1", "Bodies without a finite place at the end."),
        sum("disturbed", &T::disturbed, "1",
            "Of the others, those whose velocity is off by more than 1 % of what it was; in stages along a wall only "
            "what is along it counts."),
        part(&T::error), most("most_error", &T::most_error, "1", "The most of them."),
        sum("unanswered", &T::unanswered, "1", "Shots besides, of an engine that died or hung."),
        kept("seconds", &T::seconds));
  }
};

/// Adds the shot to the tally. `flight`: the bodies at the end of each step.
void judge(const EngineStage& stage, const EngineShot& shot, const EngineFlights::Flight& flight, EngineTally& tally);
void judge(const EngineStage& stage, const EngineShot& shot, const EngineFlights::Flight& flight, StageTally& tally);

// What a run fires.

/// What is played of a cell in a setup, and what came of it.
template <class Tally> struct EngineRowOf {
  EngineCell cell;
  const EngineSetup* setup;
  const StageKind* kind;
  std::optional<double> theory = {};  ///< [1] chance that the ball ends beyond the wall, or that a body passes
  Tally tally = {};
  std::vector<double> nanoseconds = {};  ///< a step, one of each volley
  std::int64_t steps() const { return kind->steps > 0 ? kind->steps : cell.steps; }
};
using EngineRow = EngineRowOf<EngineTally>;
using StageRow = EngineRowOf<StageTally>;

/// May be moved, not copied: its rows, which have no results yet, point to its setups.
struct EnginePlan : ChosenEngines {
  std::vector<EngineRow> rows = {};   ///< by wall, then by path in rising order
  std::vector<StageRow> stages = {};  ///< in the order of stage_kinds
  std::int64_t shots = 0;             ///< of each row
  std::int64_t stage_shots = 0;       ///< of each of the stages; 0: none is played
  std::uint64_t seed = 0;
};

/// Throws UsageError.
EnginePlan make_engine_plan(const Settings& settings, const RunOptions& options);

/// Shots `first`, `first + 1`, ... of a row. Long enough to be timed, short enough to be lost, and several make an interval.
struct EngineVolley {
  std::size_t row;
  std::int64_t first, shots;
};
inline constexpr std::int64_t most_shots_an_engine_volley = 1000;

/// `shots` of each row, in an order in which the engines take turns at each cell or stage.
template <class Tally>
std::vector<EngineVolley> volleys_in_turn(const std::vector<EngineRowOf<Tally>>& rows, std::int64_t shots) {
  constexpr std::int64_t most = most_shots_an_engine_volley;
  std::vector<EngineVolley> volleys;
  for (const auto& group : group_by(rows, [](const auto& row) { return std::pair(row.kind, row.cell); })) {
    for (std::int64_t first = 0; first < shots; first += most) {
      for (const auto* row : group)
        volleys.push_back({static_cast<std::size_t>(row - rows.data()), first, std::min(most, shots - first)});
    }
  }
  return volleys;
}

/// Shots `first`, `first + 1`, ... of a row.
template <class Tally>
Tally fire(const EngineRowOf<Tally>& row, std::int64_t first, std::int64_t shots, std::uint64_t seed) {
  const EngineStage stage = row.kind->stage(row.cell);
  const RandomStream stream = random_stream(*row.kind, row.cell, seed);
  std::vector<EngineShot> all;
  std::vector<EngineStart> starts;
  for (std::int64_t i = first; i < first + shots; ++i) {
    all.push_back(row.kind->shot(row.cell, random_words(stream, static_cast<std::uint64_t>(i), 0)));
    starts.push_back(all.back().start);
  }
  const EngineFlights flights = row.setup->mode.play(stage, starts, row.steps());
  Tally tally;
  for (std::size_t i = 0; i < flights.shots.size(); ++i) judge(stage, all[i], flights.shots[i], tally);
  tally.seconds = flights.seconds;
  tally.unanswered = shots - std::ssize(flights.shots);
  return tally;
}

/// `tallies` as the volleys come.
template <class Tally>
void add_results(const std::vector<EngineVolley>& volleys, const std::vector<Tally>& tallies,
                 std::vector<EngineRowOf<Tally>>& rows) {
  for (std::size_t i = 0; i < volleys.size(); ++i) {
    EngineRowOf<Tally>& row = rows[volleys[i].row];
    const Tally& tally = tallies[i];
    row.tally += tally;
    row.nanoseconds.push_back(1e9 * tally.seconds / static_cast<double>(tally.shots * row.steps()));
  }
}

/// Takes out, of the ball at the wall and of the stages, what an engine has done that left shots unanswered in either; returns how
/// people call it.
std::vector<std::string> drop_failed(std::vector<EngineRow>& rows, std::vector<StageRow>& stages);

/// Those of an engine and mode at a wall, from the shortest path to the longest.
std::vector<EngineRow> rows_of(const std::vector<EngineRow>& rows, const std::string& label, double wall_size);

/// What ours must do. At the wall: let none through where it sweeps, and what theory says where it looks at poses; of the latter only
/// the first wall counts, for all walls get the same shots, and a test wants independent ones. On stages: let nothing pass and
/// disturb nothing where it sweeps, and pass as theory says where it looks at poses.
std::vector<CellCount> own_counts(const std::vector<EngineRow>& rows, const std::vector<StageRow>& stages);

}  // namespace thinwall
