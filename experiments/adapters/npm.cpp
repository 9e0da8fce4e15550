/// Engines that are npm packages: scripts in npm/, which node runs, a process for each thread that asks, asked in lines of JSON.
/// npm/serve.mjs says what a line holds.

#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <mutex>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <thinwall/experiments/adapters/engine.hpp>
#include <thinwall/experiments/adapters/speaker.hpp>

#ifndef THINWALL_NPM_ENGINES
#define THINWALL_NPM_ENGINES ""  // the folder of the scripts
#endif

namespace thinwall {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr double seconds_to_start = 60, seconds_a_volley = 120;

/// But for how they play. The modes are what it comes with and what its own documentation has for fast bodies; the scripts set them.
/// Skins are the engines' own: of Rapier's prediction, Jolt's speculative distance, Box2D's four slops, PhysX's contact offset of
/// either body.
std::vector<Engine> known_engines() {
  return {
      {.name = "rapier",
       .called = "Rapier",
       .package = "@dimforge/rapier3d-compat",
       .made_of = "A World with a fixed cuboid and a ball, in float, in WebAssembly.",
       .modes = {{"discrete", "World.maxCcdSubsteps = 0, without which it sweeps bodies that do not ask for it", 1,
                  0.02},
                 {"default", "as it comes"},
                 {"ccd", "RigidBodyDesc.setCcdEnabled(true), which its guide has for fast bodies"},
                 {"soft_ccd", "RigidBodyDesc.setSoftCcdPrediction(path of a step), World.maxCcdSubsteps = 0"}},
       .has_meshes = true},
      {.name = "jolt",
       .called = "Jolt",
       .package = "jolt-physics",
       .made_of =
           "A PhysicsSystem with a static box and a sphere, in float, in WebAssembly; its speed limit of 500 m/s raised.",
       .modes = {{"discrete", "EMotionQuality_Discrete, as a body comes", 1, 0.02},
                 {"linear_cast", "EMotionQuality_LinearCast, which its documentation has for small fast bodies"}},
       .has_meshes = true},
      {.name = "physx",
       .called = "PhysX",
       .package = "physx-js-webidl",
       .made_of = "A PxScene with a static box and a sphere, in float, in WebAssembly; its meshes are not built here.",
       .modes =
           {{"discrete", "as it comes", 1, 0.04},
            {"swept",
             "eENABLE_CCD of scene and body and eDETECT_CCD_CONTACT of the pair, which its guide has for fast bodies"},
            {"speculative", "PxRigidBodyFlag::eENABLE_SPECULATIVE_CCD"}}},
      {.name = "havok",
       .called = "Havok",
       .package = "@babylonjs/havok",
       .made_of = "A world with a static box and a sphere, in float, in WebAssembly; its speed limit raised.",
       .modes = {{"default", "as it comes: it sweeps every body, and has no switch for that"}},
       .has_meshes = true},
      {.name = "mujoco",
       .called = "MuJoCo",
       .package = "@mujoco/mujoco",
       .made_of =
           "A model of a box and a free sphere, in double, in WebAssembly. Its contacts are springs; it has no continuous "
           "detection. Its meshes are convex hulls, which a flat one is not.",
       .modes = {{"default", "solref and solimp as they come, which take the speed away", 1, 0},
                 {"elastic",
                  "solref = \"-K 0\", which its documentation has for a bounce: K so that one takes two steps", 0, 0,
                  true}}},
      {.name = "box2d3",
       .called = "Box2D 3",
       .package = "box2d3-wasm",
       .made_of =
           "A b2World with a static box and a circle, in the plane, in float, in WebAssembly; its speed limit of 400 m/s raised.",
       .modes = {{"discrete", "b2WorldDef.enableContinuous = false", 1, 0.02},
                 {"continuous", "as it comes: what moves is swept against what is fixed"},
                 {"bullet", "b2BodyDef.isBullet = true, which its manual has for fast bodies"}}}};
}

/// What a file of JSON says there; empty if that is no text.
std::string text_in(const fs::path& file, const json::json_pointer& path) {
  std::ifstream in(file);
  const json value = json::parse(in, nullptr, false);
  return value.contains(path) && value.at(path).is_string() ? value.at(path).get<std::string>() : "";
}

/// The version that package.json asks for, if npm has brought it.
std::string installed_version(const fs::path& scripts, const std::string& package) {
  const std::string version =
      text_in(scripts / "node_modules" / package / "package.json", json::json_pointer("/version"));
  return text_in(scripts / "package.json", json::json_pointer("/dependencies") / package) == version ? version : "";
}

/// What npm noted, when it brought the package, of what it had checked it against.
std::string integrity(const fs::path& scripts, const std::string& package) {
  return text_in(scripts / "node_modules" / ".package-lock.json",
                 json::json_pointer("/packages") / ("node_modules/" + package) / "integrity");
}

/// What serve.mjs calls a shape, and where a fixed one stays.
struct ToJson {
  json operator()(const Sphere<double>& s) const { return {{"sphere", s.radius}, {"at", list(s.center)}}; }
  json operator()(const Aabb<double>& b) const { return {{"box", list(b.half_extents)}, {"at", list(b.center)}}; }
  json operator()(const Capsule<double>& c) const {
    return {{"capsule", {(c.b - c.a).norm() / 2, c.radius}}, {"at", list((c.a + c.b) / 2)}};
  }
  json operator()(const EngineMesh& m) const {
    json points = json::array();
    for (const Vec3<double>& p : m.points) points.push_back(list(p));
    return {{"mesh", {{"points", points}, {"triangles", m.triangles}}}, {"at", {0, 0, 0}}};
  }
  static json list(const Vec3<double>& v) { return {v[0], v[1], v[2]}; }
};

/// The processes of one engine: as many as threads ask it at once, each started when it is needed. None is started, or asked, once one
/// has failed.
class NpmProcesses {
 public:
  NpmProcesses(std::string name, fs::path scripts) : name_(std::move(name)), scripts_(std::move(scripts)) {}

