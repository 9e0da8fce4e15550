#pragma once
/// A box around everywhere a shape is that flies and spins: what the broad phase asks.

#include <algorithm>
#include <limits>

#include <thinwall/discrete/aabb.hpp>
#include <thinwall/swept/swept_volume.hpp>
#include <thinwall/swept/turning/turning_pair.hpp>

namespace thinwall {

/// Grows a box, from `low` to `high`, to contain a core with its center there.
template <Scalar S>
void contain(const CoreVectors<S>& core, const Mat3<S>& turn, const Vec3<S>& center, Vec3<S>& low, Vec3<S>& high) {
  Vec3<S> first = center, last = center;
  for (const Vec3<S>& v : core) {
    const Vec3<S> now = turn * v;
    if (core.corners) {
      low = low.cwiseMin(center + now);
      high = high.cwiseMax(center + now);
    } else {
      first -= now.cwiseAbs();
      last += now.cwiseAbs();
    }
  }
  if (core.corners) return;
  low = low.cwiseMin(first);
  high = high.cwiseMax(last);
}

/// A box that contains the shape at every time of the step, rounded outward: around as many poses as lie a sixteenth of a turn apart at most, and
/// what bulges out between two of them. A point at a distance p from the axis swings p |e across the axis| cos(phase) along e, which
/// leaves the chord of an arc of h to either side by 1 - cos(h) at most. Cut to the box around the whole orbit.
/// Error: each side lies at most 0.02 times the farthest point's distance from the axis too far out; volumes are 1.03 to 1.1 times the
/// tightest box's, up to a full turn.
/// Degenerate: no spin is the box of straight motion; from a full turn on it is that around the orbit.
/// Source: derived in docs/turning.md.
template <Shape A> Aabb<typename A::Scalar> swept_bounds(const Turning<A>& m) {
  using S = typename A::Scalar;
  using std::acos, std::sin;
  if (m.rotation == Vec3<S>::Zero()) return swept_bounds(Moving<A>{m.shape, m.displacement});
  const S size = extent(m);
  const int e = is_finite(size) ? binary_exponent(size) : std::numeric_limits<S>::max_exponent;
  if (e < -64 || e > 64) {  // squares would leave the range
    const Aabb<S> box = swept_bounds(scaled(m, -e));
    const Vec3<S> least = Vec3<S>::Constant(64 * std::numeric_limits<S>::denorm_min());
    return {times_power_of_two(box.center, e), times_power_of_two(box.half_extents, e) + least};
  }
  const TurningBody<S> body(m);
  Vec3<S> across_axis;
  for (int i = 0; i < 3; ++i) across_axis[i] = across(body.axis, axis_vector<S>(i)) * body.off_axis;
  const S on_axis = std::max(core_reach(body.core, body.axis), core_reach<S>(body.core, -body.axis));
  const Vec3<S> end = body.center + body.path, orbit = body.axis.cwiseAbs() * on_axis + across_axis;
  const Vec3<S> orbit_low = body.center.cwiseMin(end) - orbit, orbit_high = body.center.cwiseMax(end) + orbit;
  Vec3<S> low = orbit_low, high = orbit_high;
  const S full_turn = 2 * acos(S(-1));
  if (body.angle < full_turn) {
    const int pieces = 1 + static_cast<int>(body.angle * S(16) / full_turn);
    const S piece = body.angle / S(pieces), half_sine = sin(piece / S(4));
    const Mat3<S> onward = rotation_about(body.axis, piece);
    Mat3<S> turn = Mat3<S>::Identity();
    low = high = body.center;
    for (int k = 0; k <= pieces; ++k) {
      contain<S>(body.core, turn, body.center + body.path * (S(k) / S(pieces)), low, high);
      turn = Mat3<S>(onward * turn);
    }
    const Vec3<S> bulge = across_axis * (S(2) * half_sine * half_sine);
    low = (low - bulge).cwiseMax(orbit_low);
    high = (high + bulge).cwiseMin(orbit_high);
  }
  const S slack = 64 * std::numeric_limits<S>::epsilon() * (S(1) + std::min(body.angle, full_turn) / S(4));
  const Vec3<S> outward = Vec3<S>::Constant(body.radius + slack * (size + orbit.sum()));
  return {(low + high) / S(2), (high - low) / S(2) + outward};
}

}  // namespace thinwall
