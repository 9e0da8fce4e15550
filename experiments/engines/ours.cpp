#include <thinwall/experiments/engines/engine.hpp>

#include <fmt/format.h>

#include <thinwall/experiments/world.hpp>

namespace thinwall {

namespace {

class OwnWorld final : public EngineWorld {
 public:
  OwnWorld(const EngineScene& scene, const BallState& ball, const WorldOptions& options)
      : world_(bodies(scene, ball), options), step_(scene.step) {}

  void step() override { world_.step(step_); }
  BallState ball() const override {
    const Body& ball = *world_.find(1);
    return {position(ball), ball.velocity};
  }

 private:
  static std::vector<Body> bodies(const EngineScene& scene, const BallState& state) {
    Body ball, wall;
    ball.id = 1;
    ball.shape = Sphere<double>{state.position, scene.radius};
    ball.velocity = state.velocity;
    ball.restitution = 1;
    wall.id = 2;
    wall.shape = Aabb<double>{Vec3<double>::Zero(), {scene.thickness / 2, scene.half_side, scene.half_side}};
    wall.is_static = true;
    return {ball, wall};
  }

  World world_;
  double step_;
};

EngineMode own_mode(std::string what, TimePolicy policy, int substeps = 1) {
  WorldOptions options;
  options.policy = policy;
  options.substeps = substeps;
  const bool sweeps = policy == TimePolicy::clamp || policy == TimePolicy::event_driven;
  std::string name(name_of(policy));
  if (policy == TimePolicy::substeps) name += fmt::format("_{}", substeps);
  return {.name = std::move(name),
          .what = std::move(what),
          .poses_per_step = sweeps ? 0 : substeps,
          .skin = 0,
          .exact = sweeps,
          .make = [options](const EngineScene& scene, const BallState& ball) {
            return std::make_unique<OwnWorld>(scene, ball, options);
          }};
}

std::vector<EngineMode> own_modes(const EngineChoices& choices) {
  std::vector<EngineMode> modes = {own_mode("the pose at the end of the step", TimePolicy::discrete)};
  for (const std::int64_t n : choices.substeps) {
    modes.push_back(own_mode(fmt::format("the poses at the end of {} equal parts of the step", n), TimePolicy::substeps,
                             static_cast<int>(n)));
  }
  modes.push_back(own_mode("swept; the rest of the step is lost at a hit", TimePolicy::clamp));
  modes.push_back(own_mode("swept; the step goes on after a hit", TimePolicy::event_driven));
  return modes;
}

}  // namespace

Engine own_engine() {
  return {.name = "thinwall",
          .called = "thinwall",
          .package = {},
          .made_of = "World with each of its time policies, in double.",
          .modes = own_modes};
}

}  // namespace thinwall
