#pragma once
/// Planes between two turning shapes, and what bounds their gap: one that stands still, one that turns with a shape, one that stays square to
/// an edge of each. Against a resting contact the last two are exact, which is why so few of them are needed.
///
/// Nothing depends on the right choice: a poor plane proves less, never something wrong. Source: docs/turning.md derives every bound.

#include <algorithm>
#include <array>

#include <thinwall/swept/turning/concave_bound.hpp>
#include <thinwall/swept/turning/turning_pair.hpp>

namespace thinwall {

/// What a plane's normal turns with. `edges`: it is the product of an edge of A and one of B, not normalized.
enum class Rides { world, a, b, edges };

template <Scalar S> struct AttachedPlane {
  Rides rides = Rides::world;
  Swing<S> normal;          ///< unit, from A to B; `along` alone where it does not turn
  Swing<S> edge_a, edge_b;  ///< `edges`: unit; their product points from A to B
  S reach = 0;              ///< [length] of the shape it rides, both radii, the minimal separation
  S curvature = 0;          ///< [length] per step squared: that of the cores,
  S per_distance = 0, per_path = 0, per_sine = 0;  ///< of the centers, and of the radii of `edges` (curvature_at())
};

/// A bound on |(p . q)''| where p and q turn with one body each, by those angles a step: p and q are their lengths, p_across and q_across what of
/// them lies across their axes. Two bounds: differentiated twice, where only what is across the other's axis counts; and seen from p, where q
/// turns at the difference of the rotations.
template <Scalar S>
S product_curvature(const TurningPair<S>& pair, const S& angle_p, const S& angle_q, const S& p, const S& p_across,
                    const S& q, const S& q_across) {
  if (angle_p == S(0)) return angle_q * angle_q * p * q_across;
  if (angle_q == S(0)) return angle_p * angle_p * p_across * q;
  const S p_seen = std::min(p, S(p * pair.axes_sine + p_across)),
          q_seen = std::min(q, S(q * pair.axes_sine + q_across));
  const S apart = angle_p * angle_p * p_across * q_seen + S(2) * angle_p * angle_q * p_across * q_across +
                  angle_q * angle_q * p_seen * q_across;
  return std::min(apart, S(p * q * pair.cross_rate));
}

/// A vector that turns with a body, or stands still with one that does not, from what it is at `phase`.
template <Scalar S> Swing<S> swing_from(const TurningBody<S>& body, const Phase<S>& phase, const Vec3<S>& now) {
  if (!body.turns()) return {now, Vec3<S>::Zero(), Vec3<S>::Zero()};
  return body.swing(body.swing(now).at(phase.back()));
}

/// The plane across `normal`, a unit vector from A to B now.
template <Scalar S>
AttachedPlane<S> plane_riding(const TurningPair<S>& pair, const TurningInstant<S>& now, Rides rides,
                              const Vec3<S>& normal) {
  AttachedPlane<S> plane;
  plane.rides = rides;
  plane.reach = pair.reach;
  const bool with_a = rides == Rides::a;
  const TurningBody<S>* own = with_a ? &pair.a : rides == Rides::b ? &pair.b : nullptr;
  const bool turns = own != nullptr && own->turns();
  S off_axis = 0;
  if (own == nullptr) {
    plane.normal = {normal, Vec3<S>::Zero(), Vec3<S>::Zero()};
  } else {
    plane.normal = swing_from(*own, with_a ? now.phase_a : now.phase_b, normal);
    if (turns) off_axis = across(own->axis, normal);
    plane.per_distance = own->angle * off_axis;
    plane.reach += core_reach<S>(with_a ? now.core_a : now.core_b, with_a ? normal : Vec3<S>(-normal));
  }
  for (const TurningBody<S>* other : {&pair.a, &pair.b}) {
    if (other == own || other->core.count == 0 || (!other->turns() && !turns)) continue;
    if (turns) {
      plane.curvature +=
          product_curvature<S>(pair, own->angle, other->angle, S(1), off_axis, other->far, other->off_axis);
    } else {
      plane.curvature += other->angle * other->angle * across<S>(other->axis, normal) * other->off_axis;
    }
  }
  return plane;
}

/// The plane square to an edge of each, both unit and as they are now; their product points from A to B.
template <Scalar S>
AttachedPlane<S> plane_of_edges(const TurningPair<S>& pair, const TurningInstant<S>& now, const Vec3<S>& edge_a,
                                const Vec3<S>& edge_b) {
  AttachedPlane<S> plane;
  plane.rides = Rides::edges;
  const TurningBody<S>&a = pair.a, &b = pair.b;
  plane.edge_a = swing_from(a, now.phase_a, edge_a);
  plane.edge_b = swing_from(b, now.phase_b, edge_b);
  const S a_across = across(a.axis, edge_a), b_across = across(b.axis, edge_b);
  const S rate_a = a.angle * a_across, rate_b = b.angle * b_across;
  plane.per_distance = a.angle * rate_a + S(2) * rate_a * rate_b + b.angle * rate_b;
  plane.per_path = S(2) * (rate_a + rate_b);
  const S far_a = farthest(mapped(now.core_a, [&](const Vec3<S>& v) { return cross(v, edge_a); }));
  const S far_b = farthest(mapped(now.core_b, [&](const Vec3<S>& v) { return cross(v, edge_b); }));
  plane.curvature = product_curvature<S>(pair, a.angle, b.angle, far_a, far_a, S(1), b_across) +
                    product_curvature<S>(pair, a.angle, b.angle, S(1), a_across, far_b, far_b);
  if (pair.reach > S(0))
    plane.per_sine = pair.reach * product_curvature<S>(pair, a.angle, b.angle, S(1), a_across, S(1), b_across);
  return plane;
}

/// The part of the curvature that comes of the centers' motion until the last time that counts: a norm of a vector that is linear in time is
/// largest at one of the ends.
template <Scalar S>
S curvature_of_centers(const TurningPair<S>& pair, const AttachedPlane<S>& plane, const TurningInstant<S>& now) {
  using std::sqrt;
  if (plane.per_distance == S(0) && plane.per_path == S(0)) return S(0);
  const Vec3<S> last = pair.between + pair.path * pair.last;
  if (plane.rides == Rides::edges) {
    const S most = std::max(S(now.between.squaredNorm()), S(last.squaredNorm()));
    return plane.per_distance * sqrt(most) + plane.per_path * norm(pair.path);
  }
  const TurningBody<S>& own = plane.rides == Rides::a ? pair.a : pair.b;
  const Vec3<S> twice = cross(pair.path, own.axis) * S(2);
  const auto at = [&](const Vec3<S>& between) {
    return S((cross(own.axis, cross(own.rotation, between)) + twice).squaredNorm());
  };
  return plane.per_distance * sqrt(std::max(at(now.between), at(last)));
}

/// What a core takes of the gap: `normal` now, and how it changes seen from the core; `side` 1 for A, -1 for B.
template <Scalar S>
THINWALL_HOT void take_core(ConcaveBound<S>& bound, const CoreVectors<S>& core, const Vec3<S>& normal,
                            const Vec3<S>& change, const S& side) {
  for (const Vec3<S>& v : core) {
    const S value = normal.dot(v), slope = change.dot(v);
    if (core.corners) {
      bound.add_corner(side * value, side * slope);
    } else {
      bound.add_edge(value, slope);
    }
  }
}

/// A gap from now on, and the length of the normal it is counted along.
template <Scalar S> struct GapAhead {
  ConcaveBound<S> bound;
  S scale = 1;
};

/// The gap across the plane from now on, at most to the last time that counts; `of_centers` is its curvature_of_centers() until then.
template <Scalar S>
THINWALL_HOT GapAhead<S> gap_ahead(const TurningPair<S>& pair, const AttachedPlane<S>& plane,
                                   const TurningInstant<S>& now, const S& of_centers) {
  GapAhead<S> ahead;
  ConcaveBound<S>& bound = ahead.bound;
  const TurningBody<S>&a = pair.a, &b = pair.b;
  bound.curvature = plane.curvature;
  if (plane.rides == Rides::edges) {
    const Vec3<S> edge_a = plane.edge_a.at(now.phase_a), edge_b = plane.edge_b.at(now.phase_b);
    const Vec3<S> n = cross(edge_a, edge_b), rate = b.rotation - a.rotation;
    const Vec3<S> change = cross<S>(cross(a.rotation, edge_a), edge_b) + cross<S>(edge_a, cross(b.rotation, edge_b));
    ahead.scale = norm(n);
    bound.gap = n.dot(now.between) - pair.reach * ahead.scale - pair.margin;
    bound.slope = change.dot(now.between) + n.dot(pair.path) - (S(1) + pair.turn) * pair.margin;
    if (pair.reach > S(0)) {
      bound.slope -= (pair.reach * edge_a.dot(edge_b) * n.dot(rate) + pair.turn * pair.margin) / ahead.scale;
      bound.curvature += plane.per_sine / ahead.scale;
    }
    // n.v of A is (v x edge_a).edge_b, of which the second turns against the first; of B (edge_b x v).edge_a.
    const Vec3<S> change_b = cross(rate, edge_b), change_a = cross(edge_a, rate);
    take_core<S>(bound, mapped(now.core_a, [&](const Vec3<S>& v) { return cross(v, edge_a); }), edge_b, change_b, S(1));
    take_core<S>(bound, mapped(now.core_b, [&](const Vec3<S>& v) { return cross(edge_b, v); }), edge_a, change_a,
                 S(-1));
  } else {
    const bool with_a = plane.rides == Rides::a, with_b = plane.rides == Rides::b;
    const Vec3<S> n =
        plane.rides == Rides::world ? plane.normal.along : plane.normal.at(with_a ? now.phase_a : now.phase_b);
    const Vec3<S> rate = with_a ? a.rotation : with_b ? b.rotation : Vec3<S>(Vec3<S>::Zero());
    bound.gap = n.dot(now.between) - plane.reach - pair.margin;
    bound.slope = cross(rate, n).dot(now.between) + n.dot(pair.path) - (S(1) + pair.turn) * pair.margin;
    if (!with_a && a.core.count > 0) take_core<S>(bound, now.core_a, n, cross<S>(rate - a.rotation, n), S(1));
    if (!with_b && b.core.count > 0) take_core<S>(bound, now.core_b, n, cross<S>(rate - b.rotation, n), S(-1));
  }
  const S slack = 32 * std::numeric_limits<S>::epsilon();
  bound.curvature = (bound.curvature + of_centers) * (S(1) + slack) + pair.turn * pair.turn * pair.margin;
  return ahead;
}

}  // namespace thinwall
