#include <thinwall/experiments/swept_bounds/obstacles.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace thinwall {

namespace {

using Real = long double;

double both_signs(std::uint64_t word) { return 2 * uniform(word) - 1; }

/// The moving shape's core in the frame of its center: a ball's is a point.
struct Core {
  Vec3<Real> half_extents;
  Real radius;
};
Core core_of(const Sweep& s) {
  if (s.form == SweptForm::sphere) return {Vec3<Real>::Zero(), static_cast<Real>(s.width) / 2};
  return {half_extents(s).cast<Real>(), 0};
}

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
struct Times {
  std::array<Real, 8> sorted;
  std::size_t count;
};
Times times_of_change(const SquaredDistance& f) {
  Times times = {{0, 1}, 2};
  for (int i = 0; i < 3; ++i) {
    if (f.d[i] == 0) continue;
    for (const Real side : {-f.half_extents[i], f.half_extents[i]}) {
      const Real time = (f.p[i] - side) / f.d[i];
      if (0 < time && time < 1) times.sorted[times.count++] = time;
    }
  }
  std::sort(times.sorted.begin(), times.sorted.begin() + static_cast<std::ptrdiff_t>(times.count));
  return times;
}

Real least_squared(const SquaredDistance& f) {
  const Times times = times_of_change(f);
  Real least = std::min(f.at(0), f.at(1));
  for (std::size_t k = 0; k + 1 < times.count; ++k) {
    const Real from = times.sorted[k], to = times.sorted[k + 1];
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

}  // namespace

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
  double radius = ball_radius(s);
  if (!is_box) radius += s.width / 2;
  for (int i = 0; is_box && i < 3; ++i) reach[i] += outward[i] < 0 ? -half[i] : half[i];
  return {half_path + (reach + outward * radius) * (1 - inward), ball_radius(s)};
}

long double least_distance(const Sweep& s, const Vec3<double>& center) {
  const Core core = core_of(s);
  const SquaredDistance f = {center.cast<Real>(), path(s).cast<Real>(), core.half_extents};
  return std::max<Real>(0, std::sqrt(least_squared(f)) - core.radius);
}

bool touches(const Sweep& s, const Vec3<double>& center) {
  return least_distance(s, center) <= static_cast<Real>(ball_radius(s));
}

}  // namespace thinwall
