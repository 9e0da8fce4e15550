#include <thinwall/experiments/world/world.hpp>

#include <algorithm>
#include <bit>
#include <utility>

#include <thinwall/discrete/raised_flag.hpp>
#include <thinwall/experiments/world/checks.hpp>
#include <thinwall/experiments/world/step/stepping.hpp>

namespace thinwall {

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
  std::size_t place_of(std::uint32_t id) const;

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
    std::visit(
        [&](auto& shape) {
          if constexpr (!std::is_same_v<decltype(shape), std::monostate&>) shape = moved(shape, motion.offset);
        },
        bodies[i].shape);
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

std::size_t World::Impl::place_of(std::uint32_t id) const {
  const auto at = std::lower_bound(bodies.begin(), bodies.end(), id,
                                   [](const Body& body, std::uint32_t wanted) { return body.id < wanted; });
  if (at == bodies.end() || at->id != id) throw WorldError("world: there is no body with id " + std::to_string(id));
  return static_cast<std::size_t>(at - bodies.begin());
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
const Body* World::find(std::uint32_t id) const {
  const auto at = std::lower_bound(impl_->bodies.begin(), impl_->bodies.end(), id,
                                   [](const Body& body, std::uint32_t wanted) { return body.id < wanted; });
  return at == impl_->bodies.end() || at->id != id ? nullptr : &*at;
}
double World::time() const { return impl_->time; }
const StepReport& World::report() const { return impl_->report; }
const std::vector<Hit>& World::hits() const { return impl_->hits; }
CollisionEvents& World::events() { return impl_->events; }
const CollisionEvents& World::events() const { return impl_->events; }
const Plan& World::plan() const { return impl_->plan; }
const WorldOptions& World::options() const { return impl_->options; }

void World::set_velocity(std::uint32_t id, const Vec3<double>& velocity) {
  Body& body = impl_->bodies[impl_->place_of(id)];
  Body changed = body;
  changed.velocity = velocity;
  require_valid(changed);
  body = std::move(changed);
}

void World::move(std::uint32_t id, const Vec3<double>& by) {
  Body& body = impl_->bodies[impl_->place_of(id)];
  Body changed = body;
  std::visit(
      [&](auto& shape) {
        if constexpr (!std::is_same_v<decltype(shape), std::monostate&>) shape = moved(shape, by);
      },
      changed.shape);
  require_valid(changed);
  body = std::move(changed);
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
  }
  return static_cast<double>(sum);
}

/// Source: the 64-bit FNV-1a hash, by whole words.
std::uint64_t World::state_hash() const {
  std::uint64_t hash = 0xcbf29ce484222325;
  const auto add = [&](std::uint64_t word) { hash = (hash ^ word) * 0x100000001b3; };
  const auto add_vector = [&](const Vec3<double>& v) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto word = std::bit_cast<std::uint64_t>(v[axis]);
      add(word & 0xffffffff);  // the multiplication spreads what is low, not what is high
      add(word >> 32);
    }
  };
  for (const Body& body : impl_->bodies) {
    add(body.id);
    add_vector(body.velocity);
    std::visit(
        [&](const auto& shape) {
          if constexpr (!std::is_same_v<decltype(shape), const std::monostate&>) {
            add_vector(center(shape));
            add_vector(half_widths(shape));
          }
        },
        body.shape);
  }
  return hash;
}

}  // namespace thinwall
