#pragma once
/// When a moving segment comes within R of a box: the walk of core_entry.hpp over the parts of their Minkowski sum, begun
/// where the shadows on six axes first overlap. Most misses have no such time, and most hits need one part.

#include <thinwall/capsule/segment_box.hpp>
#include <thinwall/swept/closed_form/core_entry.hpp>
#include <thinwall/swept/closed_form/shared_time.hpp>

namespace thinwall {

/// When the shadows of the segment p + v t + s * d, s in [0, 1], rounded by R, and of the box [-h, h] overlap on the three
/// axes of the box and their products with d. Reaches are widened by more than rounding: no contact lies outside.
template <Scalar S>
SharedTime<S> segment_and_box_share(const Vec3<S>& p, const Vec3<S>& v, const Vec3<S>& d, const Vec3<S>& h,
                                    const S& R) {
  using std::sqrt;
  const Vec3<S> middle = p + d / S(2);
  const S noise = gap_noise(largest(middle, d, S(h.sum() + R)));
  SharedTime<S> shared;
  for (int i = 0; i < 3; ++i) shared.narrow(i, middle[i], v[i], h[i] + largest(d[i]) / S(2) + R + noise);
  if (!shared.ever()) return shared;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const S n_j = -d[k], n_k = d[j], length = sqrt(n_j * n_j + n_k * n_k);
    shared.narrow(3 + i, middle[j] * n_j + middle[k] * n_k, v[j] * n_j + v[k] * n_k,
                  h[j] * largest(n_j) + h[k] * largest(n_k) + (R + noise) * length);
  }
  return shared;
}

/// Requires lengths and displacements whose products of four are in range.
template <Scalar S>
Entry<S> capsule_box_entry_in_range(const Vec3<S>& p, const Vec3<S>& v, const S& R, const Vec3<S>& d,
                                    const Vec3<S>& h) {
  const S size = largest(p, R, d, h);
  const SharedTime<S> shared = segment_and_box_share(p, v, d, h, R);
  if (!shared.ever()) return {};
  const bool starts_apart = shared.first > S(0) && R > 4 * gap_noise(size);
  return core_entry(
      p, v, R, largest(d, h), [&](const Vec3<S>& x) { return closest_on_swept_box(x, d, h); },
      starts_apart ? shared.first : S(0));
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
