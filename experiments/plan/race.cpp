#include <thinwall/experiments/plan/race.hpp>

#include <algorithm>
#include <bit>
#include <ctime>
#include <mutex>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include <thinwall/experiments/scenes/missed.hpp>
#include <thinwall/experiments/world/world.hpp>

namespace thinwall {

namespace {

/// [s] of the processor, for this thread.
double thread_seconds() {
  std::timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Source: the 64-bit FNV-1a hash, by half words.
class Digest {
 public:
  void add(std::uint64_t word) {
    for (const std::uint64_t half : {word & 0xffffffff, word >> 32}) hash_ = (hash_ ^ half) * 0x100000001b3;
  }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
  void add(const Vec3<double>& v) {
    for (int axis = 0; axis < 3; ++axis) add(v[axis]);
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325;
};

/// The state, and what was asked for: hits where anybody could read them, events where they are read.
void add_step(Digest& digest, const World& world) {
  digest.add(world.state_hash());
  if (world.options().response || world.options().events) {
    for (const Hit& hit : world.hits()) {
      digest.add((std::uint64_t{hit.first} << 32) + hit.second);
      digest.add(hit.time);
      digest.add(hit.normal);
      digest.add(hit.point);
    }
  }
  for (const CollisionEvent& event : world.events().events()) {
    digest.add((std::uint64_t{event.first} << 32) + event.second);
    digest.add(static_cast<std::uint64_t>(event.kind));
    digest.add(event.time);
  }
}

/// Steps the scene once; the clock runs within the steps alone.
void run_once(const PlanScene& scene, const WorldOptions& options, std::int64_t steps, Way& way) {
  const bool first = way.milliseconds.empty();
  World world(scene.bodies, options);
  Digest digest;
  double seconds = 0;
  for (std::int64_t step = 0; step < steps; ++step) {
    const double start = thread_seconds();
    const StepReport& report = world.step(plan_dt);
    seconds += thread_seconds() - start;
    add_step(digest, world);
    if (!first) continue;
    way.sweeps += static_cast<std::int64_t>(report.sweeps);
    way.gated += static_cast<std::int64_t>(report.gated);
    way.hits += static_cast<std::int64_t>(report.hits);
    way.bytes = std::max(way.bytes, static_cast<std::int64_t>(report.bytes));
  }
  if (first) way.outcome = digest.value();
  way.repeated_alike = way.repeated_alike && way.outcome == digest.value();
  way.milliseconds.push_back(1e3 * seconds / static_cast<double>(steps));
}

/// What the referee of scenes finds that the steps did not.
std::int64_t count_tunneled(const PlanScene& scene, const WorldOptions& options, std::int64_t steps) {
  if (!options.events && !options.response) return 0;  // no contact is looked for, so that none is missed
  World world(scene.bodies, options);
  MissedContacts referee(world);
  std::int64_t count = 0;
  for (std::int64_t step = 0; step < steps; ++step) {
    world.step(plan_dt);
    count += static_cast<std::int64_t>(referee.after_step(world, plan_dt).size());
  }
  return count;
}

}  // namespace

PlanRace race_plans(const PlanScene& scene, const PlanRaceOptions& options) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  PlanRace race{scene.name, static_cast<std::int64_t>(scene.bodies.size()), options.steps, {}, {}};
  std::vector<WorldOptions> all;
  const auto add = [&](const std::string& name, const WorldOptions& way) {
    race.ways.emplace_back().name = name;
    all.push_back(way);
  };
  add(lean_way, scene.options);
  const Plan lean = plan(scene.bodies, scene.options);
  for (const PlanLine& line : lean.lines) {
    if (!line.omitted) continue;
    race.plan += (race.plan.empty() ? "" : ", ") + line.what;
    WorldOptions kept = scene.options;
    kept.keep = {line.what};
    add(line.what, kept);
  }
  WorldOptions full = scene.options, gated = scene.options;
  full.full_plan = true;
  gated.gate = options.gate;
  add(full_way, full);
  add(gate_way, gated);
  for (std::int64_t round = 0; round < options.rounds; ++round) {
    for (std::size_t k = 0; k < all.size(); ++k) run_once(scene, all[k], options.steps, race.ways[k]);
  }
  for (const std::size_t k : {std::size_t{0}, all.size() - 1}) {
    race.ways[k].tunneled = count_tunneled(scene, all[k], options.steps);
  }
  return race;
}

const Way* way_named(const PlanRace& race, const std::string& name) {
  const auto found = std::find_if(race.ways.begin(), race.ways.end(), [&](const Way& w) { return w.name == name; });
  return found == race.ways.end() ? nullptr : &*found;
}

bool is_right(const PlanRace& race) {
  return race.ways.front().tunneled == 0 && std::all_of(race.ways.begin(), race.ways.end(), [&](const Way& way) {
           return way.repeated_alike && (way.name == gate_way || way.outcome == race.ways.front().outcome);
         });
}

std::string to_line(const PlanRace& race) {
  nlohmann::json out = {{"scene", race.scene}, {"bodies", race.bodies}, {"steps", race.steps}, {"plan", race.plan}};
  for (const Way& w : race.ways) {
    out["ways"].push_back(
        {w.name, w.outcome, w.repeated_alike, w.sweeps, w.gated, w.hits, w.tunneled, w.bytes, w.milliseconds});
  }
  return out.dump();
}

PlanRace plan_race_from_line(const std::string& line) {
  try {
    const auto in = nlohmann::json::parse(line);
    PlanRace race{in.at("scene"), in.at("bodies"), in.at("steps"), in.at("plan"), {}};
    for (const auto& w : in.at("ways")) {
      race.ways.push_back(
          {w.at(0), w.at(1), w.at(2), w.at(3), w.at(4), w.at(5), w.at(6), w.at(7), w.at(8).get<std::vector<double>>()});
    }
    if (race.ways.empty()) throw std::runtime_error("a race of plans without a way to step");
    return race;
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(std::string("not a race of plans: ") + error.what());
  }
}

}  // namespace thinwall
