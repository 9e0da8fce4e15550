#pragma once
/// The oracle: two convex bodies that each translate, their signed separation at any time, and when they first touch. Independent of the
/// library in method and precision.
///
/// The cores of all shapes here (point, segment, box) are zonotopes, and so is the Minkowski sum of two cores: the
/// separation of two shapes is the distance of one point to one zonotope, less the sum of the radii.
///
/// The separation is convex along a translation. So it is minimized first: a positive minimum is a miss. Otherwise
/// the first contact lies before the minimizer and is bracketed there. (A bullet that crosses a wall shows no change
/// of sign between its end poses; the minimizer finds the wall.) Where the minimum is too near zero for 100 digits,
/// rational arithmetic decides.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "support/real.hpp"

namespace thinwall::oracle {

// ---- The nearest point is a least-squares problem whose factors are bounded by one. A face is named by which factors are at -1, at +1
// and free. A few steps in double guess the face; the point on it is then found, and proven nearest, at full precision. Where the proof
// fails, every face is tried.

/// The factors of up to three edges whose sum comes nearest to `target` (normal equations, pivoted elimination).
/// False if the edges are dependent: then a smaller set of edges spans the same face.
inline bool least_squares(const std::vector<Vector>& edges, const Vector& target, std::vector<Real>& factors) {
  const std::size_t n = edges.size();
  std::vector<std::vector<Real>> rows(n, std::vector<Real>(n + 1));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) rows[i][j] = dot(edges[i], edges[j]);
    rows[i][n] = dot(edges[i], target);
  }
  for (std::size_t column = 0; column < n; ++column) {
    std::size_t pivot = column;
    for (std::size_t i = column + 1; i < n; ++i)
      if (abs(rows[i][column]) > abs(rows[pivot][column])) pivot = i;
    if (rows[pivot][column] == 0) return false;
    std::swap(rows[pivot], rows[column]);
    for (std::size_t i = 0; i < n; ++i) {
      if (i == column) continue;
      const Real factor = rows[i][column] / rows[column][column];
      for (std::size_t j = column; j <= n; ++j) rows[i][j] -= factor * rows[column][j];
    }
  }
  factors.resize(n);
  for (std::size_t i = 0; i < n; ++i) factors[i] = rows[i][n] / rows[i][i];
  return true;
}

/// Tries every face: each generator is at -1, at +1, or free, at most three of them free.
class FaceSearch {
 public:
  FaceSearch(const std::vector<Vector>& generators, const Vector& point) : generators_(generators), point_(point) {
    visit(0, Vector{});
  }
  const Vector& nearest() const { return best_; }

 private:
  void visit(std::size_t index, const Vector& fixed) {
    if (index == generators_.size()) return try_face(fixed);
    const Vector& g = generators_[index];
    visit(index + 1, fixed - g);
    visit(index + 1, fixed + g);
    if (free_.size() == 3) return;
    free_.push_back(g);
    visit(index + 1, fixed);
    free_.pop_back();
  }

  // A factor beyond its range is clamped. The point found then lies in the zonotope all the same, if not nearest:
  // a face that does not hold the answer can never spoil it.
  void try_face(const Vector& fixed) {
    if (!least_squares(free_, point_ - fixed, factors_)) return;
    Vector candidate = fixed;
    for (std::size_t i = 0; i < free_.size(); ++i) {
      const Real factor = factors_[i] > 1 ? Real(1) : factors_[i] < -1 ? Real(-1) : factors_[i];
      candidate = candidate + factor * free_[i];
    }
    const Vector gap = point_ - candidate;
    const Real square = dot(gap, gap);
    if (found_ && square >= best_square_) return;
    found_ = true;
    best_ = candidate;
    best_square_ = square;
  }

  const std::vector<Vector>& generators_;
  Vector point_;
  std::vector<Vector> free_{};
  std::vector<Real> factors_{};
  bool found_ = false;
  Vector best_{};
  Real best_square_ = 0;
};

