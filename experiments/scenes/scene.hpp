#pragma once
/// A scene: its file, its bodies, its playback with a trace, the referee of what a step did not see; and several policies beside the exact
/// run.

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/discrete/broad_phase/proxy.hpp>
#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/lab/record.hpp>
#include <thinwall/experiments/lab/settings.hpp>
#include <thinwall/experiments/world/world.hpp>

namespace thinwall {

// ---- The bodies that a scene file describes.

/// Every [[body]] of the file, copies made: a grid, and random numbers that depend on the seed, on the body's own place,
/// size and grid, and on the copy's place in it alone. Ids count up from 1, in the order of the file.
/// Throws UsageError: a key out of range, missing, or not of the shape; more than two million bodies.
std::vector<Body> read_bodies(const Settings& scene, std::uint64_t seed);

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

/// Throws UsageError: a key out of range, a body or an option that no world can hold.
/// `options.trials` stands for the number of steps, `options.seed` for the copies' random places.
Scene read_scene(const Settings& settings, const RunOptions& options);

TimePolicy policy_named(std::string_view name);  ///< one of policy_names

// ---- What a viewer needs: JSON lines, one object each. The first line names the bodies and their shapes; every further one
// is a frame, with the places of the bodies that move, in the order of their ids, and where any turn, with how those do.

/// Plays the scene once more, which gives the same bits, and writes down every `trace_every`-th step and the last.
std::string trace_of(const Scene& scene);

// ---- The referee of a scene: contacts that a step went through and did not see.
//
// Between two steps a body that nothing touched moved straight, from where it was to where it is, and turned at the rate that it still
// has. Of two such bodies, apart at both ends, the closed form says whether they touched on the way, or where one turns its sweep. If they did and
// the step told no contact of theirs, one went through the other: it tunneled. Bodies that were in any contact in the step are not judged against
// others, for their way may have a corner. Under substeps gravity bends the way, by g dt^2 / 8 at most: a contact less deep than that may be judged
// wrong.

/// Two bodies that passed through each other.
struct MissedContact {
  std::uint32_t first = 0, second = 0;  ///< ids, first < second
  double time = 0;                      ///< [s] when they first touched

  static constexpr auto fields() {
    using M = MissedContact;
    return record(kept("time", &M::time, "s", "When they first touched."), kept("first_id", &M::first),
                  kept("second_id", &M::second));
  }
};

class MissedContacts {
 public:
  explicit MissedContacts(const World& world) : before_(world.bodies()) {}

  /// After a step of `dt` [s]: what it missed since the last call, by id.
  std::vector<MissedContact> after_step(const World& world, double dt);

 private:
  std::vector<Body> before_;
  std::vector<Proxy> proxies_;  // of the ways since then; kept for their memory, as the pairs are
  std::vector<ProxyPair> pairs_;
};

// ---- A scene stepped from its beginning to its end, and everything its results need to know of that.

/// What is kept of each step.
struct StepRow {
  std::int64_t step = 0;
  double time = 0;  ///< [s] at its end
  std::int64_t pairs = 0, sweeps = 0, gated = 0, hits = 0, impulses = 0, waiting = 0;
  std::int64_t begins = 0, ends = 0;
  std::int64_t tunneled = 0;  ///< pairs that went through each other
  double energy = 0;          ///< [J]

