#include <thinwall/experiments/models/tunneling_theory.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace thinwall {

namespace {

constexpr double pi = std::numbers::pi;

/// The area of the box's face across the axis.
double face(const Vec3<double>& half_extents, int axis) {
  return 4 * half_extents[(axis + 1) % 3] * half_extents[(axis + 2) % 3];
}

}  // namespace

double miss_probability(double chord, double spacing) { return std::max(0.0, 1 - chord / spacing); }

/// The integral of 1 / cos from 0 is ln tan(pi/4 + a/2), and beyond the angle whose cosine is depth / spacing nothing is missed.
double mean_miss_probability(double depth, double spacing, double angle_deg) {
  const double share = depth / spacing;
  if (share >= 1) return 0;
  const double most = angle_deg * (pi / 180);
  if (most < 1e-6) return miss_probability(depth, spacing);
  const double a = std::min(most, std::acos(share));
  return (a - share * std::log(std::tan(pi / 4 + a / 2))) / most;
}

double slab_chord(double thickness, double radius, double cosine) { return (thickness + 2 * radius) / cosine; }

double volume(const RoundedBox& box) {
  const Vec3<double> edges = 2 * box.half_extents;
  const double r = box.radius;
  const double faces = face(box.half_extents, 0) + face(box.half_extents, 1) + face(box.half_extents, 2);
  return edges.prod() + 2 * r * faces + pi * r * r * edges.sum() + 4 * pi / 3 * r * r * r;
}

double shadow(const RoundedBox& box, const Vec3<double>& direction) {
  double area = 0, perimeter = 0;
  for (int i = 0; i < 3; ++i) {
    area += std::abs(direction[i]) * face(box.half_extents, i);
    perimeter += 4 * box.half_extents[i] * std::sqrt(std::max(0.0, 1 - direction[i] * direction[i]));
  }
  return area + box.radius * perimeter + pi * box.radius * box.radius;
}

double longest_chord(const RoundedBox& box, const Vec3<double>& direction) {
  const auto fits = [&](double length) {  // some chord has this length: its vector is a difference of two points
    const Vec3<double> beyond = (length * direction.cwiseAbs() - 2 * box.half_extents).cwiseMax(0.0);
    return beyond.norm() <= 2 * box.radius;
  };
  double lower = 0, upper = 4 * (box.half_extents.norm() + box.radius);
  for (double middle = upper / 2; lower < middle && middle < upper; middle = (lower + upper) / 2) {
    (fits(middle) ? lower : upper) = middle;
  }
  return lower;
}

std::optional<double> miss_probability(const RoundedBox& box, const Vec3<double>& direction, double spacing) {
  if (spacing < longest_chord(box, direction)) return std::nullopt;
  return 1 - volume(box) / (spacing * shadow(box, direction));
}

std::optional<double> unturned_probability(const RoundedBox& box, const Vec3<double>& direction, double spacing) {
  if (spacing < longest_chord(box, direction)) return std::nullopt;
  const double h = box.half_extents[0], side = box.half_extents[1];
  // Where the shortest way out is to a side: over that face, and in the roof of the box below it. Head-on the other two
  // sides do the same, and so do the four edges between them.
  const double beside = 2 * (box.radius * 4 * h * side + 4 * (side * h * h / 2 - h * h * h / 6));
  const double across = direction[1] == 0 ? 2 * beside + pi * box.radius * box.radius * 2 * h : beside;
  return 1 - (volume(box) - across) / (2 * spacing * shadow(box, direction));
}

std::optional<double> center_ray_miss_probability(const RoundedBox& box, double step) {
  const double chord = 2 * (box.half_extents[0] + box.radius);
  if (step < chord) return std::nullopt;
  const double seen = face(box.half_extents, 0), all = shadow(box, {1, 0, 0});
  return ((all - seen) - (volume(box) - seen * chord) / step) / all;
}

Lateness pose_lateness(double chord, double spacing) {
  const double largest = std::min(spacing, chord);
  return {largest / 2, largest / std::sqrt(12.0), largest};
}

Lateness center_ray_lateness(double lead, double step) {
  if (lead >= step) return pose_lateness(lead, step);  // the step always ends first
  const double share = lead / step;
  return {lead * (1 - share / 2), lead * std::sqrt(share / 3 - share * share / 4), lead};
}

}  // namespace thinwall
