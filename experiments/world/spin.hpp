#pragma once
/// Bodies that turn: how far within a step, what resists it, and how the two are asked when they meet.

#include <type_traits>

#include <thinwall/experiments/world/world.hpp>
#include <thinwall/swept/turning/turning_bounds.hpp>
#include <thinwall/swept/turning/turning_impact.hpp>

namespace thinwall {

// ---- Which bodies turn: a ball looks the same however it does, and its normals pass through its center.

template <class A>
inline constexpr bool looks_turned = std::is_same_v<A, Obb<double>> || std::is_same_v<A, Capsule<double>>;

/// True if its orientation can change in a step, for anyone to see.
inline bool can_turn(const Body& body) {
  return body.turns && can_move(body) && !std::holds_alternative<Sphere<double>>(body.shape);
}

/// How a body turns within a step, beside its motion: at what rate, and how far it has at that motion's `anchor`.
struct Spin {
  Vec3<double> velocity = Vec3<double>::Zero();    ///< [rad/s] about its center, constant until the next contact
  Mat3<double> turned = Mat3<double>::Identity();  ///< from the start of the step to the anchor
  int looks = 0;                                   ///< at contacts that it was in already
};

/// The spin of body `which`, or nothing if it cannot turn. `spins`: one a body, or none at all where nothing turns.
template <class Spins> auto spin_of(Spins& spins, const Body& body, std::size_t which) -> decltype(spins.data()) {
  return !spins.empty() && can_turn(body) ? &spins[which] : nullptr;
}

/// The shape turned about its center, its axes made true again and its length kept: else rounding would add up from step to step.
AnyShape turned_true(const AnyShape& shape, const Mat3<double>& turn);

// ---- What resists: the inertia of a solid of uniform density.

/// [m^2] The squared radii of gyration about the center: one along each axis. Times the mass they are moments of inertia.
/// Source: the sphere, box, cylinder and hemisphere of any table; a capsule is added up in docs/world.md.
struct Gyration {
  Mat3<double> axes = Mat3<double>::Identity();  ///< unit columns
  Vec3<double> squares = Vec3<double>::Zero();
};
Gyration gyration_of(const AnyShape& shape);

/// [1/(kg m^2)] What a unit of angular momentum does to the angular velocity of a body with this shape. Zero about an axis about which it
/// has no extent, for none can be had there, and for a body that nothing moves.
Mat3<double> inverse_inertia(const AnyShape& shape, double inverse_mass);

/// [J]
long double energy_of_turning(const Body& body);

/// [m] How far the farthest point of it is from its center.
double farthest_point(const AnyShape& shape);

// ---- How two are asked.

/// What a world asks of those that turn: never late, and as near to the exact time as costs no more than a few looks.
inline constexpr ConservativeAdvancement<double> spin_sweep = {.tolerance = 0x1p-40, .max_evaluations = 4096};

/// A straight motion that turns as well, if such a shape can.
template <class A> auto spinning(const Moving<A>& m, const Vec3<double>& rotation) {
  if constexpr (looks_turned<A>) {
    return Turning<A>{m.shape, m.displacement, rotation};
  } else {
    return without_spin(m);
  }
}

}  // namespace thinwall
