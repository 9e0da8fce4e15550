/// The events of a step in the order of their times.
#include <thinwall/experiments/world/step.hpp>

#include <algorithm>

namespace thinwall {

namespace {

/// [1] Of the lesser least half width of two: how far they may sink into each other in a step where events do not suffice.
constexpr double most_sinking = 0x1p-6;

/// [1] Of the step.
constexpr double hardly_any_time = 0x1p-10;

/// Of a body, in a step: then it waits. Two that touch and roll are looked at a few dozen times.
constexpr int most_looks = 1024;

}  // namespace

void require_answers(std::span<const Body> bodies, std::span<const Touch> touches) {
  for (const Touch& touch : touches) {
    if (!touch.gave_up) continue;
    throw TurnsTooFar("nothing can be proven of when " + called(bodies[touch.first]) + " meets " +
                      called(bodies[touch.second]) + ": they turn too far in a step; take shorter ones");
  }
}

void EventLoop::run(std::span<const Touch> found) {
  changed_.assign(scene_.bodies.size(), false);
  resolve_start(found);
  for (const Touch& touch : found) {
    if (!changed_[touch.first] && !changed_[touch.second]) schedule(touch);
  }
  sweep_changed_at_start();
  while (!queue_.empty()) {
    const Event event = queue_.top();
    queue_.pop();
    if (event.is_look) {
      if (is_on_course(event)) look(event);
    } else if (is_on_course(event)) {
      happen(event);
    } else if (was_on_course(event) && !press(event.touch)) {  // those that do have been swept again
      tell(event.touch);
    }
  }
  for (std::uint32_t i = 0; i < motions_.size(); ++i) {
    if (!can_move(scene_.bodies[i])) continue;
    if (motions_[i].waiting && motions_[i].anchor < hardly_any_time) keep_no_more_speed(i);
    advance(i, 1);
  }
}

/// What touches at the start of the step is told once, be it found then or in what follows in that instant.
void EventLoop::tell(const Touch& touch) {
  if (touch.at_start && touch.time == 0) {
    if (told_.empty())
      for (const Touch& told : contacts_) told_.insert({told.first, told.second});
    if (!told_.insert({touch.first, touch.second}).second) return;
  }
  processed_.push_back(touch);
}

/// A body that waits for all of the step, or nearly, has not fallen: it would gain speed for as long as it waits.
void EventLoop::keep_no_more_speed(std::uint32_t which) {
  const Body& body = scene_.bodies[which];
  if (body.restitution == 1) return;  // what it has it was given
  const auto keep = [](Vec3<double>& now, const Vec3<double>& before) {
    const double speed = safe_norm(now), most = safe_norm(before);
    if (speed > most) now *= most / speed;
  };
  keep(motions_[which].velocity, body.velocity);
  if (Spin* const spin = mover(which).spin) keep(spin->velocity, body.angular_velocity);
}

/// True if it may move in the rest of the step, be it driven.
bool EventLoop::goes_on(std::uint32_t which) const {
  return can_move(scene_.bodies[which]) && !motions_[which].waiting;
}
bool EventLoop::is_free(std::uint32_t which) const {
  return is_moved_by_impulses(scene_.bodies[which]) && goes_on(which);
}

bool EventLoop::is_on_course(const Event& event) const {
  return event.version_first == motions_[event.touch.first].version &&
         event.version_second == motions_[event.touch.second].version;
}

/// True if both came to the place of the event, and one was turned there in the same instant, by a third: they touch.
bool EventLoop::was_on_course(const Event& event) const {
  const auto came = [&](std::uint32_t which, std::uint32_t version) {
    const BodyMotion& motion = motions_[which];
    return version == motion.version || (motion.anchor == event.touch.time && version >= motion.arrived);
  };
  return came(event.touch.first, event.version_first) && came(event.touch.second, event.version_second);
}

/// True if the two that touch go on toward each other by more than rounding, and one of them can be turned.
bool EventLoop::press(const Touch& touch) {
  return (is_free(touch.first) || is_free(touch.second)) &&
         closing(touch, true) > closing_noise(mover(touch.first), mover(touch.second));
}

/// [m/s] Of the points where they touch. `in_effect`: a body that waits has none.
double EventLoop::closing(const Touch& touch, bool in_effect) {
  return closing_speed(mover(touch.first), mover(touch.second), touch.normal, touch.point, touch.time, scene_.dt,
                       in_effect);
}

void EventLoop::advance(std::uint32_t which, double time) {
  BodyMotion& motion = motions_[which];
  if (time != motion.anchor) motion.arrived = motion.version;
  if (Spin* const spin = mover(which).spin) spin->turned = turned_at(*spin, motion, time, scene_.dt);
  motion.offset = offset_at(motion, time, scene_.dt);
  motion.anchor = time;
}

/// Contacts at the start take no event: a body that rests on another is free to slide and to hit.
void EventLoop::resolve_start(std::span<const Touch> found) {
  for (const Touch& touch : found) {
    if (touch.at_start) contacts_.push_back(touch);
  }
  processed_.insert(processed_.end(), contacts_.begin(), contacts_.end());
  bool any = true;
  for (int round = 0; round < scene_.options.contact_rounds && any; ++round) {
    any = false;
    for (const Touch& touch : contacts_) {
      const std::uint32_t a = touch.first, b = touch.second;
      if (!bounce(mover(a), mover(b), touch.normal, touch.point)) continue;
      any = true;
      ++counts_.impulses;
      changed_[a] = changed_[a] || is_moved_by_impulses(scene_.bodies[a]);
      changed_[b] = changed_[b] || is_moved_by_impulses(scene_.bodies[b]);
    }
  }
}

void EventLoop::sweep_changed_at_start() {
  for (std::uint32_t i = 0; i < changed_.size(); ++i) {
    if (!changed_[i]) continue;
    place(i, 0);
    change_course(i);
  }
  constexpr std::size_t at_a_time = 1U << 16;
  pairs_.clear();
  for (std::uint32_t i = 0; i < changed_.size(); ++i) {
    if (!changed_[i]) continue;
    for (const std::uint32_t other : scene_.neighbors.of(i)) {
      if (changed_[other] && other < i) continue;  // asked from the other side
      pairs_.push_back({std::min(i, other), std::max(i, other)});
    }
    if (pairs_.size() >= at_a_time) ask(0);
  }
  ask(0);
}

/// Asks the pairs for the rest of the step, schedules what they meet, and forgets them.
void EventLoop::ask(double time) {
  touches_.clear();
  const Asked asked = scene_.narrow.sweep(pairs_, time, scene_.options.gate, touches_);
  counts_.sweeps += asked.pairs;
  counts_.gated += asked.gated;
  pairs_.clear();
  if (!spins_.empty()) require_answers(scene_.bodies, touches_);
  for (const Touch& touch : touches_) schedule(touch);
}

void EventLoop::place(std::uint32_t which, double time) {
  const Mover m = mover(which);
  scene_.narrow.place_one(which, m.body, m.motion, m.spin, time, scene_.dt);
}

/// Bodies that touch and do not approach never meet again on straight paths: they are convex, and the plane of contact goes
/// on parting them. Those that turn may.
void EventLoop::schedule(const Touch& touch) {
  if (touch.at_start && (!press(touch) || may_sink(touch))) return look_later(touch, touch.time);
  queue_.push({touch, motions_[touch.first].version, motions_[touch.second].version, false});
}

/// True of a contact at the start with a body that has had all of its events there, if the two sink in by so little that the correction at the
/// end of the step undoes it: or what rests on another would wait for good.
bool EventLoop::may_sink(const Touch& touch) {
  const auto is_spent = [&](std::uint32_t which) {
    return is_moved_by_impulses(scene_.bodies[which]) && motions_[which].events >= scene_.max_events;
  };
  if (touch.time > 0 || (!is_spent(touch.first) && !is_spent(touch.second))) return false;
  const double least =
      std::min(least_half_width(scene_.bodies[touch.first].shape), least_half_width(scene_.bodies[touch.second].shape));
  return closing(touch, true) * scene_.dt <= most_sinking * least;
}

// ---- Contacts that go on: two that touch, do not approach, and turn. What parts them now may press them together in a moment, at
// another point. Until when nothing of note can have happened is known: then they are looked at again.

void EventLoop::look_later(const Touch& touch, double time) {
  if (spins_.empty() || (!is_free(touch.first) && !is_free(touch.second))) return;
  for (const std::uint32_t end : {touch.first, touch.second}) place(end, time);
  const ProxyPair pair{touch.first, touch.second};
  if (!scene_.narrow.turns(pair)) return;
  Touch then = touch;
  then.time = time + scene_.narrow.until_next_look(pair, touch.normal) * (1 - time);
  if (then.time < 1) queue_.push({then, motions_[touch.first].version, motions_[touch.second].version, true});
}

void EventLoop::look(const Event& event) {
  const double time = event.touch.time;
  const std::uint32_t ends[2] = {event.touch.first, event.touch.second};
  bool waits = false;
  for (const std::uint32_t end : ends) {
    place(end, time);
    if (Spin* const spin = mover(end).spin) waits = ++spin->looks > most_looks || waits;
  }
  const ProxyPair pair{ends[0], ends[1]};
  touches_.clear();
  scene_.narrow.look({&pair, 1}, touches_);
  Touch touch = touches_.empty() ? event.touch : touches_.front();
  touch.time = time;
  if (waits || (!touches_.empty() && press(touch))) {
    return answer(touch, waits ? Answer::wait : Answer::go_on);
  }
  pairs_.assign(1, pair);
  ask(time);
}

void EventLoop::happen(const Event& event) {
  const Touch& touch = event.touch;
  tell(touch);
  if (!is_free(touch.first) && !is_free(touch.second)) return;  // no impulse turns either
  answer(touch, Answer::take_event);
}

/// Lets the two bounce if they approach, or wait behind one that waits; then what both may meet is swept again.
void EventLoop::answer(const Touch& touch, Answer how) {
  const std::uint32_t ends[2] = {touch.first, touch.second};
  const bool bounces = closing(touch, false) > closing_noise(mover(ends[0]), mover(ends[1]));
  if (!bounces && how != Answer::wait && !press(touch)) return look_later(touch, touch.time);  // a graze
  bool changes[2] = {false, false};
  for (const std::uint32_t end : ends) {
    if (can_move(scene_.bodies[end])) advance(end, touch.time);
  }
  if (bounces) {
    bounce(mover(ends[0]), mover(ends[1]), touch.normal, touch.point);
    ++counts_.impulses;
  }
  if (touch.penetration > 0) part_bodies(scene_.bodies, motions_, touch, scene_.options.correction);
  for (int k = 0; k < 2; ++k) {
    BodyMotion& motion = motions_[ends[k]];
    if (!is_moved_by_impulses(scene_.bodies[ends[k]])) continue;
    changes[k] = bounces || !motion.waiting;
    if (!changes[k]) continue;  // it waits already: what is known of it stays
    ++motion.version;
    if (how == Answer::take_event) ++motion.events;
    const bool is_behind_one_that_waits = !bounces, is_at_start = touch.at_start && touch.time == 0;
    const int most = scene_.max_events + (is_at_start ? 1 : 0);  // what is left there may sink
    if (is_behind_one_that_waits || how == Answer::wait || motion.events >= most) motion.waiting = true;
  }
  for (int k = 0; k < 2; ++k) {
    if (changes[k]) change_course(ends[k]);
  }
  for (int k = 0; k < 2; ++k) {
    if (changes[k]) sweep_again(ends[k], k == 1 && changes[0] ? ends[0] : ends[k], touch.time);
  }
}

void EventLoop::change_course(std::uint32_t which) {
  const Body& body = scene_.bodies[which];
  const BodyMotion& motion = motions_[which];
  const Vec3<double> rest = moving_at(motion) * (scene_.dt * (1 - motion.anchor));
  if (!is_in_the_world(body.shape, motion.offset.cwiseAbs() + rest.cwiseAbs()) || !is_finite(motion.velocity)) {
    throw LeftTheWorld(called(body) + " left the representable world: a hit made its velocity too large");
  }
  scene_.neighbors.change(which, proxy_of(body, motion, mover(which).spin, scene_.dt));
}

/// All that the body may meet from `time` on, but the pair with `done`, which is known. One that waits may still be met.
void EventLoop::sweep_again(std::uint32_t which, std::uint32_t done, double time) {
  place(which, time);
  pairs_.clear();
  for (const std::uint32_t other : scene_.neighbors.of(which)) {
    if (other == done || (!goes_on(which) && !goes_on(other))) continue;
    place(other, time);
    pairs_.push_back({std::min(which, other), std::max(which, other)});
  }
  ask(time);
}

}  // namespace thinwall
