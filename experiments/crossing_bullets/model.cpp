#include <thinwall/experiments/crossing_bullets/model.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace thinwall {

namespace {

/// The theory is integrated over a grid: it must see both the ball and the path.
constexpr double least_path = 0.01, longest_path = 1e4;  // in contact distances

void check(const Settings& settings, const Crossing& c) {
  const double path = faster_path(c).norm() / contact_distance(c);
  if (!(least_path <= path && path <= longest_path)) {
    settings.complain("speed", fmt::format("a path of {} to {} contact distances a step; speed {}, step {}, radius {} "
                                           "make {}",
                                           least_path, longest_path, c.speed, c.step, c.radius, path));
  }
  if (relative_path(c).norm() < least_path * contact_distance(c)) {
    settings.complain("angle_deg",
                      fmt::format("a relative path of at least {} contact distances; not so at ratio {}, angle_deg {}",
                                  least_path, c.ratio, c.angle_deg));
  }
}

Vec3<long double> start_offset(const Encounter& e) {
  return e.slower.shape.center.cast<long double>() - e.faster.shape.center.cast<long double>();
}
Vec3<long double> relative_motion(const Encounter& e) {
  return e.slower.displacement.cast<long double>() - e.faster.displacement.cast<long double>();
}
long double reach(const Encounter& e) {
  return static_cast<long double>(e.slower.shape.radius) + static_cast<long double>(e.faster.shape.radius);
}

}  // namespace

const Factors<Crossing>& crossing_factors() {
  static const Factors<Crossing> all = factors<Crossing>(
      numbers("speed", &Crossing::speed, {.lower = 0, .upper = 1e9, .lower_open = true, .unit = "m/s"},
              "Of the faster ball."),
      number("step", &Crossing::step, {.lower = 0, .upper = 1e3, .lower_open = true, .unit = "s"}, "Time step."),
      number("radius", &Crossing::radius, {.lower = 1e-9, .upper = 1e3, .unit = "m"}, "Of both balls."),
      numbers("ratio", &Crossing::ratio, {.lower = 0, .upper = 1}, "Speed of the slower ball over the faster one's."),
      numbers("angle_deg", &Crossing::angle_deg, {.lower = 0, .upper = 180, .unit = "deg"},
              "Between the motions: 0 is a chase, 180 is head-on; 0 if the slower ball rests."),
      numbers("offset", &Crossing::offset, {.lower = 1, .upper = 1000, .unit = "contact distances"},
              "Radius of the disc that closest approach is uniform over."));
  return all;
}

std::vector<Crossing> make_crossings(const Settings& settings, std::size_t each) {
  std::vector<Crossing> all = crossing_factors().cells(settings, each, {}, [&](Crossing& c) {
    if (c.ratio == 1 && c.angle_deg == 0) return false;  // no relative motion
    if (c.ratio == 0) c.angle_deg = 0;                   // what rests has no direction
    if (c != head_on) check(settings, c);
    return true;
  });
  if (all.empty())
    settings.complain("angle_deg", "an angle at which balls of equal speed move against each other: not 0");
  std::erase(all, head_on);
  all.insert(all.begin(), head_on);
  return all;
}

double contact_distance(const Crossing& c) { return 2 * c.radius; }

Vec3<double> faster_path(const Crossing& c) { return {c.speed * c.step, 0, 0}; }

Vec3<double> slower_path(const Crossing& c) {
  const double path = c.ratio * c.speed * c.step, angle = c.angle_deg * (std::numbers::pi / 180);
  if (c.angle_deg == 180) return {-path, 0, 0};  // the sine of pi is not 0
  return {path * std::cos(angle), path * std::sin(angle), 0};
}

Vec3<double> relative_path(const Crossing& c) { return slower_path(c) - faster_path(c); }

double longest_contact(const Crossing& c) { return 2 * contact_distance(c) / relative_path(c).norm(); }

bool is_parallel(const Crossing& c) { return c.ratio == 0 || c.angle_deg == 0 || c.angle_deg == 180; }

Encounter random_encounter(const Crossing& c, const RandomStream& stream, std::uint64_t trial) {
  const double contact = contact_distance(c), disc = c.offset * contact;
  const Vec3<double> a = faster_path(c), b = slower_path(c), d = relative_path(c);
  const double path = d.norm();
  const Vec3<double> across(-d[1] / path, d[0] / path, 0);  // with z, spans the plane across the relative motion
  for (std::uint64_t draw = 0;; ++draw) {
    const RandomWords words = random_words(stream, trial, draw);
    const double y = (2 * uniform(words[1]) - 1) * disc, z = (2 * uniform(words[2]) - 1) * disc;
    const double squared = y * y + z * z;
    if (squared > disc * disc) continue;
    const double half_chord = std::sqrt(std::max(0.0, contact * contact - squared));
    const double closest = uniform(words[0]) + half_chord / path;
    const Vec3<double> offset = across * y + Vec3<double>(0, 0, z);
    return {{{-a * closest, c.radius}, a}, {{offset - b * closest, c.radius}, b}};
  }
}

TrueContact true_contact(const Encounter& e) {
  using std::sqrt;
  const Vec3<long double> p = start_offset(e), v = relative_motion(e);
  const long double r = reach(e), vv = v.squaredNorm(), closing = -p.dot(v), apart = p.squaredNorm() - r * r;
  const long double discriminant = vv * r * r - cross(p, v).squaredNorm();  // no cancellation
  if (discriminant < 0) return {false, 1, 1};
  const long double root = sqrt(discriminant), until = (closing + root) / vv;
  if (apart <= 0) return {true, 0, until};
  if (closing <= 0) return {false, 1, 1};
  const long double time = apart / (closing + root);
  return {time <= 1, time, until};
}

double gap_at(const Encounter& e, double time) {
  const Vec3<long double> p = start_offset(e) + relative_motion(e) * static_cast<long double>(time);
  return static_cast<double>(p.norm() - reach(e));
}

}  // namespace thinwall
