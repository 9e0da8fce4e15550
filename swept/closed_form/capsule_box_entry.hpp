#pragma once
/// When a moving segment comes within R of a box: the walk of core_entry.hpp over the parts of their Minkowski sum, begun
/// where the shadows on six axes first overlap. Most misses have no such time, and most hits need one part. Where R is zero that
/// time is the answer: the six axes are the normals of the sum's faces.

#include <thinwall/capsule/segment_box.hpp>
#include <thinwall/discrete/obb.hpp>
#include <thinwall/swept/closed_form/core_entry.hpp>
#include <thinwall/swept/closed_form/shared_time.hpp>

namespace thinwall {

/// When the shadows of the segment p + v t + s * d, s in [0, 1], rounded by R, and of a box around 0 overlap on the three axes of the box and
/// their products with d: all there are where R is zero. `faces` are the normals of its faces, which its axes are but for roundings.
template <Scalar S>
SharedTime<S> segment_and_box_share(const Vec3<S>& p, const Vec3<S>& v, const Vec3<S>& d, const Vec3<S>& h, const S& R,
                                    const Mat3<S>& axes, const Mat3<S>& faces) {
  const Vec3<S> middle = p + d / S(2);
  SharedTime<S> shared(p.cwiseAbs().sum() + d.cwiseAbs().sum() + h.sum() + R);
  const auto narrow = [&](int number, const Vec3<S>& n, const S& reach_of_segment) {
    const S reach = h.dot(Vec3<S>(axes.transpose() * n).cwiseAbs()) + reach_of_segment;
    shared.narrow(number, middle.dot(n), v.dot(n), reach, n.cwiseAbs().sum());
  };
  for (int i = 0; i < 3; ++i) narrow(i, faces.col(i), largest(S(d.dot(faces.col(i)))) / S(2) + R);
  if (!shared.ever()) return shared;
  for (int i = 0; i < 3; ++i) {
    const Vec3<S> n = accurate_cross<S>(axes.col(i), d);
    const int e = safe_exponent(largest(n));  // along an axis, but for so little that its square would be lost
    const Vec3<S> scaled = times_power_of_two(n, -e);
    narrow(3 + i, scaled, R * scaled.norm());
  }
  return shared;
}

/// When a segment without a radius meets a box around 0 of any axes: the shadows on six axes are all there is. But for whether it starts there
/// nothing is turned into the box's own axes, on each of which a long core would be off by its length's rounding.
template <Scalar S>
Entry<S> sharp_segment_box_entry(const Vec3<S>& p, const Vec3<S>& v, const Vec3<S>& d, const Vec3<S>& h,
                                 const Mat3<S>& axes) {
  Entry<S> entry;
  const CorePart<S> part = closest_on_swept_box<S>(Vec3<S>(axes.transpose() * p), Vec3<S>(axes.transpose() * d), h);
  entry.inside = part.contains_point() || part.gap == Vec3<S>::Zero();
  if (entry.inside) return entry;
  Mat3<S> faces;
  for (int i = 0; i < 3; ++i) faces.col(i) = face_normal(axes, i);
  const SharedTime<S> shared = segment_and_box_share(p, v, d, h, S(0), axes, faces);
  entry.graze = shared.close();
  if (!shared.ever() || shared.decided_by < 0) return entry;
  entry.time = shared.time();
  entry.not_before = shared.second;
  entry.not_after = shared.last;
  const int i = shared.decided_by % 3;
  const Vec3<S> n = safe_unit<S>(shared.decided_by < 3 ? Vec3<S>(faces.col(i)) : accurate_cross<S>(axes.col(i), d));
  entry.normal = v.dot(n) > S(0) ? Vec3<S>(-n) : n;
  return entry;
}

/// Requires lengths and displacements whose products of four are in range.
template <Scalar S>
Entry<S> capsule_box_entry_in_range(const Vec3<S>& p, const Vec3<S>& v, const S& R, const Vec3<S>& d,
                                    const Vec3<S>& h) {
  const S size = largest(p, R, d, h), noise = gap_noise(largest(p, d, S(h.sum() + R)));
  if (R == S(0)) return sharp_segment_box_entry<S>(p, v, d, h, Mat3<S>::Identity());
  const Mat3<S> upright = Mat3<S>::Identity();
  const SharedTime<S> shared =
      segment_and_box_share<S>(p, v, d, h, S(R + noise), upright, upright);  // no contact lies outside
  if (!shared.ever()) return {};
  const bool starts_apart = shared.first > S(0) && R > 4 * gap_noise(size);
  return core_entry(
      p, v, R, largest(d, h), [&](const Vec3<S>& x) { return closest_on_swept_box(x, d, h); },
      starts_apart ? shared.time() : S(0));
}

/// First time at which the segment p + v t + s * d, s in [0, 1], is within R of the box [-h, h]; the normal out of the box.
template <Scalar S>
Entry<S> capsule_box_entry(const Vec3<S>& p, const Vec3<S>& v, const S& R, const Vec3<S>& d, const Vec3<S>& h) {
  return entry_at_safe_scale<S>(&capsule_box_entry_in_range<S>, p, v, R, d, h);
}

/// Where the two touch, on the box, for the segment's start at x.
template <Scalar S> Vec3<S> point_on_box(const Vec3<S>& x, const Vec3<S>& d, const Vec3<S>& h) {
  return Vec3<S>(x + d * closest_parameter_to_box(x, d, h)).cwiseMin(h).cwiseMax(-h);
}

}  // namespace thinwall
