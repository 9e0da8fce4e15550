#pragma once
/// A plane that parts two moving shapes, checked in double.
///
/// For any n the shapes are apart at t if  lowest(n) + t n.v > R |n|,  and so at all times in between where it holds at two.
/// The gap and the closing speed are both rounded outward; a poor n makes a weak proof, never a wrong one.
/// Constants: docs/certified.md.

#include <thinwall/swept/certified/rounded_core.hpp>

namespace thinwall {

/// The sum of |n_i| times the sizes: what one unit of round-off may move n . x by, in u.
THINWALL_HOT double size_along(const Vec3<double>& n, const Vec3<double>& size) { return n.cwiseAbs().dot(size); }

/// The gap across the plane at time t is at least gap - closing * t.
struct PlaneProof {
  double gap = 0;      ///< [length |n|] at the start, rounded down; > 0: apart there
  double closing = 0;  ///< [length |n|] per step, rounded up

  /// The plane parts the shapes until then, at least: rounded down; infinity if it never fails.
  double free_until() const {
    if (!(gap > 0)) return 0;
    if (!(closing > 0)) return std::numeric_limits<double>::infinity();
    return gap / closing * (1 - 4 * roundoff_unit);
  }
};

template <class Core> THINWALL_HOT PlaneProof plane_proof(const Core& core, const Vec3<double>& n) {
  constexpr double u = roundoff_unit, tiny = 0x1p-900;
  const double rounded = core.R * std::sqrt(n.squaredNorm());
  PlaneProof proof;
  proof.gap = (core.lowest(n) - rounded) - (u * (20 * size_along(n, core.size) + 8 * rounded) + tiny);
  proof.closing = (8 * u * size_along(n, core.v.cwiseAbs()) + tiny) - n.dot(core.v);
  return proof;
}

}  // namespace thinwall
