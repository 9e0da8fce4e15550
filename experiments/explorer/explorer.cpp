#include <thinwall/experiments/explorer/explorer.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <thinwall/experiments/advise/advice.hpp>
#include <thinwall/experiments/lab/method_looks.hpp>
#include <thinwall/experiments/lab/statistics.hpp>
#include <thinwall/experiments/models/shot_methods.hpp>
#include <thinwall/swept/certified.hpp>

namespace thinwall {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr std::array<std::int64_t, 2> poses_a_step = {2, 8};  // always, also where the advice would offer others

std::vector<ThinWallMethod> all_methods() {
  const std::vector<std::string_view> names = method_names();
  const std::vector<std::string> wanted(names.begin(), names.end());
  return thin_wall_methods(wanted, poses_a_step, std::array<std::string, 1>{"double"});
}

struct Explorer {
  std::vector<ThinWallMethod> methods = all_methods();
  Cell cell = bullet;
  std::uint64_t seed = 0;
  Target aimed = target(bullet);
  std::vector<Tally> tallies = std::vector<Tally>(methods.size());
  std::vector<StepCost> costs;  ///< of candidates_of(methods), once they have been timed
  std::vector<double> numbers;
  std::string text;

  const ThinWallMethod& method(int m) const { return methods.at(static_cast<std::size_t>(m)); }
  Wish wish(double miss, double late) const {
    return {.cell = cell, .miss = miss, .late = late < 0 ? std::nullopt : std::optional(late)};
  }
  int say(std::initializer_list<double> values) {
    numbers = values;
    return static_cast<int>(numbers.size());
  }
  const char* say(std::string words) {
    text = std::move(words);
    return text.c_str();
  }
};

Explorer& here() {
  static Explorer one;
  return one;
}

/// Steps of shots before the one in which the ball touches, and that one, in turn.
std::vector<ShotStep> steps_of(const Explorer& explorer, std::uint64_t count) {
  const Target& aimed = explorer.aimed;
  const RandomStream stream = random_stream(explorer.cell, explorer.seed);
  std::vector<ShotStep> steps;
  for (std::uint64_t i = 0; i < count; ++i) {
    const double before = i % 2 == 0 ? 0 : 1;
    const Vec3<double> start = random_start(aimed, stream, i) - before * aimed.displacement;
    steps.push_back({{Sphere<double>{start, aimed.radius}, aimed.displacement},
                     at_rest(Aabb<double>{Vec3<double>::Zero(), aimed.half_extents})});
  }
  return steps;
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

nlohmann::ordered_json described(const ThinWallMethod& method) {
  const MethodLook* look = look_of(method.name);
  return {{"name", method.name},
          {"color", look == nullptr ? "#767676" : look->color},
          {"mark", look == nullptr ? 6 : look->point_type}};
}

nlohmann::ordered_json described(const char* name, const Range& range, double value) {
  return {{"name", name}, {"unit", range.unit}, {"lower", range.lower}, {"upper", range.upper}, {"value", value}};
}

}  // namespace

}  // namespace thinwall

using namespace thinwall;  // NOLINT(google-build-using-namespace): C has none