/// Factors near the best ones: each in turn is set to its best value, all in double and relative to the largest number.
inline std::vector<double> guess_factors(const std::vector<Vector>& generators, const Vector& point) {
  Real size = length(point);
  for (const Vector& g : generators) size = std::max(size, length(g));
  const auto shrink = [&](const Vector& v) {
    const Vector small = Real(1 / size) * v;
    return Triple<double>{
        {small[0].convert_to<double>(), small[1].convert_to<double>(), small[2].convert_to<double>()}};
  };
  std::vector<Triple<double>> edges;
  for (const Vector& g : generators) edges.push_back(shrink(g));
  Triple<double> rest = shrink(point);
  std::vector<double> factors(generators.size());
  for (int sweep = 0; sweep < 200; ++sweep) {
    double change = 0;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const double square = dot(edges[i], edges[i]);
      if (square == 0) continue;
      const double best = std::min(1.0, std::max(-1.0, factors[i] + dot(edges[i], rest) / square));
      rest = rest - (best - factors[i]) * edges[i];
      change = std::max(change, std::abs(best - factors[i]));
      factors[i] = best;
    }
    if (change < 1e-15) break;
  }
  return factors;
}

/// True if `g` is no sum of multiples of the (at most three) edges.
inline bool is_independent(const std::vector<Vector>& edges, const Vector& g) {
  if (edges.empty()) return true;
  if (edges.size() == 1) return cross(edges[0], g) != Vector{};
  return edges.size() == 2 && dot(cross(edges[0], edges[1]), g) != 0;
}

/// The nearest point if it lies on the guessed face. Proof: what is left is perpendicular to the free generators and
/// points away from the face along the others, which is the condition for the minimum of a convex function.
inline bool nearest_on_guess(const std::vector<Vector>& generators, const Vector& point, Vector& nearest) {
  const std::vector<double> guess = guess_factors(generators, point);
  std::vector<Vector> free;
  Vector fixed{};
  Real size = length(point);
  for (std::size_t i = 0; i < generators.size(); ++i) {
    size += length(generators[i]);
    if (std::abs(guess[i]) < 1 && is_independent(free, generators[i]))
      free.push_back(generators[i]);
    else
      fixed = fixed + Real(guess[i]) * generators[i];
  }
  std::vector<Real> factors;
  if (!least_squares(free, point - fixed, factors)) return false;
  nearest = fixed;
  for (std::size_t i = 0; i < free.size(); ++i) {
    if (abs(factors[i]) > 1) return false;
    nearest = nearest + factors[i] * free[i];
  }
  const Vector rest = point - nearest;
  for (std::size_t i = 0; i < generators.size(); ++i) {
    const Real along = dot(generators[i], rest), none = ldexp(length(generators[i]) * size, -325);
    if (guess[i] == 1 ? along < -none : guess[i] == -1 ? along > none : abs(along) > none) return false;
  }
  return true;
}

inline Vector nearest_of_any(const std::vector<Vector>& generators, const Vector& point) {
  Vector nearest;
  if (nearest_on_guess(generators, point, nearest)) return nearest;
  return FaceSearch(generators, point).nearest();
}

// ---- A zonotope.

/// All sums of s_i g_i with |s_i| <= 1, about the origin: a box along the axes and any number of other generators.
struct Zonotope {
  Vector box{};                      ///< [length] >= 0: half extents along x, y, z
  std::vector<Vector> generators{};  ///< [length] half edges in any direction
};

/// Every generator, those of the box first; parallel ones are added up, and those of length zero left out.
inline std::vector<Vector> all_generators(const Zonotope& z) {
  std::vector<Vector> all;
  const auto add = [&](const Vector& g) {
    if (dot(g, g) == 0) return;
    for (Vector& other : all) {
      const Vector across = cross(other, g);
      if (dot(across, across) != 0) continue;
      other = dot(other, g) > 0 ? other + g : other - g;
      return;
    }
    all.push_back(g);
  };
  for (std::size_t i = 0; i < 3; ++i) {
    Vector edge{};
    edge[i] = z.box[i];
    add(edge);
  }
  for (const Vector& g : z.generators) add(g);
  return all;
}

