#pragma once
/// What became of a scene, as tables and pictures.

#include <string>
#include <vector>

#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/scenes/playback.hpp>
#include <thinwall/experiments/world/plan.hpp>

namespace thinwall {

/// What a body is called, by its id.
std::string name_in(const Scene& scene, std::uint32_t id);

Table steps_table(const Playback& playback);                       ///< a row a step
Table events_table(const Scene& scene, const Playback& playback);  ///< begins and ends, in order
Table missed_table(const Scene& scene, const Playback& playback);  ///< who went through whom
Table bodies_table(const Scene& scene, const Playback& playback);  ///< where each is at the end
Table plan_table(const Plan& plan);                                ///< what was left out, and why
Table phases_table(const Playback& playback);                      ///< time a step by phase

Figure tracks_figure(const Scene& scene, const Playback& playback);
Figure course_figure(const Playback& playback);

/// Everything a run of a scene hands over but the trace.
Outcome scene_outcome(const Scene& scene, const Plan& plan, const Playback& playback);

/// True if what this policy claims held: one that looks at all of the motion misses nothing.
bool claims_held(const Scene& scene, const Playback& playback);

}  // namespace thinwall
