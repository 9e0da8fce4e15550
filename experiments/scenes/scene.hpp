#pragma once
/// A scene: its file, its bodies, its playback with a trace, and what is said of it.

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/lab/record.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/world/referee.hpp>
#include <thinwall/experiments/world/world.hpp>

namespace thinwall {

/// [m] From face to face. Zero without a shape.
Vec3<double> size_of(const Body& body);

/// [m] The closed box that holds it where it is, not rounded. Empty extents without a shape.
Aabb<double> box_of(const Body& body);

// ---- A scene as its file describes it: bodies, how they are stepped, for how long, and what is pushed by hand.

/// A hand that sets a body's velocity before the first step that begins at `time` or later.
struct Push {
  double time = 0;  ///< [s] >= 0
  std::uint32_t id = 0;
  Vec3<double> velocity = Vec3<double>::Zero();  ///< [m/s]
};

struct Scene {
  std::string name;          ///< letters, digits, _ and -
  std::vector<Body> bodies;  ///< in the order of the file
  WorldOptions options;
  double dt = 0;             ///< [s] > 0
  double last_dt = 0;        ///< [s] of the last step, where it is shorter than dt; 0: it is not
  std::int64_t steps = 0;    ///< >= 1
  std::vector<Push> pushes;  ///< in the order of time
  bool trace = false;
  std::int64_t trace_every = 1;  ///< [1] steps between two frames
  int across = 0, up = 1;        ///< the axes of the picture

  double length_of(std::int64_t step) const { return step == steps && last_dt > 0 ? last_dt : dt; }  ///< [s]
  double duration() const { return dt * static_cast<double>(steps) - (dt - length_of(steps)); }      ///< [s]
};

/// What [compare] says.
struct CompareKeys {
  std::vector<std::string> policies;
  std::vector<double> steps;  ///< [s] ascending
  int finer = 1, repeats = 1;
};

/// Throws UsageError: a key that is in no scene's range.
CompareKeys read_compare_keys(const Settings& settings);

/// Throws UsageError: a key out of range, a body or an option that no world can hold.
/// `options.trials` stands for the number of steps, `options.seed` for the copies' random places.
Scene read_scene(const Settings& settings, const RunOptions& options);

// ---- What a viewer needs: JSON lines, one object each. The first line names the bodies and their shapes; every further one
// is a frame, with the places of the bodies that move, in the order of their ids, and where any turn, with how those do.

/// Plays the scene once more, which gives the same bits, and writes down every `trace_every`-th step and the last.
std::string trace_of(const Scene& scene);

// ---- A scene stepped from its beginning to its end, and everything its results need to know of that.

/// What is kept of each step.
struct StepRow {
  std::int64_t step = 0;
  double time = 0;  ///< [s] at its end
  StepCounts counts = {};
  std::int64_t begins = 0, ends = 0, tunneled = 0;
  double energy = 0;  ///< [J]

  static constexpr auto fields() {
    using R = StepRow;
    return record(kept("step", &R::step, "1", "Number of the step, from 1."),
                  kept("time", &R::time, "s", "Time at its end."), part(&R::counts),
                  sum("begins", &R::begins, "1", "Contacts that began."),
                  sum("ends", &R::ends, "1", "Contacts that ended."),
                  sum("tunneled", &R::tunneled, "1", "Contacts that went unseen."),
                  kept("energy", &R::energy, "J", "Kinetic, and of height, at its end."));
  }
};

/// A contact that began or ended.
struct LoggedEvent {
  double time = 0;  ///< [s]
  std::int64_t step = 0;
  bool begins = false;
  std::uint32_t first = 0, second = 0;  ///< ids

  static constexpr auto fields() {
    using E = LoggedEvent;
    return record(kept("time", &E::time), kept("step", &E::step), kept("begins", &E::begins), kept("first", &E::first),
                  kept("second", &E::second));
  }
  bool operator==(const LoggedEvent&) const = default;
};

/// The way of one body in the plane of the picture.
struct Track {
  std::uint32_t id = 0;
  std::vector<double> x = {}, y = {};  ///< [m]
  static constexpr auto fields() { return record(kept("id", &Track::id), kept("x", &Track::x), kept("y", &Track::y)); }
};

/// Where a body is at the end.
struct FinalPlace {
  std::int64_t id = 0;
  std::string name = {};
  double x = 0, y = 0, z = 0;

  static constexpr auto fields() {
    using P = FinalPlace;
    return record(kept("id", &P::id, "1", "Id."), kept("name", &P::name, "", "Name."),
                  kept("x", &P::x, "m", "Of its center."), kept("y", &P::y, "m", "The same."),
                  kept("z", &P::z, "m", "The same."));
  }
};

/// [s] over all steps, of wall clock.
struct PhaseTime {
  double total = 0, most = 0;
  static constexpr auto fields() { return record(kept("total", &PhaseTime::total), kept("most", &PhaseTime::most)); }
};

/// The phases of a step, in order, and all of it.
inline constexpr std::array<std::string_view, 6> phase_names = {"integrate", "broad",  "narrow",
                                                                "response",  "events", "step"};

struct Playback {
  std::vector<StepRow> rows;
  std::vector<LoggedEvent> events;  ///< begins and ends, the first `most_kept`
  std::int64_t all_events = 0;
  std::vector<Meeting> missed;  ///< the first `most_kept`
  std::int64_t all_missed = 0;
  std::int64_t live = 0;  ///< contacts that had not ended
  std::vector<Track> tracks;
  std::vector<FinalPlace> places;  ///< of every body, by id
  double energy = 0;               ///< [J] at the start
  std::uint64_t hash = 0;          ///< of the state at the end
  std::array<PhaseTime, phase_names.size()> phases = {};
  StepRow sums() const;  ///< over all steps
  static constexpr auto fields() {
    using P = Playback;
    return record(kept("rows", &P::rows), kept("events", &P::events), kept("all_events", &P::all_events),
                  kept("missed", &P::missed), kept("all_missed", &P::all_missed), kept("live", &P::live),
                  kept("tracks", &P::tracks), kept("places", &P::places), kept("energy", &P::energy),
                  kept("hash", &P::hash), kept("phases", &P::phases));
  }
};

inline constexpr std::size_t most_kept = 10'000;   ///< of events and of missed contacts
inline constexpr std::size_t most_tracks = 40;     ///< moving bodies in the picture
inline constexpr std::int64_t most_points = 2000;  ///< of a track

/// True if it may have a track: it moves, and has a shape.
bool is_drawn(const Body& body);

/// [1] Steps from one point of a track to the next; the last step has one too.
inline std::int64_t steps_a_point(const Scene& scene) { return (scene.steps + most_points - 1) / most_points; }

/// Called before the first step, and after each.
using Frame = std::function<void(const World&)>;

/// Throws what World throws.
Playback play(const Scene& scene, const Frame& on_frame = {});

// ---- What is said of a scene: tables, pictures and words.

/// True of a policy that misses nothing, with that gate.
bool looks_at_all_motion(TimePolicy policy, double gate);

/// True if what this policy claims held.
bool claims_held(const Scene& scene, const Playback& playback);

/// `thinwall run FILE`: steps the scene once. What tunneled, who met whom, energy, and time a step by phase.
Experiment scene_experiment();

}  // namespace thinwall
