#include <thinwall/experiments/world/step.hpp>

#include <algorithm>
#include <chrono>

namespace thinwall {

namespace {

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// [1] Of the lesser least half width of two: how far they may sink into each other in a step where events do not suffice.
constexpr double most_sinking = 0x1p-6;

/// [1] Of the step.
constexpr double hardly_any_time = 0x1p-10;

/// Of a body, in a step: then it waits. Two that touch and roll are looked at a few dozen times.
constexpr int most_looks = 1024;

}  // namespace

PhaseClock::PhaseClock(double& seconds) : seconds_(&seconds), start_(now()) {}
PhaseClock::~PhaseClock() { *seconds_ += now() - start_; }

Stepper::Stepper(const WorldOptions& options, const Plan& plan)
    : options_(options),
      plan_(plan),
      finder_(make_pair_finder(plan.broad_phase)),
      narrow_(make_narrow_phase(plan, options.threads)) {}

void Stepper::run(std::span<const Body> bodies, double dt, bool changed_by_hand) {
  bodies_ = bodies;
  counts_ = {};
  touches_.clear();
  begin(dt, changed_by_hand);
  switch (options_.policy) {
    case TimePolicy::discrete: sampled_step(1); break;
    case TimePolicy::substeps: sampled_step(options_.substeps); break;
    case TimePolicy::clamp:
    case TimePolicy::event_driven: swept_step(); break;
  }
  finish();
}

void Stepper::begin(double dt, bool changed_by_hand) {
  const PhaseClock clock(counts_.seconds.integrate);
  dt_ = dt;
  all_anew_ = !ready_ || changed_by_hand || plan_.resting_bounds || proxies_.size() != bodies_.size();
  ready_ = false;
  motions_.assign(bodies_.size(), BodyMotion{});
  proxies_.resize(bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    motions_[i].velocity = bodies_[i].velocity;
    motions_[i].speed = bodies_[i].velocity.cwiseAbs().sum();
  }
  spins_.assign(plan_.spin ? bodies_.size() : 0, Spin{});
  for (std::size_t i = 0; i < spins_.size(); ++i) {
    spins_[i].velocity = bodies_[i].angular_velocity;
    motions_[i].speed = speed_of(bodies_[i], bodies_[i].velocity, spin(i));
  }
}

/// Gravity for `dt` [s]: the velocity at the end of a stretch is the one it is walked at (semi-implicit Euler), so that a body
/// that a contact holds does not move.
void Stepper::fall(double dt) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!is_moved_by_impulses(bodies_[i])) continue;
    BodyMotion& motion = motions_[i];
    motion.velocity += options_.gravity * (bodies_[i].gravity_scale * dt);
    motion.speed = std::max(motion.speed, speed_of(bodies_[i], motion.velocity, spin(i)));
  }
}

/// The boxes from the anchors to the end of a stretch of `dt` [s].
void Stepper::box(double dt) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!can_move(bodies_[i]) && !all_anew_) continue;
    require_in_the_world(i, moving_at(motions_[i]) * dt);
    if (plan_.contacts) proxies_[i] = proxy_of(bodies_[i], motions_[i], spin(i), dt);
  }
}

void Stepper::require_in_the_world(std::size_t which, const Vec3<double>& displacement) const {
  const BodyMotion& motion = motions_[which];
  const Vec3<double> way = motion.offset.cwiseAbs() + displacement.cwiseAbs();
  const bool turns_finitely = spins_.empty() || spins_[which].velocity.cwiseAbs().sum() * dt_ <= end_of_the_world;
  if (is_in_the_world(bodies_[which].shape, way) && is_finite(motion.velocity) && turns_finitely) return;
  throw LeftTheWorld(called(bodies_[which]) +
                     " left the representable world: its place or its velocity is out of range");
}

void Stepper::finish() {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    BodyMotion& motion = motions_[i];
    if (motion.waiting) ++counts_.waiting;
    if (can_move(bodies_[i])) require_in_the_world(i, Vec3<double>::Zero());
  }
  counts_.hits = touches_.size();
  counts_.bytes = bytes();
  ready_ = true;
}

std::size_t Stepper::bytes() const {
  return motions_.capacity() * sizeof(BodyMotion) + spins_.capacity() * sizeof(Spin) +
         proxies_.capacity() * sizeof(Proxy) + pairs_.capacity() * sizeof(ProxyPair) +
         (touches_.capacity() + found_.capacity()) * sizeof(Touch) + narrow_->bytes() + neighbors_.bytes();
}

