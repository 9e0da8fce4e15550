#pragma once
/// The middle stage: the plain closed form guesses, and what it says is then proven in double, or not.
///
/// A plane across the guessed normal parts the shapes until `lower`; a point they share, or a face that crosses the other
/// shape's corner or edge, shows contact by `upper`. A miss needs one plane for the whole step, an overlap one point.
/// Nothing here takes the guess for true: a wrong one proves nothing, and the integers decide.

#include <thinwall/swept/certified/proofs.hpp>
#include <thinwall/swept/methods/closed_form.hpp>

namespace thinwall {

inline CertifiedToi proven(ToiStatus verdict, double lower, double upper) {
  return {verdict, lower, upper, DecidedBy::certificate};
}

/// The sizes of lengths and displacements are such that no product of four loses its leading digits.
template <class Core> THINWALL_HOT bool sizes_in_range(const Core& core) {
  constexpr double least = 0x1p-150, most = 0x1p150;
  const double size = core.size.sum() + core.R, speed = core.v.cwiseAbs().sum();
  return size >= least && size <= most && (speed == 0 || (speed >= least && speed <= most));
}

/// The direction in which the middles of the two pass each other.
template <class Core> THINWALL_HOT Vec3<double> passing_direction(const Core& core) {
  const double along = -core.p.dot(core.v);
  const double time = along > 0 ? std::min(1.0, along / core.v.squaredNorm()) : 0.0;
  return core.p + core.v * time;
}

/// A time <= 1 by which the core touches the ball, near the guess; infinity if none is proven.
template <class Core> THINWALL_HOT double touched_until(const Core& core, const Vec3<double>& n, double guess) {
  const double never = std::numeric_limits<double>::infinity();
  if constexpr (Core::is_zonotope) {
    const LikelyFace face = likely_face(core, n);
    if (core.R == 0) {
      const double time = crossed_by(face.c, face.g, face.h, core.v, core.size);
      return time <= 1 ? time : never;
    }
    const Vec3<double> x = nearest_on_parallelogram(face.c + core.v * guess, face.g, face.h);
    const double distance = std::sqrt(x.squaredNorm()), closing = -x.dot(core.v);
    const Vec3<double> size = core.size + core.v.cwiseAbs() * guess;
    const double slack = roundoff_unit * (36 * size_along(x, size) + 20 * core.R * distance);
    double later = (std::max(0.0, distance - core.R) * distance + slack) / closing;
    for (int round = 0; round < 3 && later > 0; ++round) {
      const double time = std::min(1.0, guess + later);
      if (is_within(x + core.v * (time - guess), core.R, core.size + core.v.cwiseAbs() * time, 32)) return time;
      later *= 4;
    }
  }
  return never;
}

/// Proves that they touch soon after the guess, whatever the shape of the contact.
template <class Core>
THINWALL_COLD double touched_soon_after(const Core& core, const Vec3<double>& n, double guess, double closing) {
  double later = 256 * roundoff_unit * (size_along(n, core.size + core.v.cwiseAbs()) + core.R) / closing;
  for (int round = 0; round < 4 && later > 0; ++round) {
    const double time = std::min(1.0, guess + later);
    if (position_proof(core, time, n).position == Position::touching) return time;
    later *= 64;
  }
  return std::numeric_limits<double>::infinity();
}

/// A hit near the guess.
template <class Core> THINWALL_HOT CertifiedToi prove_hit(const Core& core, const Vec3<double>& n, double guess) {
  const PlaneProof plane = plane_proof(core, n);
  const double lower = plane.free_until();
  if (lower > 1) return proven(ToiStatus::apart, 1, 1);
  if (!(lower > 0)) return undecided;
  double upper = touched_until(core, n, guess);
  if (!(upper <= 1)) upper = touched_soon_after(core, n, guess, plane.closing);
  return upper <= 1 && is_narrow(lower, upper) ? proven(ToiStatus::hit, lower, upper) : undecided;
}

/// Cores of three half axes each, and no radius around them.
template <class A, class B>
inline constexpr bool are_boxes =
    std::same_as<A, Obb<double>> && (std::same_as<B, Obb<double>> || std::same_as<B, Aabb<double>>);

/// The answer in double, if it can be proven there.
template <Shape A, Shape B> CertifiedToi certificate(const Moving<A>& a, const Moving<B>& b) {
  const RoundedCore<A, B> core(a, b);
  if (!sizes_in_range(core)) return undecided;
  const Toi<double> toi = impact(ClosedForm<double>{}, a, b);
  switch (toi.status) {
    case ToiStatus::hit: return prove_hit(core, Vec3<double>(-toi.normal), toi.time);
    case ToiStatus::apart:
      if (position_proof(core, 1, passing_direction(core)).position == Position::apart) {
        return proven(ToiStatus::apart, 1, 1);
      }
      return undecided;
    case ToiStatus::overlapping:
      if constexpr (are_boxes<A, B>) {
        if (share_point(core, Vec3<double>(toi.point - a.shape.center))) return proven(ToiStatus::overlapping, 0, 0);
      }
      if (position_proof(core, 0, core.p).position == Position::touching) return proven(ToiStatus::overlapping, 0, 0);
      return undecided;
    default: return undecided;
  }
}

}  // namespace thinwall
