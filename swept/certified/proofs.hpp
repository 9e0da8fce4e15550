#pragma once
/// Proofs from a few numbers, each checked in exact arithmetic: a plane that parts, a witness that is shared, a crossing, a position.

#include <algorithm>

#include <thinwall/swept/certified/rounded_core.hpp>

namespace thinwall {

// ---- A plane that parts two moving shapes, checked in double.
//
// For any n the shapes are apart at t if  lowest(n) + t n.v > R |n|,  and so at all times in between where it holds at two.
// The gap and the closing speed are both rounded outward; a poor n makes a weak proof, never a wrong one.
// Constants: docs/certified.md.

/// The sum of |n_i| times the sizes: what one unit of round-off may move n . x by, in u.
THINWALL_HOT double size_along(const Vec3<double>& n, const Vec3<double>& size) { return n.cwiseAbs().dot(size); }

/// The gap across the plane at time t is at least gap - closing * t.
struct PlaneProof {
  double gap = 0;      ///< [length |n|] at the start, rounded down; > 0: apart there
  double closing = 0;  ///< [length |n|] per step, rounded up

  /// The plane parts the shapes until then, at least: rounded down; infinity if it never fails.
  double free_until() const {
    if (!(gap > 0)) return 0;
    if (!(closing > 0)) return std::numeric_limits<double>::infinity();
    return gap / closing * (1 - 4 * roundoff_unit);
  }
};

template <class Core> THINWALL_HOT PlaneProof plane_proof(const Core& core, const Vec3<double>& n) {
  constexpr double u = roundoff_unit, tiny = 0x1p-900;
  const double rounded = core.R * std::sqrt(n.squaredNorm());
  PlaneProof proof;
  proof.gap = (core.lowest(n) - rounded) - (u * (20 * size_along(n, core.size) + 8 * rounded) + tiny);
  proof.closing = (8 * u * size_along(n, core.v.cwiseAbs()) + tiny) - n.dot(core.v);
  return proof;
}

// ---- A point that two moving shapes share, checked in double: a point x of the relative core with |x| <= R less what its
// rounding may hide.

/// True if a point computed as x is within R of the origin, x off by at most `roundings` u times the size of each coordinate.
THINWALL_HOT bool is_within(const Vec3<double>& x, double R, const Vec3<double>& size, double roundings) {
  constexpr double u = roundoff_unit;
  const Vec3<double> farthest = x.cwiseAbs() + size * (roundings * u);
  return R > 0 && farthest.squaredNorm() <= R * R * (1 - 16 * u);
}

/// The factor in [-1, 1] for which |x + factor g| is least.
THINWALL_HOT double nearest_factor(const Vec3<double>& x, const Vec3<double>& g) {
  const double square = g.squaredNorm();
  return square > 0 ? std::clamp(-x.dot(g) / square, -1.0, 1.0) : 0.0;
}

/// x + alpha g + beta h with |alpha|, |beta| <= 1, about as near to the origin as it gets.
inline Vec3<double> nearest_on_parallelogram(const Vec3<double>& x, const Vec3<double>& g, const Vec3<double>& h) {
  const double gg = g.squaredNorm(), hh = h.squaredNorm(), gh = g.dot(h), xg = x.dot(g), xh = x.dot(h);
  const double square = gg * hh - gh * gh;
  const double alpha = (gh * xh - hh * xg) / square, beta = (gh * xg - gg * xh) / square;
  if (std::abs(alpha) <= 1 && std::abs(beta) <= 1) return (x + alpha * g) + beta * h;
  Vec3<double> best = Vec3<double>::Constant(std::numeric_limits<double>::infinity());
  const auto consider = [&](const Vec3<double>& side, const Vec3<double>& along) {
    const Vec3<double> y = side + nearest_factor(side, along) * along;
    if (y.squaredNorm() < best.squaredNorm()) best = y;
  };
  consider(x + g, h);
  consider(x - g, h);
  consider(x + h, g);
  consider(x - h, g);
  return best;
}

/// The face of a zonotope that a plane across n touches first: c + alpha g + beta h, |alpha|, |beta| <= 1, at time 0. g and h are
/// the half axes most nearly along the plane; the others take their signs from n.
struct LikelyFace {
  Vec3<double> c = Vec3<double>::Zero(), g = Vec3<double>::Zero(), h = Vec3<double>::Zero();
};

template <class Core> THINWALL_HOT LikelyFace likely_face(const Core& core, const Vec3<double>& n) {
  LikelyFace face{core.p};
  double flattest = std::numeric_limits<double>::infinity(), next = flattest;  // squared sines to the plane
  double along_g = 0, along_h = 0;
  const auto settle = [&](const Vec3<double>& axis, double along) {
    if (along > 0) {
      face.c -= axis;
    } else {
      face.c += axis;
    }
  };
  for (int k = 0; k < Core::count; ++k) {
    const Vec3<double> axis = core.half_axis(k);
    const double along = n.dot(axis), tilt = along * along / axis.squaredNorm();
    if (tilt < flattest) {
      settle(face.h, along_h);
      face.h = face.g;
      face.g = axis;
      next = flattest;
      flattest = tilt;
      along_h = along_g;
      along_g = along;
    } else if (tilt < next) {
      settle(face.h, along_h);
      face.h = axis;
      next = tilt;
      along_h = along;
    } else {
      settle(axis, along);
    }
  }
  return face;
}

// ---- When a point crosses a face of a zonotope, checked in double: the proof of contact where there is no radius to hide in.
//
// The face is c + alpha g + beta h with |alpha|, |beta| <= 1, and moves by v. It meets the origin at s where
//   c + alpha g + beta h + s v = 0:   s = -det(g, h, c) / det(g, h, v),  and alpha and beta by Cramer's rule as well.
// Every determinant comes with a bound on its rounding; if the face holds the origin at s, the shapes touch by then.
// Constants: docs/certified.md.

/// a . (b x c), and how far off it may be.
struct BoundedDeterminant {
  double value = 0, error = 0;

