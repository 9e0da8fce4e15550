#pragma once
/// The policies of a step: sampled, or swept.

#include <functional>
#include <memory>
#include <queue>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include <thinwall/experiments/world/pairs.hpp>

namespace thinwall {

// ---- One step of a world, on paper: what moves where, who meets whom. The world takes it over once all of it is known, so that
// a step that fails changes nothing.

/// Steps bodies that stay in their order; keeps its memory from step to step.
class Stepper {
 public:
  Stepper(const WorldOptions& options, const Plan& plan);

  /// A step of dt [s]. `changed_by_hand`: bodies came, went or were moved since the last one.
  void run(std::span<const Body> bodies, double dt, bool changed_by_hand);

  const std::vector<BodyMotion>& motions() const { return motions_; }  ///< each at its end: `anchor` is 1
  const std::vector<Spin>& spins() const { return spins_; }            ///< the same; none where nothing turns
  const std::vector<Touch>& touches() const { return touches_; }       ///< in the order they were processed
  const StepReport& counts() const { return counts_; }                 ///< no step, no time
  std::size_t bytes() const;

 private:
  void begin(double dt, bool changed_by_hand);
  void fall(double dt);
  void box(double dt);
  void require_in_the_world(std::size_t which, const Vec3<double>& displacement) const;
  Spin* spin(std::size_t which) { return spin_of(spins_, bodies_[which], which); }
  void finish();
  void find_touches(const std::function<Asked(std::span<const ProxyPair>)>& ask);
  void mark_proxies(bool as_they_are);
  void sampled_step(int parts);
  bool is_pushed_through(const Touch& touch, double before);
  AnyShape shape_at(std::size_t which, double time);
  void respond_at_instant(std::vector<BodyMotion>& motions, std::vector<Spin>& spins);
  void swept_step();
  void go_straight_on();
  void play(std::vector<BodyMotion>& motions, std::vector<Spin>& spins, std::vector<Touch>& processed,
            StepReport& counts);

  WorldOptions options_;
  Plan plan_;
  std::unique_ptr<PairFinder> finder_;
  std::unique_ptr<NarrowPhase> narrow_;
  Neighbors neighbors_;
  std::span<const Body> bodies_;
  double dt_ = 0;
  bool ready_ = false;    // the last step came to its end
  bool all_anew_ = true;  // the boxes and places of bodies at rest too
  std::vector<BodyMotion> motions_;
  std::vector<Spin> spins_;  // one a body, or none where nothing turns
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

// ---- What contacts do to motions that are known for the whole step: the events of a step in the order of their times.

/// Throws TurnsTooFar if the sweep of one of these gave up.
void require_answers(std::span<const Body> bodies, std::span<const Touch> touches);

/// Every contact is told. One with a body that an impulse can turn is answered, which takes one of the `max_events` of that body, or
/// ends its motion: a step of n bodies has at most n (max_events + 2) answers.
class EventLoop {
 public:
  struct Scene {
    std::span<const Body> bodies;
    double dt;       ///< [s] of the step
    int max_events;  ///< of a body; then it waits
    const WorldOptions& options;
    NarrowPhase& narrow;   ///< all placed at the start
    Neighbors& neighbors;  ///< begun
  };

  /// Moves `motions` and `spins`, appends the contacts that come about to `processed`, and adds to `counts`.
  EventLoop(const Scene& scene, std::vector<BodyMotion>& motions, std::vector<Spin>& spins,
            std::vector<Touch>& processed, StepReport& counts)
      : scene_(scene), motions_(motions), spins_(spins), processed_(processed), counts_(counts) {}

  /// Bounces and moves the bodies through the step, given what touches on the paths they start with.
  void run(std::span<const Touch> found);

 private:
  struct Event {
    Touch touch;
    std::uint32_t version_first = 0, version_second = 0;
    bool is_look = false;  ///< not a contact: until then two that touch and turn have not sunk into each other
    /// The later one: std::priority_queue hands out the greatest. Of one pair at one time the older goes first.
    bool operator<(const Event& other) const {
      if (touch.time != other.touch.time) return touch.time > other.touch.time;
      if (touch.first != other.touch.first) return touch.first > other.touch.first;
      if (touch.second != other.touch.second) return touch.second > other.touch.second;
      if (version_first != other.version_first) return version_first > other.version_first;
      return version_second > other.version_second;
    }
  };

  void resolve_start(std::span<const Touch> found);
  void sweep_changed_at_start();
  void schedule(const Touch& touch);
  void happen(const Event& event);
  bool is_on_course(const Event& event) const;
  bool was_on_course(const Event& event) const;
  bool press(const Touch& touch);
  bool may_sink(const Touch& touch);
  void tell(const Touch& touch);
  void keep_no_more_speed(std::uint32_t which);
  double closing(const Touch& touch, bool in_effect);
  void look_later(const Touch& touch, double time);
  void look(const Event& event);
  enum class Answer { take_event, go_on, wait };  // a contact; one that goes on; one that has been looked at too often
  void answer(const Touch& touch, Answer how);
  Mover mover(std::uint32_t which) {
    const Body& body = scene_.bodies[which];
    return {body, motions_[which], spin_of(spins_, body, which)};
  }
  void place(std::uint32_t which, double time);
  void sweep_again(std::uint32_t which, std::uint32_t done, double time);
  void advance(std::uint32_t which, double time);
  void change_course(std::uint32_t which);
  void ask(double time);
  bool goes_on(std::uint32_t which) const;
  bool is_free(std::uint32_t which) const;

  const Scene& scene_;
  std::vector<BodyMotion>& motions_;
  std::vector<Spin>& spins_;
  std::vector<Touch>& processed_;
  StepReport& counts_;
  std::priority_queue<Event> queue_;
  std::vector<bool> changed_;                               // by the contacts at the start
  std::vector<Touch> contacts_;                             // at the start
  std::set<std::pair<std::uint32_t, std::uint32_t>> told_;  // of these, once one is told again
  std::vector<ProxyPair> pairs_;
  std::vector<Touch> touches_;
};

}  // namespace thinwall
