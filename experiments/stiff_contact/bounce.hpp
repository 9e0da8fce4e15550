#pragma once
/// A ball flies at a wall that pushes it with a spring and a damper, and is followed until it leaves.
/// Contact is the library's: `contact` at the poses, `time_of_impact` between them.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include <thinwall/experiments/stiff_contact/scheme.hpp>

namespace thinwall {

enum class Detection {
  discrete,   ///< a step pushes if the ball touches at its start, so contact begins late by the phase
  toi_split,  ///< a step that meets the wall is split at the time of impact, and its rest pushes
};
inline constexpr std::array all_detections = {Detection::discrete, Detection::toi_split};
std::string_view name(Detection detection);

/// What flies at what.
struct Approach {
  double mass;       ///< [kg] > 0
  double speed;      ///< [m/s] > 0, straight at the wall
  double radius;     ///< [m] >= 0
  double thickness;  ///< [m] >= 0, of the wall; radius + thickness > 0
  double blow_up;    ///< [incoming speeds] > 1: a run that gets this fast has blown up
};

/// How the contact is computed.
struct PenaltyContact {
  Scheme scheme;
  Detection detection;
  double stiffness;      ///< [N/m] > 0
  double damping_ratio;  ///< [1] >= 0
  double step;           ///< [1/omega] > 0
};

/// [m] How far the center is from the middle of the wall at first contact. Past the middle, the wall pushes it on.
double reach(const Approach& e);
Spring spring_of(const Approach& e, const PenaltyContact& c);
double seconds(const Approach& e, const PenaltyContact& c);  ///< [s] a step

enum class Ending {
  returned,    ///< left on the side it came from
  escaped,     ///< left on the other
  unfinished,  ///< it rests there, or is there after 1024 + 64 (1 + zeta) / step steps, or is no finite number
};

struct Bounce {
  Ending ending;
  double speed;                ///< [incoming speeds] >= 0, at the end; 0 if unfinished
  double deepest;              ///< [m] past the front face, at a pose (or the time of impact)
  std::int64_t contact_steps;  ///< steps in which the wall was asked for a force
  std::int64_t blow_up_step;   ///< the first after which it was too fast; 0 if none
};

/// The ball starts `phase` in [0, 1) of a step before first contact. Nothing in here is NaN.
Bounce bounce(const Approach& e, const PenaltyContact& c, double phase);

}  // namespace thinwall
