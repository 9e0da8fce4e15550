#include <thinwall/experiments/crossing_bullets/model.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <boost/math/quadrature/gauss.hpp>

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

/// [m] b, in one step.
Vec3<double> slower_path(const Crossing& c) {
  const double path = c.ratio * c.speed * c.step, angle = c.angle_deg * (std::numbers::pi / 180);
  if (c.angle_deg == 180) return {-path, 0, 0};  // the sine of pi is not 0
  return {path * std::cos(angle), path * std::sin(angle), 0};
}

/// Both fly along one line, or the slower one rests.
bool is_parallel(const Crossing& c) { return c.ratio == 0 || c.angle_deg == 0 || c.angle_deg == 180; }

Vec3<long double> start_offset(const Encounter& e) {
  return e.slower.shape.center.cast<long double>() - e.faster.shape.center.cast<long double>();
}
Vec3<long double> relative_motion(const Encounter& e) {
  return e.slower.displacement.cast<long double>() - e.faster.displacement.cast<long double>();
}
long double reach(const Encounter& e) {
  return static_cast<long double>(e.slower.shape.radius) + static_cast<long double>(e.faster.shape.radius);
}

using Gauss = boost::math::quadrature::gauss<double, 8>;
using Point = Eigen::Vector2d;

double distance_to_segment(const Point& p, const Point& from, const Point& to) {
  const Point edge = to - from;
  const double along = std::clamp((p - from).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
  return (p - from - along * edge).norm();
}

double winding(const Point& a, const Point& b) { return a[0] * b[1] - a[1] * b[0]; }

/// The parallelogram of all b w - a u, with u and w in [0, 1]: what the one sweeps, seen from what the other sweeps.
struct Parallelogram {
  Point a, b;

  double distance(const Point& p) const {
    const double area = winding(a, b);
    const double u = -winding(p, b) / area, w = -winding(p, a) / area;  // p = b w - a u
    if (0 <= u && u <= 1 && 0 <= w && w <= 1) return 0;
    const Point d = b - a;
    return std::min({distance_to_segment(p, {0, 0}, b), distance_to_segment(p, b, d), distance_to_segment(p, d, -a),
                     distance_to_segment(p, -a, {0, 0})});
  }
};

/// [m^3] Starts in the tube around the diagonal, farther from it than contact, that are within contact of the
/// parallelogram: over the plane, of the length above and below it.
double false_volume(const Crossing& c) {
  if (is_parallel(c) || c.offset == 1) return 0;
  const double contact = contact_distance(c), disc = c.offset * contact, path = relative_path(c).norm();
  const Vec3<double> x = relative_path(c) / path;
  const auto seen_along = [&](const Vec3<double>& v) { return Point(v.dot(x), x[0] * v[1] - x[1] * v[0]); };
  const Parallelogram swept = {seen_along(faster_path(c)), seen_along(slower_path(c))};
  // Across, in three pieces: the length has a root at the rim of the disc and where contact begins. y = m + h cos(turn).
  const double beyond = (disc - contact) / 2, outside = contact + beyond;
  constexpr int slices = 360, turns = 120;
  double sum = 0;
  for (const auto& [middle, half] :
       {std::array{-outside, beyond}, std::array{0.0, contact}, std::array{outside, beyond}}) {
    for (int j = 0; j < turns; ++j) {
      const double turn = (j + 0.5) / turns * std::numbers::pi;
      const double y = middle + half * std::cos(turn), width = half * std::sin(turn) * (std::numbers::pi / turns);
      const double rim = std::sqrt(std::max(0.0, disc * disc - y * y));
      const double touching = std::sqrt(std::max(0.0, contact * contact - y * y));
      for (int i = 0; i < slices; ++i) {
        const double near = swept.distance({(i + 0.5) / slices * path, y});
        if (near >= contact) continue;
        const double above = std::min(std::sqrt(contact * contact - near * near), rim);
        sum += 2 * std::max(0.0, above - touching) * width;
      }
    }
  }
  return sum * (path / slices);
}

struct Span {
  double from, to;
  bool empty() const { return !(from < to); }
};

/// The times u in [0, 1] at which |p - v u| <= reach.
Span times_within(const Vec3<double>& p, const Vec3<double>& v, double reach) {
  const double vv = v.squaredNorm(), along = p.dot(v);
  if (vv == 0) return p.norm() <= reach ? Span{0, 1} : Span{1, 0};
  const double discriminant = along * along - vv * (p.squaredNorm() - reach * reach);
  if (discriminant < 0) return {1, 0};
  const double root = std::sqrt(discriminant);
  return {std::max(0.0, (along - root) / vv), std::min(1.0, (along + root) / vv)};
}

/// Integrals over the starts from which the rule confirms a hit: 1, the lateness, and its square.
struct Moments {
  double volume = 0, late = 0, late_squared = 0;
};

/// Adds the starts whose ray enters the track at `entry`, a patch of `flux` [m^3] for a whole step.
void add_entry(const Crossing& c, const Vec3<double>& entry, double flux, Moments& sum) {
  const Vec3<double> a = faster_path(c), b = slower_path(c), d = b - a;
  const double contact = contact_distance(c), path = d.norm();
  const Span there = times_within(entry, b, contact);  // the other ball is close enough to the entry
  if (there.empty()) return;
  const Span before = times_within(entry, a, contact);  // had the ball started then, it would overlap at the start
  const std::array<Span, 2> pieces = before.empty()
                                         ? std::array<Span, 2>{there, Span{1, 0}}
                                         : std::array<Span, 2>{Span{there.from, std::min(there.to, before.from)},
                                                               Span{std::max(there.from, before.to), there.to}};
  for (const Span& piece : pieces) {
    if (piece.empty()) continue;
    const double middle = (piece.from + piece.to) / 2, half = (piece.to - piece.from) / 2;
    for (std::size_t k = 0; k < Gauss::abscissa().size(); ++k) {
      for (const double sign : {-1.0, 1.0}) {
        const double time = middle + sign * half * Gauss::abscissa()[k];
        const Vec3<double> start = entry - a * time;
        const double along = start.dot(d) / path;
        const double half_chord = std::sqrt(std::max(0.0, contact * contact - start.squaredNorm() + along * along));
        const double late = time - (along - half_chord) / path, weight = flux * half * Gauss::weights()[k];
        sum.volume += weight;
        sum.late += weight * late;
        sum.late_squared += weight * late * late;
      }
    }
  }
}

/// Over the part of the slower ball's track, a capsule, that the faster one's center can enter by.
Moments confirmed_moments(const Crossing& c) {
  const Vec3<double> a = faster_path(c), b = slower_path(c);
  const double r = c.radius, path = a.norm();
  Moments sum;
  // The two ends: a disc of the radius, seen along the motion. Upper half, twice.
  constexpr int rings = 48, sectors = 48;
  for (int i = 0; i < rings; ++i) {
    const double sine = std::sqrt((i + 0.5) / rings);
    for (int j = 0; j < sectors; ++j) {
      const double turn = (j + 0.5) / sectors * std::numbers::pi;
      const Vec3<double> normal(-std::sqrt(1 - sine * sine), sine * std::cos(turn), sine * std::sin(turn));
      const Vec3<double> end = normal.dot(b) > 0 ? b : Vec3<double>(0, 0, 0);
      add_entry(c, end + normal * r, std::numbers::pi * r * r / (rings * sectors) * path, sum);
    }
  }
  if (is_parallel(c)) return sum;
  // The side: by the track's length, and by how high above the plane.
  const double length = b.norm(), sine = b[1] / length;
  const Vec3<double> facing(-sine, b[0] / length, 0);  // across b in the plane, against a
  constexpr int slices = 800, heights = 32;
  for (int j = 0; j < heights; ++j) {
    const double tilt = (j + 0.5) / heights * (std::numbers::pi / 2);
    const Vec3<double> normal = facing * std::cos(tilt) + Vec3<double>(0, 0, std::sin(tilt));
    const double flux = 2 * path * sine * std::cos(tilt) * r * (std::numbers::pi / 2 / heights) * (length / slices);
    for (int i = 0; i < slices; ++i) add_entry(c, b * ((i + 0.5) / slices) + normal * r, flux, sum);
  }
  return sum;
}

/// [m^3] What the encounters are uniform over.
double tube_volume(const Crossing& c) {
  const double disc = c.offset * contact_distance(c);
  return std::numbers::pi * disc * disc * relative_path(c).norm();
}

/// Share of the encounters: the balls overlap at the end of the step.
double touch_at_end_theory(const Crossing& c) {
  const double contact = contact_distance(c), path = relative_path(c).norm();
  const double ball = 4 * std::numbers::pi / 3 * contact * contact * contact;
  const double short_of = std::max(0.0, 2 * contact - path);
  const double lens = std::numbers::pi * (4 * contact + path) * short_of * short_of / 12;  // overlaps at the start too
  return (ball - lens) / tube_volume(c);
}

}  // namespace

