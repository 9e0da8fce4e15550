#pragma once
/// Hit or miss without rounding, for cores that are points or boxes along the axes.
///
/// The squared distance of a moving point to a box is piecewise quadratic in time, with rational breakpoints and
/// minima: the least of them against the squared reach decides, however near the two are.

#include <algorithm>
#include <vector>

#include "support/pair.hpp"

namespace thinwall::oracle {

/// Where two bodies come nearest first, and whether they touch there.
struct ExactApproach {
  Rational time = 0;   ///< [1] the first time of least distance, in [0, 1]
  int sign = 0;        ///< of the least separation: -1 overlap, 0 exact touch, +1 apart
  int start_sign = 0;  ///< the same at time 0
};

/// The motion of a point past a box about the origin.
struct ExactMotion {
  Triple<Rational> start, displacement, half;

  Rational coordinate(std::size_t i, const Rational& time) const { return start[i] + time * displacement[i]; }

  /// How far coordinate i is beyond the box; signed, zero within.
  Rational beyond(std::size_t i, const Rational& time) const {
    const Rational x = coordinate(i, time);
    if (x > half[i]) return x - half[i];
    if (x < -half[i]) return x + half[i];
    return 0;
  }
  Rational squared_distance(const Rational& time) const {
    Rational sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Rational excess = beyond(i, time);
      sum += excess * excess;
    }
    return sum;
  }
};

inline Triple<Rational> exact(const Vector& v) { return {exact(v[0]), exact(v[1]), exact(v[2])}; }

inline ExactMotion exact_motion(const Pair& pair) {
  return {exact(pair.b.center) - exact(pair.a.center), exact(pair.b.displacement) - exact(pair.a.displacement),
          exact(pair.a.core.box) + exact(pair.b.core.box)};
}

/// 0, 1, and the times between at which a coordinate passes a face of the box; sorted.
inline std::vector<Rational> breakpoints(const ExactMotion& motion) {
  std::vector<Rational> times{0, 1};
  for (std::size_t i = 0; i < 3; ++i) {
    if (motion.displacement[i] == 0) continue;
    for (const int side : {-1, 1}) {
      const Rational time = (side * motion.half[i] - motion.start[i]) / motion.displacement[i];
      if (time > 0 && time < 1) times.push_back(time);
    }
  }
  std::sort(times.begin(), times.end());
  return times;
}

/// Where the quadratic that holds between two breakpoints is least, clamped to them.
inline Rational least_between(const ExactMotion& motion, const Rational& from, const Rational& to) {
  const Rational middle = (from + to) / 2;
  Rational slope = 0, curvature = 0;  // of half the squared distance, at the middle
  for (std::size_t i = 0; i < 3; ++i) {
    const Rational excess = motion.beyond(i, middle);
    if (excess == 0) continue;
    slope += excess * motion.displacement[i];
    curvature += motion.displacement[i] * motion.displacement[i];
  }
  if (curvature == 0) return from;
  const Rational vertex = middle - slope / curvature;
  return std::clamp(vertex, from, to);
}

inline ExactApproach exact_approach(const Pair& pair) {
  const ExactMotion motion = exact_motion(pair);
  const Rational reach = exact(pair.a.radius) + exact(pair.b.radius) + exact(pair.min_separation);
  const Rational square = reach * reach;
  const std::vector<Rational> times = breakpoints(motion);

  Rational best_time = 0, best = motion.squared_distance(0);
  const int start_sign = best.compare(square);
  const auto consider = [&](const Rational& time) {
    const Rational distance = motion.squared_distance(time);
    if (distance >= best) return;
    best = distance;
    best_time = time;
  };
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    consider(least_between(motion, times[i], times[i + 1]));
    consider(times[i + 1]);
  }
  return {best_time, best.compare(square), start_sign};
}

}  // namespace thinwall::oracle
