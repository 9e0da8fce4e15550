#include <thinwall/experiments/models/rods.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include <thinwall/swept/turning/turning_impact.hpp>

namespace thinwall {

namespace {

using Real = long double;
constexpr Real half_turn = std::numbers::pi_v<Real>;  // [rad]

/// In [-pi/2, pi/2], and as good: a rod that has turned half around is the same rod.
Real without_half_turns(Real angle) { return std::remainder(angle, half_turn); }

/// The integral of  room - width cos(psi)  over psi from where that is positive to `end`; 0 if it is nowhere.
double room_left(double room, double width, double end) {
  const double begin = room >= width ? 0 : std::acos(room / width);
  if (begin >= end) return 0;
  return room * (end - begin) - width * (std::sin(end) - std::sin(begin));
}

}  // namespace

RandomStream random_stream(const RodFlight& c, std::uint64_t seed) {
  return {seed, stream_of(std::array{c.half_length, c.radius, c.thickness, c.tilt_deg, c.spin_deg, c.step_ratio})};
}

RandomStream random_stream(const BladePass& c, std::uint64_t seed) {
  return {seed, stream_of(std::array{c.half_length, c.radius, c.post_radius, c.post_distance, c.post_spin_deg})};
}

double radians(double degrees) { return degrees * (std::numbers::pi / 180); }
double clearance(const RodFlight& c) { return c.thickness + 2 * c.radius; }
double reach(const RodFlight& c) { return c.half_length * std::sin(radians(c.tilt_deg)); }
double widest(const RodFlight& c) { return clearance(c) + 2 * reach(c); }
double step_length(const RodFlight& c) { return c.step_ratio * widest(c); }
double half_window(const BladePass& c) { return std::asin((c.radius + c.post_radius) / c.post_distance); }

Moving<Obb<double>> wall(const RodFlight& c) {
  const double wide = 4 * (c.half_length + c.radius);
  return at_rest(Obb<double>{Vec3<double>::Zero(), {c.thickness / 2, wide, wide}, Mat3<double>::Identity()});
}

Moving<Capsule<double>> post(const BladePass& c) {
  const Vec3<double> middle(c.post_distance, 0, 0), half(0, 0, 2 * c.half_length);
  return at_rest(Capsule<double>{middle - half, middle + half, c.post_radius});
}

RodMotion random_motion(const RodFlight& c, const RandomStream& stream, std::uint64_t trial) {
  const RandomWords words = random_words(stream, trial, 0);
  const double tilt = radians(c.tilt_deg), spin = radians(c.spin_deg), step = step_length(c);
  const double half = clearance(c) / 2, far = half + reach(c);
  const double before = 1 + std::ceil(spin * (reach(c) + c.radius) / step);  // [steps]
  RodMotion m = {.half_length = c.half_length,
                 .radius = c.radius,
                 .axis = {std::cos(tilt), std::sin(tilt), 0},
                 .across = {std::sin(tilt), -std::cos(tilt), 0},
                 .beyond = {0, 0, -1},
                 .start = -(far + (before + 1 - uniform(words[0])) * step),
                 .step = step,
                 .angle = 2 * std::numbers::pi * uniform(words[1]),
                 .spin = spin,
                 .steps = 0,
                 .contact = 0};
  m.steps = static_cast<std::int64_t>((far - m.start) / step) + 1;
  m.contact = first_contact(-Real(m.start) - Real(half), step, reach(c), m.angle, spin);
  return m;
}

RodMotion random_motion(const BladePass& c, const RandomStream& stream, std::uint64_t trial) {
  const double window = half_window(c), spin = radians(c.post_spin_deg);
  const double phase = 1 - uniform(random_words(stream, trial, 0)[0]);
  const double angle = -window - phase * spin;
  return {.half_length = c.half_length,
          .radius = c.radius,
          .axis = {0, 0, 1},
          .across = {1, 0, 0},
          .beyond = {0, 1, 0},
          .start = 0,
          .step = 0,
          .angle = angle,
          .spin = spin,
          .steps = static_cast<std::int64_t>((window - angle) / spin) + 1,
          .contact = (-std::asin(Real(c.radius + c.post_radius) / Real(c.post_distance)) - Real(angle)) / Real(spin)};
}

Turning<Capsule<double>> step_of(const RodMotion& m, std::int64_t k) {
  const Real time = static_cast<Real>(k), angle = Real(m.angle) + time * Real(m.spin);
  const Vec3<double> middle(static_cast<double>(Real(m.start) + time * Real(m.step)), 0, 0);
  const Vec3<double> along =
      m.across * static_cast<double>(std::cos(angle)) + m.beyond * static_cast<double>(std::sin(angle));
  const Vec3<double> half = along * m.half_length;
  return {Capsule<double>{middle - half, middle + half, m.radius}, Vec3<double>(m.step, 0, 0), m.axis * m.spin};
}

double gap_at(const RodFlight& c, const RodMotion& m, long double time) {
  const Real x = Real(m.start) + time * Real(m.step), angle = Real(m.angle) + time * Real(m.spin);
  return static_cast<double>(std::abs(x) - Real(clearance(c)) / 2 - Real(reach(c)) * std::abs(std::cos(angle)));
}

double gap_at(const BladePass& c, const RodMotion& m, long double time) {
  const Real angle = Real(m.angle) + time * Real(m.spin);
  const Real along = Real(c.post_distance) * std::cos(angle), off = Real(c.post_distance) * std::sin(angle);
  const Real beyond = std::max<Real>(0, std::abs(along) - Real(c.half_length));
  return static_cast<double>(std::hypot(beyond, off) - Real(c.radius + c.post_radius));
}

long double first_contact(long double lead, long double step, long double reach, long double angle, long double spin) {
  Real time = 0, phase = without_half_turns(angle);
  constexpr Real many =
      64;  // half turns before an end of the rod can reach the wall: so many are left out, fewer are walked
  const Real out_of_reach = std::floor(((lead - reach) / step * spin + phase) / half_turn + Real(0.5));
  if (out_of_reach > many) {
    time = ((out_of_reach - Real(0.5)) * half_turn - phase) / spin;
    phase -= out_of_reach * half_turn;
  }
  for (;;) {
    const Real end = spin > 0 ? (half_turn / 2 - phase) / spin : std::numeric_limits<Real>::infinity();
    while (time < end) {
      const Real at = phase + spin * time;
      const Real gap = lead - step * time - reach * std::cos(at), slope = reach * spin * std::sin(at) - step;
      if (gap <= 0) return time;
      if (slope >= 0) break;  // convex, and it rises already
      const Real next = time - gap / slope;
      if (!(next > time)) return time;
      time = next;
    }
    time = end;
    phase -= half_turn;
  }
}

double rod_miss_probability(double clearance, double reach, double step, double spin) {
  const double room = (step - clearance) / 2;
  const double a = std::abs(std::cos(spin / 2)), b = std::abs(std::sin(spin / 2));
  if (room <= reach * a * b) return 0;
  const double meet = std::atan2(a, b);  // where a cos(psi) == b sin(psi)
  const double sum = room_left(room, reach * a, meet) + room_left(room, reach * b, std::numbers::pi / 2 - meet);
  return std::clamp(2 * sum / (std::numbers::pi / 2) / step, 0.0, 1.0);
}

double long_step_miss_probability(double clearance, double reach, double step) {
  return 1 - (clearance + 4 * reach / std::numbers::pi) / step;
}

double blade_miss_probability(double window, double spin) { return std::max(0.0, 1 - window / spin); }

// ---- Methods.

namespace {

using Chance = std::optional<double>;

double pose_theory(const RodFlight& c, int poses) {
  return rod_miss_probability(clearance(c), reach(c), step_length(c) / poses, radians(c.spin_deg) / poses);
}
double pose_theory(const BladePass& c, int poses) {
  return blade_miss_probability(2 * half_window(c), radians(c.post_spin_deg) / poses);
}

// Which theory is whose, at the wall and at the post. A method that is not named here has none, and its cells say so.

template <class Method> Chance rod_theory(const Method&, const auto&) { return {}; }
Chance rod_theory(const EndOfStep<double>&, const auto& cell) { return pose_theory(cell, 1); }
Chance rod_theory(const Substeps<double>& method, const auto& cell) { return pose_theory(cell, method.n); }
/// The sweeps join, across the wall's middle. At the post there is no path to sweep: a pose.
Chance rod_theory(const LinearSweep<double>&, const RodFlight&) { return 0; }
Chance rod_theory(const LinearSweep<double>&, const BladePass& cell) { return pose_theory(cell, 1); }
Chance rod_theory(const Speculative<double>&, const auto&) { return 0; }
Chance rod_theory(const ConservativeAdvancement<double>&, const auto&) { return 0; }

template <class Method> RodClaims claims_of(const Method&) { return {}; }
RodClaims claims_of(const EndOfStep<double>&) { return {.never_late = false, .most_gap = 0}; }
RodClaims claims_of(const Substeps<double>&) { return {.never_late = false, .most_gap = 0}; }
RodClaims claims_of(const Speculative<double>&) { return {.never_late = true, .most_gap = {}}; }
RodClaims claims_of(const ConservativeAdvancement<double>& method) {
  return {.never_late = true, .most_gap = method.tolerance};
}

template <class Cell, class Ask>
void try_once(const Cell& cell, const RodMotion& motion, const Ask& ask, RodTally& tally) {
  constexpr double noticed = 0x1p-20;  // [steps]
  ++tally.trials;
  for (std::int64_t k = 0; k < motion.steps; ++k) {
    const Toi<double> toi = ask(step_of(motion, k));
    ++tally.steps;
    tally.evaluations += toi.evaluations;
    if (toi.status == ToiStatus::apart) continue;
    if (toi.status != ToiStatus::hit && toi.status != ToiStatus::overlapping) {
      ++tally.undecided;
      return;
    }
    const long double time = static_cast<long double>(k) + static_cast<long double>(toi.time);
    const auto late = static_cast<double>(time - motion.contact);
    const double gap = gap_at(cell, motion, time);
    if (motion.contact > static_cast<long double>(k + 1) + noticed) ++tally.false_hits;
    if (late > noticed) ++tally.late;
    tally.lateness.add(late);
    tally.latest = std::max(tally.latest, late);
    tally.earliest = std::min(tally.earliest, late);
    tally.widest = std::max(tally.widest, gap);
    tally.deepest = std::min(tally.deepest, gap);
    return;
  }
  ++tally.tunneled;
}

template <class Cell, class Ask>
RodTally try_all(const Cell& cell, std::uint64_t seed, std::int64_t first, std::int64_t trials, const Ask& ask) {
  RodTally tally;
  const RandomStream stream = random_stream(cell, seed);
  for (std::int64_t i = first; i < first + trials; ++i)
    try_once(cell, random_motion(cell, stream, static_cast<std::uint64_t>(i)), ask, tally);
  return tally;
}

}  // namespace

std::vector<std::string_view> rod_method_names() { return type_names(TurningMethods<double>{}); }

std::vector<RodMethod> rod_methods(std::span<const std::string> names, std::span<const std::int64_t> substeps) {
  std::vector<RodMethod> all;
  const auto add = [&](const auto& method, std::string name) {
    const auto ask = [method](const auto& rod, const auto& obstacle) { return time_of_impact(method, rod, obstacle); };
    const auto theory = [method](const auto& cell) { return rod_theory(method, cell); };
    all.push_back({std::move(name), claims_of(method), ask, ask, theory, theory});
  };
  for_each_type(TurningMethods<double>{}, [&]<class Method>(TypeTag<Method>) {
    if (std::ranges::find(names, Method::name) == names.end()) return;
    if constexpr (std::is_same_v<Method, Substeps<double>>) {
      for (const std::int64_t n : substeps)
        add(Method{.n = static_cast<int>(n)}, fmt::format("{}_{}", Method::name, n));
    } else {
      add(Method{}, std::string(Method::name));
    }
  });
  return all;
}

RodTally fly(const RodFlight& c, const RodMethod& method, std::int64_t flights, std::uint64_t seed,
             std::int64_t first) {
  const auto ask = [&, obstacle = wall(c)](const auto& rod) { return method.at_wall(rod, obstacle); };
  return try_all(c, seed, first, flights, ask);
}

RodTally pass(const BladePass& c, const RodMethod& method, std::int64_t passes, std::uint64_t seed) {
  const auto ask = [&, obstacle = post(c)](const auto& blade) { return method.at_post(blade, obstacle); };
  return try_all(c, seed, 0, passes, ask);
}

}  // namespace thinwall