const Factors<Crossing> crossing_factors = factors<Crossing>(
    numbers("speed", &Crossing::speed, {.lower = 0, .upper = 1e9, .lower_open = true, .unit = "m/s"},
            "Of the faster ball."),
    number("step", &Crossing::step, {.lower = 0, .upper = 1e3, .lower_open = true, .unit = "s"}, "Time step."),
    number("radius", &Crossing::radius, {.lower = 1e-9, .upper = 1e3, .unit = "m"}, "Of both balls."),
    numbers("ratio", &Crossing::ratio, {.lower = 0, .upper = 1}, "Speed of the slower ball over the faster one's."),
    numbers("angle_deg", &Crossing::angle_deg, {.lower = 0, .upper = 180, .unit = "deg"},
            "Between the motions: 0 is a chase, 180 is head-on; 0 if the slower ball rests."),
    numbers("offset", &Crossing::offset, {.lower = 1, .upper = 1000, .unit = "contact distances"},
            "Radius of the disc that closest approach is uniform over."));

std::vector<Crossing> make_crossings(const Settings& settings, std::size_t each) {
  std::vector<Crossing> all = crossing_factors.cells(settings, each, {}, [&](Crossing& c) {
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

Vec3<double> relative_path(const Crossing& c) { return slower_path(c) - faster_path(c); }

double longest_contact(const Crossing& c) { return 2 * contact_distance(c) / relative_path(c).norm(); }

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

double touch_theory(const Crossing& c) { return 1 / (c.offset * c.offset); }

double false_overlap_theory(const Crossing& c) { return false_volume(c) / tube_volume(c); }

ConfirmedTheory confirmed_theory(const Crossing& c) {
  const Moments sum = confirmed_moments(c);
  if (sum.volume <= 0) return {0, 0, 0};
  const double mean = sum.late / sum.volume;
  return {sum.volume / tube_volume(c), mean, std::sqrt(std::max(0.0, sum.late_squared / sum.volume - mean * mean))};
}

CrossingTheory theory_of(const Crossing& c) {
  return {touch_theory(c), false_overlap_theory(c), touch_at_end_theory(c), confirmed_theory(c)};
}

}  // namespace thinwall
