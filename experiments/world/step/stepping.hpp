#pragma once
/// One step of a world, on paper: what moves where, who meets whom. The world takes it over once all of it is known, so that
/// a step that fails changes nothing.

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include <thinwall/experiments/world/step/narrow_phase.hpp>
#include <thinwall/experiments/world/step/neighbors.hpp>
#include <thinwall/experiments/world/step/pair_finder.hpp>
#include <thinwall/experiments/world/world.hpp>

namespace thinwall {

/// Steps bodies that stay in their order; keeps its memory from step to step.
class Stepper {
 public:
  Stepper(const WorldOptions& options, const Plan& plan);

  /// A step of dt [s]. `changed_by_hand`: bodies came, went or were moved since the last one.
  void run(std::span<const Body> bodies, double dt, bool changed_by_hand);

  const std::vector<BodyMotion>& motions() const { return motions_; }  ///< each at its end: `anchor` is 1
  const std::vector<Touch>& touches() const { return touches_; }       ///< in the order they were processed
  const StepReport& counts() const { return counts_; }                 ///< no step, no time
  std::size_t bytes() const;

 private:
  // stepping.cpp
  void begin(double dt, bool changed_by_hand);
  void fall(double dt);
  void box(double dt);
  void require_in_the_world(std::size_t which, const Vec3<double>& displacement) const;
  void finish();
  void find_touches(const std::function<Asked(std::span<const ProxyPair>)>& ask);
  void mark_proxies(bool as_they_are);
  void count(const Asked& asked);
  // sampled_step.cpp
  void sampled_step(int parts);
  void respond_at_instant(std::vector<BodyMotion>& motions);
  // swept_step.cpp
  void swept_step();
  void play(std::vector<BodyMotion>& motions, std::vector<Touch>& processed, StepReport& counts);

  WorldOptions options_;
  Plan plan_;
  PairFinder finder_;
  std::unique_ptr<NarrowPhase> narrow_;
  Neighbors neighbors_;
  std::span<const Body> bodies_;
  double dt_ = 0;
  bool ready_ = false;    // the last step came to its end
  bool all_anew_ = true;  // the boxes and places of bodies at rest too
  std::vector<BodyMotion> motions_;
  std::vector<Proxy> proxies_;
  std::vector<ProxyPair> pairs_;
  std::vector<Touch> touches_, found_;
  std::vector<bool> has_links_;
  StepReport counts_;
};

/// Adds the seconds until the end of its scope.
class PhaseClock {
 public:
  explicit PhaseClock(double& seconds);
  ~PhaseClock();
  PhaseClock(const PhaseClock&) = delete;
  PhaseClock& operator=(const PhaseClock&) = delete;

 private:
  double* seconds_;
  double start_;
};

}  // namespace thinwall
