#pragma once
/// A point that two moving shapes share, checked in double: a point x of the relative core with |x| <= R less what its
/// rounding may hide.

#include <algorithm>

#include <thinwall/swept/certified/plane_proof.hpp>

namespace thinwall {

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

}  // namespace thinwall
