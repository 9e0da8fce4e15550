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
#include <cstddef>
#include <cstdint>
#include <functional>
#include <locale>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <thinwall/discrete/raised_flag.hpp>

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

  /// The two are in contact in this step, since `time` [s]. In any order, more than once: the earliest time counts. A
  /// body does not meet itself.
  void meet(std::uint32_t a, std::uint32_t b, double time) {
    if (a != b) met_.push_back({std::minmax(a, b), time});
  }

  /// Ends the step at `time` [s], and tells the listeners. Not from within a listener.
  void finish_step(double time);

  /// Ends every contact of the body at `time` [s], and forgets what it met in a step that is not finished.
  void remove(std::uint32_t id, double time);

  /// What the last step told, in order, and before it what removals since the step before told.
  const std::vector<CollisionEvent>& events() const { return events_; }

  /// Called with each event as it is told, in the order of adding. Returns a number for forget(). An exception goes
  /// through to the caller of finish_step(); events() has everything, but no listener is told the rest.
  std::size_t listen(Listener listener) {
    listeners_.emplace_back(next_listener_, std::move(listener));
    return next_listener_++;
  }
  void forget(std::size_t listener) {
    std::erase_if(listeners_, [&](const auto& entry) { return entry.first == listener; });
  }

  /// For the log. A name outlives its body, so that what ended can still be told.
  void name(std::uint32_t id, std::string name) { names_[id] = std::move(name); }
  std::string name_of(std::uint32_t id) const;
  /// `1.25 s: bullet meets wall`, `... stays on ...`, `... leaves ...`
  std::string to_text(const CollisionEvent& event) const;

  std::size_t live() const { return live_.size(); }  ///< contacts that have begun and not ended
  std::uint64_t steps() const { return step_; }      ///< finished

 private:
  using Pair = std::pair<std::uint32_t, std::uint32_t>;
  struct Met {
    Pair pair;
    double time;  // [s]
    bool operator<(const Met& other) const { return pair < other.pair || (pair == other.pair && time < other.time); }
  };
  struct Live {
    Pair pair;
    int apart;  // consecutive steps
  };

  void tell(const CollisionEvent& event);
  void tell_from(std::vector<CollisionEvent>& list, std::size_t first);

  int end_after_;
  std::uint64_t step_ = 0;
  std::vector<Met> met_;
  std::vector<Live> live_, still_live_;        // in the order of pairs
  std::vector<CollisionEvent> events_, ends_;  // ends_: by removals since the last step
  std::vector<std::pair<std::size_t, Listener>> listeners_;
  std::size_t next_listener_ = 0;
  bool telling_ = false, of_a_step_ = false;  // what is told: events_, else ends_
  std::map<std::uint32_t, std::string> names_;
};

inline void CollisionEvents::finish_step(double time) {
  ++step_;
  events_.clear();
  events_.swap(ends_);  // told when they happened
  const std::size_t first = events_.size();
  std::sort(met_.begin(), met_.end());  // of a pair met twice the earlier one first
  still_live_.clear();
  const auto tell = [&](CollisionEventKind kind, const Pair& pair, double when) {
    events_.push_back({kind, pair.first, pair.second, step_, when, false});
  };
  std::size_t m = 0, l = 0;
  while (m < met_.size() || l < live_.size()) {
    const bool is_met = m < met_.size() && (l == live_.size() || met_[m].pair <= live_[l].pair);
    const bool is_live = l < live_.size() && (m == met_.size() || live_[l].pair <= met_[m].pair);
    if (is_met) {
      const Met met = met_[m];
      tell(is_live ? CollisionEventKind::stay : CollisionEventKind::begin, met.pair, met.time);
      still_live_.push_back({met.pair, 0});
      while (m < met_.size() && met_[m].pair == met.pair) ++m;
    } else if (const Live& gone = live_[l]; gone.apart + 1 < end_after_) {
      still_live_.push_back({gone.pair, gone.apart + 1});
    } else {
      tell(CollisionEventKind::end, gone.pair, time);
    }
    if (is_live) ++l;
  }
  live_.swap(still_live_);
  met_.clear();
  const RaisedFlag of_a_step(of_a_step_);
  tell_from(events_, first);
}

inline void CollisionEvents::remove(std::uint32_t id, double time) {
  const auto has = [&](const auto& entry) { return entry.pair.first == id || entry.pair.second == id; };
  std::vector<CollisionEvent>& list = of_a_step_ ? events_ : ends_;
  const std::size_t first = list.size();
  for (const Live& live : live_) {
    if (!has(live)) continue;
    list.push_back({CollisionEventKind::end, live.pair.first, live.pair.second, step_, time, true});
  }
  std::erase_if(live_, has);
  std::erase_if(met_, has);
  if (!telling_) tell_from(ends_, first);  // else whoever is telling comes to them
}

/// To all listeners there are by then, by their numbers, which rise: one may add others or forget them, itself included.
inline void CollisionEvents::tell(const CollisionEvent& event) {
  for (std::size_t next = 0;;) {
    const auto listener =
        std::partition_point(listeners_.begin(), listeners_.end(), [&](const auto& l) { return l.first < next; });
    if (listener == listeners_.end()) return;
    next = listener->first + 1;
    Listener(listener->second)(event);
  }
}

/// A listener may remove bodies, which adds events.
inline void CollisionEvents::tell_from(std::vector<CollisionEvent>& list, std::size_t first) {
  const RaisedFlag telling(telling_);
  for (std::size_t i = first; i < list.size(); ++i) {
    const CollisionEvent event = list[i];
    tell(event);
  }
}

inline std::string CollisionEvents::name_of(std::uint32_t id) const {
  const auto found = names_.find(id);
  return found == names_.end() || found->second.empty() ? "body " + std::to_string(id) : found->second;
}

inline std::string CollisionEvents::to_text(const CollisionEvent& event) const {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  const char* const verb = event.kind == CollisionEventKind::begin  ? " meets "
                           : event.kind == CollisionEventKind::stay ? " stays on "
                                                                    : " leaves ";
  text << event.time << " s: " << name_of(event.first) << verb << name_of(event.second);
  if (event.removed) text << " (removed)";
  return text.str();
}

}  // namespace thinwall
