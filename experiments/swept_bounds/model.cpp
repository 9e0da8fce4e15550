#include <thinwall/experiments/swept_bounds/model.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

namespace thinwall {

namespace {

/// Exact at the ends, where a sine or cosine would not be.
double cosine(double deg) { return deg == 90 ? 0 : std::cos(deg * (std::numbers::pi / 180)); }
double sine(double deg) { return deg == 90 ? 1 : std::sin(deg * (std::numbers::pi / 180)); }

/// Of the settings' values the one nearest to `wanted`.
double nearest(const Settings& settings, std::string_view factor, double wanted) {
  return std::ranges::min(settings.numbers(factor, {}), {}, [&](double x) { return std::abs(x - wanted); });
}

void check(const Settings& settings, const Sweep& s) {
  if (least_path <= path_in_widths(s) && path_in_widths(s) <= longest_path) return;
  settings.complain("speed", fmt::format("a path of {} to {} widths a step; speed {}, step {}, width {} make {}",
                                         least_path, longest_path, s.speed, s.step, s.width, path_in_widths(s)));
}

using Real = long double;

double both_signs(std::uint64_t word) { return 2 * uniform(word) - 1; }

/// The squared distance from a point that starts at `p` and moves by -d to a box around the origin, and half its derivative.
struct SquaredDistance {
  Vec3<Real> p, d, half_extents;

