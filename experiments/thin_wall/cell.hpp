#pragma once
/// One physical condition of the thin wall experiment: a ball that flies straight at a wall, in steps.
/// The wall's front faces -x, its side runs along y and z, and the ball flies in the plane of x and y.

#include <cstdint>
#include <string>
#include <string_view>

#include <thinwall/experiments/random.hpp>
#include <thinwall/experiments/tunneling_theory.hpp>

namespace thinwall {

enum class Wall { infinite, finite };

struct Cell {
  double speed;      ///< [m/s] > 0
  double step;       ///< [s] > 0
  double radius;     ///< [m] >= 0; not both 0 with thickness
  double thickness;  ///< [m] >= 0
  double angle_deg;  ///< [deg] in [0, 90), between the motion and the wall's normal
  Wall wall;
  double wall_size;  ///< [m] side of the square wall; 0 if it is infinite

  bool operator==(const Cell&) const = default;
};

constexpr std::string_view name(Wall wall) { return wall == Wall::infinite ? "infinite" : "finite"; }
std::string key(const Cell& cell);  ///< one line, for people and the journal

double step_length(const Cell& cell);      ///< [m] s = speed * step
double cosine(const Cell& cell);           ///< [1] of the angle of incidence, > 0
Vec3<double> direction(const Cell& cell);  ///< unit
double slab_chord(const Cell& cell);       ///< [m] (w + 2 r) / cosine: in contact with the wall's plane
RoundedBox rounded_box(const Cell& cell);  ///< of a finite wall
RandomStream random_stream(const Cell& cell, std::uint64_t seed);  ///< from the physical factors alone

}  // namespace thinwall
