#include <thinwall/experiments/adapters/engine.hpp>

#include <stdexcept>
#include <type_traits>

#include <fmt/format.h>

#include <thinwall/experiments/world.hpp>

namespace thinwall {

namespace {

class OwnWorld {
 public:
  OwnWorld(const EngineStage& stage, const EngineStart& start, const WorldOptions& options)
      : world_(bodies(stage, start), options), step_(stage.step) {}

  void step() { world_.step(step_); }
  BodyState body(std::size_t i) const {
    const Body& body = *world_.find(static_cast<std::uint32_t>(i + 1));
    return {position(body), body.velocity, body.angular_velocity};
  }

 private:
  /// Those that move have the ids 1, 2, ...
  static std::vector<Body> bodies(const EngineStage& stage, const EngineStart& start) {
    std::vector<Body> all;
    const auto add = [&](const EngineShape& shape, const BodyState& state, bool is_static) {
      Body& body = all.emplace_back();
      body.id = static_cast<std::uint32_t>(all.size());
      std::visit(
          [&]<class Shape>(const Shape& s) {
            if constexpr (std::is_same_v<Shape, EngineMesh>) {
              throw std::invalid_argument("a world has no meshes");
            } else {
              body.shape = moved(s, state.position);
              body.turns = std::is_same_v<Shape, Capsule<double>> && !is_static;  // a ball keeps its spin
            }
          },
          shape);
      body.velocity = state.velocity;
      if (body.turns) body.angular_velocity = state.spin;
      body.restitution = 1;
      body.is_static = is_static;
    };
    for (std::size_t i = 0; i < start.size(); ++i) add(stage.moving[i], start[i], false);
    for (const EngineShape& shape : stage.fixed) add(shape, {Vec3<double>::Zero(), Vec3<double>::Zero()}, true);
    return all;
  }

  World world_;
  double step_;
};

EngineMode own_mode(std::string what, TimePolicy policy, int substeps = 1) {
  WorldOptions options;
  options.policy = policy;
  options.substeps = substeps;
  return {.name = name_of(policy, substeps),
          .what = std::move(what),
          .poses_per_step = sweeps(policy) ? 0 : substeps,
          .exact = sweeps(policy),
          .play = played_in<OwnWorld>(options)};
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

Engine own_engine(const EngineChoices& choices) {
  return {.name = "thinwall",
          .called = "thinwall",
          .package = {},
          .made_of = "World with each of its time policies, in double.",
          .modes = own_modes(choices),
          .plays_stages = true};
}

}  // namespace thinwall
