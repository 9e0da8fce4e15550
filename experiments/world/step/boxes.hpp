#pragma once
/// The box that holds a body in what is left of a step, as the broad phase wants it.

#include <thinwall/discrete/broad_phase/proxy.hpp>
#include <thinwall/experiments/world/body.hpp>
#include <thinwall/experiments/world/step/impulse.hpp>
#include <thinwall/swept/swept_volume.hpp>

namespace thinwall {

/// From the motion's anchor to the end of the step of dt [s], rounded outward.
inline Proxy proxy_of(const Body& body, const BodyMotion& motion, double dt) {
  Proxy proxy;
  proxy.group = body.group;
  proxy.mask = body.mask;
  proxy.is_static = body.is_static;
  proxy.skipped = std::holds_alternative<std::monostate>(body.shape);
  const Vec3<double> displacement = moving_at(motion) * (dt * (1 - motion.anchor));
  std::visit(
      [&]<class A>(const A& shape) {
        if constexpr (!std::is_same_v<A, std::monostate>) {
          const Aabb<double> box = swept_bounds(Moving<A>{moved(shape, motion.offset), displacement});
          proxy.low = box.center - box.half_extents;
          proxy.high = box.center + box.half_extents;
        }
      },
      body.shape);
  return proxy;
}

/// True if the box of `inner` lies in that of `outer`.
inline bool holds_box(const Proxy& outer, const Proxy& inner) {
  return (outer.low.array() <= inner.low.array()).all() && (inner.high.array() <= outer.high.array()).all();
}

}  // namespace thinwall
