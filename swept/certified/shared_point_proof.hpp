#pragma once
/// A point that two boxes share, checked in double: the proof of overlap where there is no radius.
///
/// Any point of A, given by factors in [-1, 1] of its half axes, is a point of B if its factors there, by Cramer's rule,
/// are in [-1, 1] too, with the rounding of every determinant bounded. Constants: docs/certified.md.

#include <thinwall/swept/certified/crossing_proof.hpp>

namespace thinwall {

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
