#pragma once
/// A path that starts far off is looked at from a point shortly before it passes. What is computed from there has the
/// rounding of the body's size, not that of the distance; and an oriented box, whose axes are orthonormal to rounding only,
/// does not move a whole path by turning it.

#include <thinwall/discrete/numbers/double_word.hpp>
#include <thinwall/discrete/numbers/range.hpp>
#include <thinwall/discrete/scalar.hpp>

namespace thinwall {

/// The path p + v t, of which only what lies within `reach` of the origin matters. A start less than `far` reaches away is
/// left where it is.
/// Error: `start` is p + v * base_time to a rounding of its own.
template <Scalar S> struct NearPath {
  Vec3<S> start;
  S base_time = 0;  ///< [1] >= 0: there is no contact before

  explicit NearPath(const Vec3<S>& p) : start(p) {}  // from where it starts
  NearPath(const Vec3<S>& p, const Vec3<S>& v, const S& reach, const S& far = S(4)) : start(p) {
    if (largest(p) < far * reach) return;
    const SafeScale<S> scale(largest(p), largest(v));
    if (scale.is_one()) {
      begin_later(p, v, reach);
      return;
    }
    begin_later(scale.length(p), scale.displacement(v), scale.length(reach));
    if (base_time == S(0)) return;
    start = scale.length_back(start);
    base_time = scale.time_back(base_time);
  }

 private:
  /// Two reaches, more than the diagonal of a cube of that half width, before closest approach; and as far before that as
  /// rounding may have moved it along the path.
  void begin_later(const Vec3<S>& p, const Vec3<S>& v, const S& reach) {
    const S near = 2 * reach + gap_noise(largest(p));
    const S earlier = -p.dot(v) / v.squaredNorm() - near / safe_norm(v);
    if (!(earlier > S(0)) || !is_finite(earlier)) return;
    base_time = earlier;
    for (int i = 0; i < 3; ++i) start[i] = (exact_product(v[i], earlier) + DoubleWord<S>{p[i], S(0)}).high;
  }
};

}  // namespace thinwall
