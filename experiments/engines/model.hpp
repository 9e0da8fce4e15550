#pragma once
/// Fast balls at a thin wall in whole engines: the shots (thin_wall's, each at an angle of its own), what becomes of the ball, what theory
/// expects of looking at poses; the stages that are played besides; and what a run fires, with the rows of the results.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/engines/engine.hpp>
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

const Factors<EngineCell>& engine_factors();

/// The wall and the ball of a cell, at most a float wider than it says: models/shots.hpp.
EngineStage wall_stage(const EngineCell& cell);

/// A ball before the wall, and when it first touches.
struct EngineShot {
  EngineStart start;  ///< of the ball
  double contact;     ///< [steps] from the start to first contact, in (0, 2): the oracle's answer
};
EngineShot engine_shot(const EngineCell& cell, const RandomStream& stream, std::uint64_t trial);

/// From what decides a shot: its motion, and how thick ball and wall are. A wall of another width gets the same shots.
RandomStream random_stream(const EngineCell& cell, std::uint64_t seed);

inline constexpr std::int64_t most_engine_shots = std::int64_t(1) << 20;  ///< of a cell: the real sums have 63 bits

/// Over the shots of one cell in one mode; the real numbers are of the turned.
struct EngineTally {
  std::int64_t shots = 0, tunneled = 0, unseen = 0, stuck = 0, lost = 0, turned = 0;
  std::int64_t unanswered = 0;                            ///< shots besides, of an engine that died or hung
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

  std::int64_t kept_in_front() const { return shots - tunneled - stuck - lost; }
  std::int64_t wrong() const {
    return tunneled + stuck + lost;
  }  ///< by the oracle, which sees each of them hit the wall
};

/// Adds the shot to the tally. `flight` is where the ball was at the end of each step.
void judge(const EngineStage& stage, const EngineShot& shot, const EngineFlights::Flight& flight, EngineTally& tally);

// Theory: a ball that is looked at in poses alone. Derived in docs/tunneling_theory.md for one angle; here the angle of incidence is
// uniform between 0 and a largest one.

/// [1] The mean over angles in [0, angle_deg] of max(0, 1 - depth / (spacing cos a)). `depth` > 0 and `spacing` > 0 [m].
double mean_miss_probability(double depth, double spacing, double angle_deg);

/// [1] No pose, `poses_per_step` of them, is in contact: the ball is never seen. `skin`: contact begins so far [m] before the
/// surfaces meet.
double unseen_theory(const EngineCell& cell, int poses_per_step, double skin = 0);

/// [1] No pose is in contact before the ball's center is past the wall's middle, from where the shortest way out leads on: it
/// is never seen, or seen too late.
double through_theory(const EngineCell& cell, int poses_per_step, double skin = 0);

// The stages: what users of engines ask about besides one ball at one wall: two fast bodies, walls of many pieces, a rod, with and
// without spin, and near misses. On each every shot has an exact answer; docs/engines.md has a picture of each in words.

/// Where the bodies start, and what is right: the first body does not pass, and flies away at `velocity`.
struct StageShot {
  EngineStart start;
  Vec3<double> ahead;  ///< a unit vector
  double beyond;       ///< [m] it has passed where it is farther ahead, from the second body if there is one
  std::optional<Vec3<double>> velocity;  ///< [m/s] at the end; nothing where no formula is known
};

/// Of a cell a stage takes the step, the radius and the thickness, and the path of the motion, relative where two move.
struct StageKind {
  std::string_view name;  ///< snake_case: "head_on"
  std::string_view what;  ///< a clause, for the report
  std::int64_t steps;     ///< that a shot is followed for
  bool has_mesh, spins;
  bool along_wall;  ///< of the velocity only what is along the wall is compared: it should not change
  EngineStage (*stage)(const EngineCell&);
  StageShot (*shot)(const EngineCell&, const RandomWords&);
  /// [1] Chance of passing where so many poses a step are looked at and nothing between; null where no formula is known.
  double (*theory)(const EngineCell&, int poses_per_step, double skin) = nullptr;
};

const std::vector<StageKind>& stage_kinds();