/// How far the zonotope reaches along `direction`.
inline Real support(const Zonotope& z, const Vector& direction) {
  Real reach = 0;
  for (const Vector& g : all_generators(z)) reach += abs(dot(g, direction));
  return reach;
}

/// The point of the zonotope nearest to `p`; for a box, each coordinate is clamped.
inline Vector nearest(const Zonotope& z, const Vector& p) {
  if (!z.generators.empty()) return nearest_of_any(all_generators(z), p);
  Vector q = p;
  for (std::size_t i = 0; i < 3; ++i) {
    if (q[i] > z.box[i]) q[i] = z.box[i];
    if (q[i] < -z.box[i]) q[i] = -z.box[i];
  }
  return q;
}

/// A signed distance and the direction in which it grows.
struct Depth {
  Real distance = 0;  ///< [length] below zero inside
  Vector normal{1, 0, 0};
};

/// The least translation that takes an inner point `p` out, over the normals of all faces. A zonotope without
/// volume has no inside: the depth is zero.
inline Depth depth_inside(const Zonotope& z, const Vector& p) {
  const std::vector<Vector> generators = all_generators(z);
  Depth best;
  bool found = false;
  for (std::size_t i = 0; i < generators.size(); ++i) {
    for (std::size_t j = i + 1; j < generators.size(); ++j) {
      const Vector axis = cross(generators[i], generators[j]);
      if (dot(axis, axis) == 0) continue;
      const Vector unit = Real((dot(axis, p) < 0 ? -1 : 1) / length(axis)) * axis;
      const Real distance = dot(unit, p) - support(z, unit);
      if (found && distance <= best.distance) continue;
      found = true;
      best = {distance, unit};
    }
  }
  return best;
}

// ---- Two bodies.

/// A rounded zonotope in straight motion: all points within `radius` of `center + t * displacement + core`.
struct Body {
  Vector center{};
  Zonotope core{};
  Real radius = 0;        ///< [length] >= 0
  Vector displacement{};  ///< [length] over the step
};

/// Two bodies and the gap that counts as contact.
struct Pair {
  Body a, b;
  Real min_separation = 0;  ///< [length] >= 0

  /// The centers touch the Minkowski sum of the cores within this distance when the bodies touch.
  Real reach() const { return a.radius + b.radius + min_separation; }

  /// From the center of A to that of B.
  Vector offset(const Real& time) const { return (b.center - a.center) + time * (b.displacement - a.displacement); }
  Vector relative_displacement() const { return b.displacement - a.displacement; }

  /// The Minkowski sum of the two cores (they are symmetric, so it is the difference as well).
  Zonotope core() const {
    Zonotope sum{a.core.box + b.core.box, a.core.generators};
    sum.generators.insert(sum.generators.end(), b.core.generators.begin(), b.core.generators.end());
    return sum;
  }
};

/// Half the size of the core's bounding box.
inline Vector half_size(const Zonotope& z) {
  Vector half = z.box;
  for (const Vector& g : z.generators) half = half + magnitude(g);
  return half;
}

/// The size of the numbers that a computation at `time` must add, along each axis.
inline Vector sizes(const Pair& pair, const Real& time) {
  return magnitude(pair.a.center) + magnitude(pair.b.center) + half_size(pair.a.core) + half_size(pair.b.core) +
         time * (magnitude(pair.a.displacement) + magnitude(pair.b.displacement));
}

/// The same seen along the contact normal, radii included: the roundoff of the inputs moves the gap by u times this.
inline Real scale(const Pair& pair, const Real& time, const Vector& normal) {
  return dot(magnitude(normal), sizes(pair, time)) + pair.reach();
}

