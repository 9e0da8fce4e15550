#include <thinwall/experiments/scenes/scene.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numbers>
#include <string>

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <thinwall_embedded.hpp>

#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/random.hpp>
#include <thinwall/experiments/lab/text.hpp>
#include <thinwall/experiments/world/pairs.hpp>
#include <thinwall/experiments/world/world.hpp>

namespace thinwall {

namespace {

constexpr std::array<std::string_view, 5> shape_names = {"sphere", "box", "turned_box", "capsule", "none"};
constexpr std::array<std::string_view, 3> motion_names = {"free", "driven", "static"};
constexpr std::int64_t most_bodies = 2'000'000;

/// Of a length [m], a speed [m/s], an acceleration [m/s^2] or a mass [kg]: within the longest run no place leaves the world, and no
/// energy the range of doubles.
constexpr double most_of_a_scene = 1e30;
constexpr Range up_to_most(std::string_view unit, double lower = -most_of_a_scene) {
  return {.lower = lower, .upper = most_of_a_scene, .unit = unit};
}
constexpr Range coordinate_range = up_to_most("m"), speed_range = up_to_most("m/s"), length_range = up_to_most("m", 0);

Vec3<double> vector3(const Settings& settings, std::string_view key, const Range& range) {
  const std::array<double, 3> values = settings.vector(key, range);
  return {values[0], values[1], values[2]};
}

/// The keys that one shape has and another has not.
struct ShapeKey {
  std::string_view key;
  bool fits, needed;
};

void check_keys(const Settings& body, const std::string& shape) {
  const bool round = shape == "sphere" || shape == "capsule", box = shape == "box" || shape == "turned_box";
  for (const ShapeKey& k :
       {ShapeKey{"radius", round, round}, ShapeKey{"size", box, box},
        ShapeKey{"turn_deg", shape == "turned_box", false}, ShapeKey{"height", shape == "capsule", shape == "capsule"},
        ShapeKey{"axis", shape == "capsule", false}, ShapeKey{"at", shape != "none", false},
        ShapeKey{"every", shape != "none", false}, ShapeKey{"jitter", shape != "none", false}}) {
    if (k.needed) body.require(k.key, fmt::format("a {} needs it", shape));
    if (!k.fits && body.given(k.key)) body.complain(k.key, fmt::format("it is not of shape '{}'", shape));
  }
}

Mat3<double> turned(const Vec3<double>& degrees) {
  const Vec3<double> angles = degrees * (std::numbers::pi / 180);
  using Eigen::AngleAxisd;
  return (AngleAxisd(angles[2], Vec3<double>::UnitZ()) * AngleAxisd(angles[1], Vec3<double>::UnitY()) *
          AngleAxisd(angles[0], Vec3<double>::UnitX()))
      .toRotationMatrix();
}

AnyShape read_shape(const Settings& body, const Vec3<double>& at) {
  body.require("shape", "\"sphere\", \"box\", \"turned_box\", \"capsule\" or \"none\"");
  const std::string shape = body.choice("shape", shape_names);
  check_keys(body, shape);
  if (shape == "sphere") return Sphere<double>{at, body.number("radius", length_range)};
  if (shape == "box") return Aabb<double>{at, vector3(body, "size", length_range) / 2};
  if (shape == "turned_box") {
    return Obb<double>{at, vector3(body, "size", length_range) / 2, turned(vector3(body, "turn_deg", {.unit = "deg"}))};
  }
  if (shape == "capsule") {
    const double radius = body.number("radius", length_range), height = body.number("height", length_range);
    if (height < 2 * radius) body.complain("height", fmt::format("at least twice the radius, {} m", 2 * radius));
    const Vec3<double> axis = vector3(body, "axis", {.lower = -1e6, .upper = 1e6});
    if (axis == Vec3<double>::Zero()) body.complain("axis", "not zero");
    const Vec3<double> half = axis.stableNormalized() * (height / 2 - radius);
    return Capsule<double>{at - half, at + half, radius};
  }
  return std::monostate{};
}

/// Uniform in a box around zero of these widths.
Vec3<double> shaken(const Vec3<double>& widths, const RandomStream& stream, std::uint64_t copy, std::uint64_t draw) {
  const RandomWords words = random_words(stream, copy, draw);
  Vec3<double> by;
  for (int i = 0; i < 3; ++i) by[i] = widths[i] * (uniform(words[static_cast<std::size_t>(i)]) - 0.5);
  return by;
}

constexpr std::int64_t most_id = std::numeric_limits<std::uint32_t>::max();

/// The ids that are taken: the first of each range by its last.
using TakenIds = std::map<std::int64_t, std::int64_t>;

/// Takes `count` ids in a row, and returns the first: the one that is given, or the next from which on all are free.
std::uint32_t take_ids(const Settings& body, std::int64_t count, std::int64_t next, TakenIds& taken) {
  const std::int64_t given = body.integer("id", 0, most_id);
  std::int64_t first = given > 0 ? given : next;
  for (auto at = taken.lower_bound(first); at != taken.end() && at->second < first + count; ++at) {
    if (given > 0) body.complain("id", fmt::format("a body before it has id {}", std::max(first, at->second)));
    first = at->first + 1;
  }
  if (first + count - 1 > most_id)
    body.complain("id", fmt::format("it takes {} from {} on, and the last there is is {}", count, first, most_id));
  taken[first + count - 1] = first;
  return static_cast<std::uint32_t>(first);
}

/// One [[body]] and its copies, appended.
void append(const Settings& settings, std::uint64_t seed, std::vector<Body>& bodies, TakenIds& taken) {
  settings.reject_unknown_keys();
  const Vec3<double> at = vector3(settings, "at", coordinate_range);
  Body body;
  body.shape = read_shape(settings, at);
  const std::string name = settings.text("name"), motion = settings.choice("motion", motion_names);
  body.is_static = motion == "static";
  body.velocity = vector3(settings, "velocity", speed_range);
  if (body.is_static && settings.given("velocity") && body.velocity != Vec3<double>::Zero())
    settings.complain("velocity", "zero: the body is static");
  body.angular_velocity = vector3(settings, "angular_velocity", {.lower = -1e6, .upper = 1e6, .unit = "rad/s"});
  const bool spins = body.angular_velocity != Vec3<double>::Zero();
  if (spins && settings.given("turns") && !settings.flag("turns"))
    settings.complain("turns", "true: the body has an angular velocity");
  body.turns = settings.flag("turns") || spins;
  const std::string key = spins ? "angular_velocity" : "turns";
  if (spins && body.is_static) settings.complain(key, "zero: the body is static");
  if (body.turns && std::holds_alternative<Aabb<double>>(body.shape))
    settings.complain(key, "a box does not turn: write turned_box");
  if (body.turns && std::holds_alternative<std::monostate>(body.shape))
    settings.complain(key, "a body of shape 'none' does not turn");
  if (motion != "free" && settings.given("mass"))
    settings.complain("mass", fmt::format("none: the body is {}", motion));
  const double mass = settings.number("mass", up_to_most("kg", 1e-30));
  body.mass = motion == "free" ? mass : std::numeric_limits<double>::infinity();
  body.restitution = settings.number("restitution", {.lower = 0, .upper = 1});
  body.gravity_scale = settings.number("gravity_scale", up_to_most("1"));
  body.group = static_cast<std::uint32_t>(settings.integer("group", 0, most_id));
  body.mask = static_cast<std::uint32_t>(settings.integer("mask", 0, most_id));

  std::array<std::int64_t, 3> copies{};
  const std::array<double, 3> counts = settings.vector("copies", {.lower = 1, .upper = 1e6});
  for (std::size_t i = 0; i < 3; ++i) {
    copies[i] = static_cast<std::int64_t>(counts[i]);
    if (static_cast<double>(copies[i]) != counts[i]) settings.complain("copies", "three whole numbers");
  }
  const double total = counts[0] * counts[1] * counts[2] + static_cast<double>(bodies.size());
  if (total > static_cast<double>(most_bodies))
    settings.complain("copies", fmt::format("at most {} bodies in all", most_bodies));
  const Vec3<double> every = vector3(settings, "every", coordinate_range),
                     jitter = vector3(settings, "jitter", length_range);
  const Vec3<double> speeds = vector3(settings, "velocity_jitter", up_to_most("m/s", 0));
  const Vec3<double> size = size_of(body);
  const RandomStream stream{seed, stream_of(std::array{at[0], at[1], at[2], size[0], size[1], size[2], counts[0],
                                                       counts[1], counts[2], every[0], every[1], every[2]})};

  const std::int64_t count = copies[0] * copies[1] * copies[2];
  std::uint32_t id = take_ids(settings, count, bodies.empty() ? 1 : std::int64_t{bodies.back().id} + 1, taken);
  const bool alone = count == 1;
  for (std::int64_t copy = 0; copy < count; ++copy) {
    const auto draw = static_cast<std::uint64_t>(copy);
    const Eigen::Matrix<std::int64_t, 3, 1> cell(copy % copies[0], copy / copies[0] % copies[1],
                                                 copy / copies[0] / copies[1]);
    Body& added = bodies.emplace_back(body);
    added.id = id++;
    added.name = alone || name.empty() ? name : fmt::format("{} {}", name, copy + 1);
    move_shape(added.shape, cell.cast<double>().cwiseProduct(every) + shaken(jitter, stream, draw, 0));
    added.velocity += shaken(speeds, stream, draw, 1);
  }
}

/// Every [[body]] of the file, copies made: a grid, and random numbers that depend on the seed, on the body's own place,
/// size and grid, and on the copy's place in it alone. Ids count up from 1, in the order of the file.
/// Throws UsageError: a key out of range, missing, or not of the shape; more than two million bodies.
std::vector<Body> read_bodies(const Settings& scene, std::uint64_t seed) {
  std::vector<Body> bodies;
  TakenIds taken;
  for (const Settings& body : scene.tables("body", embedded_toml("scene_body"))) append(body, seed, bodies, taken);
  return bodies;
}

constexpr std::array<std::string_view, 3> view_names = {"xy", "xz", "zy"};
constexpr std::array<std::string_view, 2> plan_names = {"lean", "full"};
constexpr std::string_view push_defaults = "time = 0\nbody = \"\"\nvelocity = [0, 0, 0]\n";
constexpr double most_positions = 4e6;  // of a trace: some 200 MB of text

std::string scene_name(const Settings& settings) {
  const std::string name = settings.text("scene");
  constexpr std::string_view plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-";
  if (name.empty() || name.size() > 60 || name.find_first_not_of(plain) != std::string::npos)
    settings.complain("scene", "a name of 1 to 60 letters, digits, _ and -");
  return name;
}

WorldOptions world_options(const Settings& settings, int threads) {
  WorldOptions options;
  options.gravity = vector3(settings, "gravity", up_to_most("m/s^2"));
  options.policy = policy_named(settings.choice("policy", policy_names));
  options.substeps = static_cast<int>(settings.integer("substeps", 1, 1000));
  options.max_events = static_cast<int>(settings.integer("max_events", 1, 1'000'000));
  options.contact_rounds = static_cast<int>(settings.integer("contact_rounds", 0, 1000));
  options.correction = settings.number("correction", {.lower = 0, .upper = 1});
  std::vector<std::string_view> broad_phases = pair_finder_names();
  broad_phases.insert(broad_phases.begin(), "auto");
  options.broad_phase = settings.choice("broad_phase", broad_phases);
  options.response = settings.flag("response");
  options.end_after = static_cast<int>(settings.integer("end_after", 1, 1'000'000));
  options.gate = settings.number("gate", {.lower = 0});
  options.full_plan = settings.choice("plan", plan_names) == "full";
  options.threads = threads;
  options.max_pairs = static_cast<std::size_t>(settings.integer("max_pairs", 1, std::int64_t(1) << 40));
  return options;
}

/// The bodies that a push may name; nothing where two share a name.
using Pushable = std::map<std::string_view, const Body*>;

Pushable pushable(const std::vector<Body>& bodies) {
  Pushable out;
  for (const Body& body : bodies) {
    if (body.is_static || body.name.empty()) continue;
    if (const auto [at, is_new] = out.emplace(body.name, &body); !is_new) at->second = nullptr;
  }
  return out;
}

Push read_push(const Settings& push, const Pushable& bodies) {
  push.reject_unknown_keys();
  push.require("body", "the name of the body that is pushed");
  const std::string name = push.text("body");
  const auto found = bodies.find(name);
  if (found == bodies.end()) {
    std::vector<std::string_view> names;
    for (auto at = bodies.begin(); at != bodies.end() && names.size() < 20; ++at) names.push_back(at->first);
    push.complain("body", "a body that moves, by its name; " + spelling_hint(name, names));
  }
  if (!found->second) push.complain("body", "a name that one moving body alone has; several have this one");
  const Vec3<double> velocity = vector3(push, "velocity", speed_range);
  return {push.number("time", {.lower = 0, .unit = "s"}), found->second->id, velocity};
}

void check_trace(const Settings& settings, const Scene& scene) {
  if (!scene.trace) return;
  double moving = 0;
  for (const Body& body : scene.bodies)
    moving += !can_move(body) ? 0 : body.turns ? 5 : 1;  // three axes, and at what rate
  const double frames = static_cast<double>(scene.steps) / static_cast<double>(scene.trace_every) + 1;
  if (moving * frames > most_positions) {
    settings.complain("trace_every",
                      fmt::format("at least {:.0f}: a trace has at most {:.0f} positions",
                                  static_cast<double>(scene.steps) * moving / most_positions + 1, most_positions));
  }
}

}  // namespace

Aabb<double> box_of(const Body& body) {
  const Aabb<double> none = {Vec3<double>::Zero(), Vec3<double>::Zero()};
  return of_shape(body.shape, none, [](const auto& held) -> Aabb<double> { return {center(held), half_widths(held)}; });
}

Vec3<double> size_of(const Body& body) { return 2 * box_of(body).half_extents; }

constexpr std::int64_t most_steps = 1'000'000;  // a run holds 1.2 kB of each until its tables are written

CompareKeys read_compare_keys(const Settings& settings) {
  CompareKeys keys;
  keys.policies = settings.choices("compare.policy", policy_names);
  keys.steps = settings.numbers("compare.dt", {.lower = 0, .upper = 1e6, .lower_open = true, .unit = "s"});
  std::sort(keys.steps.begin(), keys.steps.end());
  keys.finer = static_cast<int>(settings.integer("compare.finer", 1, 1000));
  keys.repeats = static_cast<int>(settings.integer("compare.repeats", 1, 100));
  return keys;
}

Scene read_scene(const Settings& settings, const RunOptions& options) {
  Scene scene;
  scene.name = scene_name(settings);
  settings.text("question");
  scene.dt = settings.number("dt", {.lower = 0, .upper = 1e6, .lower_open = true, .unit = "s"});
  scene.steps = options.trials.value_or(settings.integer("steps", 1, most_steps));
  if (scene.steps > most_steps) {
    throw UsageError(fmt::format("--trials: {} is not allowed; of a scene, its steps: a whole number from 1 to {}",
                                 scene.steps, most_steps));
  }
  scene.options = world_options(settings, options.threads);
  scene.bodies = read_bodies(settings, options.seed);
  if (const std::vector<Settings> pushes = settings.tables("push", push_defaults); !pushes.empty()) {
    const Pushable bodies = pushable(scene.bodies);
    for (const Settings& push : pushes) scene.pushes.push_back(read_push(push, bodies));
  }
  std::ranges::stable_sort(scene.pushes, {}, &Push::time);
  scene.trace = settings.flag("trace");
  scene.trace_every = settings.integer("trace_every", 1, 10'000'000);
  check_trace(settings, scene);
  const std::string view = settings.choice("view", view_names);
  scene.across = view[0] - 'x';
  scene.up = view[1] - 'x';
  read_compare_keys(settings);  // they are kept with the result, be it of `run`
  try {
    plan(scene.bodies, scene.options);
  } catch (const WorldError& error) {  // the world knows best
    throw UsageError(fmt::format("scene '{}': {}", scene.name, one_line(error.what())));
  }
  return scene;
}

}  // namespace thinwall
