#include <thinwall/experiments/explorer/explorer.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <thinwall/experiments/lab/method_looks.hpp>
#include <thinwall/experiments/lab/statistics.hpp>
#include <thinwall/experiments/models/rod_methods.hpp>
#include <thinwall/experiments/models/shots.hpp>

namespace thinwall {

namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr Range allowed_length = {.lower = 0, .upper = 1e3, .lower_open = true, .unit = "m"};  // end to end
constexpr Range allowed_spin = {.lower = 0, .upper = 1e6, .unit = "rad/s"};
constexpr Range allowed_rod_radius = {.lower = 0, .upper = 1e3, .lower_open = true, .unit = "m"};

std::vector<RodMethod> all_rod_methods() {
  const std::vector<std::string_view> names = rod_method_names();
  const std::vector<std::string> wanted(names.begin(), names.end());
  return rod_methods(wanted, std::array<std::int64_t, 2>{2, 8});
}

struct RodExplorer {
  std::vector<RodMethod> methods = all_rod_methods();
  RodFlight flight{
      .half_length = 0.1, .radius = 0.02, .thickness = 0.01, .tilt_deg = 90, .spin_deg = 0, .step_ratio = 1};
  std::uint64_t seed = 0;
  std::vector<RodTally> tallies = std::vector<RodTally>(methods.size());
  std::vector<double> numbers;
  std::string text;

  const char* say(std::string words) {
    text = std::move(words);
    return text.c_str();
  }
};

RodExplorer& rod() {
  static RodExplorer one;
  return one;
}

int say(std::vector<double> numbers) {
  rod().numbers = std::move(numbers);
  return static_cast<int>(rod().numbers.size());
}

nlohmann::ordered_json described_factor(const char* name, const Range& range, double value) {
  return {{"name", name}, {"unit", range.unit}, {"lower", range.lower}, {"upper", range.upper}, {"value", value}};
}

double theory_of(const RodMethod& method, const RodFlight& flight) {
  return method.wall_theory(flight).value_or(no_number);
}

}  // namespace

}  // namespace thinwall

using namespace thinwall;  // NOLINT(google-build-using-namespace): C has none

extern "C" {

const double* explorer_rod_numbers() { return rod().numbers.data(); }

const char* explorer_rod_describe() {
  nlohmann::ordered_json methods = nlohmann::ordered_json::array();
  for (const RodMethod& method : rod().methods) {
    const MethodLook* look = look_of(method.name);
    methods.push_back({{"name", method.name},
                       {"color", look == nullptr ? "#767676" : look->color},
                       {"mark", look == nullptr ? 6 : look->point_type}});
  }
  const nlohmann::ordered_json all = {
      {"methods", methods},
      {"factors", {described_factor("length", allowed_length, 0.2), described_factor("spin", allowed_spin, 60)}}};
  return rod().say(all.dump());
}

const char* explorer_rod_set(double speed, double step, double radius, double thickness, double length, double spin,
                             double seed) {
  for (const auto& [name, value, range] : {std::tuple("speed", speed, &allowed_speed),
                                           {"step", step, &allowed_step},
                                           {"radius", radius, &allowed_rod_radius},
                                           {"thickness", thickness, &allowed_thickness},
                                           {"length", length, &allowed_length},
                                           {"spin", spin, &allowed_spin}}) {
    if (!contains(*range, value)) return rod().say(fmt::format("{}: {}", name, range_text("a number", *range)));
  }
  if (!(seed >= 0 && seed < 0x1p53 && seed == std::trunc(seed))) return rod().say("seed: a whole number below 2^53");
  if (!(length > 2 * radius))
    return rod().say("length: more than twice the radius, end to end; what is shorter is a ball");
  RodFlight flight{.half_length = length / 2 - radius,
                   .radius = radius,
                   .thickness = thickness,
                   .tilt_deg = 90,
                   .spin_deg = spin * step * 180 / std::numbers::pi,
                   .step_ratio = 1};
  flight.step_ratio = speed * step / widest(flight);
  constexpr double most_ratio = 1e4, most_steps = 2000, most_turns = 100;  // what a page can wait for
  if (!(flight.step_ratio <= most_ratio))
    return rod().say("length: a step is more than 10,000 times as long as rod and wall are wide together");
  if (flight.spin_deg > 360 * most_turns) return rod().say("spin: no more than 100 turns a step");
  // The methods are asked from where the fastest point's path in a step is the way to the wall.
  const double fastest = radians(flight.spin_deg) * (flight.half_length + radius);
  if (!((widest(flight) + fastest) / step_length(flight) <= most_steps))
    return rod().say("spin: rods that slow and spinning that fast take more than 2,000 steps to pass");
  rod().flight = flight;
  rod().seed = static_cast<std::uint64_t>(seed);
  rod().tallies.assign(rod().methods.size(), RodTally{});
  return rod().say("");
}

int explorer_rod_cell() { return say({rod().flight.step_ratio, rod().flight.spin_deg}); }

void explorer_rod_fire(int method, int count) {
  RodTally& tally = rod().tallies.at(static_cast<std::size_t>(method));
  tally += fly(rod().flight, rod().methods.at(static_cast<std::size_t>(method)), count, rod().seed, tally.trials);
}

int explorer_rod_tally(int method) {
  const RodTally& tally = rod().tallies.at(static_cast<std::size_t>(method));
  const double theory = theory_of(rod().methods.at(static_cast<std::size_t>(method)), rod().flight);
  if (tally.trials == 0) return say({0, 0, 0, 0, no_number, no_number, no_number, theory, no_number});
  const Interval interval = wilson(tally.tunneled, tally.trials);
  const auto trials = static_cast<double>(tally.trials);
  return say({trials, static_cast<double>(tally.tunneled), static_cast<double>(tally.undecided),
              static_cast<double>(tally.false_hits), static_cast<double>(tally.tunneled) / trials, interval.lower,
              interval.upper, theory, tally.lateness.mean().value_or(no_number)});
}

int explorer_rod_curve(int method, double from, double to, int count) {
  std::vector<double> numbers{rod().flight.step_ratio};
  RodFlight flight = rod().flight;
  for (int i = 0; i < count; ++i) {
    flight.step_ratio = from * std::pow(to / from, i / (count - 1.0));
    numbers.push_back(theory_of(rod().methods.at(static_cast<std::size_t>(method)), flight));
  }
  return say(std::move(numbers));
}

int explorer_rod_shot(int flight) {
  const RodFlight& c = rod().flight;
  const RodMotion motion = random_motion(c, random_stream(c, rod().seed), static_cast<std::uint64_t>(flight));
  std::vector<double> numbers{motion.half_length,
                              motion.radius,
                              c.thickness / 2,
                              motion.start,
                              motion.step,
                              motion.angle,
                              motion.spin,
                              static_cast<double>(motion.contact),
                              static_cast<double>(motion.steps)};
  for (const RodMethod& method : rod().methods) {
    const RodTally tally = fly(c, method, 1, rod().seed, flight);
    numbers.push_back(tally.tunneled > 0    ? no_number
                      : tally.undecided > 0 ? -1
                                            : static_cast<double>(motion.contact) + tally.latest);
  }
  return say(std::move(numbers));
}
}