/// The boxes as the broad phase is to see them: static and masked pairs are pairs like others where they are not left out.
void Stepper::mark_proxies(bool as_they_are) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (plan_.static_pairs) proxies_[i].is_static = as_they_are && bodies_[i].is_static;
    if (plan_.masked_pairs) {
      proxies_[i].group = as_they_are ? bodies_[i].group : 1;
      proxies_[i].mask = as_they_are ? bodies_[i].mask : 1;
    }
  }
}

/// Hands all pairs that may touch to `ask`: those that the broad phase finds, or, where disjoint boxes are not left out, every two
/// bodies, a bounded number at a time; then what they may not do to each other is dropped.
void Stepper::find_touches(const std::function<Asked(std::span<const ProxyPair>)>& ask) {
  const bool drops = plan_.static_pairs || plan_.masked_pairs;
  const auto ask_pairs = [&] {
    const Asked asked = ask(pairs_);
    counts_.pairs += pairs_.size();
    counts_.sweeps += asked.pairs;
    counts_.gated += asked.gated;
  };
  if (drops) mark_proxies(false);
  if (plan_.all_bounds) {
    const PhaseClock clock(counts_.seconds.narrow);
    constexpr std::size_t at_a_time = 1U << 16;
    pairs_.clear();
    for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
      for (std::uint32_t j = i + 1; j < bodies_.size(); ++j) {
        if (!may_meet(proxies_[i], proxies_[j])) continue;
        pairs_.push_back({i, j});
        if (pairs_.size() < at_a_time) continue;
        ask_pairs();
        pairs_.clear();
      }
    }
    ask_pairs();
    pairs_.clear();
  } else {
    {
      const PhaseClock clock(counts_.seconds.broad);
      finder_->find(proxies_, pairs_, options_.max_pairs);
    }
    const PhaseClock clock(counts_.seconds.narrow);
    ask_pairs();
  }
  if (plan_.spin) require_answers(bodies_, found_);
  if (!drops) return;
  mark_proxies(true);
  const auto has_no_say = [&](const auto& pair) { return !may_meet(proxies_[pair.first], proxies_[pair.second]); };
  std::erase_if(pairs_, has_no_say);
  std::erase_if(found_, has_no_say);
}

// ---- The policies that look at poses: what happens between them is not seen, and a fast body passes a thin wall.

void Stepper::sampled_step(int parts) {
  const double part = dt_ / parts;
  for (BodyMotion& motion : motions_)
    motion.anchor = 1;  // nothing is left to move: a box, a place is that of an instant
  for (int k = 1; k <= parts; ++k) {
    {
      const PhaseClock clock(counts_.seconds.integrate);
      fall(part);
      for (std::size_t i = 0; i < bodies_.size(); ++i) {
        if (!can_move(bodies_[i])) continue;
        motions_[i].offset += motions_[i].velocity * part;
        if (Spin* const turns = spin(i)) {
          const Vec3<double>& rate = turns->velocity;
          turns->turned = rotation_about<double>(safe_unit(rate), safe_norm(rate) * part) * turns->turned;
        }
      }
      box(0);
    }
    if (!plan_.contacts) continue;
    {
      const PhaseClock clock(counts_.seconds.narrow);
      narrow_->place(bodies_, motions_, spins_, dt_, all_anew_);
    }
    found_.clear();
    find_touches([&](std::span<const ProxyPair> pairs) { return narrow_->look(pairs, found_); });
    all_anew_ = plan_.resting_bounds;
    for (Touch& touch : found_) touch.time = k == parts ? 1 : static_cast<double>(k) / parts;
    touches_.insert(touches_.end(), found_.begin(), found_.end());
    if (!plan_.response) continue;
    const PhaseClock clock(counts_.seconds.response);
    if (options_.response) {
      respond_at_instant(motions_, spins_);
    } else {
      const std::size_t impulses = counts_.impulses;
      std::vector<BodyMotion> dropped = motions_;
      std::vector<Spin> dropped_spins = spins_;
      respond_at_instant(dropped, dropped_spins);
      counts_.impulses = impulses;
    }
  }
}

