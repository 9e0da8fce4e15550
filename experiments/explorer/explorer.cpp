#include <thinwall/experiments/explorer/explorer.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <thinwall/experiments/advise/advice.hpp>
#include <thinwall/experiments/lab/method_looks.hpp>
#include <thinwall/experiments/lab/statistics.hpp>
#include <thinwall/experiments/models/rods.hpp>
#include <thinwall/experiments/models/shot_methods.hpp>
#include <thinwall/swept/certified.hpp>

namespace thinwall {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr std::array<std::int64_t, 2> poses_a_step = {2, 8};  // always, also where the advice would offer others

// ---- What is handed over, be it of balls or of rods.

std::vector<double>& numbers() {
  static std::vector<double> all;
  return all;
}

int hand_over(std::vector<double> values) {
  numbers() = std::move(values);
  return static_cast<int>(numbers().size());
}

const char* say(std::string words) {
  static std::string text;
  text = std::move(words);
  return text.c_str();
}

/// A number that the page sets, and what it may be.
struct Given {
  const char* name;
  double value;
  const Range& range;
};

/// Why these cannot be; empty if they can.
std::string fault_of(std::initializer_list<Given> given, double seed) {
  for (const auto& [name, value, range] : given) {
    if (!contains(range, value)) return fmt::format("{}: {}", name, range_text("a number", range));
  }
  return seed >= 0 && seed < 0x1p53 && seed == std::trunc(seed) ? "" : "seed: a whole number below 2^53";
}

/// The methods with their looks, and the factors with what each is at first.
const char* offer(const auto& methods, std::initializer_list<Given> factors) {
  nlohmann::ordered_json all = {{"methods", nlohmann::ordered_json::array()},
                                {"factors", nlohmann::ordered_json::array()}};
  std::size_t steps = 0;
  for (const auto& method : methods) {
    const MethodLook* look = look_of(method.name);
    const int mark = look == nullptr ? 6 : look->name == "substeps" ? substeps_mark(steps++) : look->point_type;
    all["methods"].push_back(
        {{"name", method.name}, {"color", look == nullptr ? "#767676" : look->color}, {"mark", mark}});
  }
  for (const auto& [name, value, range] : factors) {
    all["factors"].push_back(
        {{"name", name}, {"unit", range.unit}, {"lower", range.lower}, {"upper", range.upper}, {"value", value}});
  }
  return say(all.dump());
}

/// `chance_at(ratio)` for `count` >= 2 ratios, evenly on a logarithmic scale.
std::vector<double> curve(double from, double to, int count, auto chance_at) {
  std::vector<double> chances;
  for (int i = 0; i < count; ++i) {
    const std::optional<double> chance = chance_at(from * std::pow(to / from, i / (count - 1.0)));
    chances.push_back(chance.value_or(none));
  }
  return chances;
}

/// The share of the trials that tunneled.
Measured tunneled_share(std::int64_t tunneled, std::int64_t trials) {
  return measured_share(tunneled, trials).value_or(Measured{none, {none, none}});
}

/// Where one trial saw a hit, of what first touches at `contact`.
double seen_at(const auto& tally, double contact) {
  return tally.tunneled > 0 ? none : tally.undecided > 0 ? -1 : contact + tally.latest;
}

// ---- Balls.

struct Balls {
  std::vector<ThinWallMethod> methods = thin_wall_methods(poses_a_step);
  Cell cell = bullet;
  std::uint64_t seed = 0;
  Target aimed = target(bullet);
  std::vector<Tally> tallies = std::vector<Tally>(methods.size());
  std::vector<StepCost> costs = {};  ///< of candidates_of(methods), once they have been timed

