#include <thinwall/experiments/engines/engine.hpp>

#include <stdexcept>
#include <type_traits>

#include <fmt/format.h>

#include <thinwall/experiments/lab/race.hpp>
#include <thinwall/experiments/world.hpp>

namespace thinwall {

namespace {

class OwnWorld final : public EngineWorld {
 public:
  OwnWorld(const EngineStage& stage, std::span<const BodyState> starts, const WorldOptions& options)
      : world_(bodies(stage, starts), options), step_(stage.step) {}

  void step() override { world_.step(step_); }
  BodyState ball() const override { return body(1); }
  BodyState body(std::uint32_t id) const {
    const Body& body = *world_.find(id);
    return {position(body), body.velocity, body.angular_velocity};
  }

 private:
  /// Those that move have the ids 1, 2, ...
  static std::vector<Body> bodies(const EngineStage& stage, std::span<const BodyState> starts) {
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
    for (std::size_t i = 0; i < starts.size(); ++i) add(stage.moving[i], starts[i], false);
    for (const EngineShape& shape : stage.fixed) add(shape, {Vec3<double>::Zero(), Vec3<double>::Zero()}, true);
    return all;
  }

  World world_;
  double step_;
};

EngineFlights play_own(const WorldOptions& options, const EngineStage& stage,
                       std::span<const std::vector<BodyState>> starts, std::int64_t steps) {
  EngineFlights flights;
  for (const std::vector<BodyState>& shot : starts) {
    OwnWorld world(stage, shot, options);
    EngineFlights::Flight& flight = flights.shots.emplace_back();
    for (std::int64_t i = 0; i < steps; ++i) {
      const double start = thread_seconds();
      world.step();
      flights.seconds += thread_seconds() - start;
      std::vector<BodyState>& at = flight.emplace_back();
      for (std::uint32_t id = 1; id <= shot.size(); ++id) at.push_back(world.body(id));
    }
  }
  return flights;
}

EngineMode own_mode(std::string what, TimePolicy policy, int substeps = 1) {
  WorldOptions options;
  options.policy = policy;
  options.substeps = substeps;
  std::string name(name_of(policy));
  if (policy == TimePolicy::substeps) name += fmt::format("_{}", substeps);
  return {.name = std::move(name),
          .what = std::move(what),
          .poses_per_step = sweeps(policy) ? 0 : substeps,
          .exact = sweeps(policy),
          .make =
              [options](const EngineScene& scene, const BodyState& ball) {
                return std::make_unique<OwnWorld>(stage_of(scene), std::span(&ball, 1), options);
              },
          .play = [options](const EngineStage& stage, std::span<const std::vector<BodyState>> starts,
                            std::int64_t steps) { return play_own(options, stage, starts, steps); },
          .turns = true};
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