  /// Of the point, on one axis, from the box; signed.
  Real beside(int axis, Real time) const {
    const Real x = p[axis] - d[axis] * time, h = half_extents[axis];
    return x > h ? x - h : x < -h ? x + h : 0;
  }
  Real at(Real time) const {
    Real sum = 0;
    for (int i = 0; i < 3; ++i) sum += beside(i, time) * beside(i, time);
    return sum;
  }
  Real slope(Real time) const {
    Real sum = 0;
    for (int i = 0; i < 3; ++i) sum -= d[i] * beside(i, time);
    return sum;
  }
};

/// 0, 1, and the times in between at which the point passes the plane of a face: the slope is straight between them.
std::array<Real, 8> times_of_change(const SquaredDistance& f) {
  std::array<Real, 8> times = {0, 1, 1, 1, 1, 1, 1, 1};
  std::size_t next = 2;
  for (int i = 0; i < 3; ++i) {
    for (const Real side : {-f.half_extents[i], f.half_extents[i]}) {
      const Real time = f.d[i] == 0 ? 0 : (f.p[i] - side) / f.d[i];
      if (0 < time && time < 1) times[next++] = time;
    }
  }
  std::ranges::sort(times);
  return times;
}

Real least_squared(const SquaredDistance& f) {
  const std::array<Real, 8> times = times_of_change(f);
  Real least = std::min(f.at(0), f.at(1));
  for (std::size_t k = 0; k + 1 < times.size() && times[k] < 1; ++k) {
    const Real from = times[k], to = times[k + 1];
    const Real falls = -f.slope(from), rises = f.slope(to);
    least = std::min(least, f.at(to));
    if (falls > 0 && rises > 0) least = std::min(least, f.at(from + (to - from) * (falls / (falls + rises))));
  }
  return least;
}

Vec3<double> uniform_direction(const RandomStream& stream, std::uint64_t trial) {
  for (std::uint64_t draw = 2;; ++draw) {
    const RandomWords words = random_words(stream, trial, draw);
    const Vec3<double> v(both_signs(words[0]), both_signs(words[1]), both_signs(words[2]));
    const double squared = v.squaredNorm();
    if (0 < squared && squared <= 1) return v / std::sqrt(squared);
  }
}

/// Every fourth along an axis, every fourth to a corner, the others anywhere.
Vec3<double> outward_direction(const Vec3<double>& corner, const Mat3<double>& axes, const RandomStream& stream,
                               std::uint64_t trial) {
  const RandomWords words = random_words(stream, trial, 1);
  const auto sign = [&](std::size_t i) { return words[i] >> 63 != 0 ? 1.0 : -1.0; };
  if (trial % 4 == 0) return axes.col(static_cast<int>(3 * uniform(words[3]))) * sign(0);
  if (trial % 4 == 1) return Vec3<double>(corner[0] * sign(0), corner[1] * sign(1), corner[2] * sign(2)).normalized();
  return uniform_direction(stream, trial);
}

std::vector<Vec3<double>> edges(const Vec3<double>& half_extents, const Mat3<double>& axes) {
  std::vector<Vec3<double>> all;
  for (int i = 0; i < 3; ++i) all.emplace_back(axes.col(i) * (2 * half_extents[i]));
  return all;
}

double radius_around(const Sweep& s) { return s.form == SweptForm::sphere ? s.width / 2 : half_extents(s).norm(); }

/// The axes with the motion first and a rectangle around the box's shadow behind it, one side along the shadow of `edge`.
Mat3<double> axes_with_edge(const Vec3<double>& motion, int edge) {
  Mat3<double> axes;
  axes.col(0) = motion;
  axes.col(1) = (axis_vector<double>(edge) - motion * motion[edge]).normalized();
  axes.col(2) = cross<double>(axes.col(0), axes.col(1));
  return axes;
}

/// Of the three rectangles that may have the least area. Along an axis, the box's own.
Mat3<double> fitted_axes(const Sweep& s) {
  const Vec3<double> motion = direction(s);
  if (motion.cwiseAbs().maxCoeff() == 1) return Mat3<double>::Identity();
  const RoundedZonotope box = {edges(half_extents(s), Mat3<double>::Identity()), 0};
  const std::array all = {axes_with_edge(motion, 0), axes_with_edge(motion, 1), axes_with_edge(motion, 2)};
  const auto area = [&](const Mat3<double>& axes) {
    return half_width(box, axes.col(1)) * half_width(box, axes.col(2));
  };
  return std::ranges::min(all, {}, area);
}

/// Half of the body's extents along the axes.
Vec3<double> half_widths(const RoundedZonotope& body, const Mat3<double>& axes) {
  return {half_width(body, axes.col(0)), half_width(body, axes.col(1)), half_width(body, axes.col(2))};
}

/// The part of `whole` that is not in `part`; what rounding alone can leave is none.
double rest(double whole, double part) {
  const double left = whole - part;
  return left > 64 * std::numeric_limits<double>::epsilon() * whole ? left : 0;
}

}  // namespace

const Factors<Sweep> sweep_factors = factors(
    choices("shape", &Sweep::form, swept_form_names, "What moves."),
    numbers("speed", &Sweep::speed, {.lower = 0, .upper = 1e9, .lower_open = true, .unit = "m/s"}, "Of the shape."),
    number("step", &Sweep::step, {.lower = 0, .upper = 1e3, .lower_open = true, .unit = "s"}, "Time step."),
    number("width", &Sweep::width, {.lower = 1e-9, .upper = 1e3, .unit = "m"},  // its cube is a double
           "Diameter of the sphere, longest edge of a box."),
    numbers("angle_deg", &Sweep::angle_deg, {.lower = 0, .upper = 90, .unit = "deg"},
            "Between the motion and x, the axis of plate and rod."),
    numbers("turn_deg", &Sweep::turn_deg, {.lower = 0, .upper = 90, .unit = "deg"},
            "Where to the motion leans: 0 towards y, 90 towards z."),
    numbers("obstacle", &Sweep::obstacle, {.lower = 0, .upper = 1000, .unit = "widths"},
            "Diameter of the balls at rest."));

SweepPlan make_sweeps(const Settings& settings, std::size_t each) {
  std::vector<Sweep> cells = sweep_factors.cells(settings, each, {}, [&](Sweep& s) {
    if (s.angle_deg == 0) s.turn_deg = 0;
    check(settings, s);
    return true;
  });
  std::ranges::stable_sort(cells, {}, &Sweep::form);
  Sweep view = diagonals[1];
  view.speed = nearest(settings, "speed", view.speed);
  view.step = cells.front().step;
  view.width = cells.front().width;
  view.angle_deg = nearest(settings, "angle_deg", view.angle_deg);
  view.turn_deg = view.angle_deg == 0 ? 0 : nearest(settings, "turn_deg", view.turn_deg);
  view.obstacle = nearest(settings, "obstacle", view.obstacle);
  SweepPlan plan = {.cells = {diagonals.begin(), diagonals.end()}, .view = view, .timed = {}};
  for (const Sweep& s : cells) {
    if (!is_diagonal(s)) plan.cells.push_back(s);
    Sweep timed = view;
    timed.form = s.form;
    timed.speed = s.speed;
    if (plan.timed.empty() || plan.timed.back() != timed) plan.timed.push_back(timed);
  }
  return plan;
}

bool is_diagonal(const Sweep& s) { return std::ranges::find(diagonals, s) != diagonals.end(); }

double path_in_widths(const Sweep& s) { return s.speed * s.step / s.width; }

double ball_radius(const Sweep& s) { return s.obstacle * s.width / 2; }

Vec3<double> half_extents(const Sweep& s) {
  constexpr double thin = 0.1;
  const double half = s.width / 2;
  if (s.form == SweptForm::plate) return {thin * half, half, half};
  if (s.form == SweptForm::rod) return {half, thin * half, thin * half};
  return {half, half, half};
}

Vec3<double> direction(const Sweep& s) {
  const double across = sine(s.angle_deg);
  return {cosine(s.angle_deg), across * cosine(s.turn_deg), across * sine(s.turn_deg)};
}

Vec3<double> path(const Sweep& s) { return direction(s) * (s.speed * s.step); }

Moving<Sphere<double>> moving_ball(const Sweep& s) { return {{Vec3<double>::Zero(), s.width / 2}, path(s)}; }

Moving<Aabb<double>> moving_box(const Sweep& s) { return {{Vec3<double>::Zero(), half_extents(s)}, path(s)}; }

RandomStream random_stream(const Sweep& s, std::uint64_t seed) {
  return {seed, stream_of(std::array{static_cast<double>(s.form), s.speed, s.step, s.width, s.angle_deg, s.turn_deg,
                                     s.obstacle})};
}

Sphere<double> ball_in(const BallRegion& region, const Sweep& s, const RandomStream& stream, std::uint64_t trial) {
  const RandomWords words = random_words(stream, trial, 0);
  const Vec3<double> place(both_signs(words[0]), both_signs(words[1]), both_signs(words[2]));
  return {region.middle + region.axes * place.cwiseProduct(region.half_extents), ball_radius(s)};
}

Sphere<double> grazing_ball(const Sweep& s, const Mat3<double>& axes, const RandomStream& stream, std::uint64_t trial) {
  constexpr double inward = 0x1p-20;
  const bool is_box = s.form != SweptForm::sphere;
  const Vec3<double> half = half_extents(s), half_path = path(s) / 2;
  const Vec3<double> outward = outward_direction(is_box ? half : Vec3<double>::Ones(), axes, stream, trial);
  Vec3<double> reach = half_path.dot(outward) < 0 ? Vec3<double>(-half_path) : half_path;
  const double radius = ball_radius(s) + (is_box ? 0 : s.width / 2);
  for (int i = 0; is_box && i < 3; ++i) reach[i] += outward[i] < 0 ? -half[i] : half[i];
  return {half_path + (reach + outward * radius) * (1 - inward), ball_radius(s)};
}

long double least_distance(const Sweep& s, const Vec3<double>& center) {
  const bool is_ball = s.form == SweptForm::sphere;  // whose core is a point
  const Vec3<Real> core = is_ball ? Vec3<Real>(Vec3<Real>::Zero()) : Vec3<Real>(half_extents(s).cast<Real>());
  const Real radius = is_ball ? static_cast<Real>(s.width) / 2 : 0;
  const SquaredDistance f = {center.cast<Real>(), path(s).cast<Real>(), core};
  return std::max<Real>(0, std::sqrt(least_squared(f)) - radius);
}

bool touches(const Sweep& s, const Vec3<double>& center) {
  return least_distance(s, center) <= static_cast<Real>(ball_radius(s));
}

SteinerNumbers steiner_numbers(const std::vector<Vec3<double>>& segments) {
  SteinerNumbers sum = {0, 0, 0};
  for (std::size_t i = 0; i < segments.size(); ++i) {
    sum.mean_curvature += std::numbers::pi * segments[i].norm();
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3<double> face = cross(segments[i], segments[j]);
      sum.area += 2 * face.norm();
      for (std::size_t k = 0; k < j; ++k) sum.volume += std::abs(face.dot(segments[k]));
    }
  }
  return sum;
}