  const ThinWallMethod& method(int m) const { return methods.at(static_cast<std::size_t>(m)); }
  Wish wish(double miss, double late) const {
    return {.cell = cell, .miss = miss, .late = late < 0 ? std::nullopt : std::optional(late)};
  }
};

Balls& balls() {
  static Balls one;
  return one;
}

struct StepErrors {
  double wrong = 0, p99 = 0, largest = 0;
};

/// Against certified answers; a time between their two ends is right.
StepErrors errors_of(const ThinWallMethod& method, const std::vector<ShotStep>& steps, double length,
                     const std::vector<CertifiedToi>& truth) {
  StepErrors errors;
  std::vector<double> lengths;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const StepAnswer toi = method.answer(steps[i]);
    const bool hit = toi.status == ToiStatus::hit || toi.status == ToiStatus::overlapping,
               truly = truth[i].verdict == ToiStatus::hit || truth[i].verdict == ToiStatus::overlapping;
    errors.wrong += hit == truly ? 0 : 1;
    if (hit && truly) lengths.push_back(std::max({0.0, truth[i].lower - toi.time, toi.time - truth[i].upper}) * length);
  }
  if (lengths.empty()) return {errors.wrong, none, none};
  errors.p99 = quantile(lengths, 0.99);
  errors.largest = *std::ranges::max_element(lengths);
  return errors;
}

/// [ns] What the clock moves on by at least: a browser's by a tenth of a millisecond, or a whole one.
double clock_tick() {
  using Clock = std::chrono::steady_clock;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 5; ++i) {
    const auto start = Clock::now();
    auto now = start;
    while (now == start) now = Clock::now();
    least = std::min(least, std::chrono::duration<double, std::nano>(now - start).count());
  }
  return least;
}

/// Turns of so many ticks of the clock that it cannot decide, also of the fastest method.
TimingEffort race_effort() {
  constexpr std::int64_t queries = 1 << 12;
  constexpr double fastest = 30;  // [ns] a query, about
  const double turn = std::clamp(20 * clock_tick(), 2e6, 20e6);
  return {.queries = queries,
          .rounds = turn > 4e6 ? 5 : 15,
          .round_ns = turn,
          .repeats = static_cast<std::int64_t>(std::ceil(turn / (fastest * static_cast<double>(queries))))};
}

// ---- Rods.

constexpr Range allowed_length = {.lower = 0, .upper = 1e3, .lower_open = true, .unit = "m"};  // end to end
constexpr Range allowed_spin = {.lower = 0, .upper = 1e6, .unit = "rad/s"};
constexpr Range allowed_rod_radius = {.lower = 0, .upper = 1e3, .lower_open = true, .unit = "m"};

std::vector<RodMethod> all_rod_methods() {
  const std::vector<std::string_view> names = rod_method_names();
  return rod_methods(std::vector<std::string>(names.begin(), names.end()), poses_a_step);
}

struct Rods {
  std::vector<RodMethod> methods = all_rod_methods();
  RodFlight flight{
      .half_length = 0.1, .radius = 0.02, .thickness = 0.01, .tilt_deg = 90, .spin_deg = 0, .step_ratio = 1};
  std::uint64_t seed = 0;
  std::vector<RodTally> tallies = std::vector<RodTally>(methods.size());

  const RodMethod& method(int m) const { return methods.at(static_cast<std::size_t>(m)); }
};

Rods& rods() {
  static Rods one;
  return one;
}

}  // namespace

}  // namespace thinwall

using namespace thinwall;  // NOLINT(google-build-using-namespace): C has none

