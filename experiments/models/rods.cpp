#include <thinwall/experiments/models/rods.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

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

double fastest_path(const RodMotion& m) { return m.step + m.spin * (m.half_length + m.radius); }

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

}  // namespace thinwall
