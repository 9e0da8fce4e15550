#pragma once
/// A time of impact of shapes that turn, proven where it can be: free until `lower` by planes, in contact by `upper` by a common point.

#include <algorithm>
#include <limits>

#include <thinwall/swept/certified/certified_toi.hpp>
#include <thinwall/swept/turning/turning_impact.hpp>

namespace thinwall {

/// A point of a core, and how large a ball around it lies in the core as well.
struct PointInCore {
  Vec3<double> point = Vec3<double>::Zero();  ///< [length] from the body's center
  double slack = 0;                           ///< [length] >= 0; more than 0 for boxes alone
};

/// The core's point nearest to `wanted` that lies `inside` [length] a box's faces, where it is as thick.
inline PointInCore point_in_core(const CoreVectors<double>& core, const Vec3<double>& wanted, double inside) {
  if (core.corners) {
    const Vec3<double> e1 = core.v[1] - core.v[0], e2 = core.v[2] - core.v[0];
    return {wanted - closest_on_triangle<double>(wanted - core.v[0], e1, e2).gap, 0};
  }
  PointInCore found;
  double slack = core.count == 3 ? std::numeric_limits<double>::infinity() : 0;
  for (const Vec3<double>& v : core) {
    const double half = norm(v), most = half > 0 ? std::max(0.0, 1 - inside / half) : 0;
    const double along = half > 0 ? std::clamp(wanted.dot(v) / (half * half), -most, most) : 0;
    found.point += v * along;
    slack = std::min(slack, (1 - std::abs(along)) * half);
  }
  found.slack = slack * (1 - 0x1p-20);  // axes at right angles to 2^-30
  return found;
}

/// True if the shapes share a point at `time`, beyond what rounding could undo. The point is found by projecting on one core and the other
/// in turn; for two boxes on what is left of them a quarter of their depth inside their faces.
template <Shape A, Shape B>
bool touches_for_certain(const TurningPair<double>& pair, const Turning<A>& a, const Turning<B>& b, double time) {
  const TurningInstant<double> now = instant(pair, time);
  const A posed_a = pose_at(a, time);
  const Separation<double> deepest = separation_unchecked(posed_a, pose_at(b, time));
  const double inside = pair.reach > 0 ? 0 : std::max(0.0, -deepest.distance / 4);
  Vec3<double> wanted = middle(deepest) - center(posed_a);
  for (int round = 0; round < 64; ++round) {
    const PointInCore of_a = point_in_core(now.core_a, wanted, inside);
    const PointInCore of_b = point_in_core(now.core_b, of_a.point - now.between, inside);
    wanted = now.between + of_b.point;
    if (norm<double>(of_a.point - wanted) + pair.margin <= pair.reach + of_a.slack + of_b.slack) return true;
  }
  return false;
}

/// True if a plane that stands still parts the shapes at the start, beyond what rounding could undo.
template <Shape A, Shape B> bool is_parted(const TurningPair<double>& pair, const Turning<A>& a, const Turning<B>& b) {
  const TurningInstant<double> start = instant(pair, 0.0);
  const auto plane = plane_riding(pair, start, Rides::world, separation_unchecked(a.shape, b.shape).normal);
  return first_root(gap_ahead(pair, plane, start, 0.0).bound, 0.0).value > 0;
}

/// certified_time_of_impact() of valid shapes whose lengths have squares, the shape of later rank first.
template <Shape A, Shape B> CertifiedToi certified_in_range(const Turning<A>& a, const Turning<B>& b) {
  const TurningPair<double> pair(a, b, 0);
  CertifiedToi proven{ToiStatus::gave_up, 0, 1, DecidedBy::certificate};
  if (touches_for_certain(pair, a, b, 0)) {
    proven.verdict = ToiStatus::overlapping;
    proven.upper = 0;
    return proven;
  }
  if (pair.speed == 0 && pair.first <= pair.last && !is_parted(pair, a, b))
    return proven;  // at rest advancement only looks
  constexpr double finest = std::numeric_limits<double>::epsilon();
  const Toi<double> toi = impact(ConservativeAdvancement<double>{finest, 256}, a, b);
  if (toi.status == ToiStatus::overlapping) return proven;
  proven.lower = toi.time;
  if (toi.status == ToiStatus::apart) {
    proven.verdict = ToiStatus::apart;
    return proven;
  }
  for (double ahead = finest; proven.verdict == ToiStatus::gave_up; ahead *= 2) {
    const double time = std::min(1.0, toi.time + ahead);
    if (touches_for_certain(pair, a, b, time)) {
      proven.verdict = ToiStatus::hit;
      proven.upper = time;
    }
    if (time == 1) break;
  }
  return proven;
}

/// When A and B, turning, first touch during the step: `lower` <= first contact <= `upper`, proven.
///   hit: no contact before `lower`, contact by `upper`.   overlapping: in contact at the start, both 0.
///   apart: no contact in the step, both 1.                invalid: as time_of_impact(), both NaN.
///   gave_up: not proven; no contact before `lower`, and `upper` is 1. A graze shallower than rounding, rods without a radius that
///            meet each other, a triangle or a plate, very many turns.
/// Contact is closed. The shapes are the numbers as given; what rounding could take from a proof is paid for (docs/turning.md).
/// Source: derived in docs/turning.md.
template <Shape A, Shape B> CertifiedToi certified_time_of_impact(const Turning<A>& a, const Turning<B>& b) {
  static_assert(std::same_as<typename A::Scalar, double> && std::same_as<typename B::Scalar, double>);
  static_assert(ServedPair<A, B>, "this pair of shapes is not served: see docs/pairs.md");
  if constexpr (A::rank < B::rank) {
    return certified_time_of_impact(b, a);
  } else {
    if (!valid(a) || !valid(b)) return {};
    const double size = std::max(extent(a), extent(b));
    const int e = is_finite(size) ? binary_exponent(size) : std::numeric_limits<double>::max_exponent;
    return certified_in_range(scaled(a, -e), scaled(b, -e));
  }
}
template <Shape A, Shape B> CertifiedToi certified_time_of_impact(const Turning<A>& a, const Moving<B>& b) {
  return certified_time_of_impact(a, without_spin(b));
}
template <Shape A, Shape B> CertifiedToi certified_time_of_impact(const Moving<A>& a, const Turning<B>& b) {
  return certified_time_of_impact(without_spin(a), b);
}

}  // namespace thinwall
