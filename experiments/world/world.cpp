#include <thinwall/experiments/world/world.hpp>

#include <algorithm>
#include <utility>

#include <thinwall/discrete/raised_flag.hpp>
#include <thinwall/experiments/world/step.hpp>

namespace thinwall {

std::string name_of(TimePolicy policy, int substeps) {
  const std::string name(name_of(policy));
  return policy == TimePolicy::substeps ? name + "_" + std::to_string(substeps) : name;
}

TimePolicy policy_named(std::string_view name) {
  return static_cast<TimePolicy>(std::ranges::find(policy_names, name) - policy_names.begin());
}

Vec3<double> position(const Body& body) {
  const Vec3<double> none = Vec3<double>::Zero();
  return of_shape(body.shape, none, [](const auto& shape) { return center(shape); });
}

std::string called(const Body& body) {
  return (body.name.empty() ? "body" : body.name) + " (id " + std::to_string(body.id) + ")";
}

bool is_in_the_world(const AnyShape& shape, const Vec3<double>& displacement) {
  const double size = of_shape(shape, 0.0, [](const auto& held) { return magnitude(held); });
  return size + displacement.cwiseAbs().sum() <= end_of_the_world;
}

void require_valid(const Body& body) {
  const auto complain = [&](const std::string& what) { throw WorldError(called(body) + ": " + what); };
  with_shape(body.shape, [&](const auto& shape) {
    if (!is_finite(magnitude(shape))) complain("its shape must have finite numbers only");
    if (!has_valid_sizes(shape)) complain("the sizes of its shape must be >= 0");
    if (!valid(shape)) complain("the axes of its box must be unit vectors at right angles");
  });
  const Vec3<double>& v = body.velocity;
  if (!is_finite(v)) complain("its velocity must be finite");
  if (!is_in_the_world(body.shape, Vec3<double>::Zero())) complain("its place is out of the range of coordinates");
  if (body.is_static && v != Vec3<double>::Zero()) complain("it is static, so that its velocity must be zero");
  if (!(body.mass > 0)) complain("its mass must be > 0; infinite for a body that nothing moves");
  if (!is_finite(1 / body.mass)) complain("its mass is so small that 1 / mass is not finite");
  if (!(body.restitution >= 0 && body.restitution <= 1)) complain("its restitution must be in [0, 1]");
  if (!is_finite(body.gravity_scale)) complain("its gravity scale must be finite");
  const Vec3<double>& w = body.angular_velocity;
  if (!is_finite(w)) complain("its angular velocity must be finite");
  if (!body.turns && w != Vec3<double>::Zero()) complain("it does not turn, so that its angular velocity must be zero");
  if (body.is_static && w != Vec3<double>::Zero()) complain("it is static, so that its angular velocity must be zero");
  if (!body.turns) return;
  if (std::holds_alternative<Aabb<double>>(body.shape)) complain("an aabb does not turn: write obb");
  if (std::holds_alternative<std::monostate>(body.shape)) complain("it has no shape, so that it cannot turn");
  if (!inverse_inertia(body.shape, inverse_mass(body)).allFinite())
    complain("its moment of inertia is so small that its inverse is not finite");
}

void require_valid(const WorldOptions& options) {
  const auto require = [](bool holds, const std::string& what) {
    if (!holds) throw WorldError("world: " + what);
  };
  require(is_finite(options.gravity), "gravity must be finite");
  require(options.substeps >= 1, "substeps must be >= 1");
  require(options.max_events >= 1, "max_events must be >= 1");
  require(options.contact_rounds >= 0, "contact_rounds must be >= 0");
  require(options.correction >= 0 && options.correction <= 1, "correction must be in [0, 1]");
  require(options.end_after >= 1, "end_after must be >= 1");
  require(options.gate >= 0 && is_finite(options.gate), "gate must be finite and >= 0; 0 is off");
  require(options.threads >= 1, "threads must be >= 1");
  require(options.max_pairs >= 1, "max_pairs must be >= 1");
  for (const std::string& kept : options.keep) {
    const auto is_one = [&](std::span<const std::string_view> names) {
      return std::find(names.begin(), names.end(), kept) != names.end();
    };
    require(is_one(omission_names) || is_one(spin_omission_names), "there is no omission '" + kept + "' to keep");
  }
  if (options.broad_phase == "auto") return;
  std::string names = "auto";
  for (const std::string_view name : pair_finder_names()) {
    if (name == options.broad_phase) return;
    names += ", " + std::string(name);
  }
  require(false, "there is no broad phase '" + options.broad_phase + "'; there are: " + names);
}

WorldOptions checked(WorldOptions options) {
  require_valid(options);
  return options;
}

std::vector<Body> checked_and_sorted(std::vector<Body> bodies) {
  for (const Body& body : bodies) require_valid(body);
  std::ranges::stable_sort(bodies, {}, &Body::id);
  const auto twins = std::ranges::adjacent_find(bodies, {}, &Body::id);
  if (twins != bodies.end()) throw WorldError(called(*twins) + " and " + called(*(twins + 1)) + " share one id");
  return bodies;
}

World::World(std::vector<Body> bodies, WorldOptions options)
    : options_(checked(std::move(options))),
      bodies_(checked_and_sorted(std::move(bodies))),
      plan_(thinwall::plan(bodies_, options_)),
      stepper_(std::make_unique<Stepper>(options_, plan_)),
      events_(options_.end_after),
      unread_(options_.end_after) {
  for (const Body& body : bodies_) {
    if (!body.name.empty()) events_.name(body.id, body.name);
  }
}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

const StepReport& World::step(double dt) {
  if (!(dt > 0) || !is_finite(dt)) throw WorldError("world: a step must be > 0 s and finite");
  if (stepping_) throw WorldError("world: a listener must not step the world that told it");
  stepper_->run(bodies_, dt, changed_by_hand_);  // throws, or all of the step is known
  const double start = time_;
  commit(dt);
  const RaisedFlag guard(stepping_);
  tell(start, dt);
  return report_;
}

void World::commit(double dt) {
  const std::uint64_t number = report_.step + 1;
  report_ = stepper_->counts();
  const PhaseClock clock(report_.seconds.integrate);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!can_move(bodies_[i])) continue;
    const BodyMotion& motion = stepper_->motions()[i];
    bodies_[i].velocity = motion.velocity;
    if (const Spin* const spin = spin_of(stepper_->spins(), bodies_[i], i)) {
      bodies_[i].angular_velocity = spin->velocity;
      if (spin->turned != Mat3<double>::Identity()) bodies_[i].shape = turned_true(bodies_[i].shape, spin->turned);
    }
    move_shape(bodies_[i].shape, motion.offset);
  }
  if (dt != last_dt_) {
    since_ = time_;
    last_dt_ = dt;
    equal_steps_ = 0;
  }
  time_ = since_ + static_cast<double>(++equal_steps_) * dt;
  changed_by_hand_ = false;
  report_.step = number;
  report_.time = time_;
}