extern "C" {

const double* explorer_numbers() { return here().numbers.data(); }

const char* explorer_describe() {
  nlohmann::ordered_json methods = nlohmann::ordered_json::array();
  for (const ThinWallMethod& method : here().methods) methods.push_back(described(method));
  const nlohmann::ordered_json all = {
      {"methods", methods},
      {"factors",
       {described("speed", allowed_speed, bullet.speed), described("step", allowed_step, bullet.step),
        described("radius", allowed_radius, bullet.radius), described("thickness", allowed_thickness, bullet.thickness),
        described("angle_deg", allowed_angle, bullet.angle_deg)}}};
  return here().say(all.dump());
}

const char* explorer_set(double speed, double step, double radius, double thickness, double angle_deg, double seed) {
  const Cell cell = {.speed = speed,
                     .step = step,
                     .radius = radius,
                     .thickness = thickness,
                     .angle_deg = angle_deg,
                     .wall = Wall::infinite,
                     .wall_size = 0};
  for (const auto& [name, value, range] : {std::tuple("speed", speed, &allowed_speed),
                                           {"step", step, &allowed_step},
                                           {"radius", radius, &allowed_radius},
                                           {"thickness", thickness, &allowed_thickness},
                                           {"angle_deg", angle_deg, &allowed_angle}}) {
    if (!contains(*range, value)) return here().say(fmt::format("{}: {}", name, range_text("a number", *range)));
  }
  if (!(seed >= 0 && seed < 0x1p53 && seed == std::trunc(seed))) return here().say("seed: a whole number below 2^53");
  if (const std::optional<CellFault> fault = fault_of(cell))
    return here().say(fmt::format("{}: {}", fault->key, fault->expected));
  here().cell = cell;
  here().seed = static_cast<std::uint64_t>(seed);
  here().aimed = target(cell);
  here().tallies.assign(here().methods.size(), Tally{});
  return here().say("");
}

void explorer_fire(int method, int count) {
  Tally& tally = here().tallies.at(static_cast<std::size_t>(method));
  const RandomStream stream = random_stream(here().cell, here().seed);
  for (int i = 0; i < count; ++i) {
    const Vec3<double> start = random_start(here().aimed, stream, static_cast<std::uint64_t>(tally.shots));
    here().method(method).fire(here().aimed, start, tally);
  }
}

int explorer_tally(int method) {
  const Tally& tally = here().tallies.at(static_cast<std::size_t>(method));
  const double shots = static_cast<double>(tally.shots), seen = static_cast<double>(tally.detected());
  if (tally.shots == 0) return here().say({0, 0, 0, none, none, none, none, none});
  const Interval interval = wilson(tally.tunneled, tally.shots);
  return here().say({shots, static_cast<double>(tally.tunneled), static_cast<double>(tally.undecided),
                     static_cast<double>(tally.tunneled) / shots, interval.lower, interval.upper,
                     seen > 0 ? static_cast<double>(tally.lateness) * here().aimed.lateness_unit / seen : none,
                     seen > 0 ? tally.latest : none});
}

int explorer_theory(int method) {
  const Theory theory = here().method(method).theory(here().cell);
  return here().say({theory.probability.value_or(none), theory.lateness ? theory.lateness->mean : none,
                     theory.largest_lateness().value_or(none)});
}

double explorer_step_ratio() { return step_length(here().cell) / slab_chord(here().cell); }

int explorer_curve(int method, double from, double to, int count) {
  here().numbers.clear();
  Cell cell = here().cell;
  for (int i = 0; i < count; ++i) {
    const double ratio = from * std::pow(to / from, i / (count - 1.0));
    cell.speed = ratio * slab_chord(cell) / cell.step;
    here().numbers.push_back(here().method(method).theory(cell).probability.value_or(none));
  }
  return count;
}

int explorer_shot(double phase) {
  const Target& aimed = here().aimed;
  const Vec3<double> start = start_at_phase(aimed, phase);
  const double contact = path_to_contact(aimed, start);
  here().say(
      {start[0], start[1], aimed.displacement[0], aimed.displacement[1], aimed.half_extents[0], aimed.radius, contact});
  for (const ThinWallMethod& method : here().methods) {
    Tally tally;
    method.fire(aimed, start, tally);
    here().numbers.push_back(tally.tunneled > 0 ? none : tally.undecided > 0 ? -1 : contact + tally.latest);
  }
  return static_cast<int>(here().numbers.size());
}

int explorer_race() {
  Explorer& explorer = here();
  explorer.costs = measure_costs(explorer.cell, candidates_of(explorer.methods), race_effort());
  const std::vector<ShotStep> steps = steps_of(explorer, 4096);
  std::vector<CertifiedToi> truth;
  for (const ShotStep& step : steps) truth.push_back(certified_time_of_impact(step.ball, step.wall));
  explorer.numbers.clear();
  for (std::size_t m = 0; m < explorer.methods.size(); ++m) {
    const Measured& time = explorer.costs[m].dearer();
    const StepErrors errors = errors_of(explorer.methods[m], steps, explorer.aimed.step_length, truth);
    for (const double number :
         {time.value, time.interval.lower, time.interval.upper, errors.wrong, errors.p99, errors.largest})
      explorer.numbers.push_back(number);
  }
  return static_cast<int>(explorer.numbers.size());
}

const char* explorer_advice(double miss, double late) {
  if (here().costs.empty()) return here().say("");
  return here().say(advice_sentence(advise(here().wish(miss, late), candidates_of(here().methods), here().costs)));
}

const char* explorer_toml(double miss, double late) {
  const Wish wish = here().wish(miss, late);
  return here().say(config_text(wish, candidates(wish)));
}

#ifdef __wasm__  // what Debian's runtime library for WebAssembly was compiled to look for
extern const std::uintptr_t __stack_chk_guard = 0x2f8a16c3;  // NOLINT(bugprone-reserved-identifier): theirs
[[noreturn]] void __stack_chk_fail() { std::abort(); }       // NOLINT(bugprone-reserved-identifier): theirs
#endif
}
