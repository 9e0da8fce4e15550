#pragma once
/// A physics engine as this experiment sees it: something that makes a world of one wall and one ball, and steps it.
/// An engine is one file, which makes an `Engine`, and one line in the list below. Its own headers stay in that file.

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <thinwall/discrete/scalar.hpp>

namespace thinwall {

/// A wall around the origin that stays, its front facing -x. No gravity, no damping, no friction, restitution 1.
struct EngineScene {
  double radius;     ///< [m] > 0, of the ball
  double thickness;  ///< [m] > 0, of the wall
  double half_side;  ///< [m] of the wall, wide enough that no ball gets round it
  double step;       ///< [s] > 0
};

struct BallState {
  Vec3<double> position;  ///< [m] of the center
  Vec3<double> velocity;  ///< [m/s]
};

/// One wall, one ball, nothing that an earlier shot left behind. Every thread has one of its own: an engine that does not bear
/// that makes them wait for each other.
class EngineWorld {
 public:
  virtual ~EngineWorld() = default;
  virtual void step() = 0;
  virtual BallState ball() const = 0;
};

/// A way to set an engine up.
struct EngineMode {
  std::string name;        ///< snake_case: "discrete"
  std::string what;        ///< the settings that differ from the engine's own, a clause
  int poses_per_step = 0;  ///< > 0: it looks at so many poses a step and nothing between, and theory knows its chance
  double skin = 0;         ///< [m] it lets contact begin so far before the surfaces meet
  bool exact = false;      ///< it claims that no ball goes through: the self-test holds it to that
  std::function<std::unique_ptr<EngineWorld>(const EngineScene&, const BallState&)> make;
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
  std::string package;  ///< the Debian package that brings it; empty for what is always there
  std::string made_of;  ///< what of it makes a world, for the report; ends with a period
  std::vector<EngineMode> (*modes)(const EngineChoices&) = nullptr;  ///< null: the program was built without it
  double most_path = std::numeric_limits<double>::infinity();        ///< [m] it moves nothing further in a step
  std::string why_most_path = {};                                    ///< ... and what in it says so

  bool is_there() const { return modes != nullptr; }
};

/// An engine is a line here, and a file of its own that defines this function.
#define THINWALL_ENGINES(line) line(bullet_engine) line(ode_engine) line(box2d_engine) line(own_engine)

#define THINWALL_DECLARE_ENGINE(make) Engine make();
THINWALL_ENGINES(THINWALL_DECLARE_ENGINE)
#undef THINWALL_DECLARE_ENGINE

/// Every engine that this experiment knows, in the program or not.
std::vector<Engine> engine_list();

}  // namespace thinwall
