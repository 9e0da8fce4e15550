#pragma once
/// A physics engine as this experiment sees it: something that makes a world of one wall and one ball, or of what a stage holds, and
/// steps it. An engine is one file, which makes an `Engine`, and one line in the list below. Its own headers stay in that file.

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/discrete/aabb.hpp>
#include <thinwall/discrete/sphere.hpp>

namespace thinwall {

/// A wall around the origin that stays, its front facing -x. No gravity, no damping, no friction, restitution 1.
struct EngineScene {
  double radius;     ///< [m] > 0, of the ball
  double thickness;  ///< [m] > 0, of the wall
  double half_side;  ///< [m] of the wall, wide enough that no ball gets round it
  double step;       ///< [s] > 0
};

struct BodyState {
  Vec3<double> position;                     ///< [m] of the center
  Vec3<double> velocity;                     ///< [m/s]
  Vec3<double> spin = Vec3<double>::Zero();  ///< [rad/s]
};

/// Triangles by their corners, counterclockwise as seen from outside.
struct EngineMesh {
  std::vector<Vec3<double>> points;  ///< [m]
  std::vector<std::array<int, 3>> triangles;
};
using EngineShape = std::variant<Sphere<double>, Aabb<double>, Capsule<double>, EngineMesh>;

/// Any bodies, of the materials of EngineScene and all of one density.
struct EngineStage {
  double step = 1;                       ///< [s] > 0
  std::vector<EngineShape> fixed = {};   ///< where they stay
  std::vector<EngineShape> moving = {};  ///< around the origin; a capsule along y. A shot places them
};

/// The same wall and ball.
EngineStage stage_of(const EngineScene& scene);

/// One wall, one ball, nothing that an earlier shot left behind. Every thread has one of its own: an engine that does not bear
/// that makes them wait for each other.
class EngineWorld {
 public:
  virtual ~EngineWorld() = default;
  virtual void step() = 0;
  virtual BodyState ball() const = 0;
};

/// What became of some shots, each in a world of its own.
struct EngineFlights {
  using Flight = std::vector<std::vector<BodyState>>;  ///< the moving bodies at the end of each step
  std::vector<Flight> shots = {};                      ///< none, if the engine failed
  double seconds = 0;                                  ///< of stepping
};

/// A way to set an engine up. It makes a world for a ball, or plays many shots of any stage itself, or both.
struct EngineMode {
  std::string name;        ///< snake_case: "discrete"
  std::string what;        ///< the settings that differ from the engine's own, a clause
  int poses_per_step = 0;  ///< > 0: it looks at so many poses a step and nothing between, and theory knows its chance
  double skin = 0;         ///< [m] it lets contact begin so far before the surfaces meet
  bool never_sweeps = false;  ///< so it does too, but what gives way follows no theory
  bool exact = false;         ///< it claims that no ball goes through: the self-test holds it to that
  std::function<std::unique_ptr<EngineWorld>(const EngineScene&, const BodyState&)> make = nullptr;
  std::function<EngineFlights(const EngineStage&, std::span<const std::vector<BodyState>>, std::int64_t steps)> play =
      nullptr;
  bool has_meshes = false, turns = false;  ///< what it can play
};

/// What the settings say of modes.
struct EngineChoices {
  std::vector<double> swept_radius;    ///< [1] > 0, of the ball's radius
  double motion_threshold;             ///< [1] > 0, of the ball's radius
  std::vector<std::int64_t> substeps;  ///< >= 2 poses a step
};

struct Engine {
  std::string name;     ///< as in the settings: "bullet"
  std::string called;   ///< by people: "Bullet"
  std::string package;  ///< the package that brings it; empty for what is always there
  std::string made_of;  ///< what of it makes a world, for the report; ends with a period
  std::function<std::vector<EngineMode>(const EngineChoices&)> modes = nullptr;  ///< null: it is not there
  double most_path = std::numeric_limits<double>::infinity();  ///< [m] it moves nothing further in a step
  std::string why_most_path = {};                              ///< ... and what in it says so

  std::string version = {};    ///< of the package, where the engine knows it
  std::string integrity = {};  ///< its hash, as the lock file of what is installed has it: "sha512-..."
  std::string remedy = {};     ///< what brings it, an imperative; empty: its Debian package and a build option

  bool is_there() const { return modes != nullptr; }
};

/// An engine is a line here, and a file of its own that defines this function.
#define THINWALL_ENGINES(line) line(bullet_engine) line(ode_engine) line(box2d_engine) line(own_engine)

#define THINWALL_DECLARE_ENGINE(make) Engine make();
THINWALL_ENGINES(THINWALL_DECLARE_ENGINE)
#undef THINWALL_DECLARE_ENGINE

/// Those that are npm packages, each a script in the folder that a process of its own runs. One is there if npm has brought the
/// version that the folder's package.json asks for.
std::vector<Engine> npm_engines(const std::filesystem::path& scripts);
std::vector<Engine> npm_engines();  ///< of the source tree's, in a build with peers

/// Every engine that this experiment knows, in the program or not.
std::vector<Engine> engine_list();

}  // namespace thinwall