double volume(const RoundedZonotope& body) {
  const SteinerNumbers of = steiner_numbers(body.segments);
  const double r = body.radius;
  return of.volume + r * (of.area + r * (of.mean_curvature + r * (4 * std::numbers::pi / 3)));
}

RoundedZonotope grown(RoundedZonotope body, double by) {
  body.radius += by;
  return body;
}

double half_width(const RoundedZonotope& body, const Vec3<double>& along) {
  double sum = body.radius;
  for (const Vec3<double>& segment : body.segments) sum += std::abs(segment.dot(along)) / 2;
  return sum;
}

FittedBody exact_body(const Sweep& s) {
  FittedBody exact = {{{}, 0}, fitted_axes(s)};
  if (s.form == SweptForm::sphere) {
    exact.body.radius = s.width / 2;
  } else {
    exact.body.segments = edges(half_extents(s), Mat3<double>::Identity());
  }
  exact.body.segments.push_back(path(s));
  return exact;
}

FittedBody enclosing_sphere_body(const Sweep& s) {
  return {{{}, radius_around(s) + path(s).norm() / 2}, Mat3<double>::Identity()};
}

FittedBody enclosing_aabb_body(const Sweep& s) {
  const Mat3<double> axes = Mat3<double>::Identity();
  return {{edges(half_extents(s) + path(s).cwiseAbs() / 2, axes), 0}, axes};
}

