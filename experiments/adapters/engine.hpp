#pragma once
/// A physics engine as an experiment sees it: something that plays shots, each in a world of its own. An engine is one file, which
/// makes an `Engine`, and one line in the list below. Its own headers stay in that file.

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/discrete/aabb.hpp>
#include <thinwall/discrete/sphere.hpp>
#include <thinwall/experiments/lab/race.hpp>
#include <thinwall/experiments/lab/settings.hpp>

namespace thinwall {

struct BodyState {
  Vec3<double> position;                     ///< [m] of the center
  Vec3<double> velocity;                     ///< [m/s]
  Vec3<double> spin = Vec3<double>::Zero();  ///< [rad/s]
  bool is_finite() const { return position.allFinite() && velocity.allFinite(); }
};

/// Triangles by their corners, counterclockwise as seen from outside.
struct EngineMesh {
  std::vector<Vec3<double>> points;  ///< [m]
  std::vector<std::array<int, 3>> triangles;
};
using EngineShape = std::variant<Sphere<double>, Aabb<double>, Capsule<double>, EngineMesh>;

/// Any bodies, all of one density. No gravity, no damping, no friction, restitution 1.
struct EngineStage {
  double step = 1;                       ///< [s] > 0
  std::vector<EngineShape> fixed = {};   ///< where they stay
  std::vector<EngineShape> moving = {};  ///< around the origin; a capsule along y. A shot places them

  /// Of a stage of one wall, around the origin, and one ball, which is all that some engines play.
  const Vec3<double>& wall_half_extents() const { return std::get<Aabb<double>>(fixed.front()).half_extents; }
  double ball_radius() const { return std::get<Sphere<double>>(moving.front()).radius; }
};

using EngineStart = std::vector<BodyState>;  ///< of the moving bodies
/// What became of some shots.
struct EngineFlights {
  using Flight = std::vector<std::vector<BodyState>>;  ///< the moving bodies at the end of each step
  std::vector<Flight> shots = {};                      ///< none, if the engine failed
  double seconds = 0;                                  ///< of stepping
};

/// Plays shots, each in a world of its own: nothing that an earlier one left behind. May be called by several threads at once: an engine
/// that does not bear that makes them wait for each other.
using EnginePlay = std::function<EngineFlights(const EngineStage&, std::span<const EngineStart>, std::int64_t steps)>;

/// Plays each shot in a `World(stage, start, options...)`, which has `step()` and `body(i)`, the state of a moving body. Its seconds are those of
/// both.
template <class World, class... Options> EnginePlay played_in(Options... options) {
  return [=](const EngineStage& stage, std::span<const EngineStart> starts, std::int64_t steps) {
    EngineFlights flights;
    for (const EngineStart& start : starts) {
      World world(stage, start, options...);
      EngineFlights::Flight& flight = flights.shots.emplace_back(static_cast<std::size_t>(steps), start);
      const double before = thread_seconds();
      for (std::vector<BodyState>& bodies : flight) {
        world.step();
        for (std::size_t i = 0; i < bodies.size(); ++i) bodies[i] = world.body(i);
      }
      flights.seconds += thread_seconds() - before;
    }
    return flights;
  };
}

/// A way to set an engine up.
struct EngineMode {
  std::string name;        ///< snake_case: "discrete"
  std::string what;        ///< the settings that differ from the engine's own, a clause
  int poses_per_step = 0;  ///< > 0: it looks at so many poses a step and nothing between, and theory knows its chance
  double skin = 0;         ///< [m] it lets contact begin so far before the surfaces meet
  bool never_sweeps = false;  ///< so it does too, but what gives way follows no theory
  bool exact = false;         ///< it claims that no ball goes through: the self-test holds it to that
  EnginePlay play = nullptr;
};

/// What the settings say of modes.
struct EngineChoices {
  std::vector<double> swept_radius = {};    ///< [1] > 0, of the ball's radius
  double motion_threshold = 0;              ///< [1] > 0, of the ball's radius
  std::vector<std::int64_t> substeps = {};  ///< >= 2 poses a step
};

struct Engine {
  std::string name;                    ///< as in the settings: "bullet"
  std::string called;                  ///< by people: "Bullet"
  std::string package;                 ///< the package that brings it; empty for what is always there
  std::string made_of;                 ///< what of it makes a world, for the report; ends with a period
  std::vector<EngineMode> modes = {};  ///< none: it is not there
  bool plays_stages = false;           ///< not only a ball at a wall
  bool has_meshes = false;
  double most_path = std::numeric_limits<double>::infinity();  ///< [m] it moves nothing further in a step
  std::string why_most_path = {};                              ///< ... and what in it says so

  std::string version = {};    ///< of the package
  std::string integrity = {};  ///< its hash, as the lock file of what is installed has it: "sha512-..."
  std::string remedy = {};     ///< what brings it, an imperative

  bool is_there() const { return !modes.empty(); }
};

/// An engine is a line here, and a file of its own that defines this function. Version and remedy, where it leaves them out, are those
/// of what the program was built with.
#define THINWALL_ENGINES(line) line(bullet_engine) line(ode_engine) line(box2d_engine) line(own_engine)

#define THINWALL_DECLARE_ENGINE(make) Engine make(const EngineChoices& choices);
THINWALL_ENGINES(THINWALL_DECLARE_ENGINE)
#undef THINWALL_DECLARE_ENGINE

/// Those that are npm packages, each a script in the folder that a process of its own runs. One is there if npm has brought the
/// version that the folder's package.json asks for.
std::vector<Engine> npm_engines(const std::filesystem::path& scripts);
std::vector<Engine> npm_engines();  ///< of the source tree's, in a build with peers

/// Every engine, in the program or not; ours is last.
std::vector<Engine> engine_list(const EngineChoices& choices = {});

/// An engine in one of its modes.
struct EngineSetup {
  Engine engine;
  EngineMode mode;
  std::string label() const { return engine.called + " " + mode.name; }  ///< for people
  bool is_ours() const { return engine.package.empty(); }
};

struct ChosenEngines {
  std::vector<EngineSetup> setups;
  std::vector<std::string> missing;  ///< what "all" asks for and is not in the program, and what brings it: a line each
};

/// Every mode of the engines that the settings name. Throws UsageError.
ChosenEngines choose_engines(const Settings& settings);

}  // namespace thinwall
