#pragma once
/// What contacts do to motions that are known for the whole step: the events of a step in the order of their times.

#include <queue>
#include <span>
#include <vector>

#include <thinwall/experiments/world/options.hpp>
#include <thinwall/experiments/world/step/narrow_phase.hpp>
#include <thinwall/experiments/world/step/neighbors.hpp>
#include <thinwall/experiments/world/step_report.hpp>

namespace thinwall {

/// Every contact is told. One with a body that an impulse can turn is answered, which takes one of the `max_events` of that body, or
/// ends its motion: a step of n bodies has at most n (max_events + 1) answers.
class EventLoop {
 public:
  struct Scene {
    std::span<const Body> bodies;
    double dt;       ///< [s] of the step
    int max_events;  ///< of a body; then it waits
    int contact_rounds;
    double gate;
    NarrowPhase& narrow;   ///< all placed at the start
    Neighbors& neighbors;  ///< begun
  };

  EventLoop(const Scene& scene, std::vector<BodyMotion>& motions) : scene_(scene), motions_(motions) {}

  /// Bounces and moves the bodies through the step, given what touches on the paths they start with. Appends the contacts that
  /// come about to `processed`.
  void run(std::span<const Touch> found, std::vector<Touch>& processed, StepReport& counts);

 private:
  struct Event {
    Touch touch;
    std::uint32_t version_first = 0, version_second = 0;
    /// The later one: std::priority_queue hands out the greatest. Of one pair at one time the older goes first.
    bool operator<(const Event& other) const {
      if (touch.time != other.touch.time) return touch.time > other.touch.time;
      if (touch.first != other.touch.first) return touch.first > other.touch.first;
      if (touch.second != other.touch.second) return touch.second > other.touch.second;
      if (version_first != other.version_first) return version_first > other.version_first;
      return version_second > other.version_second;
    }
  };

  void resolve_start(std::span<const Touch> found, std::vector<Touch>& processed, StepReport& counts);
  void sweep_changed_at_start(StepReport& counts);
  void schedule(const Touch& touch);
  void happen(const Event& event, std::vector<Touch>& processed, StepReport& counts);
  bool is_on_course(const Event& event) const;
  bool was_on_course(const Event& event) const;
  bool press(const Touch& touch) const;
  void sweep_again(std::uint32_t which, std::uint32_t done, double time, StepReport& counts);
  void advance(std::uint32_t which, double time);
  void change_course(std::uint32_t which);
  void ask(double time, StepReport& counts);
  bool goes_on(std::uint32_t which) const;
  bool is_free(std::uint32_t which) const;

  const Scene& scene_;
  std::vector<BodyMotion>& motions_;
  std::priority_queue<Event> queue_;
  std::vector<bool> changed_;  // by the contacts at the start
  std::vector<ProxyPair> pairs_;
  std::vector<Touch> touches_;
};

}  // namespace thinwall
