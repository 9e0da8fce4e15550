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
    require(is_one(omission_names()) || is_one(spin_omission_names()), "there is no omission '" + kept + "' to keep");
  }
  if (options.broad_phase == "auto") return;
  std::string names = "auto";
  for (const std::string_view name : pair_finder_names()) {
    if (name == options.broad_phase) return;
    names += ", " + std::string(name);
  }
  require(false, "there is no broad phase '" + options.broad_phase + "'; there are: " + names);
}

std::vector<Body> checked_and_sorted(std::vector<Body> bodies) {
  for (const Body& body : bodies) require_valid(body);
  std::ranges::stable_sort(bodies, {}, &Body::id);
  const auto twins = std::ranges::adjacent_find(bodies, {}, &Body::id);
  if (twins != bodies.end()) throw WorldError(called(*twins) + " and " + called(*(twins + 1)) + " share one id");
  return bodies;
}

struct World::Impl {
  Impl(std::vector<Body> given, WorldOptions wanted)
      : options(std::move(wanted)),
        bodies(checked_and_sorted(std::move(given))),
        plan(thinwall::plan(bodies, options)),
        stepper(options, plan),
        events(options.end_after),
        unread(options.end_after) {
    for (const Body& body : bodies) {
      if (!body.name.empty()) events.name(body.id, body.name);
    }
  }

  void step(double dt);
  void commit(double dt);
  void tell(double start, double dt);
  const Body* find(std::uint32_t id) const;
  std::size_t place_of(std::uint32_t id) const;
  template <class Change> void change(std::uint32_t id, const Change& by_hand);

  WorldOptions options;
  std::vector<Body> bodies;
  Plan plan;
  Stepper stepper;
  CollisionEvents events;
  CollisionEvents unread;  // what nobody reads, where nothing is omitted
  StepReport report;
  std::vector<Hit> hits;
  double time = 0;                // [s]
  double since = 0, last_dt = 0;  // [s] the time is since + equal_steps * last_dt: adding up would drift
  std::uint64_t equal_steps = 0;
  bool changed_by_hand = true, stepping = false;
};

void World::Impl::step(double dt) {
  if (!(dt > 0) || !is_finite(dt)) throw WorldError("world: a step must be > 0 s and finite");
  if (stepping) throw WorldError("world: a listener must not step the world that told it");
  stepper.run(bodies, dt, changed_by_hand);  // throws, or all of the step is known
  const double start = time;
  commit(dt);
  const RaisedFlag guard(stepping);
  tell(start, dt);
}

void World::Impl::commit(double dt) {
  const std::uint64_t number = report.step + 1;
  report = stepper.counts();
  const PhaseClock clock(report.seconds.integrate);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!can_move(bodies[i])) continue;
    const BodyMotion& motion = stepper.motions()[i];
    bodies[i].velocity = motion.velocity;
    if (const Spin* const spin = spin_of(stepper.spins(), bodies[i], i)) {
      bodies[i].angular_velocity = spin->velocity;
      if (spin->turned != Mat3<double>::Identity()) bodies[i].shape = turned_true(bodies[i].shape, spin->turned);
    }
    move_shape(bodies[i].shape, motion.offset);
  }
  if (dt != last_dt) {
    since = time;
    last_dt = dt;
    equal_steps = 0;
  }
  time = since + static_cast<double>(++equal_steps) * dt;
  changed_by_hand = false;
  report.step = number;
  report.time = time;
}

void World::Impl::tell(double start, double dt) {
  const PhaseClock clock(report.seconds.events);
  hits.clear();
  for (const Touch& touch : stepper.touches()) {
    const double when = touch.time == 1 ? time : start + touch.time * dt;
    hits.push_back({bodies[touch.first].id, bodies[touch.second].id, when, touch.at_start, touch.normal, touch.point});
  }
  if (!plan.events) return;
  CollisionEvents& told = options.events ? events : unread;
  for (const Hit& hit : hits) told.meet(hit.first, hit.second, hit.time);
  told.finish_step(time);
}

const Body* World::Impl::find(std::uint32_t id) const {
  const auto at = std::ranges::lower_bound(bodies, id, {}, &Body::id);
  return at == bodies.end() || at->id != id ? nullptr : &*at;
}

std::size_t World::Impl::place_of(std::uint32_t id) const {
  const Body* const found = find(id);
  if (!found) throw WorldError("world: there is no body with id " + std::to_string(id));
  return static_cast<std::size_t>(found - bodies.data());
}

/// If the world can hold what comes of it.
template <class Change> void World::Impl::change(std::uint32_t id, const Change& by_hand) {
  Body& body = bodies[place_of(id)];
  Body changed = body;
  by_hand(changed);
  require_valid(changed);
  body = std::move(changed);
}

World::World(std::vector<Body> bodies, WorldOptions options) {
  require_valid(options);
  impl_ = std::make_unique<Impl>(std::move(bodies), std::move(options));
}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

const StepReport& World::step(double dt) {
  impl_->step(dt);
  return impl_->report;
}

const std::vector<Body>& World::bodies() const { return impl_->bodies; }
const Body* World::find(std::uint32_t id) const { return impl_->find(id); }
double World::time() const { return impl_->time; }
const StepReport& World::report() const { return impl_->report; }
const std::vector<Hit>& World::hits() const { return impl_->hits; }
CollisionEvents& World::events() { return impl_->events; }
const CollisionEvents& World::events() const { return impl_->events; }
const Plan& World::plan() const { return impl_->plan; }
const WorldOptions& World::options() const { return impl_->options; }

void World::set_velocity(std::uint32_t id, const Vec3<double>& velocity) {
  impl_->change(id, [&](Body& body) { body.velocity = velocity; });
}

void World::move(std::uint32_t id, const Vec3<double>& by) {
  impl_->change(id, [&](Body& body) { move_shape(body.shape, by); });
  impl_->changed_by_hand = true;
}

void World::remove(std::uint32_t id) {
  const std::size_t place = impl_->place_of(id);
  impl_->bodies.erase(impl_->bodies.begin() + static_cast<std::ptrdiff_t>(place));
  impl_->changed_by_hand = true;
  impl_->unread.remove(id, impl_->time);
  impl_->events.remove(id, impl_->time);  // last, for it tells listeners
}

/// In long double, whose range holds the product of any three doubles: never NaN.
double World::energy() const {
  using Wide = long double;
  Wide sum = 0;
  for (const Body& body : impl_->bodies) {
    if (!is_moved_by_impulses(body)) continue;
    const Vec3<Wide> v = body.velocity.cast<Wide>(), g = impl_->options.gravity.cast<Wide>();
    const Vec3<Wide> place = position(body).cast<Wide>();
    sum += Wide(body.mass) * (v.squaredNorm() / 2 - Wide(body.gravity_scale) * g.dot(place));
    if (body.turns) sum += energy_of_turning(body);
  }
  return static_cast<double>(sum);
}

std::uint64_t World::state_hash() const {
  Digest digest;
  for (const Body& body : impl_->bodies) {
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