/// What lies between the two bodies at one time.
struct Gap {
  Real core = 0;           ///< [length] between the cores; below zero: how deep they are in each other
  Real separation = 0;     ///< [length] between the surfaces: core less the sum of the radii
  Vector normal{1, 0, 0};  ///< unit, from A to B
};

/// Oblique cores meet only to the last digits of a Real: nearer than this, relative to their size, they touch.
inline Real noise(const Zonotope& core, const Vector& offset) {
  if (core.generators.empty()) return 0;  // clamping is exact
  return ldexp(length(offset) + length(half_size(core)), -270);
}

inline Gap gap(const Pair& pair, const Real& time) {
  const Zonotope core = pair.core();
  const Vector offset = pair.offset(time);
  const Vector across = offset - nearest(core, offset);
  const Real distance = length(across);
  if (distance > noise(core, offset)) return {distance, distance - pair.reach(), Real(1 / distance) * across};
  const Depth inside = depth_inside(core, offset);
  return {inside.distance, inside.distance - pair.reach(), inside.normal};
}

/// The separation along one direction: at most gap().separation, and equal to it for the right normal.
inline Real separation_along(const Pair& pair, const Real& time, const Vector& normal) {
  return dot(normal, pair.offset(time)) - support(pair.core(), normal) - pair.reach();
}

/// True if the bodies share a point at `time`, touching included. No square root: boxes and points are exact.
inline bool touching(const Pair& pair, const Real& time) {
  const Zonotope core = pair.core();
  const Vector offset = pair.offset(time);
  const Vector across = offset - nearest(core, offset);
  const Real reach = pair.reach() + noise(core, offset);
  return dot(across, across) <= reach * reach;
}

// ---- Hit or miss without rounding, for cores that are points or boxes along the axes: the squared distance of a moving point to a box is
// piecewise quadratic in time, with rational breakpoints and minima. The least of them against the squared reach decides, however near
// the two are.

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

// ---- At 100 digits.

enum class Verdict { apart, hit, overlapping };

struct Impact {
  Verdict verdict = Verdict::apart;
  Real margin = 0;        ///< [1] least separation over scale(); 0 is an exact touch, or cores with an inside that meet
  Real start_margin = 0;  ///< [1] the same at time 0
  Real time = 1;          ///< [1] of first contact; apart: of closest approach
  Vector normal{};        ///< unit, from A to B, at that time
  Real conditioning = 0;  ///< [1] kappa * time: a relative change u of the inputs moves the time by u times this
};

/// Halves [low, high] until it is narrow, keeping the step of a monotone predicate inside. `guess` names where the
/// step may be; a good guess saves rounds, a bad one costs them, and neither changes the answer.
template <class Reached, class Guess> void bracket(Real& low, Real& high, const Reached& reached, const Guess& guess) {
  const auto probe = [&](const Real& time) {
    if (time <= low || time >= high) return;
    (reached(time) ? high : low) = time;
  };
  for (int round = 0; round < 20000 && high - low > ldexp(high, -290); ++round) {
    const Real center = guess(low, high);
    const Real near = ldexp(high - low, -20);
    probe(center - near);
    probe(center + near);
    probe((low + high) / 2);
  }
}

/// Half the derivative of the squared core distance; zero where the cores meet. Piecewise linear in time.
inline Real approach_slope(const Pair& pair, const Zonotope& core, const Real& time) {
  const Vector offset = pair.offset(time);
  const Vector across = offset - nearest(core, offset);
  return length(across) <= noise(core, offset) ? Real(0) : dot(across, pair.relative_displacement());
}

/// The first time in [0, 1] at which the separation is least, from the sign of its derivative.
inline Real closest_approach(const Pair& pair) {
  const Zonotope core = pair.core();
  if (approach_slope(pair, core, 0) >= 0) return 0;
  if (approach_slope(pair, core, 1) < 0) return 1;
  Real low = 0, high = 1;
  bracket(
      low, high, [&](const Real& time) { return approach_slope(pair, core, time) >= 0; },
      [&](const Real& from, const Real& to) {
        const Real beside = ldexp(to - from, -60);  // the slope is linear there
        const Real start = approach_slope(pair, core, from), next = approach_slope(pair, core, from + beside);
        return Real(next == start ? to : from - start * beside / (next - start));
      });
  return high;
}

