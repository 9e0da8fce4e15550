#include <thinwall/experiments/scenes/scene.hpp>

#include <algorithm>
#include <limits>

#include <thinwall/experiments/lab/json_reader.hpp>
#include <thinwall/experiments/world/world.hpp>

namespace thinwall {

namespace {

using nlohmann::ordered_json;

std::string line(const ordered_json& value) { return exact_text(value, ",", ":") + "\n"; }

ordered_json list(const Vec3<double>& v) { return {v[0], v[1], v[2]}; }

/// How it is turned, where that is to be seen.
void add_turn(ordered_json& shape, const AnyShape& any) {
  if (const auto* const box = std::get_if<Obb<double>>(&any)) {
    shape["axes"] = {list(box->axes.col(0)), list(box->axes.col(1)), list(box->axes.col(2))};
  } else if (const auto* const capsule = std::get_if<Capsule<double>>(&any)) {
    shape["half_core"] = list((capsule->b - capsule->a) / 2);
  }
}

/// Around its own center: a body's place in a frame is where that center is.
struct ShapeSeen {
  ordered_json operator()(const std::monostate&) const { return nullptr; }
  ordered_json operator()(const Sphere<double>& s) const { return {{"type", "sphere"}, {"radius", s.radius}}; }
  ordered_json operator()(const Aabb<double>& b) const { return {{"type", "box"}, {"size", list(2 * b.half_extents)}}; }
  ordered_json operator()(const Obb<double>& b) const {
    return {{"type", "turned_box"}, {"size", list(2 * b.half_extents)}};
  }
  ordered_json operator()(const Capsule<double>& c) const { return {{"type", "capsule"}, {"radius", c.radius}}; }
};

std::string header(const Scene& scene, const World& world) {
  ordered_json bodies = ordered_json::array();
  for (const Body& body : world.bodies()) {
    ordered_json shape = std::visit(ShapeSeen{}, body.shape);
    add_turn(shape, body.shape);
    bodies.push_back({{"id", body.id},
                      {"name", body.name},
                      {"static", body.is_static},
                      {"shape", shape},
                      {"at", list(position(body))}});
  }
  return line({{"scene", scene.name}, {"dt", scene.dt}, {"bodies", bodies}});
}

std::string frame(const World& world) {
  ordered_json at = ordered_json::array(), turning = at, events = at;
  for (const Body& body : world.bodies()) {
    if (!can_move(body)) continue;
    at.push_back(list(position(body)));
    if (!body.turns) continue;
    ordered_json& turned = turning.emplace_back(ordered_json{{"id", body.id}});
    add_turn(turned, body.shape);
    turned["angular_velocity"] = list(body.angular_velocity);
  }
  for (const CollisionEvent& event : world.events().events()) {
    if (event.kind == CollisionEventKind::stay) continue;
    const char* const kind = event.kind == CollisionEventKind::begin ? "begin" : "end";
    events.push_back({kind, event.first, event.second, event.time});
  }
  ordered_json out = {{"time", world.time()}, {"at", at}};
  if (!turning.empty()) out["turning"] = turning;
  out["events"] = events;
  return line(out);
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
    const Vec3<double> place = position(*body);
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

bool is_drawn(const Body& body) { return can_move(body) && !std::holds_alternative<std::monostate>(body.shape); }

StepRow Playback::sums() const {
  StepRow sums;
  for (const StepRow& row : rows) sums += row;
  return sums;
}

Playback play(const Scene& scene, const Frame& on_frame) {
  World world(scene.bodies, scene.options);
  Referee referee(world);
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
    const StepReport& report = world.step(dt);
    const StepCounts& counts = report;
    StepRow row = {.step = static_cast<std::int64_t>(report.step), .time = report.time, .counts = counts};
    add(report.seconds, out);
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
    for (const Meeting& missed : referee.missed_by(world, dt)) {
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
    const Vec3<double> at = position(body);
    out.places.push_back({body.id, body.name, at[0], at[1], at[2]});
  }
  out.hash = world.state_hash();
  return out;
}

}  // namespace thinwall
