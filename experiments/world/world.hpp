#pragma once
/// Bodies that move, meet and bounce. docs/world.md says what a step does under each policy, and proves it bounded.
///
/// Every order is that of the ids, whatever the order the bodies are given in, and no sum depends on how work is split:
/// the same bodies and options give the same bits with any number of threads.

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <vector>

#include <thinwall/discrete/collision_events.hpp>
#include <thinwall/experiments/world/body.hpp>
#include <thinwall/experiments/world/options.hpp>
#include <thinwall/experiments/world/plan.hpp>
#include <thinwall/experiments/world/step_report.hpp>

namespace thinwall {

/// A body or an option that no world can hold; one line that names it and what is allowed.
struct WorldError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// A body whose place or velocity no double holds any more; the world stays as it was before the step.
struct LeftTheWorld : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class World {
 public:
  /// Throws WorldError: two bodies with one id, a mass that is not > 0, a velocity, size or place that is not finite,
  /// axes that are not orthonormal, a static body with a velocity, an option out of range. No bodies: a world where
  /// nothing happens. Bodies that overlap or lie in each other are in contact from the start, and are parted.
  World(std::vector<Body> bodies, WorldOptions options);
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  /// dt [s] > 0 and finite, or WorldError. Throws TooManyPairs or LeftTheWorld, and then nothing has changed.
  const StepReport& step(double dt);

  const std::vector<Body>& bodies() const;   ///< in the order of ids
  const Body* find(std::uint32_t id) const;  ///< nothing if there is none
  double time() const;                       ///< [s] since the world began
  const StepReport& report() const;          ///< of the last step
  const std::vector<Hit>& hits() const;      ///< of the last step, in the order they were processed
  CollisionEvents& events();                 ///< begin, stay, end; listeners
  const CollisionEvents& events() const;
  const Plan& plan() const;
  const WorldOptions& options() const;

  /// By hand, between two steps. Throw WorldError as the constructor does, and if there is no such body.
  void set_velocity(std::uint32_t id, const Vec3<double>& velocity);  ///< [m/s]
  void move(std::uint32_t id, const Vec3<double>& by);                ///< [m]
  void remove(std::uint32_t id);                                      ///< also from within a listener; its contacts end

  double energy() const;             ///< [J] kinetic, and of height, over bodies of finite mass; in the order of ids
  std::uint64_t state_hash() const;  ///< of every body's id, place and velocity, to the bit

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace thinwall
