#pragma once
/// A scene stepped from its beginning to its end, and everything its results need to know of that.

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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
};

/// The way of one body in the plane of the picture.
struct Track {
  std::uint32_t id = 0;
  std::vector<double> x, y;  ///< [m]
};

/// [s] over all steps, of wall clock.
struct PhaseTime {
  double total = 0, most = 0;
};

/// The phases of a step, in order, and all of it.
inline constexpr std::array<std::string_view, 6> phase_names = {"integrate", "broad",  "narrow",
                                                                "response",  "events", "step"};

struct Playback {
  std::vector<StepRow> rows;
  std::vector<CollisionEvent> events;  ///< begins and ends, the first `most_kept`
  std::int64_t all_events = 0;
  std::vector<MissedContact> missed;  ///< the first `most_kept`
  std::int64_t all_missed = 0;
  std::int64_t live = 0;  ///< contacts that had not ended
  std::vector<Track> tracks;
  std::vector<std::pair<std::uint32_t, Vec3<double>>> places;  ///< [m] of every body at the end, by id
  double energy = 0;                                           ///< [J] at the start
  std::uint64_t hash = 0;                                      ///< of the state at the end
  std::int64_t bytes = 0;                                      ///< [B] the most that stepping held
  std::array<PhaseTime, phase_names.size()> phases = {};
};

inline constexpr std::size_t most_kept = 10'000;   ///< of events and of missed contacts
inline constexpr std::size_t most_tracks = 40;     ///< moving bodies in the picture
inline constexpr std::int64_t most_points = 2000;  ///< of a track

/// Called before the first step, and after each.
using Frame = std::function<void(const World&)>;

/// Throws what World throws.
Playback play(const Scene& scene, const Frame& on_frame = {});

/// One line of text, without losing a bit, and back. Throws std::runtime_error for what is not one.
std::string to_line(const Playback& playback);
Playback playback_from_line(const std::string& line);

}  // namespace thinwall
