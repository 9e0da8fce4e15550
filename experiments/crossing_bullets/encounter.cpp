#include <thinwall/experiments/crossing_bullets/encounter.hpp>

#include <cmath>

namespace thinwall {

namespace {

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
