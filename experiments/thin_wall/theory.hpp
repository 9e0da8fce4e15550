#pragma once
/// What theory expects of each method. A method that is not named here has none, and its cells say so.
/// Derived in docs/tunneling_theory.md.

#include <optional>

#include <thinwall/experiments/thin_wall/cell.hpp>
#include <thinwall/experiments/tunneling_theory.hpp>
#include <thinwall/swept/methods.hpp>

namespace thinwall {

struct Theory {
  std::optional<double> probability;  ///< of tunneling
  std::optional<Lateness> lateness;   ///< [m] along the path, of the detected
};

Theory pose_theory(const Cell& cell, double poses_per_step);
Theory center_ray_theory(const Cell& cell);
Theory swept_volume_ray_theory(const Cell& cell);
Theory exact_theory();

template <class Method> Theory theory_of(const Method&, const Cell&) { return {}; }
template <Scalar S> Theory theory_of(const EndOfStep<S>&, const Cell& cell) { return pose_theory(cell, 1); }
template <Scalar S> Theory theory_of(const Substeps<S>& method, const Cell& cell) {
  return pose_theory(cell, method.n);
}
template <Scalar S> Theory theory_of(const CentreRay<S>&, const Cell& cell) { return center_ray_theory(cell); }
template <Scalar S> Theory theory_of(const SweptVolumeRay<S>&, const Cell& cell) {
  return swept_volume_ray_theory(cell);
}
template <Scalar S> Theory theory_of(const ClosedForm<S>&, const Cell&) { return exact_theory(); }

}  // namespace thinwall
