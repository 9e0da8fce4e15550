#include <thinwall/experiments/swept_bounds/theory.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace thinwall {

namespace {

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
