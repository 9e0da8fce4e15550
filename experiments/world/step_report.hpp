#pragma once
/// What a step did and what it cost.

#include <cstddef>
#include <cstdint>

#include <thinwall/discrete/scalar.hpp>

namespace thinwall {

/// Two bodies in contact during a step.
struct Hit {
  std::uint32_t first = 0, second = 0;         ///< ids, first < second
  double time = 0;                             ///< [s] since the world began
  bool at_start = false;                       ///< in contact at the start of the step already
  Vec3<double> normal = Vec3<double>::Zero();  ///< unit, from first to second
  Vec3<double> point = Vec3<double>::Zero();   ///< [m] where they touch
};

/// [s] of wall clock, by phase.
struct PhaseSeconds {
  double integrate = 0;  ///< velocities and boxes
  double broad = 0;      ///< pairs whose boxes meet
  double narrow = 0;     ///< sweeps, or tests at an instant
  double response = 0;   ///< impulses, what they change later in the step, and the correction
  double events = 0;     ///< begin, stay, end; the listeners
  double total() const { return integrate + broad + narrow + response + events; }
};

/// All but the seconds and the bytes are the same in every run.
struct StepReport {
  std::uint64_t step = 0;    ///< 1 for the first
  double time = 0;           ///< [s] at its end
  std::size_t pairs = 0;     ///< that the broad phase handed over; substeps add up
  std::size_t sweeps = 0;    ///< pairs asked, those after a hit included
  std::size_t gated = 0;     ///< of these: tested at an instant because both moved less than the gate
  std::size_t hits = 0;      ///< contacts, each with its time
  std::size_t impulses = 0;  ///< exchanged
  std::size_t waiting = 0;   ///< bodies that stopped early: clamped, or out of events
  std::size_t bytes = 0;     ///< [B] held for stepping, bodies not included
  PhaseSeconds seconds;
};

}  // namespace thinwall