void World::tell(double start, double dt) {
  const PhaseClock clock(report_.seconds.events);
  hits_.clear();
  for (const Touch& touch : stepper_->touches()) {
    const double when = touch.time == 1 ? time_ : start + touch.time * dt;
    hits_.push_back(
        {bodies_[touch.first].id, bodies_[touch.second].id, when, touch.at_start, touch.normal, touch.point});
  }
  if (!plan_.events) return;
  CollisionEvents& told = options_.events ? events_ : unread_;
  for (const Hit& hit : hits_) told.meet(hit.first, hit.second, hit.time);
  told.finish_step(time_);
}

const Body* World::find(std::uint32_t id) const {
  const auto at = std::ranges::lower_bound(bodies_, id, {}, &Body::id);
  return at == bodies_.end() || at->id != id ? nullptr : &*at;
}

std::size_t World::place_of(std::uint32_t id) const {
  const Body* const found = find(id);
  if (!found) throw WorldError("world: there is no body with id " + std::to_string(id));
  return static_cast<std::size_t>(found - bodies_.data());
}

/// If the world can hold what comes of it.
template <class Change> void World::change(std::uint32_t id, const Change& by_hand) {
  Body& body = bodies_[place_of(id)];
  Body changed = body;
  by_hand(changed);
  require_valid(changed);
  body = std::move(changed);
}

void World::set_velocity(std::uint32_t id, const Vec3<double>& velocity) {
  change(id, [&](Body& body) { body.velocity = velocity; });
}

void World::move(std::uint32_t id, const Vec3<double>& by) {
  change(id, [&](Body& body) { move_shape(body.shape, by); });
  changed_by_hand_ = true;
}

void World::remove(std::uint32_t id) {
  const std::size_t place = place_of(id);
  bodies_.erase(bodies_.begin() + static_cast<std::ptrdiff_t>(place));
  changed_by_hand_ = true;
  unread_.remove(id, time_);
  const RaisedFlag guard(stepping_);
  events_.remove(id, time_);  // last, for it tells listeners
}

/// In long double, whose range holds the product of any three doubles: never NaN.
double World::energy() const {
  using Wide = long double;
  Wide sum = 0;
  for (const Body& body : bodies_) {
    if (!is_moved_by_impulses(body)) continue;
    const Vec3<Wide> v = body.velocity.cast<Wide>(), g = options_.gravity.cast<Wide>();
    const Vec3<Wide> place = position(body).cast<Wide>();
    sum += Wide(body.mass) * (v.squaredNorm() / 2 - Wide(body.gravity_scale) * g.dot(place));
    if (body.turns) sum += energy_of_turning(body);
  }
  return static_cast<double>(sum);
}

std::uint64_t World::state_hash() const {
  Digest digest;
  for (const Body& body : bodies_) {
    digest.add(body.id);
    digest.add(body.velocity);
    with_shape(body.shape, [&](const auto& shape) {
      digest.add(center(shape));
      digest.add(half_widths(shape));
    });
    if (!body.turns) continue;
    digest.add(body.angular_velocity);
    if (const auto* const box = std::get_if<Obb<double>>(&body.shape)) {
      for (int k = 0; k < 3; ++k) digest.add(box->axes.col(k));
    } else if (const auto* const capsule = std::get_if<Capsule<double>>(&body.shape)) {
      digest.add(capsule->b);
    }
  }
  return digest.value();
}

}  // namespace thinwall