  /// `size_a` bounds the magnitude of a, coordinate by coordinate, where a itself is off by up to 14 u of it.
  BoundedDeterminant(const Vec3<double>& a, const Vec3<double>& size_a, const Vec3<double>& b, const Vec3<double>& c) {
    double products = 0;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const double first = b[j] * c[k], second = b[k] * c[j];
      value += a[i] * (first - second);
      products += size_a[i] * (std::abs(first) + std::abs(second));
    }
    error = 28 * roundoff_unit * products + 0x1p-900;
  }
  double largest() const { return std::abs(value) + error; }
  double least() const { return std::abs(value) - error; }
};

/// A time by which the face c +- g +- h has met the origin, rounded up; infinity if that is not proven.
inline double crossed_by(const Vec3<double>& c, const Vec3<double>& g, const Vec3<double>& h, const Vec3<double>& v,
                         const Vec3<double>& size) {
  constexpr double never = std::numeric_limits<double>::infinity();
  const BoundedDeterminant speed(v, v.cwiseAbs(), g, h), distance(c, size, g, h);
  if (!(speed.least() > 0) || !(distance.least() > 0) || (speed.value > 0) == (distance.value > 0)) return never;
  const BoundedDeterminant alpha(c, size, h, v), beta(c, size, v, g);
  if (!(alpha.largest() <= speed.least()) || !(beta.largest() <= speed.least())) return never;
  return distance.largest() / speed.least() * (1 + 4 * roundoff_unit);
}

// ---- Where a swept core lies, apart from the ball about the origin or touching it, by GJK in double whose every exit is a
// proof: a plane, a point of the simplex, or a tetrahedron around the origin. Rounding may lead it astray; then it gives up.
// Constants: docs/certified.md.

enum class Position { apart, touching, unknown };

struct PositionProof {
  Position position = Position::unknown;
  Vec3<double> normal = Vec3<double>::Zero();  ///< of the last plane tried, that which parts them if `apart`
};

inline Vec3<double> to_vector(const Triple<double>& x) { return {x[0], x[1], x[2]}; }