/// Impulses in the order of the pairs, until nobody approaches or the rounds are over, then every penetration undone.
void Stepper::respond_at_instant(std::vector<BodyMotion>& motions, std::vector<Spin>& spins) {
  const auto mover = [&](std::size_t i) { return Mover{bodies_[i], motions[i], spin_of(spins, bodies_[i], i)}; };
  bool any = true;
  for (int round = 0; round <= options_.contact_rounds && any; ++round) {
    any = false;
    for (const Touch& touch : found_) {
      if (!bounce(mover(touch.first), mover(touch.second), touch.normal, touch.point)) continue;
      any = true;
      ++counts_.impulses;
    }
  }
  for (const Touch& touch : found_) {
    part_bodies(bodies_[touch.first], bodies_[touch.second], motions[touch.first], motions[touch.second], touch.normal,
                touch.penetration, options_.correction);
  }
}

// ---- The policies that look at all of the motion.

void Stepper::swept_step() {
  {
    const PhaseClock clock(counts_.seconds.integrate);
    fall(dt_);
    box(dt_);
  }
  if (!plan_.contacts) {
    go_straight_on();
    return;
  }
  {
    const PhaseClock clock(counts_.seconds.narrow);
    narrow_->place(bodies_, motions_, spins_, dt_, all_anew_);
  }
  found_.clear();
  find_touches([&](std::span<const ProxyPair> pairs) { return narrow_->sweep(pairs, 0, options_.gate, found_); });
  const PhaseClock clock(counts_.seconds.response);
  if (plan_.response) {
    if (options_.response) {
      play(motions_, spins_, touches_, counts_);
    } else {  // to show that leaving it out changes nothing
      std::vector<BodyMotion> motions = motions_;
      std::vector<Spin> spins = spins_;
      std::vector<Touch> processed;
      StepReport counts;
      play(motions, spins, processed, counts);
    }
  }
  if (options_.response) return;
  touches_ = found_;
  std::ranges::stable_sort(touches_, {}, &Touch::time);
  go_straight_on();
}

/// All bodies to the end of the step, on the paths that they started on.
void Stepper::go_straight_on() {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!can_move(bodies_[i])) continue;
    if (Spin* const turns = spin(i)) turns->turned = turned_at(*turns, motions_[i], 1, dt_);
    motions_[i].offset = offset_at(motions_[i], 1, dt_);
  }
}

/// The events of the step, then the correction of what overlapped at its start and still does at its end.
void Stepper::play(std::vector<BodyMotion>& motions, std::vector<Spin>& spins, std::vector<Touch>& processed,
                   StepReport& counts) {
  has_links_.resize(bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) has_links_[i] = is_moved_by_impulses(bodies_[i]);
  neighbors_.begin(proxies_, plan_.all_bounds ? std::span<const ProxyPair>() : std::span<const ProxyPair>(pairs_),
                   has_links_, plan_.all_bounds);
  const int max_events = options_.policy == TimePolicy::clamp ? 1 : options_.max_events;
  const EventLoop::Scene scene{bodies_, dt_, max_events, options_, *narrow_, neighbors_};
  EventLoop(scene, motions, spins, processed, counts).run(found_);
  std::vector<ProxyPair> overlapping;
  for (const Touch& touch : found_) {
    if (touch.at_start) overlapping.push_back({touch.first, touch.second});
  }
  if (overlapping.empty()) return;
  for (const ProxyPair& pair : overlapping) {
    for (const std::uint32_t end : {pair.first, pair.second}) {
      narrow_->place_one(end, bodies_[end], motions[end], spin_of(spins, bodies_[end], end), 1, dt_);
    }
  }
  std::vector<Touch> still;
  narrow_->look(overlapping, still);
  for (const Touch& touch : still) {
    part_bodies(bodies_[touch.first], bodies_[touch.second], motions[touch.first], motions[touch.second], touch.normal,
                touch.penetration, options_.correction);
  }
}

// ---- The events of a step in the order of their times.

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
  const auto velocity = [&](const Mover& m) {
    return velocity_of(m, arm_of(m, touch.point, touch.time, scene_.dt), in_effect);
  };
  return closing_speed(touch.normal, velocity(mover(touch.first)), velocity(mover(touch.second)));
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
  if (touch.penetration > 0) {
    part_bodies(scene_.bodies[ends[0]], scene_.bodies[ends[1]], motions_[ends[0]], motions_[ends[1]], touch.normal,
                touch.penetration, scene_.options.correction);
  }
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
