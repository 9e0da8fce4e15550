#pragma once
/// What theory expects of a cell. Derived in docs/tunneling_theory.md.

#include <optional>

#include <thinwall/experiments/thin_wall/model.hpp>
#include <thinwall/experiments/tunneling_theory.hpp>

namespace thinwall {

struct Theory {
  std::optional<double> probability;   ///< of tunneling
  std::optional<Lateness> lateness;    ///< [m] along the path, of the detected
  std::optional<double> latest;        ///< [m] the most there can be, where nothing is said of its mean
  double widest = 0;                   ///< [m] how far from the wall a detection may be, rounding aside
  std::optional<double> through = {};  ///< of a bounce: of tunneling or being pushed out on the wrong side
  const char* why = "";                ///< of an infinite wall: the formula of the probability, in the letters of docs/
  const char* why_late = "";           ///< ... and of the largest lateness

  std::optional<double> largest_lateness() const { return lateness ? std::optional(lateness->largest) : latest; }
};

Theory pose_theory(const Cell& cell, int poses_per_step);
Theory center_ray_theory(const Cell& cell);
Theory swept_volume_ray_theory(const Cell& cell);
Theory confirmed_ray_theory(const Cell& cell);
Theory speculative_theory(const Cell& cell);
Theory early_theory(const Cell& cell, double tolerance);  ///< [1] of a step: detects so much before contact at most
Theory late_theory(const Cell& cell, double tolerance);   ///< [1] of a step: detects so much after contact at most
Theory exact_theory();

}  // namespace thinwall
