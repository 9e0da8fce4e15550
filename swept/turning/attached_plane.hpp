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
  Vec3<S> normal = Vec3<S>::Zero();          ///< unit, from A to B, at the start of the step for what it rides
  Vec3<S> edge_a = normal, edge_b = normal;  ///< `edges`: unit, at the start; their product points from A to B
  CoreVectors<S> beyond_a, beyond_b;         ///< `edges`: what else there is of A, times its edge, and of B
  S reach = 0;                               ///< [length] of the shape it rides, both radii, the minimal separation
  S curvature = 0;                           ///< [length] per step squared: that of the cores,
  S per_distance = 0, per_path = 0, per_sine = 0;  ///< of the centers, and of the radii of `edges` (curvature_at())
};

/// A bound on |(p . q)''| where p and q turn with one body each, by those angles a step: p and q are their lengths, p_across and q_across what of
/// them lies across their axes. Two bounds: differentiated twice; and seen from p, where q turns at the difference of the rotations.
template <Scalar S>
S product_curvature(const TurningPair<S>& pair, const S& angle_p, const S& angle_q, const S& p, const S& p_across,
                    const S& q, const S& q_across) {
  if (angle_p == S(0)) return angle_q * angle_q * p * q_across;
  if (angle_q == S(0)) return angle_p * angle_p * p_across * q;
  const S apart = angle_p * angle_p * p_across * q + S(2) * angle_p * angle_q * p_across * q_across +
                  angle_q * angle_q * p * q_across;
  return std::min(apart, S(p * q * pair.cross_rate));
}

/// The plane across `normal`, a unit vector from A to B given at the start of the step for what it rides.
template <Scalar S> AttachedPlane<S> plane_riding(const TurningPair<S>& pair, Rides rides, const Vec3<S>& normal) {
  AttachedPlane<S> plane;
  plane.rides = rides;
  plane.normal = normal;
  plane.reach = pair.reach;
  const TurningBody<S>* own = rides == Rides::a ? &pair.a : rides == Rides::b ? &pair.b : nullptr;
  const bool turns = own != nullptr && own->angle > S(0);
  const S off_axis = turns ? across(own->axis, normal) : S(0);
  if (own != nullptr) {
    plane.per_distance = own->angle * off_axis;
    plane.reach += core_reach<S>(own->core, rides == Rides::a ? normal : Vec3<S>(-normal));
  }
  for (const TurningBody<S>* other : {&pair.a, &pair.b}) {
    if (other == own || other->core.count == 0 || (other->angle == S(0) && !turns)) continue;
    if (turns) {
      plane.curvature +=
          product_curvature<S>(pair, own->angle, other->angle, S(1), off_axis, other->far, other->off_axis);
    } else {
      plane.curvature += other->angle * other->angle * across<S>(other->axis, normal) * other->off_axis;
    }
  }
  return plane;
}

/// The plane square to an edge of each, both unit and given at the start of the step; their product now points from A to B.
template <Scalar S>
AttachedPlane<S> plane_of_edges(const TurningPair<S>& pair, const Vec3<S>& edge_a, const Vec3<S>& edge_b) {
  AttachedPlane<S> plane;
  plane.rides = Rides::edges;
  plane.edge_a = edge_a;
  plane.edge_b = edge_b;
  const TurningBody<S>&a = pair.a, &b = pair.b;
  plane.beyond_a = mapped(a.core, [&](const Vec3<S>& v) { return cross(v, edge_a); });
  plane.beyond_b = mapped(b.core, [&](const Vec3<S>& v) { return cross(edge_b, v); });
  const S a_across = across(a.axis, edge_a), b_across = across(b.axis, edge_b);
  const S rate_a = a.angle * a_across, rate_b = b.angle * b_across;
  plane.per_distance = a.angle * rate_a + S(2) * rate_a * rate_b + b.angle * rate_b;
  plane.per_path = S(2) * (rate_a + rate_b);
  const S far_a = farthest(plane.beyond_a), far_b = farthest(plane.beyond_b);
  plane.curvature = product_curvature<S>(pair, a.angle, b.angle, far_a, far_a, S(1), b_across) +
                    product_curvature<S>(pair, a.angle, b.angle, S(1), a_across, far_b, far_b);
  plane.per_sine = pair.reach * product_curvature<S>(pair, a.angle, b.angle, S(1), a_across, S(1), b_across);
  return plane;
}

