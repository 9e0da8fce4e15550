#pragma once
/// A scene stepped from its beginning to its end, and everything its results need to know of that.

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/lab/record.hpp>
#include <thinwall/experiments/scenes/missed.hpp>
#include <thinwall/experiments/scenes/scene.hpp>
#include <thinwall/experiments/world/world.hpp>

namespace thinwall {

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
  std::vector<double> x, y;  ///< [m]
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

/// Called before the first step, and after each.
using Frame = std::function<void(const World&)>;

/// Throws what World throws.
Playback play(const Scene& scene, const Frame& on_frame = {});

}  // namespace thinwall
