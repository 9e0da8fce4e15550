#include <thinwall/experiments/world/step.hpp>

#include <algorithm>
#include <chrono>

#include <thinwall/swept/dispatch.hpp>

namespace thinwall {

namespace {

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

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
  counts_.hits = std::ssize(touches_);
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

/// Places the bodies, then hands all pairs that may touch to `ask`: those that the broad phase finds, or, where disjoint
/// boxes are not left out, every two bodies, a bounded number at a time; then what they may not do to each other is dropped.
void Stepper::find_touches(const std::function<Asked(std::span<const ProxyPair>)>& ask) {
  {
    const PhaseClock clock(counts_.seconds.narrow);
    narrow_->place(bodies_, motions_, spins_, dt_, all_anew_);
  }
  found_.clear();
  const bool drops = plan_.static_pairs || plan_.masked_pairs;
  const auto ask_pairs = [&] {
    const Asked asked = ask(pairs_);
    counts_.pairs += std::ssize(pairs_);
    counts_.sweeps += asked.pairs;
    counts_.gated += asked.gated;
  };
  const auto mark = [&](bool as_they_are) {
    const PhaseClock clock(counts_.seconds.broad);
    if (drops) mark_proxies(as_they_are);
  };
  mark(false);
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
  if (drops) {
    mark(true);
    const auto has_no_say = [&](const auto& pair) { return !may_meet(proxies_[pair.first], proxies_[pair.second]); };
    std::erase_if(pairs_, has_no_say);
    std::erase_if(found_, has_no_say);
  }
  if (plan_.spin) require_answers(bodies_, found_);
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
    find_touches([&](std::span<const ProxyPair> pairs) { return narrow_->look(pairs, found_); });
    all_anew_ = plan_.resting_bounds;
    for (Touch& touch : found_) touch.time = k == parts ? 1 : static_cast<double>(k) / parts;
    touches_.insert(touches_.end(), found_.begin(), found_.end());
    if (!plan_.response) continue;
    const PhaseClock clock(counts_.seconds.response);
    if (options_.response) {
      for (const Touch& touch : found_) counts_.pushed_through += is_pushed_through(touch, 1 - 1.0 / parts) ? 1 : 0;
      respond_at_instant(motions_, spins_);
    } else {
      const std::int64_t impulses = counts_.impulses;
      std::vector<BodyMotion> dropped = motions_;
      std::vector<Spin> dropped_spins = spins_;
      respond_at_instant(dropped, dropped_spins);
      counts_.impulses = impulses;
    }
  }
}

/// True if the two part along the normal that is to push them out, and were apart at the look before, at `before` [1] of the step: one
/// has come in by a side that no pose shows, and the response sends it on.
bool Stepper::is_pushed_through(const Touch& touch, double before) {
  const auto mover = [&](std::size_t i) { return Mover{bodies_[i], motions_[i], spin(i)}; };
  const Mover a = mover(touch.first), b = mover(touch.second);
  if (!is_moved_by_impulses(a.body) && !is_moved_by_impulses(b.body)) return false;
  const double closing = closing_speed(a, b, touch.normal, touch.point, 1, dt_, false);
  if (!(closing < -closing_noise(a, b))) return false;
  return !overlaps(shape_at(touch.first, before), shape_at(touch.second, before));
}

/// The shape where it was at `time` [1] of the step, since when it has met nothing.
AnyShape Stepper::shape_at(std::size_t which, double time) {
  AnyShape shape = bodies_[which].shape;
  const BodyMotion& motion = motions_[which];
  if (const Spin* const turns = spin(which)) shape = turned_true(shape, turned_at(*turns, motion, time, dt_));
  move_shape(shape, offset_at(motion, time, dt_));
  return shape;
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
  for (const Touch& touch : found_) part_bodies(bodies_, motions, touch, options_.correction);
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
  for (const Touch& touch : still) part_bodies(bodies_, motions, touch, options_.correction);
}

}  // namespace thinwall