extern "C" {

const double* explorer_numbers() { return numbers().data(); }

const char* explorer_describe() {
  return offer(balls().methods, {{"speed", bullet.speed, allowed_speed},
                                 {"step", bullet.step, allowed_step},
                                 {"radius", bullet.radius, allowed_radius},
                                 {"thickness", bullet.thickness, allowed_thickness},
                                 {"angle_deg", bullet.angle_deg, allowed_angle}});
}

const char* explorer_set(double speed, double step, double radius, double thickness, double angle_deg, double seed) {
  const std::string fault = fault_of({{"speed", speed, allowed_speed},
                                      {"step", step, allowed_step},
                                      {"radius", radius, allowed_radius},
                                      {"thickness", thickness, allowed_thickness},
                                      {"angle_deg", angle_deg, allowed_angle}},
                                     seed);
  if (!fault.empty()) return say(fault);
  const Cell cell = {speed, step, radius, thickness, angle_deg, Wall::infinite, 0};
  if (const std::optional<CellFault> unfit = fault_of(cell))
    return say(fmt::format("{}: {}", unfit->key, unfit->expected));
  balls().cell = cell;
  balls().seed = static_cast<std::uint64_t>(seed);
  balls().aimed = target(cell);
  balls().tallies.assign(balls().methods.size(), Tally{});
  return say("");
}

void explorer_fire(int method, int count) {
  Tally& tally = balls().tallies.at(static_cast<std::size_t>(method));
  const RandomStream stream = random_stream(balls().cell, balls().seed);
  for (int i = 0; i < count; ++i) {
    const Vec3<double> start = random_start(balls().aimed, stream, static_cast<std::uint64_t>(tally.shots));
    balls().method(method).fire(balls().aimed, start, tally);
  }
}

int explorer_tally(int method) {
  const Tally& tally = balls().tallies.at(static_cast<std::size_t>(method));
  const Measured share = tunneled_share(tally.tunneled, tally.shots);
  const double seen = static_cast<double>(tally.detected());
  return hand_over({static_cast<double>(tally.shots), static_cast<double>(tally.tunneled),
                    static_cast<double>(tally.undecided), share.value, share.interval.lower, share.interval.upper,
                    seen > 0 ? static_cast<double>(tally.lateness) * balls().aimed.lateness_unit / seen : none,
                    seen > 0 ? tally.latest : none});
}

int explorer_theory(int method) {
  const Theory theory = balls().method(method).theory(balls().cell);
  return hand_over({theory.probability.value_or(none), theory.lateness ? theory.lateness->mean : none,
                    theory.largest_lateness().value_or(none)});
}

double explorer_step_ratio() { return step_length(balls().cell) / slab_chord(balls().cell); }

int explorer_curve(int method, double from, double to, int count) {
  return hand_over(curve(from, to, count, [&, cell = balls().cell](double ratio) mutable {
    cell.speed = ratio * slab_chord(cell) / cell.step;
    return balls().method(method).theory(cell).probability;
  }));
}

int explorer_shot(double phase) {
  const Target& aimed = balls().aimed;
  const Vec3<double> start = start_at_phase(aimed, phase);
  const double contact = path_to_contact(aimed, start);
  std::vector<double> shot = {
      start[0], start[1], aimed.displacement[0], aimed.displacement[1], aimed.half_extents[0], aimed.radius, contact};
  for (const ThinWallMethod& method : balls().methods) {
    Tally tally;
    method.fire(aimed, start, tally);
    shot.push_back(seen_at(tally, contact));
  }
  return hand_over(std::move(shot));
}

int explorer_race() {
  Balls& b = balls();
  b.costs = measure_costs(b.cell, candidates_of(b.methods), race_effort());
  std::vector<ShotStep> steps;
  std::vector<CertifiedToi> truth;
  for (std::uint64_t i = 0; i < 4096; ++i) {  // the step in which the ball touches, and the one before, in turn
    const ShotStep& step =
        steps.emplace_back(random_step(b.aimed, random_stream(b.cell, b.seed), i, i % 2 == 0 ? 0 : 1));
    truth.push_back(certified_time_of_impact(step.ball, step.wall));
  }
  std::vector<double> raced;
  for (std::size_t m = 0; m < b.methods.size(); ++m) {
    const Measured& time = b.costs[m].dearer();
    const StepErrors errors = errors_of(b.methods[m], steps, b.aimed.step_length, truth);
    raced.insert(raced.end(),
                 {time.value, time.interval.lower, time.interval.upper, errors.wrong, errors.p99, errors.largest});
  }
  return hand_over(std::move(raced));
}

const char* explorer_advice(double miss, double late) {
  if (balls().costs.empty()) return say("");
  return say(advice_sentence(advise(balls().wish(miss, late), candidates_of(balls().methods), balls().costs)));
}

const char* explorer_toml(double miss, double late) {
  const Wish wish = balls().wish(miss, late);
  return say(config_text(wish, candidates(wish)));
}

const double* explorer_rod_numbers() { return explorer_numbers(); }

const char* explorer_rod_describe() {
  return offer(rods().methods, {{"length", 0.2, allowed_length}, {"spin", 60, allowed_spin}});
}

const char* explorer_rod_set(double speed, double step, double radius, double thickness, double length, double spin,
                             double seed) {
  const std::string fault = fault_of({{"speed", speed, allowed_speed},
                                      {"step", step, allowed_step},
                                      {"radius", radius, allowed_rod_radius},
                                      {"thickness", thickness, allowed_thickness},
                                      {"length", length, allowed_length},
                                      {"spin", spin, allowed_spin}},
                                     seed);
  if (!fault.empty()) return say(fault);
  if (!(length > 2 * radius)) return say("length: more than twice the radius, end to end; what is shorter is a ball");
  RodFlight flight{.half_length = length / 2 - radius,
                   .radius = radius,
                   .thickness = thickness,
                   .tilt_deg = 90,
                   .spin_deg = spin * step * 180 / std::numbers::pi,
                   .step_ratio = 1};
  flight.step_ratio = speed * step / widest(flight);
  constexpr double most_ratio = 1e4, most_steps = 2000, most_turns = 100;  // what a page can wait for
  if (!(flight.step_ratio <= most_ratio))
    return say("length: a step is more than 10,000 times as long as rod and wall are wide together");
  if (flight.spin_deg > 360 * most_turns) return say("spin: no more than 100 turns a step");
  // The methods are asked from where the fastest point's path in a step is the way to the wall.
  const double fastest = radians(flight.spin_deg) * (flight.half_length + radius);
  if (!((widest(flight) + fastest) / step_length(flight) <= most_steps))
    return say("spin: rods that slow and spinning that fast take more than 2,000 steps to pass");
  rods().flight = flight;
  rods().seed = static_cast<std::uint64_t>(seed);
  rods().tallies.assign(rods().methods.size(), RodTally{});
  return say("");
}

int explorer_rod_cell() { return hand_over({rods().flight.step_ratio, rods().flight.spin_deg}); }

void explorer_rod_fire(int method, int count) {
  RodTally& tally = rods().tallies.at(static_cast<std::size_t>(method));
  tally += fly(rods().flight, rods().method(method), count, rods().seed, tally.trials);
}

int explorer_rod_tally(int method) {
  const RodTally& tally = rods().tallies.at(static_cast<std::size_t>(method));
  const Measured share = tunneled_share(tally.tunneled, tally.trials);
  return hand_over(
      {static_cast<double>(tally.trials), static_cast<double>(tally.tunneled), static_cast<double>(tally.undecided),
       static_cast<double>(tally.false_hits), share.value, share.interval.lower, share.interval.upper,
       rods().method(method).wall_theory(rods().flight).value_or(none), tally.lateness.mean().value_or(none)});
}

int explorer_rod_curve(int method, double from, double to, int count) {
  std::vector<double> chances = curve(from, to, count, [&, flight = rods().flight](double ratio) mutable {
    flight.step_ratio = ratio;
    return rods().method(method).wall_theory(flight);
  });
  chances.insert(chances.begin(), rods().flight.step_ratio);
  return hand_over(std::move(chances));
}

int explorer_rod_shot(int flight) {
  const RodFlight& c = rods().flight;
  const RodMotion motion = random_motion(c, random_stream(c, rods().seed), static_cast<std::uint64_t>(flight));
  const auto contact = static_cast<double>(motion.contact);
  std::vector<double> shot = {motion.half_length, motion.radius, c.thickness / 2,
                              motion.start,       motion.step,   motion.angle,
                              motion.spin,        contact,       static_cast<double>(motion.steps)};
  for (const RodMethod& method : rods().methods)
    shot.push_back(seen_at(fly(c, method, 1, rods().seed, flight), contact));
  return hand_over(std::move(shot));
}

#ifdef __wasm__  // what Debian's runtime library for WebAssembly was compiled to look for
extern const std::uintptr_t __stack_chk_guard = 0x2f8a16c3;  // NOLINT(bugprone-reserved-identifier): theirs
[[noreturn]] void __stack_chk_fail() { std::abort(); }       // NOLINT(bugprone-reserved-identifier): theirs
#endif
}
