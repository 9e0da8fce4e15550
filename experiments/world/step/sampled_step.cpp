/// The policies that look at poses: what happens between them is not seen, and a fast body passes a thin wall.

#include <thinwall/experiments/world/step/stepping.hpp>

namespace thinwall {

void Stepper::sampled_step(int parts) {
  const double part = dt_ / parts;
  for (BodyMotion& motion : motions_)
    motion.anchor = 1;  // nothing is left to move: a box, a place is that of an instant
  for (int k = 1; k <= parts; ++k) {
    {
      const PhaseClock clock(counts_.seconds.integrate);
      fall(part);
      for (std::size_t i = 0; i < bodies_.size(); ++i) {
        if (can_move(bodies_[i])) motions_[i].offset += motions_[i].velocity * part;
      }
      box(0);
    }
    if (!plan_.contacts) continue;
    {
      const PhaseClock clock(counts_.seconds.narrow);
      narrow_->place(bodies_, motions_, dt_, all_anew_);
    }
    found_.clear();
    find_touches([&](std::span<const ProxyPair> pairs) { return narrow_->look(pairs, found_); });
    all_anew_ = plan_.resting_bounds;
    for (Touch& touch : found_) touch.time = k == parts ? 1 : static_cast<double>(k) / parts;
    touches_.insert(touches_.end(), found_.begin(), found_.end());
    if (!plan_.response) continue;
    const PhaseClock clock(counts_.seconds.response);
    if (options_.response) {
      respond_at_instant(motions_);
    } else {
      const std::size_t impulses = counts_.impulses;
      std::vector<BodyMotion> dropped = motions_;
      respond_at_instant(dropped);
      counts_.impulses = impulses;
    }
  }
}

/// Impulses in the order of the pairs, until nobody approaches or the rounds are over, then every penetration undone.
void Stepper::respond_at_instant(std::vector<BodyMotion>& motions) {
  bool any = true;
  for (int round = 0; round <= options_.contact_rounds && any; ++round) {
    any = false;
    for (const Touch& touch : found_) {
      if (!bounce(bodies_[touch.first], bodies_[touch.second], motions[touch.first], motions[touch.second],
                  touch.normal)) {
        continue;
      }
      any = true;
      ++counts_.impulses;
    }
  }
  for (const Touch& touch : found_) {
    part_bodies(bodies_[touch.first], bodies_[touch.second], motions[touch.first], motions[touch.second], touch.normal,
                touch.penetration, options_.correction);
  }
}

}  // namespace thinwall