inline Real closing_speed(const Pair& pair, const Vector& normal) {
  return abs(dot(normal, pair.relative_displacement()));
}

/// The first contact before `closest`, a time at which the bodies touch.
inline Impact first_contact(const Pair& pair, const Real& closest, const Real& margin, const Real& start_margin) {
  Real low = 0, high = closest;
  bracket(
      low, high, [&](const Real& time) { return touching(pair, time); },
      [&](const Real& from, const Real& to) {
        const Gap start = gap(pair, from);
        const Real speed = closing_speed(pair, start.normal);
        return speed == 0 ? to : Real(from + start.separation / speed);
      });
  const Gap before = gap(pair, low);  // at contact itself, cores without a radius have no normal
  const Real speed = closing_speed(pair, before.normal);
  const Real conditioning = speed == 0 ? Real(0) : Real(scale(pair, high, before.normal) / speed);
  return {Verdict::hit, margin, start_margin, high, before.normal, conditioning};
}

/// The tri-state verdict, the time and how well conditioned both are.
inline Impact impact(const Pair& pair) {
  const auto margin_at = [&](const Real& time, const Gap& there) {
    const Real size = scale(pair, time, there.normal);
    return size == 0 ? Real(0) : Real(there.separation / size);  // two points that rest at the origin
  };
  const bool fractions = pair.core().generators.empty();
  const Real touch = ldexp(Real(1), fractions ? -200 : -260);  // a margin below is decided by fractions, or is a touch

  const Gap start = gap(pair, 0);
  Real start_margin = margin_at(0, start);
  Real closest = closest_approach(pair);
  Gap there = gap(pair, closest);
  Real margin = margin_at(closest, there);
  int start_sign = start_margin > touch ? 1 : start_margin < -touch ? -1 : 0;
  int sign = margin > touch ? 1 : margin < -touch ? -1 : 0;
  if (fractions && (start_sign == 0 || sign == 0)) {
    const ExactApproach exactly = exact_approach(pair);
    start_sign = exactly.start_sign;
    sign = exactly.sign;
    if (sign == 0) closest = Real(exactly.time);
    if (sign == 0) margin = 0;
    if (start_sign == 0) start_margin = 0;
  }
  if (start_sign <= 0) return {Verdict::overlapping, margin, start_margin, 0, start.normal, 0};
  if (sign > 0) return {Verdict::apart, margin, start_margin, closest, there.normal, 0};
  return first_contact(pair, closest, margin, start_margin);
}

// ---- How wrong is a computed time of impact, in units of the rounding error of its scalar?

/// |time - true time| over u * kappa * true time. kappa: how far a relative change of the inputs moves the time,
///   kappa = [sum |n_i| (|cA| + |cB| + h + t (|vA| + |vB|))_i + R] / (t |n.v|).
/// A graze (n.v = 0) has no finite kappa: there the backward error is the measure, and this is zero.
template <class S> Real forward_error_in_u_kappa(const Impact& truth, const S& time) {
  if (truth.conditioning == 0) return 0;
  return abs(lift(time) - truth.time) / (unit_roundoff<S>() * truth.conditioning);
}

/// True if a relative change of the inputs by at most `change`, each coordinate by itself, makes the bodies touch
/// without overlap at `time`.
inline bool touch_is_near(const Pair& pair, const Real& time, const Real& change) {
  const Vector offset = pair.offset(time);
  const Vector play = change * sizes(pair, time);
  Zonotope wider = pair.core();
  wider.box = wider.box + play;
  if (length(offset - nearest(wider, offset)) > pair.reach() * (1 + change)) return false;  // still apart
  for (unsigned corner = 0; corner < 8; ++corner) {  // the distance is convex: it is largest at a corner
    Vector moved = offset;
    for (std::size_t i = 0; i < 3; ++i) moved[i] += (corner >> i & 1U) != 0 ? play[i] : -play[i];
    const Real distance = length(moved - nearest(pair.core(), moved));
    if (distance > 0 && distance >= pair.reach() * (1 - change)) return true;
  }
  return false;
}

