#pragma once
/// The bodies that a scene file describes.

#include <cstdint>
#include <vector>

#include <thinwall/experiments/settings.hpp>
#include <thinwall/experiments/world/body.hpp>

namespace thinwall {

/// What a scene may say of a length [m], a speed [m/s], an acceleration [m/s^2] or a mass [kg]: within the longest run no place
/// leaves the world, and no energy the range of doubles.
inline constexpr double most_of_a_scene = 1e30;
inline constexpr Range scene_coordinate = {.lower = -most_of_a_scene, .upper = most_of_a_scene, .unit = "m"};
inline constexpr Range scene_speed = {.lower = -most_of_a_scene, .upper = most_of_a_scene, .unit = "m/s"};

/// Every [[body]] of the file, copies made: a grid, and random numbers that depend on the seed, on the body's own place,
/// size and grid, and on the copy's place in it alone. Ids count up from 1, in the order of the file.
/// Throws UsageError: a key out of range, missing, or not of the shape; more than two million bodies.
std::vector<Body> read_bodies(const Settings& scene, std::uint64_t seed);

/// [m] From face to face. Zero without a shape.
Vec3<double> size_of(const Body& body);

/// [m] The closed box that holds it where it is, not rounded. Empty extents without a shape.
Aabb<double> box_of(const Body& body);

}  // namespace thinwall