  static constexpr auto fields() {
    using R = StepRow;
    return record(
        kept("step", &R::step, "1", "Number of the step, from 1."), kept("time", &R::time, "s", "Time at its end."),
        sum("pairs", &R::pairs, "1", "Pairs whose boxes meet, as the broad phase found them."),
        sum("sweeps", &R::sweeps, "1", "Pairs that were asked, those after a hit included."),
        sum("gated", &R::gated, "1", "Of those, tested at an instant because both moved less than the gate."),
        sum("hits", &R::hits, "1", "Contacts."), sum("impulses", &R::impulses, "1", "Impulses exchanged."),
        sum("waiting", &R::waiting, "1", "Bodies that stopped before the end of the step."),
        sum("begins", &R::begins, "1", "Contacts that began."), sum("ends", &R::ends, "1", "Contacts that ended."),
        sum("tunneled", &R::tunneled, "1", "Pairs that went through each other unseen."),
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
  double x = 0, y = 0, z = 0;

  static constexpr auto fields() {
    return record(kept("id", &FinalPlace::id, "1", "Id."), kept("x", &FinalPlace::x, "m", "Of its center."),
                  kept("y", &FinalPlace::y, "m", "The same."), kept("z", &FinalPlace::z, "m", "The same."));
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
  std::vector<MissedContact> missed;  ///< the first `most_kept`
  std::int64_t all_missed = 0;
  std::int64_t live = 0;  ///< contacts that had not ended
  std::vector<Track> tracks;
  std::vector<FinalPlace> places;  ///< of every body, by id
  double energy = 0;               ///< [J] at the start
  std::uint64_t hash = 0;          ///< of the state at the end
  std::int64_t bytes = 0;          ///< [B] the most that stepping held
  std::array<PhaseTime, phase_names.size()> phases = {};
  StepRow sums() const;  ///< over all steps
  static constexpr auto fields() {
    using P = Playback;
    return record(kept("rows", &P::rows), kept("events", &P::events), kept("all_events", &P::all_events),
                  kept("missed", &P::missed), kept("all_missed", &P::all_missed), kept("live", &P::live),
                  kept("tracks", &P::tracks), kept("places", &P::places), kept("energy", &P::energy),
                  kept("hash", &P::hash), kept("bytes", &P::bytes), kept("phases", &P::phases));
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

// ---- One scene under many time policies and steps, each held against the finest exact run.
//
// The exact run is stepped by events, with steps `finer` times shorter than the shortest compared. What it is exact about
// is the motion within a step; under gravity its path is still that of the integrator, which errs by g t dt / 2. Of each
// pair of bodies the first meeting is compared, and no later one: after a bounce at another time two runs part, in a scene
// of many bodies for good.

/// One way to step the scene.
struct Contender {
  TimePolicy policy = TimePolicy::discrete;
  int substeps = 1;
  double dt = 0;  ///< [s]
  std::string label() const;
};

struct Comparison {
  Scene scene;
  std::vector<Contender> contenders;  ///< policy by policy, from the shortest step to the longest
  Contender exact;
  int repeats = 1;
};

/// What [compare] says.
struct CompareKeys {
  std::vector<std::string> policies;
  std::vector<double> steps;  ///< [s] ascending
  int finer = 1, repeats = 1;
};

/// Throws UsageError: a key that is in no scene's range.
CompareKeys read_compare_keys(const Settings& settings);

/// Throws UsageError.
Comparison read_comparison(const Settings& settings, const RunOptions& options);

/// The scene, stepped that way for the same time: where steps of that length do not divide it, the last one is shorter.
Scene scene_for(const Comparison& comparison, const Contender& contender);

/// When a pair of bodies met first.
struct FirstMeeting {
  std::uint32_t first = 0, second = 0;  ///< ids
  double time = 0;                      ///< [s]

  static constexpr auto fields() {
    using M = FirstMeeting;
    return record(kept("first", &M::first), kept("second", &M::second), kept("time", &M::time));
  }
  bool operator==(const FirstMeeting&) const = default;
};

/// What a run of a contender leaves.
struct Trial {
  std::vector<FirstMeeting> meetings;  ///< by id
  std::int64_t tunneled = 0, hits = 0, sweeps = 0;
  double energy = 0, energy_end = 0;  ///< [J]
  std::uint64_t hash = 0;
  double seconds = 0;  ///< of stepping, the referee not included

  static constexpr auto fields() {
    using T = Trial;
    return record(
        kept("meetings", &T::meetings),
        kept("tunneled", &T::tunneled, "1", "Pairs that went through each other unseen, counted step by step."),
        kept("hits", &T::hits, "1", "Contacts over all steps."),
        kept("sweeps", &T::sweeps, "1", "Pairs asked over all steps: the machine-independent cost."),
        kept("energy", &T::energy), kept("energy_end", &T::energy_end), kept("hash", &T::hash),
        kept("seconds", &T::seconds));
  }
  std::optional<double> met(std::uint32_t first, std::uint32_t second) const;  ///< [s] when these met first

  bool same_outcome(const Trial& other) const;  ///< all but the seconds
};

Trial run_trial(const Scene& scene);

/// A contender against the exact run.
struct Contest {
  Contender contender;
  Trial trial;                  ///< of the first repeat
  std::vector<double> seconds;  ///< of each
  bool repeated_alike = true;   ///< every repeat gave the same bits
  std::int64_t met = 0;         ///< pairs that met in both runs
  std::int64_t unmet = 0;       ///< pairs that met in the exact run alone, in time for this one to see it
  std::int64_t extra = 0;       ///< pairs that met in this run alone
  std::vector<double> errors;   ///< [s] between the two first meetings, sorted; of the pairs that met in both
};

/// `last_step` [s]: when its last step begins.
Contest contest(const Contender& contender, const std::vector<Trial>& repeats, const Trial& exact, double last_step);

// ---- What is said of a scene, alone and compared: tables, pictures and words.

/// True of a policy that misses nothing, with that gate.
bool looks_at_all_motion(TimePolicy policy, double gate);

/// True if what this policy claims held.
bool claims_held(const Scene& scene, const Playback& playback);

/// `thinwall run FILE`: steps the scene once. What tunneled, who met whom, energy, and time a step by phase.
Experiment scene_experiment();

/// `thinwall compare FILE`: steps it under every time policy and step, and holds each against the finest exact run.
Experiment compare_experiment();

}  // namespace thinwall