/// The point of the simplex' nearest face that is nearest to the origin.
inline Vec3<double> nearest_of(const Simplex<double>& simplex) {
  const Vec3<double> a = to_vector(simplex.corners[0]);
  if (simplex.count == 1) return a;
  const Vec3<double> ab = to_vector(simplex.corners[1]) - a;
  if (simplex.count == 2) return a + ab * std::clamp(-a.dot(ab) / ab.squaredNorm(), 0.0, 1.0);
  const Vec3<double> ac = to_vector(simplex.corners[2]) - a, n = cross(ab, ac);
  const double square = n.squaredNorm();
  const double beta = std::clamp(cross(ac, a).dot(n) / square, 0.0, 1.0);
  const double gamma = std::clamp(cross(a, ab).dot(n) / square, 0.0, 1.0 - beta);
  return (a + ab * beta) + ac * gamma;
}

/// True if the origin is inside the tetrahedron, whose corners are off by up to 20 u of `size`.
inline bool holds_origin(const Simplex<double>& simplex, const Vec3<double>& size) {
  const auto side = [&](std::size_t i, std::size_t j, std::size_t k) {
    return to_vector(simplex.corners[i]).dot(cross(to_vector(simplex.corners[j]), to_vector(simplex.corners[k])));
  };
  const double error = 6 * 80 * roundoff_unit * (size[0] * size[1] * size[2]) + 0x1p-900;
  const double sides[] = {side(1, 2, 3), -side(0, 2, 3), side(0, 1, 3), -side(0, 1, 2)};
  const auto beyond = [&](double sign) {
    return std::all_of(std::begin(sides), std::end(sides), [&](double x) { return sign * x > error; });
  };
  return beyond(1) || beyond(-1);
}

/// The core swept over [0, time], n the first plane to try.
template <class Core> PositionProof position_proof(const Core& core, double time, const Vec3<double>& n) {
  constexpr double u = roundoff_unit, tiny = 0x1p-900;
  constexpr int most_rounds = 32;  // of a guess: what is left is decided exactly
  const Vec3<double> sweep = core.v * time, size = core.size + sweep.cwiseAbs();
  PositionProof proof{Position::unknown, n};
  Simplex<double> simplex({0, 0, 0});
  for (int round = 0; round < most_rounds; ++round) {
    const double length = std::sqrt(proof.normal.squaredNorm());
    if (!(length > 0)) return proof;
    proof.normal /= length;
    Triple<double> corner = core.lowest_corner(proof.normal);
    if (proof.normal.dot(sweep) < 0) {
      for (int i = 0; i < 3; ++i) corner[static_cast<std::size_t>(i)] += sweep[i];
    }
    const double level = proof.normal.dot(to_vector(corner));
    const double error = u * (28 * size_along(proof.normal, size) + 8 * core.R) + tiny;
    if (level - core.R > error) {
      proof.position = Position::apart;
      return proof;
    }
    if (round == 0) {
      simplex = Simplex<double>(corner);
    } else if (!(level < proof.normal.dot(to_vector(simplex.corners[0])) - error)) {
      return proof;  // no nearer than rounding
    } else if (!simplex.add(corner)) {
      if (simplex.count == 4 && holds_origin(simplex, size)) proof.position = Position::touching;
      return proof;
    }
    if (is_within(nearest_of(simplex), core.R, size, 64)) {
      proof.position = Position::touching;
      return proof;
    }
    proof.normal = to_vector(simplex.normal);
  }
  return proof;
}

// ---- A point that two boxes share, checked in double: the proof of overlap where there is no radius.
//
// Any point of A, given by factors in [-1, 1] of its half axes, is a point of B if its factors there, by Cramer's rule,
// are in [-1, 1] too, with the rounding of every determinant bounded. Constants: docs/certified.md.

/// True if the point of A nearest to `from_a`, seen from A's center, is proven to be in B.
template <class Core> bool share_point(const Core& core, const Vec3<double>& from_a) {
  Vec3<double> x = core.p;  // from B's center to the point of A
  for (int k = 0; k < 3; ++k) {
    const Vec3<double> g = core.part_a.half_axis(k);
    x += g * nearest_factor(-from_a, g);
  }
  const Vec3<double> f = core.part_b.half_axis(0), g = core.part_b.half_axis(1), h = core.part_b.half_axis(2);
  const double volume = BoundedDeterminant(f, f.cwiseAbs(), g, h).least();
  return BoundedDeterminant(x, core.size, g, h).largest() <= volume &&
         BoundedDeterminant(x, core.size, h, f).largest() <= volume &&
         BoundedDeterminant(x, core.size, f, g).largest() <= volume;
}

}  // namespace thinwall
