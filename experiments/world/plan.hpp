#pragma once
/// What a scene needs, decided from the scene alone. A plan omits only what it proves to yield nothing: with or without
/// it every outcome is the same to the bit (docs/world.md says why, the tests show it).

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <thinwall/experiments/world/body.hpp>
#include <thinwall/experiments/world/options.hpp>

namespace thinwall {

/// One thing that a step might do.
struct PlanLine {
  std::string what;      ///< `static pairs`
  bool omitted = false;  ///< it is left out
  std::string why;       ///< the proof, or why it is needed, in numbers of the scene
};

struct Plan {
  bool full = false;            ///< nothing is omitted
  std::string broad_phase;      ///< its name
  bool sphere_aabb = false;     ///< the kernels of spheres and axis-aligned boxes alone
  bool all_bounds = false;      ///< every two bodies are asked, whatever their boxes
  bool static_pairs = false;    ///< pairs of two static bodies are asked, and what they find is dropped
  bool masked_pairs = false;    ///< the same for pairs that a mask leaves out
  bool resting_bounds = false;  ///< boxes and places of bodies that never move are computed anew in each step
  bool contacts = false;        ///< pairs are looked for at all
  bool events = false;          ///< begin, stay and end are kept, be it for nobody
  bool response = false;        ///< impulses are computed, be it to drop them
  std::vector<PlanLine> lines;  ///< the same for people
};

/// Throws what World's constructor throws for the same scene.
Plan plan(std::span<const Body> bodies, const WorldOptions& options);

/// What a plan may omit: the `what` of its lines, in their order.
std::span<const std::string_view> omission_names();

/// What it omits, what it keeps, and why; ends with a newline.
std::string to_text(const Plan& plan);

}  // namespace thinwall
