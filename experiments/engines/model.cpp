#include <thinwall/experiments/engines/model.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <thinwall/experiments/lab/text.hpp>

namespace thinwall {

constexpr Range length = {.lower = 1e-9, .upper = 1e6, .unit = "m"};

const Factors<EngineCell> engine_factors =
    factors<EngineCell>(numbers("wall_size", &EngineCell::wall_size, length, "Side of the wall, a square."),
                        numbers("path", &EngineCell::path, length, "Path of the ball in a step."),
                        number("step", &EngineCell::step, {.lower = 1e-9, .upper = 1e3, .unit = "s"}, "Time step."),
                        number("radius", &EngineCell::radius, length, "Of the ball."),
                        number("thickness", &EngineCell::thickness, length, "Of the wall."),
                        number("angle_deg", &EngineCell::angle_deg, {.lower = 0, .upper = 89.9, .unit = "deg"},
                               "Largest angle of incidence."),
                        count("steps", &EngineCell::steps, 4, 1000, "Steps that a shot is followed for."));

// What became of a shot.

namespace {

/// The lines of flight before and after the bounce meet at some time: of a ball that turns in an instant, when it turned. Its
/// distance from first contact, in steps; < 0 where the ball turns before it touches.
double lateness_of(const EngineStage& stage, const EngineShot& shot, const BodyState& end, double steps) {
  const double contact_at = -shot.beyond - stage.ball_radius();
  const double in = shot.start[0].velocity[0] * stage.step, out = end.velocity[0] * stage.step;
  return (end.position[0] - contact_at - out * (steps - shot.contact)) / (in - out);
}

/// Where the ball would be had there been no wall, to a hundredth of its radius.
bool flew_straight(const EngineStage& stage, const EngineShot& shot, const BodyState& end, double steps) {
  const Vec3<double> straight = shot.start[0].position + steps * stage.step * shot.start[0].velocity;
  return (end.position - straight).norm() <= stage.ball_radius() / 100;
}

}  // namespace

void judge(const EngineStage& stage, const EngineShot& shot, const EngineFlights::Flight& flight, EngineTally& tally) {
  ++tally.shots;
  const BodyState& end = flight.back()[0];
  const auto steps = static_cast<double>(flight.size());
  if (!end.is_finite()) {
    ++tally.lost;
  } else if (end.position[0] > shot.beyond) {
    ++tally.tunneled;
    if (flew_straight(stage, shot, end, steps)) ++tally.unseen;
  } else if (end.position[0] >= -shot.beyond) {
    ++tally.stuck;
  } else if (end.velocity[0] < 0) {
    ++tally.turned;
    const double lateness = lateness_of(stage, shot, end, steps);
    const double energy = std::min(1024.0, end.velocity.squaredNorm() / shot.start[0].velocity.squaredNorm());
    tally.lateness.add(lateness);
    tally.energy.add(energy);
    tally.latest = std::max(tally.latest, lateness);
    tally.earliest = std::min(tally.earliest, lateness);
    tally.most_energy = std::max(tally.most_energy, energy);
    tally.least_energy = std::min(tally.least_energy, energy);
    for (const EngineStart& at : flight)
      tally.deepest = std::max(tally.deepest, at[0].position[0] + stage.ball_radius() + shot.beyond);
  }
}

void judge(const EngineStage&, const EngineShot& shot, const EngineFlights::Flight& flight, StageTally& tally) {
  ++tally.shots;
  const std::vector<BodyState>& end = flight.back();
  const Vec3<double> from = end.size() > 1 ? end[1].position : Vec3<double>::Zero();
  if (!std::ranges::all_of(end, &BodyState::is_finite)) {
    ++tally.lost;
  } else if ((end[0].position - from).dot(shot.ahead) > shot.beyond) {
    ++tally.passed;
  } else if (shot.velocity) {
    Vec3<double> change = end[0].velocity - *shot.velocity;
    if (shot.along_wall) change[0] = 0;
    const double error = std::min(1024.0, change.norm() / shot.start[0].velocity.norm());
    tally.error.add(error);
    tally.most_error = std::max(tally.most_error, error);
    if (error > 0.01) ++tally.disturbed;
  }
}

// What a run fires.

namespace {

/// Poses lie on a grid that float holds, as thin_wall's do: a path must not be longer than this many times what it crosses.
constexpr double most_walls_a_path = 1e6;

/// A ball that is not stopped is behind the wall in time.
void check_path(const Settings& settings, const EngineCell& cell) {
  const double thick = cell.thickness + 2 * cell.radius;
  const double ahead =
      cell.path * std::cos(cell.angle_deg * (std::numbers::pi / 180)) * static_cast<double>(cell.steps - 2);
  if (ahead < thick) {
    settings.complain("path", fmt::format("long enough that {} steps cross the wall at {} deg: at least {} m",
                                          cell.steps, cell.angle_deg, rounded_text(thick / ahead * cell.path, 3)));
  }
  if (cell.path > most_walls_a_path * thick) {
    settings.complain(
        "path", fmt::format("at most {} times thickness + 2 * radius: not so at {} m", most_walls_a_path, cell.path));
  }
}

void check_wall(const Settings& settings, const EngineCell& cell) {
  const double least = 2 * (static_cast<double>(cell.steps) * cell.path + 2 * (cell.radius + cell.thickness));
  if (cell.wall_size < least) {
    settings.complain("wall_size",
                      fmt::format("at least {} m, so that no ball gets round it: path is {} m, steps is {}",
                                  rounded_text(std::ceil(least), 6), cell.path, cell.steps));
  }
}

/// By wall, then by path in rising order. `each`: units of a cell.
std::vector<EngineCell> read_cells(const Settings& settings, std::size_t each) {
  std::vector<EngineCell> cells = engine_factors.cells(settings, each);
  const std::vector<double> walls = distinct(cells, &EngineCell::wall_size);
  std::ranges::sort(cells, {}, [&](const EngineCell& cell) {
    return std::pair(std::ranges::find(walls, cell.wall_size), cell.path);
  });
  for (const EngineCell& cell : cells) {
    check_path(settings, cell);
    if (cell.path == cells.back().path) check_wall(settings, cell);  // the longest needs the widest
  }
  return cells;
}

/// In every setup that can play it.
template <class Tally>
void add_rows(const StageKind& kind, const EngineCell& cell, const std::vector<EngineSetup>& setups,
              std::vector<EngineRowOf<Tally>>& rows) {
  const bool has_mesh = std::ranges::any_of(
      kind.stage(cell).fixed, [](const EngineShape& shape) { return std::holds_alternative<EngineMesh>(shape); });
  for (const EngineSetup& setup : setups) {
    const Engine& engine = setup.engine;
    const bool can_play = &kind == &ball_at_wall || (engine.plays_stages && (engine.has_meshes || !has_mesh));
    if (!can_play || cell.path > engine.most_path) continue;
    const int poses = setup.mode.poses_per_step;
    rows.push_back({cell, &setup, &kind});
    if (poses > 0 && kind.theory != nullptr) rows.back().theory = kind.theory(cell, poses, setup.mode.skin);
  }
}

}  // namespace

EnginePlan make_engine_plan(const Settings& settings, const RunOptions& options) {
  EnginePlan plan = {choose_engines(settings)};
  plan.seed = options.seed;
  plan.shots = settings.trials("shots", 1, most_engine_shots, options.trials);
  const std::int64_t volleys = (plan.shots + most_shots_an_engine_volley - 1) / most_shots_an_engine_volley;
  const std::vector<EngineCell> cells = read_cells(settings, plan.setups.size() * static_cast<std::size_t>(volleys));
  for (const EngineCell& c : cells) add_rows(ball_at_wall, c, plan.setups, plan.rows);
  const Engine& engine = plan.setups.front().engine;
  if (plan.rows.empty()) {
    settings.complain("path", fmt::format("one of at most {} m: {} moves nothing further in a step ({})",
                                          engine.most_path, engine.called, engine.why_most_path));
  }
  EngineCell cell = cells.front();
  const std::vector<std::string> stages = settings.choices_or_all("stage", distinct(stage_kinds, &StageKind::name));
  plan.stage_shots = settings.trials("stage_shots", 0, most_engine_shots, options.trials);
  cell.path = settings.number("stage_path", {.lower = 1e-9, .upper = 1000, .unit = "m"});
  if (plan.stage_shots == 0) return plan;
  const double least_path = 13 * cell.radius + 2 * cell.thickness;
  if (cell.path < least_path) {
    settings.complain("stage_path",
                      fmt::format("at least {} m, so that what is not stopped has passed at the end of a shot; "
                                  "without stages, stage_shots is 0",
                                  rounded_text(least_path, 3)));
  }
  for (const StageKind& kind : stage_kinds) {
    if (std::ranges::find(stages, kind.name) != stages.end()) add_rows(kind, cell, plan.setups, plan.stages);
  }
  return plan;
}

std::vector<std::string> drop_failed(std::vector<EngineRow>& rows, std::vector<StageRow>& stages) {
  std::vector<std::string> failed;
  const auto is_failed = [&](const auto& row) {
    return std::ranges::find(failed, row.setup->engine.called) != failed.end();
  };
  const auto look = [&](const auto& all) {
    for (const auto& row : all) {
      if (row.tally.unanswered > 0 && !is_failed(row)) failed.push_back(row.setup->engine.called);
    }
  };
  look(rows);
  look(stages);
  std::erase_if(rows, is_failed);
  std::erase_if(stages, is_failed);
  return failed;
}

std::vector<EngineRow> rows_of(const std::vector<EngineRow>& rows, const std::string& label, double wall_size) {
  return only(rows,
              [&](const EngineRow& row) { return row.setup->label() == label && row.cell.wall_size == wall_size; });
}

std::vector<CellCount> own_counts(const std::vector<EngineRow>& rows, const std::vector<StageRow>& stages) {
  std::vector<CellCount> counts;
  const auto judge = [&](const auto& row, const char* where, std::int64_t wrong, double theory) {
    if (row.setup->is_ours()) counts.push_back({row.setup->label() + where, "double", row.tally.shots, wrong, theory});
  };
  for (const EngineRow& row : rows) {
    const bool at_first_wall = row.cell.wall_size == rows.front().cell.wall_size;
    if (row.theory && at_first_wall) judge(row, "", row.tally.wrong(), *row.theory);
    if (row.setup->mode.exact) judge(row, "", row.tally.wrong(), 0);
  }
  for (const StageRow& row : stages) {
    const std::int64_t wrong = row.tally.passed + row.tally.lost;
    if (row.theory && !row.kind->spins) judge(row, " on stages", wrong, *row.theory);  // of what spins it is the least
    if (row.setup->mode.exact) judge(row, " on stages", wrong + row.tally.disturbed, 0);
  }
  return counts;
}

}  // namespace thinwall