/// The part of the curvature that comes of the centers' motion until the end of the step: a norm of a vector that is linear in time is
/// largest at one of the ends.
template <Scalar S>
S curvature_of_centers(const TurningPair<S>& pair, const AttachedPlane<S>& plane, const TurningInstant<S>& now) {
  using std::sqrt;
  if (plane.per_distance == S(0) && plane.per_path == S(0)) return S(0);
  const Vec3<S> last = pair.between + pair.path;
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

/// What a core takes of the gap: `normal` now and how it changes, in the world; `side` 1 for A, -1 for B.
template <Scalar S>
void take_core(ConcaveBound<S>& bound, const TurningBody<S>& body, const CoreVectors<S>& core, const Mat3<S>& turn,
               const Vec3<S>& normal, const Vec3<S>& change, const S& side) {
  if (core.count == 0) return;
  const Vec3<S> seen = body.seen(turn, normal), seen_change = body.seen(turn, change);
  for (const Vec3<S>& v : core) {
    const S value = seen.dot(v), slope = seen_change.dot(v);
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

/// The gap across the plane from now on, at most to the end of the step; `of_centers` is its curvature_of_centers() until then.
template <Scalar S>
THINWALL_HOT GapAhead<S> gap_ahead(const TurningPair<S>& pair, const AttachedPlane<S>& plane,
                                   const TurningInstant<S>& now, const S& of_centers) {
  GapAhead<S> ahead;
  ConcaveBound<S>& bound = ahead.bound;
  const TurningBody<S>&a = pair.a, &b = pair.b;
  bound.curvature = plane.curvature;
  if (plane.rides == Rides::edges) {
    const Vec3<S> edge_a = a.in_world(now.turn_a, plane.edge_a), edge_b = b.in_world(now.turn_b, plane.edge_b);
    const Vec3<S> n = cross(edge_a, edge_b), rate = b.rotation - a.rotation;
    const Vec3<S> change = cross<S>(cross(a.rotation, edge_a), edge_b) + cross<S>(edge_a, cross(b.rotation, edge_b));
    ahead.scale = norm(n);
    bound.gap = n.dot(now.between) - pair.reach * ahead.scale - pair.margin;
    bound.slope = change.dot(now.between) + n.dot(pair.path) - (S(1) + pair.turn) * pair.margin;
    if (pair.reach > S(0)) {
      bound.slope -= (pair.reach * edge_a.dot(edge_b) * n.dot(rate) + pair.turn * pair.margin) / ahead.scale;
      bound.curvature += plane.per_sine / ahead.scale;
    }
    take_core<S>(bound, a, plane.beyond_a, now.turn_a, edge_b, cross(rate, edge_b), S(1));
    take_core<S>(bound, b, plane.beyond_b, now.turn_b, edge_a, cross(edge_a, rate), S(-1));
  } else {
    const bool with_a = plane.rides == Rides::a, with_b = plane.rides == Rides::b;
    const Vec3<S> n = with_a   ? a.in_world(now.turn_a, plane.normal)
                      : with_b ? b.in_world(now.turn_b, plane.normal)
                               : plane.normal;
    const Vec3<S> rate = with_a ? a.rotation : with_b ? b.rotation : Vec3<S>(Vec3<S>::Zero());
    bound.gap = n.dot(now.between) - plane.reach - pair.margin;
    bound.slope = cross(rate, n).dot(now.between) + n.dot(pair.path) - (S(1) + pair.turn) * pair.margin;
    if (!with_a) take_core<S>(bound, a, a.core, now.turn_a, n, cross<S>(rate - a.rotation, n), S(1));
    if (!with_b) take_core<S>(bound, b, b.core, now.turn_b, n, cross<S>(rate - b.rotation, n), S(-1));
  }
  constexpr S slack = 32 * std::numeric_limits<S>::epsilon();
  bound.curvature = (bound.curvature + of_centers) * (S(1) + slack) + pair.turn * pair.turn * pair.margin;
  return ahead;
}

}  // namespace thinwall
