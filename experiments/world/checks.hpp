#pragma once
/// What no world can hold, by name.

#include <vector>

#include <thinwall/experiments/world/world.hpp>

namespace thinwall {

/// [m] A coordinate beyond this has left the representable world: boxes and sweeps add up a few of them.
inline constexpr double end_of_the_world = std::numeric_limits<double>::max() / 1024;

/// True if the shape's fields are so small that a step's sums of them do not overflow. False for NaN.
bool is_in_the_world(const AnyShape& shape, const Vec3<double>& displacement);

/// Throws WorldError.
void require_valid(const Body& body);
void require_valid(const WorldOptions& options);

/// The same bodies in the order of ids. Throws WorldError.
std::vector<Body> checked_and_sorted(std::vector<Body> bodies);

}  // namespace thinwall
