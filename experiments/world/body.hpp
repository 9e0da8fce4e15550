#pragma once
/// What a world is made of: a body has a shape, or none, and moves without turning.

#include <cstdint>
#include <limits>
#include <string>
#include <variant>

#include <thinwall/capsule/capsule.hpp>
#include <thinwall/discrete/sphere.hpp>

namespace thinwall {

/// A shape that every other of the list can meet, or none.
using AnyShape = std::variant<std::monostate, Sphere<double>, Aabb<double>, Obb<double>, Capsule<double>>;

/// Two bodies meet only if each belongs to a group that the other's mask has: (a.group & b.mask) and (b.group & a.mask).
struct Body {
  std::uint32_t id = 0;                          ///< no two bodies share one; decides every order
  std::string name;                              ///< empty: `body ID`
  AnyShape shape;                                ///< [m] where it is; std::monostate collides with nothing
  Vec3<double> velocity = Vec3<double>::Zero();  ///< [m/s] of the whole body; zero if it is static
  double mass = 1;                               ///< [kg] > 0; infinity: moves at its velocity, and nothing changes it
  bool is_static = false;                        ///< stays where it is, whatever its mass
  double restitution = 0;                        ///< [1] in [0, 1]; of two bodies in contact the larger one counts
  double gravity_scale = 1;                      ///< [1] times the world's gravity; of no effect without a finite mass
  std::uint32_t group = 1;                       ///< bits it belongs to
  std::uint32_t mask = ~std::uint32_t{0};        ///< bits it may meet
};

/// [1/kg] What an impulse does to it: 0 for a body that nothing moves.
inline double inverse_mass(const Body& body) { return body.is_static ? 0 : 1 / body.mass; }

/// True if its place can change in a step.
inline bool can_move(const Body& body) { return !body.is_static; }

/// [m] The point that its contact data is relative to; zero without a shape.
Vec3<double> position(const Body& body);

/// What complaints and the log call it: `bullet (id 3)`.
std::string called(const Body& body);

}  // namespace thinwall
