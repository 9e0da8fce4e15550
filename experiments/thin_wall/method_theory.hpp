#pragma once
/// Which theory is whose. A method that is not named here has none, and its cells say so.

#include <thinwall/experiments/thin_wall/theory.hpp>
#include <thinwall/swept/methods.hpp>

namespace thinwall {

template <class Method> Theory theory_of(const Method&, const Cell&) { return {}; }
template <Scalar S> Theory theory_of(const EndOfStep<S>&, const Cell& cell) { return pose_theory(cell, 1); }
template <Scalar S> Theory theory_of(const Substeps<S>& method, const Cell& cell) {
  return pose_theory(cell, method.n);
}
template <Scalar S> Theory theory_of(const CentreRay<S>&, const Cell& cell) { return center_ray_theory(cell); }
template <Scalar S> Theory theory_of(const SweptVolumeRay<S>&, const Cell& cell) {
  return swept_volume_ray_theory(cell);
}
template <Scalar S> Theory theory_of(const SweepThenConfirm<S>&, const Cell& cell) {
  return confirmed_ray_theory(cell);
}
template <Scalar S> Theory theory_of(const Speculative<S>&, const Cell& cell) { return speculative_theory(cell); }
template <Scalar S> Theory theory_of(const ConservativeAdvancement<S>& method, const Cell& cell) {
  return early_theory(cell, static_cast<double>(method.tolerance));
}
template <Scalar S> Theory theory_of(const Bisection<S>& method, const Cell& cell) {
  return late_theory(cell, static_cast<double>(method.tolerance));
}
template <Scalar S> Theory theory_of(const Inclusion<S>& method, const Cell& cell) {
  return early_theory(cell, static_cast<double>(method.tolerance));
}
template <Scalar S> Theory theory_of(const ClosedForm<S>&, const Cell&) { return exact_theory(); }

}  // namespace thinwall