/// Over the shots of one stage in one mode.
struct StageTally {
  std::int64_t shots = 0, passed = 0, lost = 0, disturbed = 0;
  std::int64_t unanswered = 0;  ///< shots besides, of an engine that died or hung
  RealSum error;                ///< [1] at most 1024 each
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
void judge(const StageKind& kind, const StageShot& shot, const EngineFlights::Flight& flight, StageTally& tally);

// What a run fires.

/// An engine in one of its modes.
struct EngineSetup {
  Engine engine;
  EngineMode mode;
  std::string label() const { return engine.called + " " + mode.name; }  ///< for people
  bool is_ours() const { return engine.package.empty(); }
  bool can_do(const EngineCell& cell) const { return cell.path <= engine.most_path; }
};

struct EnginePlan {
  std::vector<EngineCell> cells;  ///< by wall, then by path in rising order
  std::vector<EngineSetup> setups;
  std::vector<Engine> missing;      ///< asked for by "all", and not in the program
  std::int64_t shots;               ///< of each cell and setup
  std::vector<std::string> stages;  ///< names
  std::int64_t stage_shots;         ///< of each stage and setup; 0: none is played
  double stage_path;                ///< [m] of the motion in a step
  std::uint64_t seed;
};

/// Throws UsageError.
EnginePlan make_engine_plan(const Settings& settings, const RunOptions& options);

/// A line for each engine that is missing: what it is, and what would bring it.
std::vector<std::string> missing_engines(const EnginePlan& plan);

/// A cell, an engine in a mode, and what came of it. The plan must outlive it.
struct EngineRow {
  EngineCell cell;
  const EngineSetup* setup;
  std::optional<double> theory = {};  ///< [1] chance of going through, where only poses are looked at
  EngineTally tally = {};
  std::vector<double> nanoseconds = {};  ///< a step, one of each volley
  std::int64_t steps() const { return cell.steps; }
};

/// The same of a stage.
struct StageRow {
  const StageKind* kind;
  EngineCell cell;
  const EngineSetup* setup;
  std::optional<double> theory = {};  ///< [1] chance of passing
  StageTally tally = {};
  std::vector<double> nanoseconds = {};
  std::int64_t steps() const { return kind->steps; }
};

/// Without results: every setup at every cell that it can do, by cell.
std::vector<EngineRow> engine_rows(const EnginePlan& plan);
/// Without results: every stage of the plan, in every mode that can play it.
std::vector<StageRow> stage_rows(const EnginePlan& plan);

/// Shots `first`, `first + 1`, ... of a row. Long enough to be timed, short enough to be lost, and several make an interval.
struct EngineVolley {
  std::size_t row;
  std::int64_t first, shots;
};
inline constexpr std::int64_t most_shots_an_engine_volley = 1000;

/// `shots` of each row, in an order in which the rows of one key, which are engines, take turns.
template <class Row, class Key>
std::vector<EngineVolley> volleys_in_turn(const std::vector<Row>& rows, const Key& key, std::int64_t shots) {
  constexpr std::int64_t most = most_shots_an_engine_volley;
  std::vector<EngineVolley> volleys;
  for (const Group<Row>& group : group_by(rows, key)) {
    for (std::int64_t first = 0; first < shots; first += most) {
      for (const Row* row : group)
        volleys.push_back({static_cast<std::size_t>(row - rows.data()), first, std::min(most, shots - first)});
    }
  }
  return volleys;
}

/// Shots `first`, `first + 1`, ... of a row.
EngineTally fire(const EngineRow& row, std::int64_t first, std::int64_t shots, std::uint64_t seed);
StageTally fire(const StageRow& row, std::int64_t first, std::int64_t shots, std::uint64_t seed);

/// `tallies` as the volleys come.
template <class Row, class Tally>
void add_results(const std::vector<EngineVolley>& volleys, const std::vector<Tally>& tallies, std::vector<Row>& rows) {
  for (std::size_t i = 0; i < volleys.size(); ++i) {
    Row& row = rows[volleys[i].row];
    const Tally& tally = tallies[i];
    row.tally += tally;
    if (tally.shots > 0)
      row.nanoseconds.push_back(1e9 * tally.seconds / static_cast<double>(tally.shots * row.steps()));
  }
}

/// Takes out, of the ball at the wall and of the stages, what an engine has done that left shots unanswered in either; returns how
/// people call it.
std::vector<std::string> drop_failed(std::vector<EngineRow>& rows, std::vector<StageRow>& stages);

/// Those of an engine and mode at a wall, from the shortest path to the longest.
std::vector<EngineRow> rows_of(const std::vector<EngineRow>& rows, const std::string& label, double wall_size);

/// What ours must do: let none through where it sweeps, and what theory says where it looks at poses. Of the latter only the
/// first wall counts: all walls get the same shots, and a test wants independent ones.
std::vector<CellCount> own_counts(const std::vector<EngineRow>& rows);
/// Let nothing pass and disturb nothing where it sweeps, and pass as theory says where it looks at poses.
std::vector<CellCount> own_counts(const std::vector<StageRow>& rows);

}  // namespace thinwall
