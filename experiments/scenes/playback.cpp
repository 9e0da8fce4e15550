#include <thinwall/experiments/scenes/scene.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <thinwall/discrete/broad_phase/uniform_grid.hpp>
#include <thinwall/experiments/lab/escape.hpp>
#include <thinwall/experiments/lab/text.hpp>
#include <thinwall/experiments/world/pairs.hpp>
#include <thinwall/experiments/world/world.hpp>
#include <thinwall/swept/dispatch.hpp>

namespace thinwall {

namespace {

std::string vector_text(const Vec3<double>& v) {
  return fmt::format("[{},{},{}]", exact_text(v[0]), exact_text(v[1]), exact_text(v[2]));
}

std::string axes_text(const Obb<double>& b) {
  return fmt::format(R"("axes":[{},{},{}])", vector_text(b.axes.col(0)), vector_text(b.axes.col(1)),
                     vector_text(b.axes.col(2)));
}
std::string half_core_text(const Capsule<double>& c) {
  return fmt::format(R"("half_core":{})", vector_text((c.b - c.a) / 2));
}

/// The shape around its own center: a body's place in a frame is where that center is.
struct ShapeText {
  std::string operator()(const std::monostate&) const { return "null"; }
  std::string operator()(const Sphere<double>& s) const {
    return fmt::format(R"({{"type":"sphere","radius":{}}})", exact_text(s.radius));
  }
  std::string operator()(const Aabb<double>& b) const {
    return fmt::format(R"({{"type":"box","size":{}}})", vector_text(2 * b.half_extents));
  }
  std::string operator()(const Obb<double>& b) const {
    return fmt::format(R"({{"type":"turned_box","size":{},{}}})", vector_text(2 * b.half_extents), axes_text(b));
  }
  std::string operator()(const Capsule<double>& c) const {
    return fmt::format(R"({{"type":"capsule","radius":{},{}}})", exact_text(c.radius), half_core_text(c));
  }
};

/// How a body that turns is oriented, and at what rate it turns.
std::string spin_text(const Body& body) {
  std::string text = fmt::format(R"({{"id":{},)", body.id);
  if (const auto* const box = std::get_if<Obb<double>>(&body.shape)) text += axes_text(*box) + ",";
  if (const auto* const capsule = std::get_if<Capsule<double>>(&body.shape)) text += half_core_text(*capsule) + ",";
  return text + fmt::format(R"("angular_velocity":{}}})", vector_text(body.angular_velocity));
}

std::string header(const Scene& scene, const World& world) {
  std::string bodies;
  for (const Body& body : world.bodies()) {
    bodies += fmt::format(R"({}{{"id":{},"name":{},"static":{},"shape":{},"at":{}}})", bodies.empty() ? "" : ",",
                          body.id, json_string(body.name), body.is_static, std::visit(ShapeText{}, body.shape),
                          vector_text(box_of(body).center));
  }
  return fmt::format("{{\"scene\":{},\"dt\":{},\"bodies\":[{}]}}\n", json_string(scene.name), exact_text(scene.dt),
                     bodies);
}

std::string frame(const World& world) {
  std::string at, spins, events;
  for (const Body& body : world.bodies()) {
    if (!can_move(body)) continue;
    at += (at.empty() ? "" : ",") + vector_text(position(body));
    if (body.turns) spins += (spins.empty() ? "" : ",") + spin_text(body);
  }
  for (const CollisionEvent& event : world.events().events()) {
    if (event.kind == CollisionEventKind::stay) continue;
    const char* const kind = event.kind == CollisionEventKind::begin ? "begin" : "end";
    events += fmt::format(R"({}["{}",{},{},{}])", events.empty() ? "" : ",", kind, event.first, event.second,
                          exact_text(event.time));
  }
  const std::string turning = spins.empty() ? "" : fmt::format(R"("turning":[{}],)", spins);
  return fmt::format("{{\"time\":{},\"at\":[{}],{}\"events\":[{}]}}\n", exact_text(world.time()), at, turning, events);
}

constexpr double infinity = std::numeric_limits<double>::infinity();

/// [rad] How far a body that nothing touched turned in a step of dt [s].
Vec3<double> rotation_of(const Body& after, double dt) {
  return can_turn(after) ? Vec3<double>(after.angular_velocity * dt) : Vec3<double>(Vec3<double>::Zero());
}

/// [m] From one place to the other: the way at the velocity, where the places are roundings of it. Two that pass flush would seem to meet.
Vec3<double> flown(const Body& before, const Body& after, double dt) {
  const Vec3<double> from = box_of(before).center, to = box_of(after).center, way = after.velocity * dt;
  const Vec3<double> rounding =
      4 * std::numeric_limits<double>::epsilon() * (from.cwiseAbs() + to.cwiseAbs() + way.cwiseAbs());
  const bool is_it = ((to - from - way).cwiseAbs().array() <= rounding.array()).all();
  return is_it ? way : Vec3<double>(to - from);
}

/// The box of both poses, rounded outward, or of all in between where it turns.
Proxy way_of(const Body& before, const Body& after, double dt) {
  if (can_turn(after)) {
    BodyMotion motion;
    motion.velocity = flown(before, after, dt);  // as the pair is asked about
    Spin spin;
    spin.velocity = rotation_of(after, dt);
    return proxy_of(before, motion, &spin, 1);
  }
  const Aabb<double> a = box_of(before), b = box_of(after);
  Proxy proxy;
  for (int i = 0; i < 3; ++i) {
    const double low = std::min(a.center[i] - a.half_extents[i], b.center[i] - b.half_extents[i]);
    const double high = std::max(a.center[i] + a.half_extents[i], b.center[i] + b.half_extents[i]);
    const double room = 4 * std::numeric_limits<double>::epsilon() *
                        (std::abs(a.center[i]) + std::abs(b.center[i]) + a.half_extents[i] + b.half_extents[i]);
    proxy.low[i] = std::nextafter(low - room, -infinity);
    proxy.high[i] = std::nextafter(high + room, infinity);
  }
  proxy.group = after.group;
  proxy.mask = after.mask;
  proxy.is_static = after.is_static;
  proxy.skipped = std::holds_alternative<std::monostate>(after.shape);
  return proxy;
}

/// When two first touch that turn.
Toi<double> impact_of_spinning(const Moving<AnyShape>& a, const Moving<AnyShape>& b, const Vec3<double>& spin_a,
                               const Vec3<double>& spin_b) {
  return visit_shapes(a.shape, b.shape, Toi<double>{}, [&]<class A, class B>(const A& x, const B& y) {
    return time_of_impact(spin_sweep, spinning(Moving<A>{x, a.displacement}, spin_a),
                          spinning(Moving<B>{y, b.displacement}, spin_b));
  });
}

/// True if the two go into each other by more than rounding after they touch: not if they rest on each other, or slide along.
bool goes_in(const Toi<double>& toi, const Moving<AnyShape>& a, const Moving<AnyShape>& b, const Vec3<double>& spin_a,
             const Vec3<double>& spin_b) {
  double size = 0;
  const auto way_of_point = [&](const Moving<AnyShape>& m, const Vec3<double>& spin) -> Vec3<double> {
    const Vec3<double> center = of_shape(m.shape, m.displacement, [](const auto& s) { return thinwall::center(s); });
    const Vec3<double> arm = toi.point - (center + m.displacement * toi.time);
    size += of_shape(m.shape, 0.0, [](const auto& s) { return magnitude(s); }) + m.displacement.cwiseAbs().sum();
    return m.displacement + cross(spin, arm);
  };
  const Vec3<double> way = way_of_point(a, spin_a) - way_of_point(b, spin_b);
  return way.dot(toi.normal) * (1 - toi.time) > 16 * std::numeric_limits<double>::epsilon() * size;
}

std::vector<Track> begin_tracks(const std::vector<Body>& bodies) {
  std::vector<std::uint32_t> ids;
  for (const Body& body : bodies) {
    if (is_drawn(body)) ids.push_back(body.id);
  }
  const std::size_t count = std::min(ids.size(), most_tracks);
  std::vector<Track> tracks;
  for (std::size_t i = 0; i < count; ++i) tracks.push_back({ids[i * ids.size() / count]});
  return tracks;
}

void extend(std::vector<Track>& tracks, const World& world, const Scene& scene) {
  for (Track& track : tracks) {
    const Body* const body = world.find(track.id);
    if (!body) continue;
    const Vec3<double> place = box_of(*body).center;
    track.x.push_back(place[scene.across]);
    track.y.push_back(place[scene.up]);
  }
}

void add(const PhaseSeconds& seconds, Playback& playback) {
  const std::array<double, phase_names.size()> now = {seconds.integrate, seconds.broad,  seconds.narrow,
                                                      seconds.response,  seconds.events, seconds.total()};
  for (std::size_t i = 0; i < now.size(); ++i) {
    playback.phases[i].total += now[i];
    playback.phases[i].most = std::max(playback.phases[i].most, now[i]);
  }
}

StepRow row_of(const StepReport& report) {
  const auto count = [](std::size_t n) { return static_cast<std::int64_t>(n); };
  return {.step = static_cast<std::int64_t>(report.step),
          .time = report.time,
          .pairs = count(report.pairs),
          .sweeps = count(report.sweeps),
          .gated = count(report.gated),
          .hits = count(report.hits),
          .impulses = count(report.impulses),
          .waiting = count(report.waiting)};
}

}  // namespace

std::string trace_of(const Scene& scene) {
  std::string text;
  std::int64_t step = 0;
  play(scene, [&](const World& world) {
    if (step == 0) text += header(scene, world);
    if (step % scene.trace_every == 0 || step == scene.steps) text += frame(world);
    ++step;
  });
  return text;
}

std::vector<MissedContact> MissedContacts::after_step(const World& world, double dt) {
  const std::vector<Body>& after = world.bodies();
  std::vector<bool> touched(after.size());
  const auto index_of = [&after](std::uint32_t id) {
    return static_cast<std::size_t>(std::ranges::lower_bound(after, id, {}, &Body::id) - after.begin());
  };
  for (const Hit& hit : world.hits()) {
    for (const std::uint32_t id : {hit.first, hit.second}) {
      const std::size_t i = index_of(id);
      if (i < after.size() && can_move(after[i])) touched[i] = true;
    }
  }
  proxies_.clear();
  for (std::size_t i = 0; i < after.size(); ++i) {
    Proxy& proxy = proxies_.emplace_back(way_of(before_[i], after[i], dt));
    proxy.skipped |= touched[i];
  }
  find_pairs(UniformGrid{}, proxies_, pairs_);
  std::vector<MissedContact> missed;
  const double start = world.time() - dt;
  for (const ProxyPair& pair : pairs_) {
    const Body &a = before_[pair.first], &b = before_[pair.second];
    const Moving<AnyShape> first{a.shape, flown(a, after[pair.first], dt)},
        second{b.shape, flown(b, after[pair.second], dt)};
    const Vec3<double> spin_a = rotation_of(after[pair.first], dt), spin_b = rotation_of(after[pair.second], dt);
    const bool turns = spin_a != Vec3<double>::Zero() || spin_b != Vec3<double>::Zero();
    const Toi<double> toi = turns ? impact_of_spinning(first, second, spin_a, spin_b) : time_of_impact(first, second);
    if (toi.status != ToiStatus::hit || !goes_in(toi, first, second, spin_a, spin_b)) continue;
    if (overlaps(after[pair.first].shape, after[pair.second].shape)) continue;
    missed.push_back({a.id, b.id, start + toi.time * dt});
  }
  before_ = after;
  return missed;
}

bool is_drawn(const Body& body) { return can_move(body) && !std::holds_alternative<std::monostate>(body.shape); }

StepRow Playback::sums() const {
  StepRow sums;
  for (const StepRow& row : rows) sums += row;
  return sums;
}

Playback play(const Scene& scene, const Frame& on_frame) {
  World world(scene.bodies, scene.options);
  MissedContacts referee(world);
  auto push = scene.pushes.begin();
  Playback out;
  out.energy = world.energy();
  out.tracks = begin_tracks(world.bodies());
  extend(out.tracks, world, scene);
  if (on_frame) on_frame(world);
  const std::int64_t stride = steps_a_point(scene);
  for (std::int64_t step = 1; step <= scene.steps; ++step) {
    const double start = static_cast<double>(step - 1) * scene.dt, dt = scene.length_of(step);
    const double begun = start * (1 + 4 * std::numeric_limits<double>::epsilon());  // as a step's start may be worded
    for (; push != scene.pushes.end() && push->time <= begun; ++push) world.set_velocity(push->id, push->velocity);
    StepRow row = row_of(world.step(dt));
    add(world.report().seconds, out);
    out.bytes = std::max(out.bytes, static_cast<std::int64_t>(world.report().bytes));
    std::vector<CollisionEvent> events = world.events().events();
    std::ranges::stable_sort(events, {}, &CollisionEvent::time);  // those that are kept are the first
    for (const CollisionEvent& event : events) {
      if (event.kind == CollisionEventKind::stay) continue;
      ++(event.kind == CollisionEventKind::begin ? row.begins : row.ends);
      ++out.all_events;
      if (out.events.size() < most_kept) {
        out.events.push_back({event.time, static_cast<std::int64_t>(event.step),
                              event.kind == CollisionEventKind::begin, event.first, event.second});
      }
    }
    for (const MissedContact& missed : referee.after_step(world, dt)) {
      ++row.tunneled;
      ++out.all_missed;
      if (out.missed.size() < most_kept) out.missed.push_back(missed);
    }
    row.energy = world.energy();
    out.rows.push_back(row);
    if (step % stride == 0 || step == scene.steps) extend(out.tracks, world, scene);
    if (on_frame) on_frame(world);
  }
  std::ranges::stable_sort(out.events, {}, &LoggedEvent::time);
  out.live = static_cast<std::int64_t>(world.events().live());
  for (const Body& body : world.bodies()) {
    const Vec3<double> at = box_of(body).center;
    out.places.push_back({body.id, at[0], at[1], at[2]});
  }
  out.hash = world.state_hash();
  return out;
}

}  // namespace thinwall