/// By how much the inputs would have to change, in u, for `time` to be the exact time of contact.
/// To first order it is the separation at that time over [sum |n_i| (...)_i + R]. Where that is more than one u, the
/// change is found by bisection: a step many radii long turns the normal within one rounding of the time.
template <class S> Real backward_error_in_u(const Pair& pair, const S& time) {
  const Gap there = gap(pair, lift(time));
  if (there.separation == 0) return 0;
  const Real u = unit_roundoff<S>();
  const Real first_order = abs(there.separation) / (u * scale(pair, lift(time), there.normal));
  if (first_order <= 1) return first_order;
  Real low = 0, high = 1;
  while (!touch_is_near(pair, lift(time), high * u) && high < 1 / u) high *= 2;
  for (int i = 0; i < 12; ++i) {
    const Real middle = (low + high) / 2;
    (touch_is_near(pair, lift(time), middle * u) ? high : low) = middle;
  }
  return high;
}

/// True if a relative change of the inputs by at most `change`, each coordinate by itself, makes the bodies touch: the
/// cores grow by all that the inputs may give.
inline bool touch_is_possible(Pair pair, const Impact& truth, const Real& change, bool at_start) {
  const Vector play = change * sizes(pair, at_start ? Real(0) : truth.time);
  pair.a.core.box = pair.a.core.box + play;
  pair.min_separation += change * pair.reach();
  return at_start ? touching(pair, 0) : impact(pair).verdict != Verdict::apart;
}

/// True if such a change makes `verdict` right, which is not the one where they touch sooner. Tries the corners of the
/// box of inputs: what lies beyond a touch stays so farther out, but may no longer be met within the step, so also those of smaller boxes.
inline bool miss_is_possible(const Pair& pair, Verdict verdict, const Real& change) {
  for (const Real& part : {change, Real(change / 4), Real(change / 16)}) {
    const Vector place = part * sizes(pair, 0);
    const Vector path = part * (magnitude(pair.a.displacement) + magnitude(pair.b.displacement));
    for (unsigned corner = 0; corner < 64; ++corner) {
      const auto sign = [&](std::size_t bit) { return (corner >> bit & 1U) != 0 ? 1 : -1; };
      Pair changed = pair;
      changed.min_separation -= part * pair.reach();
      for (std::size_t i = 0; i < 3; ++i) {
        changed.b.center[i] += sign(i) * place[i];
        changed.b.displacement[i] += sign(i + 3) * path[i];
      }
      if (impact(changed).verdict == verdict) return true;
    }
  }
  return false;
}

/// True if `verdict` is right but for a relative change of the inputs by at most `change`.
inline bool verdict_is_near(const Pair& pair, const Impact& truth, Verdict verdict, const Real& change) {
  if (verdict == truth.verdict) return true;
  if (change == 0) return false;
  if (verdict == Verdict::overlapping) return touch_is_possible(pair, truth, change, true);
  if (truth.verdict == Verdict::apart) return touch_is_possible(pair, truth, change, false);
  return miss_is_possible(pair, verdict, change);
}

/// The first time at which the separation is at most `allowance` in u * scale: how early a backward error that
/// small can put a graze. Inflates the reach, which bounds the scale at the true contact.
template <class S> Real earliest_time(Pair pair, const Impact& truth, int allowance) {
  pair.min_separation += allowance * unit_roundoff<S>() * scale(pair, truth.time, truth.normal);
  const Impact inflated = impact(pair);
  return inflated.verdict == Verdict::apart ? truth.time : inflated.time;
}

}  // namespace thinwall::oracle
