#pragma once
/// Who met whom, and when: a contact begins once, stays, and ends on the n-th consecutive step apart.
///
/// Every step names its contacts with meet() and is closed by finish_step(), which tells, in the order of the ids:
///   begin   the two were not in contact and met in this step
///   stay    they were, and met again
///   end     they have not met in `end_after` consecutive steps, or one of them was removed
/// In the steps apart before the end nothing is told: a contact that flickers is one contact. So begins and ends alternate
/// for every pair, a begin first. With end_after = 1 a contact ends on the first step apart.
///
/// remove() ends all contacts of a body at once. It may be called at any time, by a listener too: what the step has decided is
/// told first, the ends that a removal adds after it, so that no end comes before its begin.
///
/// Cost of a step: the contacts met are sorted, and merged with those that live.

#include <algorithm>
#include <compare>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace thinwall {

enum class CollisionEventKind { begin, stay, end };

struct CollisionEvent {
  CollisionEventKind kind = CollisionEventKind::begin;
  std::uint32_t first = 0, second = 0;  ///< ids, first < second
  std::uint64_t step = 0;               ///< 1 for the first; of a removal between two steps, the one before
  double time = 0;                      ///< [s] when they met; of an end, when the step ended
  bool removed = false;                 ///< an end because one of the two was removed
  bool operator==(const CollisionEvent&) const = default;
};

class CollisionEvents {
 public:
  using Listener = std::function<void(const CollisionEvent&)>;

  /// `end_after` [1] >= 1, in steps; less counts as 1.
  explicit CollisionEvents(int end_after = 1) : end_after_(std::max(1, end_after)) {}

  /// The two are in contact in this step, since `time` [s]. In any order, more than once: the earliest time counts.
  void meet(std::uint32_t a, std::uint32_t b, double time);

  /// Ends the step at `time` [s], and tells the listeners.
  void finish_step(double time);

  /// Ends every contact of the body at `time` [s], and forgets its name.
  void remove(std::uint32_t id, double time);

  /// What the last step told, in order, and before it what removals since the step before told.
  const std::vector<CollisionEvent>& events() const { return events_; }

  /// Called with each event as it is told, in the order of adding. Returns a number for forget().
  std::size_t listen(Listener listener);
  void forget(std::size_t listener);

  void name(std::uint32_t id, std::string name) { names_[id] = std::move(name); }
  /// `body ID` where none was given.
  std::string name_of(std::uint32_t id) const;
  /// `1.25 s: bullet meets wall`, `... leaves ...`, `... stays on ...`
  std::string to_text(const CollisionEvent& event) const;

  std::size_t live() const;  ///< contacts that have begun and not ended
  std::uint64_t steps() const { return step_; }

 private:
  int end_after_;
  std::uint64_t step_ = 0;
  std::vector<CollisionEvent> events_;
  std::map<std::uint32_t, std::string> names_;
};

}  // namespace thinwall
