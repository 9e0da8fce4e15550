#include <thinwall/experiments/scenes/playback.hpp>

#include <algorithm>

#include <thinwall/experiments/scenes/bodies.hpp>

namespace thinwall {

namespace {

/// The hands that push, in the order of time.
class Hands {
 public:
  explicit Hands(const std::vector<Push>& pushes) : pushes_(pushes) {}

  void before_step(World& world, double time) {
    for (; next_ < pushes_.size() && pushes_[next_].time <= time; ++next_) {
      world.set_velocity(pushes_[next_].id, pushes_[next_].velocity);
    }
  }

 private:
  const std::vector<Push>& pushes_;
  std::size_t next_ = 0;
};

std::vector<Track> begin_tracks(const std::vector<Body>& bodies) {
  std::vector<std::uint32_t> ids;
  for (const Body& body : bodies) {
    if (can_move(body) && !std::holds_alternative<std::monostate>(body.shape)) ids.push_back(body.id);
  }
  const std::size_t count = std::min(ids.size(), most_tracks);
  std::vector<Track> tracks;
  for (std::size_t i = 0; i < count; ++i) tracks.push_back({.id = ids[i * ids.size() / count], .x = {}, .y = {}});
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

StepRow Playback::sums() const {
  StepRow sums;
  for (const StepRow& row : rows) sums += row;
  return sums;
}

Playback play(const Scene& scene, const Frame& on_frame) {
  World world(scene.bodies, scene.options);
  MissedContacts referee(world);
  Hands hands(scene.pushes);
  Playback out;
  out.energy = world.energy();
  out.tracks = begin_tracks(world.bodies());
  extend(out.tracks, world, scene);
  if (on_frame) on_frame(world);
  const std::int64_t stride = (scene.steps + most_points - 1) / most_points;
  for (std::int64_t step = 1; step <= scene.steps; ++step) {
    hands.before_step(world, static_cast<double>(step - 1) * scene.dt);
    StepRow row = row_of(world.step(scene.dt));
    add(world.report().seconds, out);
    out.bytes = std::max(out.bytes, static_cast<std::int64_t>(world.report().bytes));
    for (const CollisionEvent& event : world.events().events()) {
      if (event.kind == CollisionEventKind::stay) continue;
      ++(event.kind == CollisionEventKind::begin ? row.begins : row.ends);
      ++out.all_events;
      if (out.events.size() < most_kept) {
        out.events.push_back({event.time, static_cast<std::int64_t>(event.step),
                              event.kind == CollisionEventKind::begin, event.first, event.second});
      }
    }
    for (const MissedContact& missed : referee.after_step(world, scene.dt)) {
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
