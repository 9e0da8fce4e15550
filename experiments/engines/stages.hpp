#pragma once
/// What users of engines ask about besides one ball at one wall: two fast bodies, walls of many pieces, a rod, with and without spin,
/// and near misses. Each is a stage on which every shot has an exact answer; docs/engines.md has a picture of each in words.
///
///   for (const StageKind& kind : stage_kinds()) {
///     const StageShot shot = kind.shot(size, words);            // where the bodies start, and what is right
///     ... mode.play(kind.stage(size), ...) ... judge(kind, shot, flight, tally);
///   }

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include <thinwall/experiments/engines/model.hpp>

namespace thinwall {

/// Of all stages of a run.
struct StageSize {
  double path;       ///< [m] > 0, of the motion in a step, relative where two move
  double step;       ///< [s] > 0
  double radius;     ///< [m] > 0, of the balls
  double thickness;  ///< [m] > 0, of walls
};

/// Where the bodies start, and what is right: the first body does not pass, and flies away at `velocity`.
struct StageShot {
  std::vector<BodyState> start;
  Vec3<double> ahead;  ///< a unit vector
  double beyond;       ///< [m] it has passed where it is farther ahead, from the second body if there is one
  std::optional<Vec3<double>> velocity;  ///< [m/s] at the end; nothing where no formula is known
};

struct StageKind {
  std::string_view name;  ///< snake_case: "head_on"
  std::string_view what;  ///< a clause, for the report
  std::int64_t steps;     ///< that a shot is followed for
  bool has_mesh, spins;
  bool along_wall;  ///< of the velocity only what is along the wall is compared: it should not change
  EngineStage (*stage)(const StageSize&);
  StageShot (*shot)(const StageSize&, const RandomWords&);
  /// [1] Chance of passing where so many poses a step are looked at and nothing between; null where no formula is known.
  double (*theory)(const StageSize&, int poses_per_step, double skin) = nullptr;
};

const std::vector<StageKind>& stage_kinds();

/// Over the shots of one stage in one mode.
struct StageTally {
  std::int64_t shots = 0, passed = 0, lost = 0, disturbed = 0;
  std::int64_t unanswered = 0;  ///< shots besides, of an engine that died or hung
  RealSum error;                ///< [1] at most 1024 each
  double most_error = no_most;
  double seconds = 0;  ///< of stepping

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

/// A stage, an engine in a mode, and what came of it. The plan must outlive it.
struct StageRow {
  const StageKind* kind;
  const EngineSetup* setup;
  StageSize size;
  std::optional<double> theory = {};  ///< [1] chance of passing
  StageTally tally = {};
};

/// Every stage of the plan, in every mode that can play it. Without results.
std::vector<StageRow> stage_rows(const EnginePlan& plan);

/// Shots `first`, `first + 1`, ... of a row.
StageTally play(const StageRow& row, std::int64_t first, std::int64_t shots, std::uint64_t seed);

/// Takes out, of the ball at the wall and of the stages, what an engine has done that left shots unanswered in either; returns how
/// people call it.
std::vector<std::string> drop_failed(std::vector<EngineRow>& rows, std::vector<StageRow>& stages);

/// What ours must do: let nothing pass and disturb nothing where it sweeps, and pass as theory says where it looks at poses.
std::vector<CellCount> own_counts(const std::vector<StageRow>& rows);

}  // namespace thinwall