FittedBody capsule_body(const Sweep& s) { return {{{path(s)}, radius_around(s)}, fitted_axes(s)}; }

FittedBody box_around(const FittedBody& exact, const Mat3<double>& axes) {
  return {{edges(half_widths(exact.body, axes), axes), 0}, axes};
}

FittedBody oriented_box_body(const Sweep& s) {
  const FittedBody exact = exact_body(s);
  return box_around(exact, exact.axes);
}

double volume(const BallRegion& region) { return 8 * region.half_extents.prod(); }

BallRegion region_around(const FittedBody& bound, const Sweep& s, double room) {
  return {path(s) / 2, bound.axes, room * half_widths(grown(bound.body, ball_radius(s)), bound.axes)};
}

SweepTheory sweep_theory(const FittedBody& bound, const Sweep& s) {
  const RoundedZonotope exact = exact_body(s).body;
  const double of_exact = volume(grown(exact, ball_radius(s))), of_bound = volume(grown(bound.body, ball_radius(s)));
  const double drawn = volume(region_around(bound, s)), false_volume = rest(of_bound, of_exact);
  return {.touching = of_exact / drawn,
          .false_hits = false_volume / drawn,
          .false_fraction = false_volume / of_bound,
          .empty = rest(volume(bound.body), volume(exact)) / volume(bound.body)};
}

std::optional<double> path_to_turn_for(const Sweep& s) {
  const auto pays = [&](double widths) {
    Sweep at = s;
    at.speed = widths * s.width / s.step;
    return sweep_theory(oriented_box_body(at), at).false_fraction <
           sweep_theory(enclosing_aabb_body(at), at).false_fraction;
  };
  double shorter = least_path, longer = longest_path;
  if (s.form == SweptForm::sphere || pays(shorter) || !pays(longer)) return std::nullopt;
  for (int i = 0; i < 64; ++i) {
    const double middle = std::sqrt(shorter * longer);
    (pays(middle) ? longer : shorter) = middle;
  }
  return longer;
}

}  // namespace thinwall
