#pragma once
/// Asks many pairs at once, grouped by type pair, split among threads in blocks of fixed size: the answers and their order
/// do not depend on the threads.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <thinwall/discrete/broad_phase/proxy.hpp>
#include <thinwall/experiments/world/body.hpp>
#include <thinwall/experiments/world/step/impulse.hpp>

namespace thinwall {

/// A pair in contact, by the places of its bodies in the list.
struct Touch {
  std::uint32_t first = 0, second = 0;         ///< places, first < second
  double time = 0;                             ///< [1] part of the step
  bool at_start = false;                       ///< in contact where the question starts already
  Vec3<double> normal = Vec3<double>::Zero();  ///< unit, from first to second
  Vec3<double> point = Vec3<double>::Zero();   ///< [m]
  double penetration = 0;                      ///< [m] >= 0; at an instant alone
};

/// What a question cost, for the report.
struct Asked {
  std::size_t pairs = 0;
  std::size_t gated = 0;  ///< not swept, because both moved less than the gate
};

/// The bodies as the narrow phase reads them: each at some time of the step, with what is left of its motion.
class NarrowPhase {
 public:
  NarrowPhase() = default;
  NarrowPhase(const NarrowPhase&) = delete;
  NarrowPhase& operator=(const NarrowPhase&) = delete;
  virtual ~NarrowPhase() = default;

  /// As many bodies as given, where their motions' anchors are. Those that cannot move keep their old place unless
  /// `resting_too`.
  virtual void place(std::span<const Body> bodies, std::span<const BodyMotion> motions, double dt,
                     bool resting_too) = 0;
  /// One of them, at `time` [1].
  virtual void place_one(std::uint32_t which, const Body& body, const BodyMotion& motion, double time, double dt) = 0;

  /// Appends the pairs that come into contact in what is left of the step from `start` [1] on, in the order of `pairs`.
  /// All must be placed at that time. gate [1]: see WorldOptions.
  virtual Asked sweep(std::span<const ProxyPair> pairs, double start, double gate, std::vector<Touch>& touches) = 0;
  /// Appends the pairs in contact where they are placed, with penetrations.
  virtual Asked look(std::span<const ProxyPair> pairs, std::vector<Touch>& touches) = 0;

  virtual std::size_t bytes() const = 0;
};

/// With the kernels of spheres and axis-aligned boxes alone, or of every shape; on `threads` >= 1 threads.
std::unique_ptr<NarrowPhase> make_narrow_phase(bool sphere_aabb, int threads);

/// [m] Where a body is at `time` [1], relative to its place at the start of the step of dt [s].
inline Vec3<double> offset_at(const BodyMotion& motion, double time, double dt) {
  if (time == motion.anchor) return motion.offset;
  return motion.offset + moving_at(motion) * (dt * (time - motion.anchor));
}

}  // namespace thinwall