  EngineFlights play(const std::string& mode, const EngineStage& stage, std::span<const EngineStart> starts,
                     std::int64_t steps) {
    try {
      std::unique_ptr<Speaker> speaker = take();
      if (!speaker) return {};
      EngineFlights flights =
          flights_of(speaker->ask(question(mode, stage, starts, steps), seconds_a_volley), starts, steps);
      const std::scoped_lock lock(mutex_);
      idle_.push_back(std::move(speaker));
      return flights;
    } catch (const std::exception& error) {
      const std::scoped_lock lock(mutex_);
      if (!failed_) std::cerr << fmt::format("engines: {}: left out from here on\n", error.what());
      failed_ = true;
      return {};
    }
  }

 private:
  /// Null where the engine has failed.
  std::unique_ptr<Speaker> take() {
    {
      const std::scoped_lock lock(mutex_);
      if (failed_) return nullptr;
      if (!idle_.empty()) {
        std::unique_ptr<Speaker> speaker = std::move(idle_.back());
        idle_.pop_back();
        return speaker;
      }
    }
    auto speaker = std::make_unique<Speaker>(name_, std::vector<std::string>{"node", "serve.mjs", name_}, scripts_);
    if (!speaker->hear(seconds_to_start).is_object()) throw SpeakerError(name_ + " does not say what it is");
    return speaker;
  }

  static json question(const std::string& mode, const EngineStage& stage, std::span<const EngineStart> starts,
                       std::int64_t steps) {
    json shots = json::array(), fixed = json::array(), moving = json::array();
    for (const EngineStart& bodies : starts) {
      json& shot = shots.emplace_back(json::array());
      for (const BodyState& body : bodies) {
        const Vec3<double>&p = body.position, &v = body.velocity, &w = body.spin;
        shot.push_back({p[0], p[1], p[2], v[0], v[1], v[2], w[0], w[1], w[2]});
      }
    }
    for (const EngineShape& shape : stage.fixed) fixed.push_back(std::visit(ToJson{}, shape));
    for (const EngineShape& shape : stage.moving) moving.push_back(std::visit(ToJson{}, shape));
    return {{"id", question_id}, {"mode", mode},     {"step", stage.step},       {"steps", steps},
            {"fixed", fixed},    {"moving", moving}, {"shots", std::move(shots)}};
  }

  /// Throws SpeakerError, or json's own, unless it is an answer to such a question.
  EngineFlights flights_of(const json& answer, std::span<const EngineStart> starts, std::int64_t steps) const {
    if (answer.contains("error")) throw SpeakerError(fmt::format("{} says: {}", name_, answer.at("error").dump()));
    if (answer.at("id") != question_id || answer.at("flights").size() != starts.size())
      throw SpeakerError(name_ + " answers something else");
    EngineFlights flights;
    flights.seconds = answer.at("seconds").get<double>();
    for (const json& answered : answer.at("flights")) {
      EngineFlights::Flight& flight = flights.shots.emplace_back();
      for (const json& bodies : answered) {
        std::vector<BodyState>& at = flight.emplace_back();
        for (const json& body : bodies) {
          const auto number = [&body](std::size_t i) {  // JSON has no other word for what is not finite
            return body.at(i).is_null() ? std::numeric_limits<double>::quiet_NaN() : body.at(i).get<double>();
          };
          at.push_back({{number(0), number(1), number(2)},
                        {number(3), number(4), number(5)},
                        {number(6), number(7), number(8)}});
        }
        if (at.size() != starts.front().size()) throw SpeakerError(name_ + " answers of another number of bodies");
      }
      if (std::ssize(flight) != steps) throw SpeakerError(name_ + " answers with another number of steps");
    }
    return flights;
  }

  static constexpr int question_id = 1;  // a process is asked one thing at a time

  std::string name_;
  fs::path scripts_;
  std::mutex mutex_;  ///< of what follows
  std::vector<std::unique_ptr<Speaker>> idle_;
  bool failed_ = false;
};

}  // namespace

std::vector<Engine> npm_engines() { return npm_engines(THINWALL_NPM_ENGINES); }

std::vector<Engine> npm_engines(const fs::path& scripts) {
  std::vector<Engine> engines = known_engines();
  for (Engine& engine : engines) {
    engine.version = scripts.empty() ? "" : installed_version(scripts, engine.package);
    engine.integrity = integrity(scripts, engine.package);
    engine.made_of += fmt::format(" Version {} of {}.", engine.version, engine.package);
    engine.plays_stages = true;
    engine.remedy = "run `npm ci` in experiments/adapters/npm, configure with -DTHINWALL_PEERS=ON";
    if (engine.version.empty()) engine.modes.clear();
    const auto processes = std::make_shared<NpmProcesses>(engine.name, scripts);
    for (EngineMode& mode : engine.modes) {
      mode.play = [processes, name = mode.name](const EngineStage& stage, std::span<const EngineStart> starts,
                                                std::int64_t steps) {
        return processes->play(name, stage, starts, steps);
      };
    }
  }
  return engines;
}

}  // namespace thinwall
